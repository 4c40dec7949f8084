#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <studies/sample_motion.hpp>
#include <studies/tune.hpp>

namespace heml {
namespace {

constexpr std::size_t max_tets = 150000;  // of meshes for the mesh error
constexpr double max_reference = 120;     // s, wall time expected of a finer mesh's reference
constexpr double finer_costs = 16;        // times the cost of the mesh: eight times the elements, half the step

/// Whether the scene generates its mesh and refers to it by regions of space only, so that another mesh fits as well.
bool can_be_remade(const Scene& scene) {
  const auto is_place = [](const Selection& where) { return where.nodes.empty(); };
  const auto keeps = [&](const Event& event) {
    const auto* remove = std::get_if<RemoveElements>(&event.command);
    return !std::holds_alternative<Grasp>(event.command) && !(remove && !remove->which.tets.empty());
  };
  return (scene.mesh.box || (!scene.mesh.surface.empty() && scene.mesh.max_volume)) &&
         std::all_of(scene.boundary.begin(), scene.boundary.end(), [&](const auto& b) { return is_place(b.where); }) &&
         std::all_of(scene.loads.begin(), scene.loads.end(), [&](const auto& l) { return is_place(l.where); }) &&
         std::all_of(scene.events.begin(), scene.events.end(), keeps) && scene.initial_positions.empty();
}

/// With elements of twice (factor 2) or half the size (0.5); none: a box with an odd number of cells has no coarser
/// mesh.
std::optional<Scene> remade(Scene scene, double factor) {
  if (!scene.mesh.box) {
    *scene.mesh.max_volume *= factor * factor * factor;
    return scene;
  }
  for (int& cells : scene.mesh.box->cells) {
    if (factor > 1 && cells % 2) return std::nullopt;
    cells = static_cast<int>(std::lround(cells / factor));
  }
  return scene;
}

std::string mesh_text(const Scene& scene, std::size_t tets) {
  if (!scene.mesh.box) return fmt::format("{} tetrahedra of at most {:.3g} m³", tets, *scene.mesh.max_volume);
  const auto& cells = scene.mesh.box->cells;
  return fmt::format("{} × {} × {} cells, {} tetrahedra", cells[0], cells[1], cells[2], tets);
}

/// Adds another mesh of the scene, with its time errors and its mesh error from the first mesh's extrapolation.
void add_mesh(Tuning& tuning, const Scene& scene, const Problem& first, const MeshConvergenceStudy& convergence,
              const std::vector<double>& times, const StudyContext& context) {
  const Problem other = problem_of(scene);
  for (const std::string& element : elements_of(other)) {
    const Problem now = with_element(other, element);
    TunedMesh mesh{mesh_text(scene, now.setup.mesh.tets.size()), now.scene,
                   study_time(key_of(other), now, times, Breadth::brief, context), std::nullopt};
    if (convergence.reference.failure.empty()) {
      const auto x = equilibrium_positions(key_of(other), now, context);
      if (!x.empty()) {
        const bool quadratic = is_quadratic(element);  // by its nodes, between which it is almost linear
        const TetMesh mesh_of_nodes = quadratic ? subdivided(now.setup.mesh, now.setup.midedges) : now.setup.mesh;
        const auto there = sample_motion(mesh_of_nodes, x, first.setup.mesh.nodes);
        mesh.mesh_error =
            std::max(rms_distance(there, convergence.reference.best, first.mass), convergence.reference.resolution());
      }
    }
    tuning.meshes.push_back(std::move(mesh));
  }
}

void add_other_meshes(Tuning& tuning, const Scene& scene, const Problem& first, const MeshConvergenceStudy& convergence,
                      const std::vector<double>& times, const StudyContext& context) {
  if (!can_be_remade(scene)) {
    tuning.notes.push_back("the mesh stays: it is not made by the scene, or something refers to its nodes or elements");
    return;
  }
  if (const auto coarser = remade(scene, 2))
    add_mesh(tuning, *coarser, first, convergence, times, context);
  else
    tuning.notes.push_back("no coarser mesh was tried: the numbers of cells are not all even");
  if (finer_costs * tuning.meshes.front().study.reference.seconds > max_reference)
    tuning.notes.push_back("no finer mesh was tried: its reference would take minutes");
  else
    add_mesh(tuning, *remade(scene, 0.5), first, convergence, times, context);
}

/// Upper bound: a coarser and a finer mesh.
std::size_t steps_of_other_meshes(const Problem& problem) {
  return 2 * elements_of(problem).size() * (steps_of_time_study(Breadth::brief) + 1);
}

std::string goal_text(const TuneGoal& goal) {
  return goal.frame_seconds ? fmt::format("within {:.3g} ms a frame", 1e3 * *goal.frame_seconds)
                            : fmt::format("within an error of {}", length_text(*goal.error));
}

std::string facts_text(const Candidate& c) {
  return fmt::format("{} ({} of time{}), {:.3g} ms a frame", length_text(c.error()), length_text(c.measured->error),
                     c.mesh_error ? ", " + length_text(*c.mesh_error) + " of the mesh" : "", 1e3 * c.frame_seconds());
}

const Candidate& most_exact(const std::vector<Candidate>& candidates) {
  return *std::min_element(candidates.begin(), candidates.end(),
                           [](const Candidate& a, const Candidate& b) { return a.error() < b.error(); });
}

const Candidate& fastest(const std::vector<Candidate>& candidates) {
  return *std::min_element(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.frame_seconds() < b.frame_seconds();
  });
}

}  // namespace

std::vector<Candidate> Tuning::candidates() const {
  std::vector<Candidate> list;
  for (const TunedMesh& mesh : meshes)
    for (const Measured& measured : mesh.study.measured)
      if (!measured.failed()) list.push_back({&mesh.study, &measured, mesh.mesh_error});
  return list;
}

const TunedMesh& Tuning::of(const Candidate& candidate) const {
  return *std::find_if(meshes.begin(), meshes.end(),
                       [&](const TunedMesh& mesh) { return &mesh.study == candidate.study; });
}

Tuning measure_for_tuning(const Scene& scene, bool quick,
                          const std::function<void(double fraction, const std::string& doing)>& progress) {
  const Problem problem = problem_of(scene);
  SceneStudyOptions options;
  options.max_tets = max_tets;
  if (quick) options.sweep = Breadth::brief;
  std::size_t steps = steps_of_scene_study(problem, options), done = 0;
  if (!quick && can_be_remade(scene)) steps += steps_of_other_meshes(problem);
  StudyContext context;
  context.step_done = [&](const std::string& doing) {
    ++done;
    if (progress) progress(std::min(1.0, static_cast<double>(done) / static_cast<double>(steps)), doing);
  };

  SceneStudy own = study_scene(problem.scene.name, problem, options, context);
  Tuning tuning;
  tuning.notes = own.notes;
  for (TimeStudy& study : own.time) {
    Scene with = with_element(problem, study.element).scene;
    tuning.meshes.push_back({"the scene's mesh", std::move(with), study, own.mesh_error(study.element)});
  }
  if (!quick)
    add_other_meshes(tuning, scene, linear_base(problem).value_or(problem), own.convergence, set_times(scene), context);
  return tuning;
}

std::optional<Candidate> best_for(const TuneGoal& goal, const Tuning& tuning) {
  const auto candidates = tuning.candidates();
  return goal.frame_seconds ? best_within(candidates, *goal.frame_seconds) : fastest_within(candidates, *goal.error);
}

Scene tuned_scene(const Tuning& tuning, const Candidate& best) {
  return with_method(tuning.of(best).scene, best.measured->method);
}

std::vector<std::string> tuning_text(const TuneGoal& goal, const Tuning& tuning, const Candidate& best) {
  const auto candidates = tuning.candidates();
  const Method& method = best.measured->method;
  const TunedMesh& mesh = tuning.of(best);
  std::vector<std::string> text;
  text.push_back(fmt::format("{}: {}: {}, with {}, on {}.", mesh.scene.name, goal_text(goal), facts_text(best),
                             text_of(best), mesh.mesh));
  const Candidate& exact = most_exact(candidates);
  if (exact.error() < best.error())
    text.push_back(fmt::format("Given up: {} of error; the most exact way tried, {}, on {}, has {}.",
                               length_text(best.error() - exact.error()), text_of(exact), tuning.of(exact).mesh,
                               facts_text(exact)));
  else
    text.push_back("Given up: no exactness; nothing tried has a smaller error.");
  const Candidate& fast = fastest(candidates);
  if (fast.frame_seconds() < best.frame_seconds())
    text.push_back(fmt::format("The fastest way tried, {}, on {}, has {}.", text_of(fast), tuning.of(fast).mesh,
                               facts_text(fast)));
  if (method.single_precision) text.push_back("Given up: double precision.");
  if (best.measured->run.slow_tick > method.step.value_or(1e-3))
    text.push_back(fmt::format("One tick in a hundred takes {:.3g} ms or more, which is longer than the tick itself.",
                               1e3 * best.measured->run.slow_tick));
  for (const std::string& note : tuning.notes) text.push_back(note + ".");
  text.push_back("Times are of this machine and of what else it did; errors are not.");
  return text;
}

std::string nothing_reaches(const TuneGoal& goal, const Tuning& tuning) {
  const auto candidates = tuning.candidates();
  std::string text = goal_text(goal) + ": nothing tried reaches it";
  if (candidates.empty()) {
    for (const std::string& note : tuning.notes) text += "; " + note;
    return text;
  }
  const Candidate& nearest = goal.frame_seconds ? fastest(candidates) : most_exact(candidates);
  return fmt::format("{}; the {} way, {}, on {}, has {}", text, goal.frame_seconds ? "fastest" : "most exact",
                     text_of(nearest), tuning.of(nearest).mesh, facts_text(nearest));
}

}  // namespace heml
