#pragma once
// What a world keeps to bring its body back: the last state nothing was wrong with, and, while a recovery goes on, the
// body that stands in for the scene's. Made when a scene asks for it ("recovery"); worlds without it pay nothing.
#include <heml/dynamics/state.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/world/recovery.hpp>
#include <heml/world/recovery_surrogate.hpp>
#include <memory>

namespace heml {

/// What there is to see of a state.
struct StateCheck {
  double min_J = 1;
  int worst = 0;      ///< inner number of the element that has it
  int inverted = 0;   ///< elements with J ≤ 0, or none at all
  double speed = 0;   ///< m/s, of the fastest node beside the mean velocity; infinite where a node is nowhere
  double extent = 1;  ///< of the body, as a part of its extent at rest (radii of gyration)
};

template <class Real>
class RecoveryState {
 public:
  /// fastest: m/s, that no node can be if all is well.
  RecoveryState(const TetMesh& mesh, const std::vector<Real>& masses, double max_speed, const State<Real>& start);

  /// Further nodes, where the last good state has them.
  void append(const MeshEdit& edit) {
    heml::append(edit, last_good.x, 3);
    heml::append(edit, last_good.v, 3);
  }
  /// Other elements.
  void set_mesh(const TetMesh& mesh, const std::vector<Real>& masses);

  StateCheck check(const TetMesh& mesh, const State<Real>& state, const std::vector<Real>& masses) const;
  /// Keeps where the tool is, to tell how fast it was lately.
  void track_tool(const GraspSpring<Real>* grasp, double time);

  const double max_speed;      ///< m/s
  State<Real> last_good;       ///< the last one: x, v, time
  bool has_last_good = false;  ///< whether there was any but the start
  std::unique_ptr<RecoverySurrogate<Real>> surrogate;
  std::optional<Recovery> last;
  long count = 0;
  long upright_steps = 0;  ///< in a row, to now
  bool unfolding = false;  ///< helping it out of a tangle, until it is out
  long unfold_steps = 0;   ///< steps that was done
  double tool_speed = 0;   ///< m/s; 0: no tool

 private:
  std::vector<double> rest_volume_;  ///< #T, m³
  double rest_extent_ = 0;           ///< m
  Vec3 tool_was_ = Vec3::Zero();
  double tool_seen_ = -1;  ///< s; negative: no tool
};

}  // namespace heml
