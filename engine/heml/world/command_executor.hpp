#pragma once
// What each command does to a running world. Reset is TypedWorld's.
#include <heml/world/command.hpp>
#include <heml/world/implicit_stepper.hpp>
#include <heml/world/mesh_editor.hpp>
#include <heml/world/method_choice.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class CommandExecutor {
 public:
  CommandExecutor(Simulation<Real>& s, MethodChoice<Real>& method, ImplicitStepper<Real>& implicit,
                  RecoveryController<Real>& recovery, MeshEditor<Real>& editor)
      : s_(s), method_(method), implicit_(implicit), recovery_(recovery), editor_(editor) {}

  /// Each returns what is wrong with the command; a refused command changes nothing.
  Status execute(const Grasp& command);
  Status execute(const MoveTool& command);
  Status execute(const Release& command);
  Status execute(const PinTissue& command);
  Status execute(const Unpin& command);
  Status execute(const SetMaterial& command);
  Status execute(const SetDamping& command);
  Status execute(const SetGravity& command);
  Status execute(const SetIntegrator& command);
  Status execute(const SetBudget& command);
  Status execute(const SetRate& command);
  Status execute(const SetStepCost& command);
  Status execute(const AdoptPreconditioner& command);
  Status execute(const RemoveElements& command) { return editor_.remove(command); }
  Status execute(const CutTissue& command) { return editor_.cut(command); }
  Status execute(const Undo&) { return editor_.undo(); }
  Status execute(const SetTables& command);
  Status execute(const SetBoundary& command);
  Status execute(const SetLoads& command);
  Status execute(const MoveProbe& command);
  Status execute(const WithdrawProbe& command);
  Status execute(const SutureTissue& command);
  Status execute(const CutSutures& command);

 private:
  auto grasp_of(int hand);
  void put_into_hand(GraspSpring<Real> grasp, int hand);
  std::vector<int> surface_with(int node, const std::vector<int>& hidden) const;
  void update_constraints();
  std::size_t node_count() const { return s_.masses->lumped.size(); }

  Simulation<Real>& s_;
  MethodChoice<Real>& method_;
  ImplicitStepper<Real>& implicit_;
  RecoveryController<Real>& recovery_;
  MeshEditor<Real>& editor_;
};

}  // namespace heml
