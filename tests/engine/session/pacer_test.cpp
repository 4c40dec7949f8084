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
  const Pace pace = pacer.pace(now);
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
  const Pace pace = pacer.pace(now);
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
  CHECK(pacer.pace(now).keeping_up);
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
  CHECK_FALSE(pacer.pace(now).keeping_up);
  pacer.set_tick(0.1, now);
  CHECK(run(pacer, now, 5ms, 2s) == doctest::Approx(20).epsilon(0.06));
  const Pace pace = pacer.pace(now);
  CHECK(pace.rate == doctest::Approx(10));
  CHECK(pace.keeping_up);
  CHECK(pace.p50 == doctest::Approx(5e-3));
}

}  // namespace heml::pacer_test
