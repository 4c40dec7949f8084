#pragma once
// The accuracy study in words and tables: the answers first, then the Pareto fronts, then everything.
#include <studies/accuracy_study.hpp>
#include <studies/html_page.hpp>

namespace heml {

/// The budgets of a frame that every report answers for, s.
inline constexpr double frame_budgets[] = {0.033, 0.016, 0.001};

/// One sentence a scene and budget, the scene's name first where there are several.
std::vector<std::string> answers_of(const AccuracyStudy& study);

/// What nothing tried beats: computing time a frame, errors, how.
TextTable front_table(const SceneStudy& scene);
/// Every method on one mesh and element; failed ones say why.
TextTable time_table(const TimeStudy& study);
/// Mesh and element at rest.
TextTable mesh_convergence_table(const MeshConvergenceStudy& study);
TextTable locking_table(const std::vector<LockingBeam>& beams);
/// Of linear tetrahedra: what the panel estimates of the error of a mesh, and what finer meshes tell of it.
TextTable refinement_table(const RefinementStudy& study);
TextTable step_doubling_table(const AccuracyStudy& study);
TextTable law_table(const std::vector<LawCheck>& laws);
TextTable feature_table(const FeatureStudy& study);
/// One line a run, with the machine, compiler, commit and threads it was made with.
TextTable run_table(const AccuracyStudy& study);

/// A picture of the report and the part it belongs to: a scene's name, "locking", or "features" and a scene's name.
struct ReportPicture {
  std::string part;
  std::filesystem::path file;
  std::string caption;
};

/// The whole report. command: what made it. worse: what_got_worse().
std::string accuracy_page(const AccuracyStudy& study, const std::vector<ReportPicture>& pictures,
                          const std::string& command, const std::vector<std::string>& worse);

}  // namespace heml
