#include <fmt/format.h>

#include <app/panel/state_banner.hpp>
#include <cmath>

namespace heml::panel {
namespace {

constexpr float late_delay = 1;            // s of being late before the banner
constexpr float recovery_banner_time = 5;  // s that the banner stays after a recovery
constexpr double stuck_time = 2;           // s, simulated, after which a J that does not change stays
constexpr double steady_J = 0.01;

}  // namespace

void StateBanner::update(const Frame& frame, float seconds) {
  follow_lowest(frame);
  since_recovery_ += seconds;
  if (!frame.recovery) since_recovery_ = recovery_banner_time;
  if (frame.recovery && (!frame.recovery->ended || frame.recovery->tick != recovery_seen_)) {
    recovery_seen_ = frame.recovery->tick;
    since_recovery_ = 0;
  }
  const bool is_paced = !frame.paused && frame.fast_forward_target == 0;
  late_for_ = !is_paced || frame.pace.keeping_up ? 0 : late_for_ + seconds;
}

/// Elements may stay inverted: incompatible rest shapes, as of burns beside what is not burnt, have their least energy
/// so, and loads and supports may hold a body so.
void StateBanner::follow_lowest(const Frame& frame) {
  const bool goes_on = frame.recovery && !frame.recovery->ended;
  const bool same = goes_on && frame.recovery->tick == lowest_.recovery && frame.time >= lowest_.since;
  if (!same || !(std::abs(frame.min_J - lowest_.J) < steady_J))
    lowest_ = {goes_on ? frame.recovery->tick : -1, frame.min_J, frame.time};
  is_stuck_ = goes_on && frame.time - lowest_.since > stuck_time;
}

bool StateBanner::shows_recovery() const {
  return since_recovery_ < recovery_banner_time && !(is_stuck_ && dismissed_ == recovery_seen_);
}

Banner StateBanner::recovery_banner(const Frame& frame, const std::optional<Area>& beside) const {
  const Recovery& recovery = *frame.recovery;
  std::string text = capitalised(recovery.message) + ".";
  if (is_stuck_)
    text += fmt::format(
        "\nThe body rests so, with a least J of {:.2g}, on a simple law that takes the place of its own. Undo (Ctrl+Z) "
        "takes the last action back; Reset (R) returns to the initial state.",
        frame.min_J);
  if (!frame.recovery_file.empty()) text += "\nReplay: heml run " + frame.recovery_file;
  Banner banner{is_stuck_        ? frame.min_J > 0 ? "Tissue stays nearly flat" : "Tissue stays inverted"
                : recovery.ended ? "Tissue recovered"
                                 : "Recovering the tissue",
                std::move(text), "", colours::warning};
  if (is_stuck_) {
    banner.close = "Dismiss";
    banner.beside = beside;
  }
  return banner;
}

std::optional<Banner> StateBanner::choose(const Frame& frame, Integrator integrator, int budget,
                                          const std::optional<Area>& beside) {
  if (!frame.halted.empty())
    return Banner{
        "The simulation stopped",
        frame.halted +
            "\nReset returns to the initial state. Undo (Ctrl+Z) returns to the state before the last action. "
            "Smaller tool motions or more damping may avoid this.",
        "Reset (R)", colours::danger};
  if (frame.recovery && shows_recovery()) return recovery_banner(frame, beside);
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
  if (press == BannerPress::close && frame.recovery && shows_recovery())
    dismissed_ = recovery_seen_;
  else if (press == BannerPress::close)
    slow_dismissed_ = true;
  if (press != BannerPress::button) return {};
  if (!frame.halted.empty()) return {Action::reset, {}};
  if (!cure_) return {};
  late_for_ = 0;
  return {{}, cure_->commands()};
}

}  // namespace heml::panel
