#include <algorithm>
#include <heml/session/pacer.hpp>
#include <vector>

namespace heml {
namespace {

constexpr double shortest_window = 1.0 / 16;  // s: over a shorter time the slowdown would be chance

double seconds(Pacer::Clock::duration d) { return std::chrono::duration<double>(d).count(); }

double percentile(std::vector<float>& values, std::size_t percent) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * percent / 100);
  std::nth_element(values.begin(), place, values.end());
  return static_cast<double>(*place);
}

}  // namespace

Pacer::Time Pacer::at(long tick) const {
  return base_ +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(static_cast<double>(tick) * tick_));
}

void Pacer::restart(Time now) {
  base_ = window_began_ = now;
  done_ = 0;
  ticks_.clear();
}

void Pacer::set_tick(double tick, Time now) {
  tick_ = tick;
  restart(now);
}

void Pacer::book(Time began, Time ended) {
  ++done_;
  if (ended > at(done_)) ++missed_;
  if (seconds(ended - at(done_)) > patience) {
    base_ = ended;
    done_ = 0;
  }
  keep(began, ended);
}

void Pacer::book_unscheduled(Time began, Time ended) {
  base_ = ended;
  done_ = 0;
  keep(began, ended);
}

void Pacer::keep(Time began, Time ended) {
  ticks_.push_back({ended, static_cast<float>(seconds(ended - began))});
  for (; seconds(ended - ticks_.front().ended) > window; ticks_.pop_front()) window_began_ = ticks_.front().ended;
}

Pace Pacer::pace() const {
  Pace pace;
  pace.rate = 1 / tick_;
  pace.missed = missed_;
  if (ticks_.empty()) return pace;
  std::vector<float> durations;
  durations.reserve(ticks_.size());
  for (const Tick& tick : ticks_) durations.push_back(tick.duration);
  pace.p50 = percentile(durations, 50);
  pace.p99 = percentile(durations, 99);
  const double wall = seconds(ticks_.back().ended - window_began_);
  if (wall > shortest_window) pace.slowdown = wall / (static_cast<double>(ticks_.size()) * tick_);
  pace.keeping_up = pace.slowdown < 1.1;
  return pace;
}

}  // namespace heml
