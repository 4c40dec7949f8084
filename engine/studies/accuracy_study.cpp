#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <studies/accuracy_study.hpp>

namespace heml {
namespace {

constexpr double max_growth = 1.1;
constexpr double negligible = 1e-9;    // m, or relative
constexpr double round_off = 1e-6;     // relative force: smaller residuals are rounding noise
constexpr double feature_weight = 15;  // s a scene takes: its part of the progress
constexpr double refined_poisson = 0.3;

RefinementStudy refine_beam(const std::vector<LockingBeam>& beams, bool quick, const StudyContext& context) {
  const auto beam =
      std::find_if(beams.begin(), beams.end(), [](const LockingBeam& b) { return b.poisson == refined_poisson; });
  return study_refinement(*beam, cells_of_locking_study(quick), quick ? 5000 : 30000, context);
}

/// A key of results ("beam 011b105b179f046f|p1, 200 tetrahedra|verlet") without its hash, its parts joined by commas.
std::string readable(const std::string& key) {
  std::string text;
  for (const char c : std::regex_replace(key, std::regex(" [0-9a-f]{16}(?=\\|)"), ""))
    text += c == '|' ? ", " : std::string(1, c);
  return text;
}

/// Overall progress: each part has a weight; the steps of a part count equally.
class Parts {
 public:
  Parts(const AccuracyOptions& options, double whole) : options_(options), whole_(whole) {}

  StudyContext part(double weight, std::size_t steps) {
    before_ += weight_;
    weight_ = weight, steps_ = steps, done_ = 0;
    return {options_.results, options_.make, [this](const std::string& doing) {
              ++done_;
              const double inside = std::min(1.0, static_cast<double>(done_) / static_cast<double>(steps_));
              options_.progress((before_ + weight_ * inside) / whole_, readable(doing));
            }};
  }

 private:
  const AccuracyOptions& options_;
  double whole_, before_ = 0, weight_ = 0;
  std::size_t steps_ = 1, done_ = 0;
};

std::string result_name(const SceneStudy& scene, const TimeStudy& study, const Measured& measured) {
  return fmt::format("{}; {}; {}", scene.name, study.problem, text_of(measured.method));
}

AccuracyStudy study_users_scene(const AccuracyOptions& options) {
  const Problem problem = problem_of(*options.scene);
  SceneStudyOptions how;
  if (options.quick) how.sweep = Breadth::brief, how.max_tets = 20000;
  Parts parts(options, 1.05);
  AccuracyStudy study;
  study.scenes.push_back(
      study_scene(problem.scene.name, problem, how, parts.part(1, steps_of_scene_study(problem, how))));
  if (!options.quick) study.features = {study_features(*options.scene, parts.part(0.05, 1))};
  return study;
}

/// What can be measured by itself.
struct Case {
  double weight;  ///< expected computing time, for the progress
  std::size_t steps;
  std::function<void(const StudyContext&, AccuracyStudy&)> measure;
};

std::vector<Case> own_cases(bool quick) {
  std::vector<Case> cases;
  cases.push_back({2, steps_of_law_study(), [](const StudyContext& context, AccuracyStudy& study) {
                     study.laws = study_laws(context);
                   }});
  cases.push_back({quick ? 8.0 : 80.0, steps_of_locking_study(quick) + 1,
                   [quick](const StudyContext& context, AccuracyStudy& study) {
                     study.locking = study_locking(quick, context);
                     study.refinement = refine_beam(study.locking, quick, context);
                   }});
  for (AccuracyScene& scene : accuracy_scenes(quick))
    cases.push_back({scene.weight, steps_of_scene_study(scene.problem, scene.options),
                     [scene](const StudyContext& context, AccuracyStudy& study) {
                       study.scenes.push_back(study_scene(scene.name, scene.problem, scene.options, context));
                     }});
  if (quick) return cases;
  for (const char* name : {"kidney_pull", "brain_block"})
    cases.push_back({feature_weight, 1, [name](const StudyContext& context, AccuracyStudy& study) {
                       const auto file = assets_folder() / "scenes" / fmt::format("{}.json", name);
                       study.features.push_back(study_features(read_scene(file), context));
                     }});
  return cases;
}

AccuracyStudy study_own_cases(const AccuracyOptions& options) {
  std::vector<Case> cases;
  for (int number = 1; Case& one : own_cases(options.quick)) {
    if (options.only.empty() || std::count(options.only.begin(), options.only.end(), number))
      cases.push_back(std::move(one));
    ++number;
  }
  double whole = 0;
  for (const Case& one : cases) whole += one.weight;
  Parts parts(options, whole);
  AccuracyStudy study;
  for (const Case& one : cases) one.measure(parts.part(one.weight, one.steps), study);
  return study;
}

}  // namespace

int accuracy_case_count(bool quick) { return static_cast<int>(own_cases(quick).size()); }

AccuracyStudy study_accuracy(const AccuracyOptions& options) {
  return options.scene ? study_users_scene(options) : study_own_cases(options);
}

std::vector<ResultValue> result_values(const AccuracyStudy& study) {
  std::vector<ResultValue> values;
  for (const SceneStudy& scene : study.scenes) {
    for (const TimeStudy& time : scene.time)
      for (const Measured& measured : time.measured)
        if (!measured.failed() && measured.resolved && !measured.method.single_precision &&
            measured.method.threads == 1)
          values.push_back({result_name(scene, time, measured), measured.error});
    for (const ConvergenceMesh& mesh : scene.convergence.meshes)
      if (mesh.failed.empty() && mesh.resolved)
        values.push_back(
            {fmt::format("{}; at rest; {}, {} tetrahedra", scene.name, mesh.element, mesh.tets), mesh.error});
  }
  for (const LockingBeam& beam : study.locking) {
    if (!beam.convergence.reference.failure.empty()) continue;
    values.push_back({fmt::format("beam off theory, poisson {}", beam.poisson), std::abs(beam.off_theory())});
    for (const ConvergenceMesh& mesh : beam.convergence.meshes)
      if (mesh.failed.empty() && mesh.resolved)
        values.push_back(
            {fmt::format("beam of poisson {}; {}, {} tetrahedra", beam.poisson, mesh.element, mesh.tets), mesh.error});
  }
  if (study.refinement)
    for (int round = 0; const RefinedMesh& mesh : study.refinement->meshes)
      if (mesh.adapted)
        values.push_back({fmt::format("energy norm of the beam, adapted {} times", round++), mesh.error});
  for (const LawCheck& law : study.laws)
    if (law.failed.empty())
      values.push_back({fmt::format("force left by {}", law.law), std::max(law.left_over, round_off)});
  return values;
}

Json to_json(const std::vector<ResultValue>& values) {
  Json json = Json::object();
  for (const ResultValue& value : values) json[value.name] = value.value;
  return json;
}

std::vector<std::string> what_got_worse(const std::vector<ResultValue>& values, const Json& committed) {
  std::vector<std::string> worse;
  for (const auto& [name, value] : committed.items()) {
    const auto now =
        std::find_if(values.begin(), values.end(), [&, &name = name](const ResultValue& f) { return f.name == name; });
    const double before = value.get<double>();
    if (now == values.end())
      worse.push_back(fmt::format("{}: was {:.4g}, and is no more: it failed or was not measured", name, before));
    else if (!(now->value <= max_growth * before + negligible))
      worse.push_back(fmt::format("{}: was {:.4g}, is {:.4g}", name, before, now->value));
  }
  return worse;
}

}  // namespace heml
