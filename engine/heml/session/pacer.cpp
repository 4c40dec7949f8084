#include <algorithm>
#include <heml/session/pacer.hpp>

namespace heml {
namespace {
double seconds(Pacer::Clock::duration d) { return std::chrono::duration<double>(d).count(); }
constexpr std::size_t marks_kept = 16, durations_kept = 1000;
}  // namespace

Pacer::Pacer(double tick) : tick_(tick) { durations_.reserve(durations_kept); }

Pacer::Time Pacer::at(long tick) const {
  return base_ +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(static_cast<double>(tick) * tick_));
}

void Pacer::restart(Time now) {
  base_ = now;
  done_ = 0;
  marks_.assign(1, {now, total_});
  next_mark_ = 1;
}

void Pacer::set_tick(double tick, Time now) {
  tick_ = tick;
  durations_.clear();
  next_duration_ = 0;
  restart(now);
}

void Pacer::book(Time began, Time ended) {
  ++done_;
  ++total_;
  if (ended > at(done_)) ++missed_;
  if (seconds(ended - at(done_)) > patience) {
    base_ = ended;
    done_ = 0;
  }
  const float duration = static_cast<float>(seconds(ended - began));
  if (durations_.size() < durations_kept)
    durations_.push_back(duration);
  else
    durations_[next_duration_] = duration;
  next_duration_ = (next_duration_ + 1) % durations_kept;
  const Mark& last = marks_[(next_mark_ + marks_kept - 1) % marks_kept];
  if (seconds(ended - last.wall) < window / marks_kept) return;
  if (marks_.size() < marks_kept)
    marks_.push_back({ended, total_});
  else
    marks_[next_mark_] = {ended, total_};
  next_mark_ = (next_mark_ + 1) % marks_kept;
}

Pace Pacer::pace(Time now) const {
  Pace pace;
  pace.rate = 1 / tick_;
  pace.missed = missed_;
  if (!durations_.empty()) {
    std::vector<float> sorted = durations_;
    std::sort(sorted.begin(), sorted.end());
    pace.p50 = static_cast<double>(sorted[sorted.size() / 2]);
    pace.p99 = static_cast<double>(sorted[std::min(sorted.size() - 1, sorted.size() * 99 / 100)]);
  }
  if (marks_.empty()) return pace;
  const Mark& oldest = marks_.size() < marks_kept ? marks_.front() : marks_[next_mark_];
  const double wall = seconds(now - oldest.wall), simulated = static_cast<double>(total_ - oldest.ticks) * tick_;
  if (wall > window / marks_kept) pace.slowdown = simulated > 0 ? wall / simulated : 1e9;
  pace.keeping_up = pace.slowdown < 1.1;
  return pace;
}

}  // namespace heml
