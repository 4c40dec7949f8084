#pragma once
// Whether steps take less time with all threads or with one, found by trial now and then. A step of a small body takes
// some ten microseconds, and where cores share no cache, or other programs use them, what its threads read of each
// other costs more than they save. The accounts of ThreadTeam cannot see that: it makes the serial part slower too.
//
//   steps:   | all | one | all | one |  the faster of them, for some thousand steps  | all | one | ...
//
// The bits of a step do not depend on it.
#include <algorithm>
#include <chrono>
#include <heml/base/thread_team.hpp>
#include <limits>

namespace heml {

class ThreadTrial {
 public:
  static constexpr int block = 32;      ///< steps of one kind in a row
  static constexpr int unmeasured = 8;  ///< the first of a block, before which workers may have fallen asleep
  static constexpr int trial = 4 * block;
  static constexpr int held = 8192;  ///< steps until the next trial, which costs 1 % of them where threads halve a step
  static constexpr double gain = 0.97;          ///< threads that save less than the rest leave their cores to others
  static constexpr double short_step = 100e-6;  ///< s; no trial of longer steps, which are worth their threads

  /// Whether the next step shall use all threads.
  bool uses_all() const { return is_measuring() ? step_ / block % 2 == 0 : all_are_faster_; }
  /// Whether its time matters.
  bool is_measuring() const { return step_ < trial; }

  /// The step is done; seconds: its time, if it matters.
  void took(double seconds) {
    if (is_measuring()) {
      const bool all = uses_all();
      if (step_ % block >= unmeasured) sum_ += seconds;
      if (step_ % block == block - 1) end_block(all);
    }
    if (++step_ >= trial + held) step_ = 0;
  }

 private:
  void end_block(bool all) {
    double& fastest = all ? fastest_all_ : fastest_one_;
    if (step_ < 2 * block) fastest = std::numeric_limits<double>::max();  // of this trial
    fastest = std::min(fastest, sum_);
    sum_ = 0;
    if (step_ + 1 == block && fastest_all_ > (block - unmeasured) * short_step) {
      all_are_faster_ = true;
      step_ = trial - 1;
    } else if (step_ + 1 == trial) {
      all_are_faster_ = fastest_all_ < gain * fastest_one_;
    }
  }

  int step_ = 0;  ///< since the trial began
  bool all_are_faster_ = true;
  double sum_ = 0;                            ///< s, of the block
  double fastest_all_ = 0, fastest_one_ = 0;  ///< s, of the blocks of the trial
};

/// Lasts as long as one step of a trial: limits the team to its threads, and takes its time.
class StepOnTrial {
 public:
  using Clock = std::chrono::steady_clock;
  StepOnTrial(ThreadTrial& trial, ThreadTeam& team) : trial_(trial), team_(team), threads_(team.limit()) {
    if (threads_ <= 1) return;
    if (!trial_.uses_all()) team_.limit(1);
    if (trial_.is_measuring()) began_ = Clock::now();
  }
  ~StepOnTrial() {
    if (threads_ <= 1) return;
    team_.limit(threads_);
    trial_.took(trial_.is_measuring() ? std::chrono::duration<double>(Clock::now() - began_).count() : 0);
  }
  StepOnTrial(const StepOnTrial&) = delete;
  StepOnTrial& operator=(const StepOnTrial&) = delete;

 private:
  ThreadTrial& trial_;
  ThreadTeam& team_;
  int threads_;
  Clock::time_point began_{};
};

}  // namespace heml
