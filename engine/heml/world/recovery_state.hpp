#pragma once
// State of recoveries: the last good state and, during a recovery, the surrogate of the body. Made if the scene has
// "recovery"; worlds without it pay nothing.
#include <heml/dynamics/state.hpp>
#include <heml/elastic/body.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/world/recovery.hpp>
#include <heml/world/recovery_surrogate.hpp>
#include <memory>

namespace heml {

/// Measures of a state by which it is judged good or bad.
struct StateCheck {
  double min_J = 1;
  int worst = 0;      ///< inner number of the element that has it
  int inverted = 0;   ///< elements with J ≤ 0, or none at all, at any of their points
  double speed = 0;   ///< m/s, of the fastest node beside the mean velocity; infinite where a node is nowhere
  double extent = 1;  ///< of the body, as a part of its extent at rest (radii of gyration)
};

/// The values of recoveries, copied by snapshots.
template <class Real>
struct RecoveryProgress {
  double max_speed = 0;        ///< m/s; a faster node is a sign of instability
  State<Real> last_good;       ///< x, v, time
  bool has_last_good = false;  ///< whether there was one since the start
  InternalState<Real> last_good_internal;  ///< of the body then; empty where no material has any
  std::optional<Recovery> last;
  long count = 0;
  long healthy_steps = 0;       ///< successive steps with a healthy min J
  bool is_tangled = false;      ///< moved towards rest until no element is inverted
  long moves_towards_rest = 0;  ///< steps with such a move in this recovery
  double tool_speed = 0;        ///< m/s, of the fastest; 0: no tool
  struct Tool {
    long serial;
    Vec3 place;  ///< m
  };
  std::vector<Tool> tools_were;  ///< that hold something
  double tool_time = 0;          ///< s, of tools_were
};

/// progress: where recoveries are. surrogate: its implicit part, while there is one.
template <class Real>
struct RecoverySnapshot {
  RecoveryProgress<Real> progress;
  std::optional<ImplicitSnapshot<Real>> surrogate;
};

template <class Real>
class RecoveryState : public RecoveryProgress<Real> {
 public:
  RecoveryState(const Model<Real>& model, const std::vector<Real>& masses, RecoveryProgress<Real> progress);

  /// Adds the nodes of an edit to the last good state.
  void append(const MeshEdit& edit) {
    heml::append(edit, this->last_good.x, 3);
    heml::append(edit, this->last_good.v, 3);
  }
  /// Follows a change of the elements.
  void set_mesh(const Model<Real>& model, const std::vector<Real>& masses);

  StateCheck check(const Model<Real>& model, const State<Real>& state, const std::vector<Real>& masses) const;
  /// Whether an element is folded: a quadratic one can be, while its points are upright. Of linear ones: false.
  bool is_folded(const State<Real>& state) const;
  /// Updates tool_speed from the tools' positions at a time (s).
  void track_tools(const std::vector<GraspSpring<Real>>& grasps, double time);

  std::unique_ptr<RecoverySurrogate<Real>> surrogate;

 private:
  std::vector<double> rest_volume_;  ///< m³, of the points of each element: one, of quadratic ones four
  std::vector<Tet> eighths_;  ///< linear tetrahedra on the nodes of quadratic ones, eight each, those upright at rest
  double rest_extent_ = 0;           ///< m
};

}  // namespace heml
