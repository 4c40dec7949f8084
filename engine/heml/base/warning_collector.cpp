#include <heml/base/warning_collector.hpp>

namespace heml {
namespace {
thread_local WarningCollector* innermost = nullptr;
}

WarningCollector::WarningCollector() : outer_(innermost) { innermost = this; }
WarningCollector::~WarningCollector() { innermost = outer_; }

void WarningCollector::add(const std::string& text) {
  for (WarningCollector* one = innermost; one; one = one->outer_) one->texts_.push_back(text);
}

}  // namespace heml
