#pragma once
// The HTML report of the accuracy study: answers first, then Pareto fronts, then all tables.
#include <studies/accuracy_study.hpp>
#include <studies/html_page.hpp>

namespace heml {

/// Computing times of a frame (s) within which every report names the most accurate method.
inline constexpr double frame_budgets[] = {0.033, 0.016, 0.001};

/// One sentence per scene and budget of frame_budgets.
std::vector<std::string> answers_of(const AccuracyStudy& study);

/// The Pareto front: computing time of a frame, errors, method.
TextTable front_table(const SceneStudy& scene);
/// Every method on one mesh and element; failed ones with the reason.
TextTable time_table(const TimeStudy& study);
/// Meshes and elements at static equilibrium.
TextTable mesh_convergence_table(const MeshConvergenceStudy& study);
TextTable locking_table(const std::vector<LockingBeam>& beams);
/// Uniform and adapted meshes: error and the panel's estimate of it, in the energy norm.
TextTable refinement_table(const RefinementStudy& study);
/// Linear tetrahedra: the panel's estimate of the mesh error against the error from finer meshes.
TextTable error_estimate_table(const AccuracyStudy& study);
TextTable law_table(const std::vector<LawCheck>& laws);
TextTable feature_table(const FeatureStudy& study);
/// One row per run, with machine, compiler, commit and threads.
TextTable run_table(const AccuracyStudy& study);

/// A picture of the report and the part it belongs to: a scene's name, "locking", or "features" and a scene's name.
struct ReportPicture {
  std::string part;
  std::filesystem::path file;
  std::string caption;
};

/// The whole report as HTML. command: the command line that made it. worse: from what_got_worse().
std::string accuracy_page(const AccuracyStudy& study, const std::vector<ReportPicture>& pictures,
                          const std::string& command, const std::vector<std::string>& worse);

}  // namespace heml
