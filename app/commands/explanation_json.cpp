#include <app/commands/explanation_json.hpp>
#include <studies/operation_count.hpp>

namespace heml {
namespace {

Json body_json(const Explanation& explained) {
  const WorldFacts& world = explained.world;
  const QualityReport& quality = explained.quality;
  return {{"nodes", world.nodes},
          {"tets", world.tets},
          {"live_tets", world.live_tets},
          {"regions", quality.regions},
          {"components", quality.components},
          {"held_nodes", world.constrained_nodes},
          {"boundary_faces", world.faces},
          {"volume", quality.volume},
          {"shortest_edge", quality.shortest_edge},
          {"longest_edge", quality.longest_edge},
          {"worst_dihedral", quality.worst_dihedral},
          {"worst_tet", quality.worst_tet},
          {"slivers", quality.slivers}};
}

Json regions_json(const Explanation& explained) {
  Json list = Json::array();
  for (const RegionFacts& region : explained.regions)
    list.push_back({{"number", region.number},
                    {"name", region.name.empty() ? Json() : Json(region.name)},
                    {"tets", region.tets},
                    {"volume", region.volume}});
  return list;
}

Json materials_json(const Explanation& explained) {
  Json list = Json::array();
  for (const MaterialFacts& material : explained.materials) {
    const KernelInfo& kernel = material.kernel;
    Json terms = Json::array();
    for (const TermFacts& term : material.terms) terms.push_back({{"name", term.name}, {"detail", term.detail}});
    Json operations;
    if (const auto count = element_operations(explained.setup.materials[kernel.material].material))
      operations = {
          {"multiplications", count->multiplications}, {"additions", count->additions}, {"others", count->others}};
    list.push_back({{"region", material.region ? Json(*material.region) : Json()},
                    {"law", find_law(kernel.law)->name},
                    {"tets", kernel.elements},
                    {"kernel", kernel.kernel},
                    {"instructions", kernel.instructions},
                    {"bytes_per_tet", kernel.bytes_per_tet},
                    {"operations_per_tet", operations},
                    {"terms", terms},
                    {"density", material.density},
                    {"shear_modulus", material.rest.shear},
                    {"bulk_modulus", material.rest.bulk},
                    {"poisson", material.poisson}});
    const auto& names = explained.setup.mesh.region_names;
    if (const auto name = material.region ? names.find(*material.region) : names.end(); name != names.end())
      list.back()["name"] = name->second;
  }
  return list;
}

Json method_json(const Explanation& explained) {
  const MethodFacts& method = explained.world.method;
  const StepFacts& step = explained.world.step;
  const SolverSettings& solver = explained.setup.solver;
  return {{"asked", integrator_name(method.asked)},
          {"integrator", integrator_name(method.used)},
          {"precision", solver.single_precision ? "float" : "double"},
          {"element", solver.element()},
          {"threads", explained.world.threads},
          {"tick", step.tick},
          {"step_given", solver.step.has_value()},
          {"steps_a_tick", step.steps_per_tick},
          {"stable_step", step.stable},
          {"added_mass", step.added_mass},
          {"heavier_nodes", step.heavier_nodes},
          {"step_cost", method.step_cost},
          {"explicit_share", method.explicit_share},
          {"explicit_enough", method.enough},
          {"lowest_frequency", method.lowest_frequency ? Json(*method.lowest_frequency) : Json()},
          {"tick_times_frequency", method.lowest_frequency ? Json(step.tick * *method.lowest_frequency) : Json()},
          {"resolved_below", method.resolved}};
}

Json limit_json(const Explanation& explained) {
  const LimitFacts& limit = explained.limit;
  const StepFacts& step = explained.world.step;
  if (limit.element < 0) return nullptr;
  return {{"element", limit.element},
          {"cause", name_of(limit.cause)},
          {"share", step.element_share},
          {"over_median", step.median_ratio},
          {"dihedral", limit.dihedral},
          {"height", limit.height},
          {"median_height", limit.median_height},
          {"wave_speed", limit.wave_speed},
          {"median_wave_speed", limit.median_wave_speed}};
}

Json solver_json(const Explanation& explained) {
  if (!explained.world.solver) return nullptr;
  const SolverFacts& solver = *explained.world.solver;
  return {{"minimiser", minimiser_names[static_cast<std::size_t>(solver.minimiser)]},
          {"preconditioner", preconditioner_names[static_cast<std::size_t>(solver.preconditioner)]},
          {"chosen_by_size", solver.by_size},
          {"free_nodes", solver.free_nodes},
          {"levels", solver.levels},
          {"projection", projection_names[static_cast<std::size_t>(solver.projection)]},
          {"tolerance", solver.tolerance},
          {"rescues", solver.rescues},
          {"budget_iterations", solver.budget && solver.budget->iterations ? Json(solver.budget->iterations) : Json()},
          {"budget_milliseconds",
           solver.budget && solver.budget->milliseconds > 0 ? Json(solver.budget->milliseconds) : Json()}};
}

/// What was chosen for a bare mesh; null of a scene file.
Json chosen_json(const Explanation& explained) {
  if (!explained.chosen) return nullptr;
  const BareMeshChoices& chosen = *explained.chosen;
  const SolverSettings& solver = explained.setup.solver;
  Json texts = Json::array();
  for (const BareMeshChoices::Text& text : chosen.texts) texts.push_back({{"about", text.about}, {"text", text.text}});
  Json findings = Json::array();
  for (const BareMeshChoices::Finding& finding : chosen.findings)
    findings.push_back({{"count", finding.count},
                        {"found", finding.found},
                        {"done", finding.done},
                        {"mended", finding.is_mended},
                        {"detail", finding.detail}});
  return {{"unit", chosen.unit.empty() ? Json() : Json(chosen.unit)},
          {"scale", chosen.scale},
          {"length", chosen.length},
          {"up", info_of(chosen.up).name},
          {"supports", name_of(chosen.supports)},
          {"supported_area", chosen.supported_area},
          {"young", chosen.young},
          {"poisson", chosen.poisson},
          {"density", chosen.density},
          {"stretch", chosen.stretch},
          {"element", solver.element()},
          {"integrator", integrator_name(solver.integrator)},
          {"rate", solver.rate},
          {"budget_iterations", solver.budget ? Json(solver.budget->iterations) : Json()},
          {"budget_linear", solver.budget ? Json(solver.budget->linear) : Json()},
          {"load", chosen.load},
          {"tissue", chosen.given.tissue ? Json(*chosen.given.tissue) : Json()},
          {"read_tets", chosen.read_tets},
          {"tets", chosen.tets},
          {"min_dihedral", chosen.min_dihedral},
          {"findings", findings},
          {"texts", texts}};
}

Json tools_json(const Explanation& explained) {
  const auto or_null = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json list = Json::array();
  for (const ToolFacts& tool : explained.tools)
    list.push_back({{"name", tool.name},
                    {"detail", tool.detail},
                    {"times", tool.times},
                    {"first", or_null(tool.first)},
                    {"last", or_null(tool.last)}});
  return list;
}

Json measurement_json(const Measurement& measured) {
  Json changes = Json::array();
  const double as_it_is = measured.changes.front().milliseconds;
  for (const MeasuredChange& change : measured.changes)
    changes.push_back({{"feature", change.feature},
                       {"from", change.from},
                       {"to", change.to},
                       {"milliseconds", change.milliseconds},
                       {"saved", as_it_is - change.milliseconds},
                       {"steps", change.steps},
                       {"error", change.error},
                       {"halted", change.halted.empty() ? Json() : Json(change.halted)}});
  return {{"stretch", measured.stretch},
          {"turns", measured.turns},
          {"largest_motion", measured.max_motion},
          {"changes", changes}};
}

}  // namespace

Json explanation_json(const Explanation& explained, const std::optional<Measurement>& measured) {
  Json json{{"scene", explained.file}, {"name", explained.name}};
  json["chosen"] = chosen_json(explained);
  json["body"] = body_json(explained);
  json["regions"] = regions_json(explained);
  json["materials"] = materials_json(explained);
  json["method"] = method_json(explained);
  json["limit"] = limit_json(explained);
  json["solver"] = solver_json(explained);
  json["tools"] = tools_json(explained);
  std::size_t bytes = 0;
  json["memory"] = Json::object();
  for (const MemoryFacts& memory : explained.world.memory) {
    json["memory"][memory.what] = memory.bytes;
    bytes += memory.bytes;
  }
  json["memory"]["all"] = bytes;
  json["startup"] = Json::array();
  for (const StartupWork& work : explained.startup)
    json["startup"].push_back({{"what", work.what}, {"seconds", work.seconds}});
  json["left_out"] = Json::array();
  for (const OmittedFeature& left : explained.omitted_features)
    json["left_out"].push_back({{"feature", left.feature}, {"why", left.why}});
  json["warnings"] = Json::array();
  for (const Advice& advice : explained.advice)
    json["warnings"].push_back({{"about", advice.about}, {"text", advice.text}, {"remedy", advice.remedy}});
  json["measured"] = measured ? measurement_json(*measured) : Json();
  return json;
}

}  // namespace heml
