#include <algorithm>
#include <chrono>
#include <cmath>
#include <studies/interleaved_timing.hpp>

namespace heml {
namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double seconds_of(const std::function<void()>& work, long runs) {
  const double began = now();
  for (long k = 0; k < runs; ++k) work();
  return now() - began;
}

/// Number of runs that make a sample of `shortest` s. Also warms up.
long runs_of_sample(const std::function<void()>& work, double shortest) {
  work();
  long runs = 1;
  for (;;) {
    const double taken = seconds_of(work, runs);
    if (taken >= shortest) return runs;
    runs = std::max(runs + 1, static_cast<long>(std::ceil(1.2 * static_cast<double>(runs) * shortest /
                                                          std::max(taken, shortest / 100))));
  }
}

}  // namespace

Timing summary(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const std::size_t count = samples.size();
  const double median = (samples[(count - 1) / 2] + samples[count / 2]) / 2;
  return {median, samples.front(), samples.back(), (samples[3 * (count - 1) / 4] - samples[(count - 1) / 4]) / median,
          static_cast<int>(count)};
}

std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& works, const TimingLimits& limits) {
  std::vector<long> runs;
  for (const auto& work : works) runs.push_back(runs_of_sample(work, limits.min_sample));
  std::vector<std::vector<double>> samples(works.size());
  const double until = now() + limits.seconds;
  for (int round = 0; round < limits.min_rounds || (round < limits.max_rounds && now() < until); ++round)
    for (std::size_t w = 0; w < works.size(); ++w)
      samples[w].push_back(seconds_of(works[w], runs[w]) / static_cast<double>(runs[w]));
  std::vector<Timing> result;
  for (auto& of_work : samples) result.push_back(summary(std::move(of_work)));
  return result;
}

}  // namespace heml
