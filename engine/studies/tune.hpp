#pragma once
// Finds the best method for a scene: the smallest error within a time, or the shortest time within an error. Measured
// on the scene itself: every method on its mesh with all elements, and on a coarser and a finer mesh where the scene
// can be remeshed (boxes and surfaces whose selections are boxes and spheres).
#include <studies/scene_study.hpp>

namespace heml {

/// Exactly one is set.
struct TuneGoal {
  std::optional<double> frame_seconds;  ///< s, max wall time of a frame
  std::optional<double> error;          ///< m, max error
};

/// A mesh and element of the scene, and all methods tried on it.
struct TunedMesh {
  std::string mesh;  ///< "the scene's mesh", "12 × 4 × 4 cells"
  Scene scene;       ///< with that mesh and element
  TimeStudy study;
  std::optional<double> mesh_error;  ///< m
};

struct Tuning {
  std::vector<TunedMesh> meshes;
  std::vector<std::string> notes;  ///< what was not measured, and why

  std::vector<Candidate> candidates() const;
  const TunedMesh& of(const Candidate& candidate) const;
};

/// quick: fewer methods, the scene's mesh only. Throws InputError if the scene is static or cannot be loaded.
Tuning measure_for_tuning(const Scene& scene, bool quick,
                          const std::function<void(double fraction, const std::string& doing)>& progress = {});

/// The best candidate that reaches the goal; none: no method does.
std::optional<Candidate> best_for(const TuneGoal& goal, const Tuning& tuning);
/// The scene with the mesh, element and method of a candidate.
Scene tuned_scene(const Tuning& tuning, const Candidate& best);
/// Sentences: the best candidate, what was given up for it, and notes.
std::vector<std::string> tuning_text(const TuneGoal& goal, const Tuning& tuning, const Candidate& best);
/// A sentence for a goal that no method reaches: which comes nearest.
std::string nothing_reaches(const TuneGoal& goal, const Tuning& tuning);

}  // namespace heml
