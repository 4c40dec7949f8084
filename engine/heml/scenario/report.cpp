#include <fmt/format.h>

#include <algorithm>
#include <heml/base/write_file.hpp>
#include <heml/scenario/frame_series.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/positions_csv.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/vector_json.hpp>

namespace heml {
namespace {

Json halt_json(const StopReason& halt) {
  constexpr const char* causes[] = {"out_of_range", "unstable", "not_converged"};
  Json json = {{"cause", causes[static_cast<std::size_t>(halt.cause)]}, {"message", halt.message}};
  if (halt.element >= 0) json["element"] = halt.element;
  if (halt.node >= 0) json["node"] = halt.node;
  return json;
}

Json energies_json(const Energies& energies) {
  return {{"kinetic", energies.kinetic}, {"elastic", energies.elastic}, {"potential", energies.potential}};
}

Json edit_json(const EditReport& edit) {
  Json json = {{"step", edit.tick},
               {"removed", edit.removed},
               {"mass", edit.mass},
               {"energy_before", energies_json(edit.before)},
               {"energy_after", energies_json(edit.after)},
               {"stable_step_before", edit.step_before},
               {"stable_step_after", edit.step_after}};
  if (edit.split > 0) {
    json["split"] = edit.split;
    json["pieces"] = edit.pieces;
    json["area"] = edit.area;
    json["smallest_angle"] = edit.min_angle;
  }
  if (edit.burnt > 0) json["burnt"] = edit.burnt;
  if (edit.torn > 0) {
    json["torn"] = edit.torn;
    json["area"] = edit.area;
  }
  return json;
}

/// Energies that are not finite, of laws without one, are written as null.
Json switch_json(const LawSwitch& at) {
  return {{"time", at.time}, {"before", energies_json(at.before)}, {"after", energies_json(at.after)}};
}

Json recovery_json(const Recovery& recovery) {
  Json json = {{"message", recovery.message}, {"step", recovery.tick},         {"steps", recovery.steps},
               {"least_J", recovery.min_J},   {"inverted", recovery.inverted}, {"begun", switch_json(recovery.begun)}};
  if (recovery.element >= 0) json["element"] = recovery.element;
  if (recovery.ended) json["ended"] = switch_json(*recovery.ended);
  return json;
}

/// Tables and self-contact have entries; what a user moves is in the trace.
void add_tool(const ToolState& tool, Json& report) {
  std::visit(
      ByKind{[&](const TableState& table) {
               report["tables"].push_back({{"force", vector_json(table.force)},
                                           {"work", table.work},
                                           {"deepest", table.max_penetration},
                                           {"touching", table.contact_count}});
             },
             [&](const SelfContactState& contact) {
               report["self_contact"] = {{"force", contact.force},
                                         {"work", contact.work},
                                         {"energy", contact.energy},
                                         {"deepest", contact.max_penetration},
                                         {"touching", contact.contact_count}};
             },
             [](const GraspState&) {}, [](const PinState&) {}, [](const ProbeState&) {}, [](const SutureState&) {}},
      tool);
}

bool is_inverted(double J) { return !(J > 0); }

}  // namespace

std::string inversion_message(World& world) {
  const std::vector<double> J = world.point_volume_ratios();  // one an element, or four
  const auto inverted = std::count_if(J.begin(), J.end(), is_inverted);
  if (inverted == 0) return "";
  const std::vector<int>& elements = world.topology()->elements;
  const std::size_t of_each = J.size() / elements.size();
  const auto least = std::min_element(J.begin(), J.end());
  return fmt::format("{} of {} {} are inverted or flat (J ≤ 0), most of all element {} with J = {:.3g}", inverted,
                     J.size(), of_each == 1 ? "elements" : "integration points",
                     elements[static_cast<std::size_t>(least - J.begin()) / of_each], *least);
}

std::string report_text(World& world, const SolveFacts& facts, const std::string& file) {
  const Energies energies = world.energies();
  const SolverStats work = world.solver_stats();
  const std::vector<double> J = world.point_volume_ratios();
  Json report = {{"converged", facts.converged},
                 {"load", work.load},
                 {"time", world.time()},
                 {"ticks", world.ticks()},
                 {"steps", world.steps()},
                 {"iterations", work.iterations},
                 {"residual", work.residual},
                 {"explicit_rescues", work.explicit_rescues},
                 {"unconverged_steps", work.unconverged_steps},
                 {"damped_steps", work.damped_steps},
                 {"lagging_flow_steps", work.lagging_flow_steps},
                 {"unconverged_residual", work.unconverged_residual},
                 {"wall_seconds", facts.wall_seconds},
                 {"kinetic_energy", energies.kinetic},
                 {"elastic_energy", energies.elastic},
                 {"potential_energy", energies.potential},
                 {"min_J", *std::min_element(J.begin(), J.end())},
                 {"max_J", *std::max_element(J.begin(), J.end())},
                 {"inverted", std::count_if(J.begin(), J.end(), is_inverted)}};
  report["reaction"] = Json::array();
  for (const Vec3& force : world.reactions()) report["reaction"].push_back(vector_json(force));
  for (const ToolState& tool : world.tools()) add_tool(tool, report);
  report["nodes"] = world.setup().mesh.nodes.size();
  report["corner_nodes"] = world.setup().mesh.nodes.size() - count_nodes(world.setup().midedges);
  const std::size_t removed = removed_count(world);
  report["tets"] = world.topology()->elements.size() + removed;
  report["removed"] = removed;
  report["edits"] = Json::array();
  for (const EditReport& edit : world.edits()) report["edits"].push_back(edit_json(edit));
  report["state_hash"] = fmt::format("{:016x}", world.state_hash());
  report["recoveries"] = world.recoveries();
  if (const Recovery* recovery = world.recovery()) report["recovery"] = recovery_json(*recovery);
  if (facts.halt) report["halt"] = halt_json(*facts.halt);
  if (facts.refused) report["refused"] = *facts.refused;
  return json_text(report, file, true) + "\n";
}

void write_report(const std::filesystem::path& path, World& world, const SolveFacts& facts) {
  write_file(path, report_text(world, facts, path.string()));
}

void write_state(const std::filesystem::path& folder, const std::string& stem, World& world, bool csv, bool vtu) {
  if (csv) write_positions_csv(folder / (stem + ".csv"), world.positions());
  if (vtu) write_frame(folder / (stem + ".vtu"), world);
}

}  // namespace heml
