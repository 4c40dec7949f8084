#include <doctest/doctest.h>

#include <heml/session/thread_balance.hpp>

namespace heml::thread_balance_test {

/// Number of threads after some looks, 0.5 s apart, with a constant `load` (cores) of others.
int threads_after(ThreadBalance& balance, double& wall, double& others, double load, int looks) {
  for (int k = 0; k < looks; ++k) {
    wall += 0.5;
    others += 0.5 * load;
    CHECK(balance.is_due(wall));
    balance.look(wall, others);
    CHECK_FALSE(balance.is_due(wall + 0.4));
  }
  return balance.threads();
}

TEST_CASE("if drawing uses one of two cores, stepping uses the other") {
  ThreadBalance balance(2);
  double wall = 100, others = 7;
  CHECK(threads_after(balance, wall, others, 0, 1) == 2);
  CHECK(threads_after(balance, wall, others, 0.9, 1) == 1);
  CHECK(balance.load_of_others() == doctest::Approx(0.9));
  CHECK(threads_after(balance, wall, others, 5, 3) == 1);
}

TEST_CASE("stepping takes a core back after two successive measurements find it free") {
  ThreadBalance balance(2);
  double wall = 0, others = 0;
  threads_after(balance, wall, others, 1, 3);
  CHECK(threads_after(balance, wall, others, 0.05, 1) == 1);
  CHECK(threads_after(balance, wall, others, 0.9, 1) == 1);
  CHECK(threads_after(balance, wall, others, 0.05, 1) == 1);
  CHECK(threads_after(balance, wall, others, 0.05, 1) == 2);
}

TEST_CASE("of many cores stepping uses those that drawing leaves") {
  ThreadBalance balance(16);
  double wall = 0, others = 0;
  CHECK(threads_after(balance, wall, others, 0.1, 4) == 16);
  CHECK(threads_after(balance, wall, others, 1.4, 4) == 14);
}

}  // namespace heml::thread_balance_test
