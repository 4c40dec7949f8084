#include <doctest/doctest.h>

#include <heml/base/log.hpp>
#include <heml/base/warning_collector.hpp>
#include <thread>

namespace heml::warning_collector_test {

TEST_CASE("warnings of a thread are collected, also by an outer collector, and nothing else is") {
  const WarningCollector outer;
  warn("one {}", 1);
  log_info("progress");
  {
    const WarningCollector inner;
    warn("two");
    std::thread([] { warn("elsewhere"); }).join();
    CHECK(inner.texts() == std::vector<std::string>{"two"});
  }
  warn("three");
  CHECK(outer.texts() == std::vector<std::string>{"one 1", "two", "three"});
}

}  // namespace heml::warning_collector_test
