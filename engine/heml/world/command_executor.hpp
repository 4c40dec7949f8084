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

  /// Each returns what is wrong with the command, or nothing; a wrong one changes nothing.
  using Problem = std::optional<std::string>;

  // command_executor.cpp: grasp, pins, materials, settings
  Problem execute(const Grasp& command);
  Problem execute(const MoveTool& command);
  Problem execute(const Release& command);
  Problem execute(const PinTissue& command);
  Problem execute(const Unpin& command);
  Problem execute(const SetMaterial& command);
  Problem execute(const SetDamping& command);
  Problem execute(const SetGravity& command);
  Problem execute(const SetIntegrator& command);
  Problem execute(const SetBudget& command);
  Problem execute(const SetStepCost& command);
  Problem execute(const AdoptPreconditioner& command);
  Problem execute(const RemoveElements& command) { return editor_.remove(command); }
  Problem execute(const CutTissue& command) { return editor_.cut(command); }
  Problem execute(const Undo&) { return editor_.undo(); }

  // contact_commands.cpp: tables, probe, sutures
  Problem execute(const SetTables& command);
  Problem execute(const MoveProbe& command);
  Problem execute(const WithdrawProbe& command);
  Problem execute(const SutureTissue& command);
  Problem execute(const CutSutures& command);

 private:
  std::vector<int> surface_with(int node) const;
  void update_constraints();

  Simulation<Real>& s_;
  MethodChoice<Real>& method_;
  ImplicitStepper<Real>& implicit_;
  RecoveryController<Real>& recovery_;
  MeshEditor<Real>& editor_;
};

}  // namespace heml
