#pragma once
// Edits of the mesh of a running world: removal, cuts, burns, tears, undo. The inner layout is rebuilt; positions,
// velocities, internal state of materials, constraints and tools carry over.
#include <heml/mesh/cut.hpp>
#include <heml/tools/tearing.hpp>
#include <heml/world/command.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/simulation_snapshot.hpp>

namespace heml {

/// What edits leave behind: states to go back to, and the stroke under way.
template <class Real>
struct EditHistory {
  using Saved = std::shared_ptr<const SimulationSnapshot<Real>>;
  Saved whole;               ///< before the first edit; null: there was none
  std::vector<Saved> saved;  ///< before each of the last edits
  Stroke stroke;             ///< what the last cut leaves to the next one, mesh-file order
  bool in_stroke = false;    ///< whether the current stroke has its state saved
  std::string missed;        ///< what the last stroke did not do, where it changed nothing
  double snap = 0;           ///< m, snapping distance of cuts; 0: not computed yet
};

template <class Real>
class MeshEditor {
 public:
  MeshEditor(Simulation<Real>& s, RecoveryController<Real>& recovery) : s_(s), recovery_(recovery) {}

  /// Each returns what is wrong with the command, or nothing; a wrong one changes nothing.
  Status remove(const RemoveElements& command);
  Status cut(const CutTissue& command);
  Status cauterize(const CauterizeTissue& command);
  /// Rest shapes of burnt tissue go on shrinking, at the start of a tick.
  void contract();
  Status undo();
  /// Back to the elements of the start; the list of edits is cleared.
  void undo_all();
  /// Separates elements where they are stretched beyond the limit of the scene (tools/tearing.hpp), at the start of a
  /// tick, if the scene asks for it. All tearing until another edit is one edit to undo.
  void tear();

  bool has_history() const { return history_.whole != nullptr; }
  std::size_t history_bytes() const;

  const EditHistory<Real>& history() const { return history_; }
  /// Of a snapshot that the simulation was restored to.
  void restore_history(const EditHistory<Real>& history);

 private:
  Status add_midedge_nodes(MeshEdit& edit) const;
  void begin_stroke(std::string missed);
  Status part(const Sweep& sweep);
  void burn(const Heat& heat, const Sweep& sweep);
  void set_burns(std::vector<Burn> burns);
  EditReport& stroke_report();
  EditReport begin_report();
  void end_report(EditReport& report);
  void carry_out(const MeshEdit& edit);
  void move_front(const Sweep& sweep);
  void rebuild_after_edit();
  void follow_rest_shapes();
  void save();
  void undo_to(const SimulationSnapshot<Real>& before);
  void restore_before_edit(const SimulationSnapshot<Real>& before);
  void keep_conditions();
  void keep_regions(const TetMesh& mesh);
  void restore_grasps(const SimulationSnapshot<Real>& before);

  Simulation<Real>& s_;
  RecoveryController<Real>& recovery_;
  EditHistory<Real> history_;
  std::optional<Tearing> tearing_;  ///< built on first use
};

}  // namespace heml
