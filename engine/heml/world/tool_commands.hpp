#pragma once
// What commands of tools do: those that grasp, pin, press on and sew the body.
#include <heml/world/command.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class ToolCommands {
 public:
  ToolCommands(Simulation<Real>& s, RecoveryController<Real>& recovery) : s_(s), recovery_(recovery) {}

  /// Each returns what is wrong with the command; a refused command changes nothing.
  Status execute(const Grasp& command);
  Status execute(const MoveTool& command);
  Status execute(const Release& command);
  Status execute(const PinTissue& command);
  Status execute(const Unpin& command);
  Status execute(const SetTables& command);
  Status execute(const MoveProbe& command);
  Status execute(const WithdrawProbe& command);
  Status execute(const SutureTissue& command);
  Status execute(const CutSutures& command);

 private:
  auto grasp_of(int hand);
  void put_into_hand(GraspSpring<Real> grasp, int hand);
  std::vector<int> surface_with(int node, const std::vector<int>& hidden) const;
  Status pin_nodes(const std::vector<int>& nodes);
  Status unpin_nodes(const std::vector<int>& nodes);

  Simulation<Real>& s_;
  RecoveryController<Real>& recovery_;
};

/// Updates what depends on the set of constrained nodes.
template <class Real>
void update_constraints(Simulation<Real>& s, RecoveryController<Real>& recovery);

}  // namespace heml
