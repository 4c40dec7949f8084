#pragma once
// A scene solved the best way that was found for it: the least error within a time, or the least time within an error.
// Measured on the scene itself: every method on its mesh with both elements, and on a coarser and a finer mesh where
// the scene's can be made anew (boxes and surfaces whose selections are boxes and spheres).
#include <studies/scene_study.hpp>

namespace heml {

/// One of the two.
struct TuneGoal {
  std::optional<double> frame_seconds;  ///< s of computing a frame, at most
  std::optional<double> error;          ///< m, at most
};

/// A mesh and element of the scene, and all that was tried on it.
struct TunedMesh {
  std::string mesh;  ///< "the scene's mesh", "12 × 4 × 4 cells"
  Scene scene;       ///< with that mesh and element
  TimeStudy study;
  std::optional<double> mesh_error;  ///< m
};

struct Tuning {
  std::vector<TunedMesh> meshes;
  std::vector<std::string> notes;  ///< what could not be measured, or was left out

  std::vector<Candidate> candidates() const;
  const TunedMesh& of(const Candidate& candidate) const;
};

/// quick: fewer methods, the scene's mesh alone. Throws InputError for a static scene and for what loading refuses.
Tuning measure_for_tuning(const Scene& scene, bool quick,
                          const std::function<void(double fraction, const std::string& doing)>& progress = {});

/// What reaches the goal best; none: nothing tried does.
std::optional<Candidate> best_for(const TuneGoal& goal, const Tuning& tuning);
/// The scene solved that way.
Scene tuned_scene(const Tuning& tuning, const Candidate& best);
/// In sentences: what it is, what was given up for it, how sure that is.
std::vector<std::string> tuning_text(const TuneGoal& goal, const Tuning& tuning, const Candidate& best);
/// Why nothing reaches the goal, and what comes nearest.
std::string nothing_reaches(const TuneGoal& goal, const Tuning& tuning);

}  // namespace heml
