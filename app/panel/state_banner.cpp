#include <fmt/format.h>

#include <app/panel/state_banner.hpp>

namespace heml::panel {
namespace {

constexpr float late_delay = 1;            // s of being late before the banner
constexpr float recovery_banner_time = 5;  // s that the banner stays after a recovery

}  // namespace

void StateBanner::update(const Frame& frame, float seconds) {
  since_recovery_ += seconds;
  if (!frame.recovery) since_recovery_ = recovery_banner_time;
  if (frame.recovery && (!frame.recovery->ended || frame.recovery->tick != recovery_seen_)) {
    recovery_seen_ = frame.recovery->tick;
    since_recovery_ = 0;
  }
  late_for_ = frame.paused || frame.pace.keeping_up ? 0 : late_for_ + seconds;
}

bool StateBanner::shows_recovery() const { return since_recovery_ < recovery_banner_time; }

std::optional<Banner> StateBanner::choose(const Frame& frame, Integrator integrator, int budget,
                                          const std::optional<Area>& beside) {
  if (!frame.halted.empty())
    return Banner{
        "The simulation stopped",
        frame.halted +
            "\nReset returns to the initial state. Undo (Ctrl+Z) returns to the state before the last action. "
            "Smaller tool motions or more damping may avoid this.",
        "Reset (R)", colours::danger};
  if (frame.recovery && shows_recovery())
    return Banner{frame.recovery->ended ? "Tissue recovered" : "Recovering the tissue",
                  capitalised(frame.recovery->message) + "." +
                      (frame.recovery_file.empty() ? "" : "\nReplay: heml run " + frame.recovery_file),
                  "", colours::warning};
  if (!(late_for_ > late_delay) || slow_dismissed_) return std::nullopt;
  cure_ = cure_for(frame, integrator, budget);
  return Banner{fmt::format("{:.1f}× slower than real time", frame.pace.slowdown),
                cure_ ? cure_->cost
                      : "A coarser or better mesh would help: slivers and small elements cost the most "
                        "(heml explain names the worst).",
                cure_ ? cure_->button : "",
                colours::warning,
                "Dismiss",
                beside};
}

StateBanner::Request StateBanner::take(BannerPress press, const Frame& frame) {
  if (press == BannerPress::close) slow_dismissed_ = true;
  if (press != BannerPress::button) return {};
  if (!frame.halted.empty()) return {Action::reset, {}};
  if (!cure_) return {};
  late_for_ = 0;
  return {{}, cure_->commands()};
}

}  // namespace heml::panel
