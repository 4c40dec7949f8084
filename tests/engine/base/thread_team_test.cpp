#include <doctest/doctest.h>

#include <heml/base/thread_team.hpp>
#include <vector>

namespace heml::thread_team_test {

TEST_CASE("every item of a loop is visited once, whatever the number of threads") {
  for (const int threads : {1, 2, 3, 16}) {
    ThreadTeam team(threads);
    CHECK(team.size() == threads);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
      std::vector<int> visits(count, 0);
      for (int repeat = 0; repeat < 20; ++repeat)
        team.for_ranges(count, 3, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
      for (const int visit : visits) REQUIRE(visit == 20);
    }
  }
}

TEST_CASE("a loop shorter than its grain stays on the calling thread") {
  ThreadTeam team(4);
  std::size_t calls = 0;
  team.for_ranges(99, 100, [&](std::size_t begin, std::size_t end) {
    ++calls;
    CHECK(begin == 0);
    CHECK(end == 99);
  });
  CHECK(calls == 1);
}

}  // namespace heml::thread_team_test
