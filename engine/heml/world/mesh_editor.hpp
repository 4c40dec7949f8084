#pragma once
// Edits of the mesh of a running world: removal, cuts, tears, undo. The inner layout is rebuilt; positions, velocities,
// internal state of materials, constraints and tools carry over.
#include <heml/tools/tearing.hpp>
#include <heml/world/command.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class MeshEditor {
 public:
  MeshEditor(Simulation<Real>& s, RecoveryController<Real>& recovery) : s_(s), recovery_(recovery) {}

  /// Each returns what is wrong with the command, or nothing; a wrong one changes nothing.
  Status remove(const RemoveElements& command);
  Status cut(const CutTissue& command);
  Status undo();
  /// Back to the elements of the start; the list of edits is cleared.
  void undo_all();
  /// Separates elements where they are stretched beyond the limit of the scene (tools/tearing.hpp), at the start of a
  /// tick, if the scene asks for it. All tearing until another edit is one edit to undo.
  void tear();

  bool has_history() const { return whole_ != nullptr; }
  std::size_t history_bytes() const;

 private:
  /// State before an edit, for undo.
  struct Saved {
    TetMesh mesh;
    std::vector<Boundary> boundary;
    std::vector<Load> loads;
    Model<Real> model;
    std::shared_ptr<const Topology> topology;
    BodySnapshot<Real> body;
    std::vector<PinnedPatch> pins;
    std::vector<Suture> sutures;
    std::vector<GraspSpring<Real>> grasps;
    long grasps_taken;
    // Restored only if nothing but edits has happened since:
    long changes;
    State<Real> state;
    StepLimit limit;
    std::optional<double> lowest_frequency;
    std::optional<ImplicitSnapshot> implicit;
  };

  EditReport begin_report();
  void end_report(EditReport& report);
  void carry_out(const MeshEdit& edit);
  void rebuild_after_edit();
  void save();
  void restore(const Saved& saved);
  void restore_grasp(const Saved& saved);
  void restore_exactly(const Saved& saved);

  Simulation<Real>& s_;
  RecoveryController<Real>& recovery_;
  std::shared_ptr<const Saved> whole_;               ///< before the first edit; null: there was none
  std::vector<std::shared_ptr<const Saved>> saved_;  ///< before each of the last edits
  std::vector<int> stroke_;                          ///< nodes in the last cut, mesh-file order
  bool in_stroke_ = false;                           ///< whether the current stroke has its state saved
  std::optional<long> missed_;                       ///< tick of the last stroke that parted nothing
  double snap_ = 0;                                  ///< m, snapping distance of cuts; 0: not computed yet
  std::optional<Tearing> tearing_;                   ///< built on first use
};

}  // namespace heml
