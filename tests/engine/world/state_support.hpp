#pragma once
// Tests of states that are taken back to: all that can be read of a world, a bar in contact, an example of every
// command.
#include <doctest/doctest.h>

#include <heml/materials/material.hpp>
#include <utility>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::test {

inline void add(std::vector<double>& readings, const Vec3& v) {
  readings.insert(readings.end(), {v.x(), v.y(), v.z()});
}

inline void add(std::vector<double>& readings, const ContactState& state) {
  add(readings, state.force);
  readings.insert(readings.end(), {state.work, state.energy, state.max_penetration, double(state.contact_count)});
}

/// All that can be read of a world, as numbers.
inline std::vector<double> readings_of(World& world) {
  std::vector<double> all;
  for (const std::vector<Vec3>& list : {world.positions(), world.velocities(), world.reactions()})
    for (const Vec3& v : list) add(all, v);
  const Energies energies = world.energies();
  const SolverStats stats = world.solver_stats();
  all.insert(all.end(),
             {energies.kinetic, energies.elastic, energies.potential, world.stable_step(), world.time(),
              double(world.ticks()), double(world.steps()), double(world.substeps()), stats.load,
              double(stats.iterations), stats.residual, double(stats.linear.iterations), double(world.edits().size()),
              double(world.recoveries()), double(world.halt().has_value()), double(world.topology()->elements.size())});
  for (const ToolState& tool : world.tools())
    std::visit(
        ByKind{[&](const GraspState& grasp) { add(all, grasp.target), add(all, grasp.force); },
               [&](const PinState& pin) { add(all, pin.place), add(all, pin.force); },
               [&](const TableState& table) { add(all, static_cast<const ContactState&>(table)); },
               [&](const ProbeState& probe) { add(all, probe.tip), add(all, static_cast<const ContactState&>(probe)); },
               [&](const SutureState& suture) { add(all, suture.force); },
               [&](const SelfContactState& tissue) {
                 all.insert(all.end(), {tissue.force, tissue.work, tissue.energy, double(tissue.contact_count)});
               }},
        tool);
  for (const EditReport& edit : world.edits()) all.insert(all.end(), {edit.mass, edit.area, edit.after.elastic});
  return all;
}

inline WorldSetup bar(const Material& material, Integrator integrator, bool single) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.06, 0.02, 0.02), {4, 1, 2});
  setup.materials = {{std::nullopt, material}};
  Boundary left{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })};
  left.translate = Vec3(-0.008, 0.004, 0);
  left.ramp_time = 0.03;
  setup.boundary = {left};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = integrator;
  setup.solver.single_precision = single;
  setup.solver.continuation = true;
  setup.solver.threads = 1;
  setup.solver.rate = 200;
  setup.solver.duration = 0.05;
  return setup;
}

inline constexpr int tip = 4, above_tip = 9;  // nodes of the bar

// An example of each kind of command; one that has none does not compile.
inline Command example(const Grasp&) { return Grasp{tip, 0.012}; }
inline Command example(const MoveTool&) { return MoveTool{Vec3(0.07, 0.01, 0.005)}; }
inline Command example(const Release&) { return Release{}; }
inline Command example(const PinTissue&) { return PinTissue{above_tip, 0}; }
inline Command example(const Unpin&) { return Unpin{}; }
inline Command example(const SetTables&) { return SetTables{{{Vec3(0, -0.002, 0), Vec3(0.1, 1, 0), 0.4}}}; }
inline Command example(const SetBoundary&) { return SetBoundary{{{{0, 5, 10}}, {{1}, Vec3(0, 1e-3, 0)}}}; }
inline Command example(const SetLoads&) {
  return SetLoads{{{Load::Kind::force, {tip, above_tip}, Vec3(0, 0.01, 0)},
                   {Load::Kind::pressure, {4, 9, 14, 19}, Vec3::Zero(), 30}}};
}
inline Command example(const MoveProbe&) {
  return MoveProbe{0.006, Vec3::Zero(), 0.4, {Vec3(0.04, 0.03, 0.01), Vec3(0.045, 0.02, 0.01)}, 0.4};
}
inline Command example(const WithdrawProbe&) { return WithdrawProbe{}; }
inline Command example(const SutureTissue&) { return SutureTissue{{1, 3}, 0.02, 0.05}; }
inline Command example(const CutSutures&) { return CutSutures{}; }
inline Command example(const SetMaterial&) { return SetMaterial{std::nullopt, sample_material("stvk")}; }
inline Command example(const SetActiveStress&) { return SetActiveStress{std::nullopt, 700}; }
inline Command example(const TagRegion&) {
  return TagRegion{{{}, {{3, 4, 17, 30}, {}, {}, {}}, "lesion", {}}, sample_material("mooney_rivlin")};
}
inline Command example(const SetDamping&) { return SetDamping{3}; }
inline Command example(const SetGravity&) { return SetGravity{Vec3(0, -5, 2)}; }
inline Command example(const SetIntegrator&) { return SetIntegrator{Integrator::automatic}; }
inline Command example(const SetBudget&) { return SetBudget{2}; }
inline Command example(const SetRate&) { return SetRate{150}; }
inline Command example(const SetStepCost&) { return SetStepCost{500}; }
inline Command example(const RemoveElements&) { return RemoveElements{{{3, 17, 30}, {}, {}, {}}}; }
inline Command example(const CutTissue&) { return blade_at(0.034); }
inline Command example(const CauterizeTissue&) {
  const Vec3 down(0, -0.012, 0), from(0.034, 0.021, -0.01), to(0.034, 0.021, 0.03);
  return CauterizeTissue{{{{from, from + down}, {to, to + down}}}, {0.008, 0.2}};
}
inline Command example(const Undo&) { return Undo{}; }
inline Command example(const StepHistory&) { return StepHistory{-1}; }
inline Command example(const AdoptPreconditioner&) { return AdoptPreconditioner{}; }
inline Command example(const Reset&) { return Reset{}; }

template <std::size_t... kind>
inline std::vector<Command> examples(std::index_sequence<kind...>) {
  return {example(std::variant_alternative_t<kind, Command>{})...};
}
inline std::vector<Command> examples() { return examples(std::make_index_sequence<std::variant_size_v<Command>>{}); }

/// What must have come before a command for it to be accepted.
inline std::vector<Command> before(const Command& command) {
  if (std::holds_alternative<MoveTool>(command)) return {example(Grasp{})};
  if (std::holds_alternative<Undo>(command)) return {example(CutTissue{})};
  if (std::holds_alternative<StepHistory>(command)) return {example(PinTissue{})};
  return {};
}

/// With every contact there is, so that its state is part of all snapshots.
inline WorldSetup bar_in_contact(Integrator integrator, bool single) {
  Material material = sample_material("mooney_rivlin");
  material.relaxation = {{0.5, 0.02}};
  material.fibre = Vec3(3, 0, 4) / 5;
  WorldSetup setup = bar(material, integrator, single);
  setup.tables = {{Vec3(0, -0.001, 0), Vec3::UnitY(), 0.5}};
  setup.self_contact = SelfContactSettings{0.3};
  return setup;
}

}  // namespace heml::test
