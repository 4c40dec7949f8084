#pragma once
// All errors of one scene, and the best method within a time or an error.
//
//   time error   each method against the reference on the same mesh and element      (time_study.hpp)
//   mesh error   the same mesh and element at equilibrium against finer meshes       (mesh_convergence_study.hpp)
//   error        their sum: an estimate of the total error
#include <studies/mesh_convergence_study.hpp>
#include <studies/time_study.hpp>

namespace heml {

inline constexpr double seconds_per_frame = 1.0 / 60;  ///< s of simulated time per frame

/// One method on one mesh and element, with its time and mesh errors.
struct Candidate {
  const TimeStudy* study = nullptr;
  const Measured* measured = nullptr;
  std::optional<double> mesh_error;                                          ///< m; none: unknown
  double error() const { return measured->error + mesh_error.value_or(0); }  ///< m
  double frame_seconds() const {
    return measured->seconds_per_second() * seconds_per_frame;
  }                                                                     ///< s, wall time of a frame
  double tick() const { return measured->method.step.value_or(1e-3); }  ///< s
};

struct SceneStudy {
  std::string name, title;
  std::vector<std::string> laws;
  std::vector<TimeStudy> time;  ///< one per kind of element
  MeshConvergenceStudy convergence;
  std::vector<std::string> notes;  ///< what could not be measured, and why

  std::vector<Candidate> candidates() const;  ///< all methods that did not fail
  std::optional<double> mesh_error(const std::string& element) const;
};

struct SceneStudyOptions {
  Breadth sweep = Breadth::whole;
  bool all_elements = true;       ///< time errors also of the elements that the scene does not use
  std::size_t max_tets = 150000;  ///< of meshes for the mesh error; 0: not measured
};

/// name: for tables. Throws InputError if the scene is static.
SceneStudy study_scene(const std::string& name, const Problem& problem, const SceneStudyOptions& options,
                       const StudyContext& context);
std::size_t steps_of_scene_study(const Problem& problem, const SceneStudyOptions& options);

/// The smallest error among methods that compute a frame in that time and whose tick is no longer than a frame; none:
/// no method does.
std::optional<Candidate> best_within(const std::vector<Candidate>& candidates, double frame_seconds);
/// The fastest method whose error is no larger; none: no method is as accurate.
std::optional<Candidate> fastest_within(const std::vector<Candidate>& candidates, double error);

/// "0.31 mm", "12 µm".
std::string length_text(double metres);
/// "nodal_pressure, tr_bdf2, steps of 10 ms, 1 iteration".
std::string text_of(const Candidate& candidate);
/// "within 16 ms a frame, the smallest error is 0.3 mm (0.1 mm of time, 0.2 mm of the mesh), with …"
std::string answer_within(const std::vector<Candidate>& candidates, double frame_seconds);

}  // namespace heml
