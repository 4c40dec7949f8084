#include <doctest/doctest.h>

#include <heml/math/ramp.hpp>
#include <utility>

namespace heml::ramp_test {

TEST_CASE("ramp: grows from its start, stays before and after, and is whole at all times without duration") {
  const Ramp late{2, 4};
  for (const auto& [time, value] : {std::pair(0.0, 0.0), {2.0, 0.0}, {3.0, 0.25}, {6.0, 1.0}, {9.0, 1.0}})
    CHECK(late(time) == value);
  CHECK(late.is_growing(5.9));
  CHECK_FALSE(late.is_growing(6));
  const Ramp at_once{2, 0};
  CHECK(at_once(0) == 1);
  CHECK_FALSE(at_once.is_growing(0));
}

}  // namespace heml::ramp_test
