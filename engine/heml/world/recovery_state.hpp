#pragma once
// State of recoveries: the last good state and, during a recovery, the surrogate of the body. Made if the scene has
// "recovery"; worlds without it pay nothing.
#include <heml/base/shared.hpp>
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

/// What a shape is compared with.
struct RecoveryReference {
  std::vector<double> volume;  ///< m³, of the points of each element: one, of quadratic ones four
  std::vector<Tet> eighths;    ///< linear tetrahedra on the nodes of quadratic ones, eight each, those upright at rest
  double extent = 0;           ///< m, radius of gyration

  bool operator==(const RecoveryReference&) const = default;
};

/// masses: #V, kg.
template <class Real>
RecoveryReference make_recovery_reference(const Model<Real>& model, const std::vector<Real>& masses);

/// The values of recoveries, copied by snapshots.
template <class Real>
struct RecoveryProgress {
  Shared<RecoveryReference> reference;  ///< of the elements there are
  double max_speed = 0;        ///< m/s; a faster node is a sign of instability
  Motion<Real> last_good;
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
  explicit RecoveryState(RecoveryProgress<Real> progress) : RecoveryProgress<Real>(std::move(progress)) {}

  /// Adds the nodes of an edit to the last good state.
  void append(const MeshEdit& edit) {
    heml::append(edit, this->last_good.x, 3);
    heml::append(edit, this->last_good.v, 3);
  }

  StateCheck check(const Model<Real>& model, const State<Real>& state, const std::vector<Real>& masses,
                   ThreadTeam& team) const;
  /// Whether an element is folded: a quadratic one can be, while its points are upright. Of linear ones: false.
  bool is_folded(const State<Real>& state) const;
  /// Updates tool_speed from the tools' positions at a time (s).
  void track_tools(const std::vector<GraspSpring<Real>>& grasps, double time);

  std::unique_ptr<RecoverySurrogate<Real>> surrogate;
};

}  // namespace heml
