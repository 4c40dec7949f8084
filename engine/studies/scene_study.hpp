#pragma once
// All errors of one scene, and the answer they lead to.
//
//   time error   each method against the reference on the same mesh and element      (time_study.hpp)
//   mesh error   the same mesh and element at rest against finer meshes              (mesh_convergence_study.hpp)
//   error        their sum: what a user sees at most
#include <studies/mesh_convergence_study.hpp>
#include <studies/time_study.hpp>

namespace heml {

inline constexpr double frame = 1.0 / 60;  ///< s of simulated time between two pictures: what is budgeted

/// One method on one mesh and element with both its errors.
struct Candidate {
  const TimeStudy* study = nullptr;
  const Measured* measured = nullptr;
  std::optional<double> mesh_error;                                                ///< m; none: not known
  double error() const { return measured->error + mesh_error.value_or(0); }        ///< m
  double frame_seconds() const { return measured->seconds_per_second() * frame; }  ///< of computing
  double tick() const { return measured->method.step.value_or(1e-3); }             ///< s
};

struct SceneStudy {
  std::string name, title;
  std::vector<std::string> laws;
  std::vector<TimeStudy> time;  ///< one an element
  MeshConvergenceStudy convergence;
  std::vector<std::string> notes;  ///< what could not be measured, and why

  std::vector<Candidate> candidates() const;  ///< all that did not fail
  std::optional<double> mesh_error(bool nodal_pressure) const;
};

struct SceneStudyOptions {
  Breadth sweep = Breadth::whole;
  bool both_elements = true;      ///< time errors of the element the scene does not name, too
  std::size_t max_tets = 150000;  ///< of meshes for the mesh error; 0: none is measured
};

/// name: for tables. Throws InputError for a static scene and for what loading refuses.
SceneStudy study_scene(const std::string& name, const Problem& problem, const SceneStudyOptions& options,
                       const StudyContext& context);
std::size_t steps_of_scene_study(const Problem& problem, const SceneStudyOptions& options);

/// The least error whose frame is computed in that time and that has a state for every frame; none: nothing is as fast.
std::optional<Candidate> best_within(const std::vector<Candidate>& candidates, double frame_seconds);
/// The least time whose error is no larger; none: nothing is as exact.
std::optional<Candidate> fastest_within(const std::vector<Candidate>& candidates, double error);

/// "0.31 mm", "12 µm".
std::string length_text(double metres);
/// "nodal_pressure, tr_bdf2, steps of 10 ms, 1 iteration".
std::string text_of(const Candidate& candidate);
/// "within 16 ms a frame, the smallest error is 0.3 mm (0.1 mm of time, 0.2 mm of the mesh), with …"
std::string answer_within(const std::vector<Candidate>& candidates, double frame_seconds);

}  // namespace heml
