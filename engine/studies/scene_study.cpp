#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <studies/scene_study.hpp>

namespace heml {
namespace {

constexpr int finest = 2;  // uniform subdivisions of the finest mesh

std::vector<std::string> laws_of(const WorldSetup& setup) {
  std::vector<std::string> laws;
  for (const RegionMaterial& entry : setup.materials)
    if (std::find(laws.begin(), laws.end(), entry.material.law) == laws.end()) laws.push_back(entry.material.law);
  return laws;
}

std::vector<std::string> elements_of(const Problem& problem, const SceneStudyOptions& options) {
  return options.all_elements ? elements_of(problem) : std::vector{problem.element()};
}

int halvings_of(const Problem& problem, const SceneStudyOptions& options) {
  const int halvings = halvings_within(problem.setup.mesh.tets.size(), options.max_tets, finest);
  return halvings == finest && linear_base(problem) ? finest : 0;  // extrapolation needs three meshes
}

template <class Better, class Wanted>
std::optional<Candidate> best_of(const std::vector<Candidate>& candidates, const Wanted& wanted, const Better& better) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (wanted(candidate) && (!best || better(candidate, *best))) best = &candidate;
  return best ? std::optional(*best) : std::nullopt;
}

}  // namespace

std::optional<double> SceneStudy::mesh_error(const std::string& element) const {
  if (!convergence.reference.failure.empty()) return std::nullopt;
  const ConvergenceMesh* mesh = convergence.find(element, 0);
  return mesh ? std::optional(mesh->error) : std::nullopt;
}

std::vector<Candidate> SceneStudy::candidates() const {
  std::vector<Candidate> list;
  for (const TimeStudy& study : time)
    for (const Measured& measured : study.measured)
      if (!measured.failed()) list.push_back({&study, &measured, mesh_error(study.element)});
  return list;
}

std::size_t steps_of_scene_study(const Problem& problem, const SceneStudyOptions& options) {
  const int halvings = halvings_of(problem, options);
  return elements_of(problem, options).size() * steps_of_time_study(options.sweep) +
         (halvings ? steps_of_mesh_convergence_study(problem, halvings) : 0);
}

SceneStudy study_scene(const std::string& name, const Problem& problem, const SceneStudyOptions& options,
                       const StudyContext& context) {
  if (problem.scene.solver.is_static())
    throw InputError(problem.scene.file, "solver.integrator", "is static: it has no steps to choose",
                     "give an integrator of motions, or measure its mesh by refining it");
  const std::string key = key_of(problem);
  SceneStudy study;
  study.name = name;
  study.title = problem.scene.title.empty() ? name : problem.scene.title;
  study.laws = laws_of(problem.setup);
  for (const std::string& element : elements_of(problem, options)) {
    const Problem now = with_element(problem, element);
    study.time.push_back(study_time(key, now, set_times(problem.scene), options.sweep, context));
    const TimeStudy& time = study.time.back();
    if (!time.reference.failure.empty())
      study.notes.push_back(
          fmt::format("{}: no time errors, since the reference failed: {}", time.problem, time.reference.failure));
  }
  if (const int halvings = halvings_of(problem, options); halvings > 0)
    study.convergence = study_mesh_convergence(key, problem, halvings, context);
  else
    study.convergence.reference.failure =
        options.max_tets == 0 ? "it is measured on another mesh of this scene" : "finer meshes are too large";
  if (!study.convergence.reference.failure.empty())
    study.notes.push_back(fmt::format("the mesh error is not known: {}", study.convergence.reference.failure));
  else if (!problem.scene.events.empty())
    study.notes.push_back("the mesh error is of the body at rest, before any event");
  return study;
}

std::optional<Candidate> best_within(const std::vector<Candidate>& candidates, double frame_seconds) {
  return best_of(
      candidates,
      [&](const Candidate& c) {
        return c.frame_seconds() <= frame_seconds && c.tick() <= seconds_per_frame * (1 + 1e-9);
      },
      [](const Candidate& a, const Candidate& b) {
        return a.error() != b.error() ? a.error() < b.error() : a.frame_seconds() < b.frame_seconds();
      });
}

std::optional<Candidate> fastest_within(const std::vector<Candidate>& candidates, double error) {
  return best_of(
      candidates, [&](const Candidate& c) { return c.error() <= error; },
      [](const Candidate& a, const Candidate& b) { return a.frame_seconds() < b.frame_seconds(); });
}

std::string length_text(double metres) {
  if (metres == 0) return "0";
  if (metres >= 0.01) return fmt::format("{:.3g} cm", 100 * metres);
  if (metres >= 1e-4) return fmt::format("{:.2g} mm", 1e3 * metres);
  return metres >= 1e-7 ? fmt::format("{:.2g} µm", 1e6 * metres) : fmt::format("{:.2g} nm", 1e9 * metres);
}

std::string text_of(const Candidate& candidate) {
  return fmt::format("{}, {}", candidate.study->element, text_of(candidate.measured->method));
}

std::string answer_within(const std::vector<Candidate>& candidates, double frame_seconds) {
  const auto best = best_within(candidates, frame_seconds);
  if (!best) return fmt::format("within {:.3g} ms a frame, nothing tried is fast enough", 1e3 * frame_seconds);
  const std::string parts = best->mesh_error
                                ? fmt::format(" ({} of time, {} of the mesh)", length_text(best->measured->error),
                                              length_text(*best->mesh_error))
                                : std::string(" of time (that of the mesh is not known)");
  return fmt::format("within {:.3g} ms a frame, the smallest error is {}{}, with {}", 1e3 * frame_seconds,
                     length_text(best->error()), parts, text_of(*best));
}

}  // namespace heml
