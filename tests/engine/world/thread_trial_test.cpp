#include <doctest/doctest.h>

#include <heml/world/thread_trial.hpp>

namespace heml::thread_trial_test {

/// Steps that take these times; returns how many of `count` used all threads.
int play(ThreadTrial& trial, int count, double all, double one) {
  int used = 0;
  for (int k = 0; k < count; ++k) {
    used += trial.uses_all();
    trial.took(trial.uses_all() ? all : one);
  }
  return used;
}

TEST_CASE("thread trial: the faster kind is kept until the next trial") {
  for (const bool all_are_faster : {true, false}) {
    CAPTURE(all_are_faster);
    ThreadTrial trial;
    const double all = all_are_faster ? 10e-6 : 20e-6, one = 15e-6;
    CHECK(play(trial, ThreadTrial::trial, all, one) == ThreadTrial::trial / 2);
    CHECK_FALSE(trial.is_measuring());
    CHECK(play(trial, ThreadTrial::held, all, one) == (all_are_faster ? ThreadTrial::held : 0));
    CHECK(trial.is_measuring());
    // What holds may change.
    CHECK(play(trial, ThreadTrial::trial, 25e-6 - all, one) == ThreadTrial::trial / 2);
    CHECK(trial.uses_all() == !all_are_faster);
  }
}

TEST_CASE("thread trial: a gain too small to be worth a core is none") {
  ThreadTrial trial;
  play(trial, ThreadTrial::trial, 0.98 * 15e-6, 15e-6);
  CHECK_FALSE(trial.uses_all());
}

TEST_CASE("thread trial: one pause in one block decides nothing") {
  for (const int step : {20, 40, 80, 120}) {
    CAPTURE(step);
    ThreadTrial trial;
    play(trial, step, 10e-6, 15e-6);
    trial.took(4e-3);
    play(trial, ThreadTrial::trial - step - 1, 10e-6, 15e-6);
    CHECK_FALSE(trial.is_measuring());
    CHECK(trial.uses_all());
  }
}

TEST_CASE("thread trial: long steps use all threads from the first on") {
  ThreadTrial trial;
  CHECK(play(trial, 2 * ThreadTrial::held, 1e-3, 0.5e-3) == 2 * ThreadTrial::held);
}

TEST_CASE("thread trial: a step on trial leaves the team as it was") {
  ThreadTeam team(3);
  team.limit(2);
  ThreadTrial trial;
  int alone = 0;
  for (int k = 0; k < ThreadTrial::trial; ++k) {
    const StepOnTrial on_trial(trial, team);
    alone += team.limit() == 1;
    CHECK((team.limit() == 1 || team.limit() == 2));
  }
  CHECK(alone == ThreadTrial::trial / 2);
  CHECK(team.limit() == 2);

  // With one thread there is nothing to try.
  team.limit(1);
  ThreadTrial none;
  for (int k = 0; k < ThreadTrial::trial; ++k) const StepOnTrial on_trial(none, team);
  CHECK(none.is_measuring());
  CHECK(none.uses_all());
}

}  // namespace heml::thread_trial_test
