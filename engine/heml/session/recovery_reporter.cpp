#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/session/recovery_reporter.hpp>

namespace heml {

/// Logs a recovery when it begins and ends, and writes the recording.
void RecoveryReporter::ticked(const World& world, const Scene& scene, std::span<const Event> history) {
  report_rescue(world);
  const auto news = monitor_.after_tick(world);
  if (news == RecoveryMonitor::Change::none) return;
  const Recovery& recovery = *world.recovery();
  if (news == RecoveryMonitor::Change::began)
    warn("{}", recovery.message);
  else
    log_info("the body came back after {} steps, {:.3g} s", recovery.steps, recovery.ended->time - recovery.begun.time);
  write(world, scene, history, news == RecoveryMonitor::Change::began);
}

/// Logs the first tick that did not converge; the panel counts them.
void RecoveryReporter::report_rescue(const World& world) {
  if (rescue_reported_) return;
  const std::string message = rescue_message(world.solver_stats());
  rescue_reported_ = !message.empty();
  if (rescue_reported_) warn("{} at t = {:.6g} s (the panel counts them)", message, world.time());
}

void RecoveryReporter::write(const World& world, const Scene& scene, std::span<const Event> history, bool say) try {
  if (file_.empty() || world.halt() || world.unfinished()) return;
  std::error_code ignored;
  std::filesystem::create_directories(file_.parent_path(), ignored);
  write_replay(file_, scene, history, world);
  written_ = file_.string();
  if (say) log_info("{} shows it again", written_);
} catch (const InputError& error) {
  warn("{}", error.what());
  file_.clear();
}

}  // namespace heml
