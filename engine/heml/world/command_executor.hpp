#pragma once
// What each command does to a running world: materials, regions, conditions and method here, tools in
// tool_commands.hpp, edits in mesh_editor.hpp. Reset is TypedWorld's.
#include <heml/world/command.hpp>
#include <heml/world/implicit_stepper.hpp>
#include <heml/world/mesh_editor.hpp>
#include <heml/world/method_choice.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/simulation.hpp>
#include <heml/world/tool_commands.hpp>

namespace heml {

template <class Real>
class CommandExecutor {
 public:
  CommandExecutor(Simulation<Real>& s, MethodChoice<Real>& method, ImplicitStepper<Real>& implicit,
                  RecoveryController<Real>& recovery, MeshEditor<Real>& editor)
      : s_(s), method_(method), implicit_(implicit), recovery_(recovery), editor_(editor), tools_(s, recovery) {}

  /// Each returns what is wrong with the command; a refused command changes nothing.
  template <class C>
    requires requires(ToolCommands<Real>& tools, const C& command) { tools.execute(command); }
  Status execute(const C& command) {
    return tools_.execute(command);
  }
  Status execute(const SetMaterial& command);
  Status execute(const SetActiveStress& command);
  Status execute(const TagRegion& command);
  Status execute(const SetDamping& command);
  Status execute(const SetGravity& command);
  Status execute(const SetIntegrator& command);
  Status execute(const SetBudget& command);
  Status execute(const SetRate& command);
  Status execute(const SetStepCost& command);
  Status execute(const AdoptPreconditioner& command);
  Status execute(const RemoveElements& command) { return editor_.remove(command); }
  Status execute(const CutTissue& command) { return editor_.cut(command); }
  Status execute(const CauterizeTissue& command) { return editor_.cauterize(command); }
  Status execute(const Undo&) { return editor_.undo(); }
  Status execute(const SetBoundary& command);
  Status execute(const SetLoads& command);

 private:
  Status find_entry(const char* what, std::optional<int> region, std::size_t& index) const;
  Status refused(const Material& material, const RegionMaterial* replaced) const;
  RegionMaterial copied_material(const TaggedRegion& region) const;
  void follow_materials();

  Simulation<Real>& s_;
  MethodChoice<Real>& method_;
  ImplicitStepper<Real>& implicit_;
  RecoveryController<Real>& recovery_;
  MeshEditor<Real>& editor_;
  ToolCommands<Real> tools_;
};

}  // namespace heml
