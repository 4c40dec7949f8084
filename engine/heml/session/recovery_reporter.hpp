#pragma once
// Tells of recoveries and of ticks that did not converge, in the log, and keeps a recording of the last recovery.
#include <heml/scenario/recovery_monitor.hpp>
#include <string>

namespace heml {

class RecoveryReporter {
 public:
  /// file: where the recording is kept; empty: nowhere.
  explicit RecoveryReporter(std::filesystem::path file) : file_(std::move(file)) {}

  bool keeps_recording() const { return !file_.empty(); }
  /// Of the last recovery; empty: none was written.
  const std::string& written() const { return written_; }

  /// Call after every tick. scene, history: of write_replay().
  void ticked(const World& world, const Scene& scene, std::span<const Event> history);

 private:
  void write(const World& world, const Scene& scene, std::span<const Event> history, bool say);
  void report_rescue(const World& world);

  std::filesystem::path file_;
  std::string written_;
  RecoveryMonitor monitor_;
  bool rescue_reported_ = false;
};

}  // namespace heml
