// `heml explain`: prints what a scene makes the engine run, its costs and warnings.
#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/explanation_json.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/write_file.hpp>
#include <heml/dynamics/linear_solver.hpp>
#include <heml/scenario/input_files.hpp>
#include <numbers>
#include <studies/operation_count.hpp>

namespace heml {
namespace {

void print_head(const char* title) { fmt::print("\n{}\n", title); }

template <class... Args>
void print_line(const std::string& name, fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("  {:<18}{}\n", name, fmt::format(format, std::forward<Args>(args)...));
}

std::string bytes_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", bytes / 1e3);
  return bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6) : fmt::format("{:.2f} GB", bytes / 1e9);
}

void print_chosen(const Explanation& explained) {
  if (!explained.chosen) return;
  print_head("Chosen for a bare mesh");
  for (const BareMeshChoices::Text& text : explained.chosen->texts) print_line(text.about, "{}", text.text);
}

void print_body(const Explanation& explained) {
  const WorldFacts& world = explained.world;
  const QualityReport& quality = explained.quality;
  print_head("Body");
  print_line("mesh", "{} nodes, {} tetrahedra{}, {} region{}", world.nodes, world.tets,
             world.live_tets == world.tets ? "" : fmt::format(" ({} live)", world.live_tets), quality.regions,
             quality.regions == 1 ? "" : "s");
  print_line("shape", "edges {:.3g} to {:.3g} mm, min dihedral angle {:.3g}° (element {})", 1e3 * quality.shortest_edge,
             1e3 * quality.longest_edge, quality.worst_dihedral, quality.worst_tet);
  print_line("constrained", "{} nodes", world.constrained_nodes);
  if (explained.regions.size() > 1)
    for (const RegionFacts& region : explained.regions)
      print_line(fmt::format("region {}", region.number), "{}{} tetrahedra, {:.4g} cm³",
                 region.name.empty() ? "" : region.name + ": ", region.tets, 1e6 * region.volume);
}

std::string region_text(const TetMesh& mesh, int region) {
  const auto name = mesh.region_names.find(region);
  return fmt::format("region {}{}", region, name == mesh.region_names.end() ? "" : ", " + name->second);
}

void print_materials(const Explanation& explained) {
  print_head("Elements");
  for (const MaterialFacts& material : explained.materials) {
    const KernelInfo& kernel = material.kernel;
    print_line(material.region ? region_text(explained.setup.mesh, *material.region) : "default",
               "{} tetrahedra, kernel {} ({})", kernel.elements, kernel.kernel, kernel.instructions);
    for (const TermFacts& term : material.terms) print_line("  " + term.name, "{}", term.detail);
    if (material.rest.shear > 0)
      print_line("  at rest", "shear modulus {:.4g} Pa, bulk {:.4g} Pa, Poisson's ratio {:.4g}", material.rest.shear,
                 material.rest.bulk, material.poisson);
    if (const auto count = element_operations(explained.setup.materials[kernel.material].material))
      print_line("  operations", "{} multiplications, {} additions, {} others per tetrahedron and force evaluation",
                 count->multiplications, count->additions, count->others);
    if (kernel.bytes_per_tet > 0)
      print_line("  traffic", "{:.0f} bytes per tetrahedron and force evaluation", kernel.bytes_per_tet);
  }
}

void print_choice(const Explanation& explained) {
  const MethodFacts& method = explained.world.method;
  const StepFacts& step = explained.world.step;
  if (method.asked != Integrator::automatic) return;
  if (explained.setup.solver.step)
    print_line("why", "the given step of {:.3g} ms is {:.3g} of the stable one; explicit up to 1", 1e3 * step.tick,
               step.tick / step.stable);
  else
    print_line("why",
               "explicit steps would take {:.3g} of real time ({:.0f} ns per element and step); explicit up to {}",
               method.explicit_share, 1e9 * method.step_cost, method.enough);
  if (method.lowest_frequency && !is_explicit(method.used))
    print_line("", "tick × lowest frequency = {:.3g}; tr_bdf2 below {}, else backward_euler",
               step.tick * *method.lowest_frequency, method.resolved);
}

std::string stable_step_text(const Explanation& explained) {
  const WorldFacts& world = explained.world;
  if (!(world.step.stable > 0))
    return fmt::format("none: the stiffness of the body is no number that {} precision can hold",
                       explained.setup.solver.single_precision ? "single" : "double");
  return fmt::format("{:.4g} ms for explicit methods now; {:.3g} of real time by the cost model",
                     1e3 * world.step.stable, world.method.explicit_share);
}

void print_method(const Explanation& explained) {
  const WorldFacts& world = explained.world;
  const StepFacts& step = world.step;
  const LimitFacts& limit = explained.limit;
  print_head("Motion");
  print_line("integrator", "{}{}, {} precision, {} thread{}", integrator_name(world.method.used),
             world.method.asked == Integrator::automatic ? " (auto)" : "",
             explained.setup.solver.single_precision ? "float" : "double", world.threads,
             world.threads == 1 ? "" : "s");
  if (world.threads > 1 && explained.setup.solver.threads == 0)
    print_line("", "one per core; in the window less the cores that drawing takes");
  print_choice(explained);
  if (explained.setup.solver.is_static())
    print_line("load", "in adaptive increments");
  else
    print_line("tick", "{:.4g} ms, {} step{}", 1e3 * step.tick, step.steps_per_tick,
               step.steps_per_tick == 1 ? "" : "s");
  print_line("stable step", "{}", stable_step_text(explained));
  if (step.heavier_nodes > 0)
    print_line("mass scaling", "{:.2g} % of the mass added, at {} node{}", 1e2 * step.added_mass, step.heavier_nodes,
               step.heavier_nodes == 1 ? "" : "s");
  if (world.method.lowest_frequency)
    print_line("lowest frequency", "{:.3g} Hz at rest", *world.method.lowest_frequency / (2 * std::numbers::pi));
  if (limit.element < 0) return;
  constexpr const char* causes[] = {"no element stands out", "a sliver", "small", "high stiffness per mass"};
  print_line("limited by", "element {} and those round it: {}; ω² is {:.3g} times the median", limit.element,
             causes[static_cast<std::size_t>(limit.cause)], step.median_ratio);
  print_line("", "smallest angle {:.3g}°, height {:.3g} mm (median {:.3g}), waves {:.3g} m/s (median {:.3g})",
             limit.dihedral, 1e3 * limit.height, 1e3 * limit.median_height, limit.wave_speed, limit.median_wave_speed);
}

void print_solver(const Explanation& explained) {
  if (!explained.world.solver) return;
  const SolverFacts& solver = *explained.world.solver;
  const bool at_rest = explained.setup.solver.is_static();
  print_head("Solver");
  print_line("minimiser", "{}, relative residual {:.3g}", minimiser_names[static_cast<std::size_t>(solver.minimiser)],
             solver.tolerance);
  print_line("preconditioner", "{}{}", preconditioner_names[static_cast<std::size_t>(solver.preconditioner)],
             solver.levels ? fmt::format(", {} level{}", solver.levels, solver.levels == 1 ? "" : "s") : "");
  const std::size_t small = max_direct_unknowns_each_time(at_rest);
  if (solver.by_size)
    print_line("why", "{} free nodes: cholesky up to {}, {}multilevel above", solver.free_nodes, small,
               small < max_direct_unknowns_once ? fmt::format("scalar up to {}, ", max_direct_unknowns_once) : "");
  else
    print_line("why", "set by the scene; {} free nodes", solver.free_nodes);
  print_line("projection", "{}, where the stiffness is indefinite",
             projection_names[static_cast<std::size_t>(solver.projection)]);
  print_line("no convergence", "{}",
             solver.rescues ? "halved steps, then explicit substeps, then the best iterate" : "ends the run");
  if (solver.budget)
    print_line("budget", "{}",
               solver.budget->iterations ? fmt::format("{} iterations per stage", solver.budget->iterations)
                                         : fmt::format("{:.3g} ms per tick", solver.budget->milliseconds));
}

void print_tools(const Explanation& explained) {
  if (explained.tools.empty()) return;
  print_head("Tools");
  for (const ToolFacts& tool : explained.tools) {
    std::string use;
    if (tool.first)
      use = tool.first == tool.last ? fmt::format("at {:.3g} s: ", *tool.first)
                                    : fmt::format("{} time{}, from {:.3g} to {:.3g} s: ", tool.times,
                                                  tool.times == 1 ? "" : "s", *tool.first, *tool.last);
    print_line(tool.name, "{}{}", use, tool.detail);
  }
}

void print_costs(const Explanation& explained) {
  print_head("Memory");
  double all = 0;
  for (const MemoryFacts& memory : explained.world.memory) {
    print_line(memory.what, "{}", bytes_text(static_cast<double>(memory.bytes)));
    all += static_cast<double>(memory.bytes);
  }
  print_line("total", "{}, {:.0f} bytes per tetrahedron", bytes_text(all),
             all / static_cast<double>(explained.world.live_tets));
  print_head("Startup");
  for (const StartupWork& work : explained.startup) fmt::print("  {:>8.2f} ms  {}\n", 1e3 * work.seconds, work.what);
}

void print_rest(const Explanation& explained) {
  print_head("Omitted");
  for (const OmittedFeature& left : explained.omitted_features) fmt::print("  {:<28}{}\n", left.feature, left.why);
  print_head("Warnings");
  for (const Advice& advice : explained.advice)
    fmt::print("  {}: {}\n    → {}\n", advice.about, advice.text, advice.remedy);
  if (explained.advice.empty()) fmt::print("  none\n");
}

void print_measured(const Explanation& explained, const Measurement& measured) {
  const bool at_rest = explained.setup.solver.is_static();
  print_head("Measured");
  fmt::print("  {:.4g} {}; min of {} rounds; max displacement {:.4g} mm\n", measured.stretch,
             at_rest ? "of the load" : "s of simulated time", measured.turns, 1e3 * measured.max_motion);
  fmt::print("  {:<20}{:<26}{:>11}{:>11}{:>10}{:>13}\n", "feature", "changed", at_rest ? "ms" : "ms/tick", "saved",
             "steps", "rms mm");
  for (const MeasuredChange& change : measured.changes) {
    const std::string changed = change.from.empty() ? "" : change.from + " → " + change.to;
    fmt::print("  {:<20}{:<26}{:>11.4g}", change.feature, changed, change.milliseconds);
    if (change.from.empty())
      fmt::print("{:>11}{:>10.3g}", "", change.steps);
    else
      fmt::print("{:>11.3g}{:>10.3g}{:>13.3g}", measured.changes.front().milliseconds - change.milliseconds,
                 change.steps, 1e3 * change.error);
    fmt::print("{}\n", change.halted.empty() ? "" : "  ended early");
  }
}

}  // namespace

int explain_scene(const ExplainArguments& arguments) {
  const Scene scene = read_scene(arguments.scene);
  if (arguments.save) {
    check_output_file(input_files(scene), *arguments.save);
    write_file(*arguments.save, scene_text(scene, std::filesystem::absolute(*arguments.save).parent_path()));
  }
  const Explanation explained = explain(scene);
  std::optional<Measurement> measured;
  if (arguments.measure) {
    Progress progress("measuring");
    measured = measure_features(scene, explained.setup, [&](double fraction) { progress.show(fraction); });
  }
  if (arguments.json) {
    fmt::print("{}\n", json_text(explanation_json(explained, measured), scene.file, true));
    return exit_done;
  }
  fmt::print("{}\n", scene.name.empty() ? scene.file : fmt::format("{} ({})", scene.name, scene.file));
  print_chosen(explained);
  print_body(explained);
  print_materials(explained);
  print_method(explained);
  print_solver(explained);
  print_tools(explained);
  print_costs(explained);
  print_rest(explained);
  if (measured) print_measured(explained, *measured);
  return exit_done;
}

}  // namespace heml
