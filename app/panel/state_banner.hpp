#pragma once
// The banner that the state of the simulation calls for: it stopped, it recovers, tissue stays inverted, or it is
// slower than real time.
#include <app/panel/actions.hpp>
#include <app/panel/notices.hpp>
#include <app/panel/slow_body.hpp>
#include <heml/session/frame.hpp>
#include <optional>
#include <vector>

namespace heml::panel {

class StateBanner {
 public:
  void update(const Frame& frame, float seconds);  ///< seconds: wall time since the last call
  /// Whether a recovery is running or ended a few seconds ago, and was not dismissed.
  bool shows_recovery() const;

  /// The banner to draw now, or none. integrator, budget: as set. beside: where that of a lasting state stands; none:
  /// at the top of the free area.
  std::optional<Banner> choose(const Frame& frame, Integrator integrator, int budget,
                               const std::optional<Area>& beside);

  /// What pressing its buttons asks for: an action where the simulation stopped, else the commands that cure a slow
  /// body.
  struct Request {
    std::optional<Action> action;
    std::vector<Command> commands;
  };
  Request take(BannerPress press, const Frame& frame);

 private:
  void follow_lowest(const Frame& frame);
  Banner recovery_banner(const Frame& frame, const std::optional<Area>& beside) const;

  std::optional<Cure> cure_;     ///< that the banner of a slow body offers
  bool slow_dismissed_ = false;  ///< that banner was
  float late_for_ = 0;           ///< s of wall time since the engine last kept up
  long recovery_seen_ = -1;      ///< Recovery::tick of the last recovery
  float since_recovery_ = 1e9f;  ///< s of wall time since a recovery was running
  /// The lowest J of a recovery under way, and since when it has hardly changed.
  struct LowestJ {
    long recovery = -1;  ///< Recovery::tick
    double J = 0;
    double since = 0;  ///< s, simulated
  };
  LowestJ lowest_;
  bool is_stuck_ = false;  ///< it has not changed for long: no more recovers
  long dismissed_ = -1;    ///< Recovery::tick of a stuck recovery whose banner was
};

}  // namespace heml::panel
