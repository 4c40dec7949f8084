#include <doctest/doctest.h>

#include <heml/session/pacer.hpp>

namespace heml::pacer_test {

using namespace std::chrono_literals;

namespace {
const Pacer::Time start{100s};

/// Runs ticks that take `work` each, sleeping until due in between, for `wall`; returns ticks done.
long run(Pacer& pacer, Pacer::Time& now, Pacer::Clock::duration work, Pacer::Clock::duration wall) {
  long ticks = 0;
  for (const auto end = now + wall; now < end; ++ticks) {
    now = std::max(now, pacer.due());
    pacer.book(now, now + work);
    now += work;
  }
  return ticks;
}
}  // namespace

TEST_CASE("an engine that is fast enough runs in real time and misses nothing") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  CHECK(run(pacer, now, 300us, 2s) == doctest::Approx(2000).epsilon(0.002));
  const Pace pace = pacer.pace();
  CHECK(pace.missed == 0);
  CHECK(pace.slowdown == doctest::Approx(1).epsilon(0.01));
  CHECK(pace.keeping_up);
  CHECK(pace.p50 == doctest::Approx(300e-6));
}

TEST_CASE("an engine three times too slow slows simulated time threefold and reports it") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 3ms, 3s);
  const Pace pace = pacer.pace();
  CHECK(pace.slowdown == doctest::Approx(3).epsilon(0.02));
  CHECK_FALSE(pace.keeping_up);
  CHECK(pace.missed > 900);
  CHECK(pace.p99 == doctest::Approx(3e-3));
}

TEST_CASE("ticks missed in a long stall are dropped, so that no burst follows") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 100us, 1s);
  run(pacer, now, 2s, 1s);  // one tick that took two seconds
  const long after = run(pacer, now, 100us, 1s);
  CHECK(after <= 1001);
  CHECK(pacer.pace().keeping_up);
}

TEST_CASE("a short delay is made up for") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 20ms, 1ms);
  CHECK(run(pacer, now, 100us, 1s) >= 1018);
}

TEST_CASE("another period counts from when it is set") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 5ms, 1s);
  CHECK_FALSE(pacer.pace().keeping_up);
  pacer.set_tick(0.1, now);
  CHECK(run(pacer, now, 5ms, 2s) == doctest::Approx(20).epsilon(0.06));
  const Pace pace = pacer.pace();
  CHECK(pace.rate == doctest::Approx(10));
  CHECK(pace.keeping_up);
  CHECK(pace.p50 == doctest::Approx(5e-3));
}

TEST_CASE("times of ticks and the slowdown are of the same second") {
  Pacer pacer(1e-2);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 40ms, 4s);
  CHECK(pacer.pace().p50 == doctest::Approx(40e-3));
  run(pacer, now, 1ms, 1500ms);
  const Pace pace = pacer.pace();
  CHECK(pace.keeping_up);
  CHECK(pace.p50 == doctest::Approx(1e-3));
  CHECK(pace.p99 == doctest::Approx(1e-3));
}

TEST_CASE("the slowdown of ticks that take seconds is that of the last one") {
  Pacer pacer(0.1);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 4s, 20s);
  run(pacer, now, 2s, 2s);
  CHECK(pacer.pace().slowdown == doctest::Approx(20));
  CHECK(pacer.pace().p50 == doctest::Approx(2));
}

TEST_CASE("time in which nothing runs, as in a pause, is no slowdown") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  run(pacer, now, 100us, 1s);
  now += 60s;
  pacer.restart(now);
  CHECK(pacer.pace().keeping_up);
  run(pacer, now, 100us, 200ms);
  CHECK(pacer.pace().slowdown == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("ticks without deadlines tell how much faster than real time they are, and the schedule goes on from them") {
  Pacer pacer(1e-3);
  auto now = start;
  pacer.restart(now);
  for (int tick = 0; tick < 20000; ++tick, now += 100us) pacer.book_unscheduled(now, now + 100us);
  CHECK(pacer.pace().slowdown == doctest::Approx(0.1).epsilon(0.01));
  CHECK(pacer.pace().p50 == doctest::Approx(100e-6));
  CHECK(pacer.pace().missed == 0);
  CHECK(run(pacer, now, 100us, 1s) == doctest::Approx(1000).epsilon(0.01));
  CHECK(pacer.pace().missed == 0);
}

}  // namespace heml::pacer_test
