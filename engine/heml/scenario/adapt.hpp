#pragma once
// Adaptive mesh refinement: solve, estimate the error (elastic/error_estimate.hpp), refine the elements that hold half
// of the squared error (mesh/refine.hpp), and repeat until the estimate meets the goal.
//
//     WorldSetup ──► equilibrium, or state at a given time ──► estimate e_t² ──► half of Σ e_t² refined ─┐
//         ▲                                                                                             │
//         └─────────────────────────────────────────────────────────────────────────────────────────────┘
//
// Deterministic. Refinement at equilibrium ignores scene events, so replays rebuild the same mesh.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <string>
#include <vector>

namespace heml {

/// One mesh of the sequence.
struct AdaptedMesh {
  std::size_t nodes, tets;
  double error;              ///< estimated, relative, in the energy norm
  double stored, potential;  ///< J: elastic energy; total potential energy Π, with that of the loads
};

struct Adaptation {
  WorldSetup setup;                 ///< on the last mesh
  std::vector<int> origins;         ///< #T of the last mesh: each element's ancestor in the first mesh
  std::vector<AdaptedMesh> meshes;  ///< from the first to the last
  bool reached = false;             ///< whether the last mesh meets the goal's error
  bool stagnated = false;           ///< whether the error has stopped falling, as under forces at points
};

/// Who follows an adaptation. Either may be empty.
struct AdaptationObserver {
  std::function<void(const AdaptedMesh&)> told = {};  ///< of every mesh once its error is known
  std::function<void(std::size_t tets)> begun = {};   ///< of every mesh before it is solved
};

/// setup: of the scene, on the initial mesh. time: s, of the scene's motion, at which the error is estimated; empty: in
/// equilibrium under all loads, without events. Throws InputError where the scene cannot be solved or is not deformed
/// there. Solves the scene once per mesh, until the goal's error or number of tetrahedra is reached, or the error has
/// not fallen by a tenth in eight meshes.
Adaptation adapt(const Scene& scene, WorldSetup setup, const RefineGoal& goal, const std::optional<double>& time,
                 const AdaptationObserver& observer = {});

/// Why an adaptation has not reached its goal's error, in one sentence; reached: empty.
std::string why_not_reached(const Adaptation& adaptation, const RefineGoal& goal);

/// The scene on the last mesh, with the fields and regions of the scene's own mesh. The caller writes `mesh` to
/// mesh_file. Throws InputError where events have elements by their numbers.
struct AdaptedScene {
  Scene scene;
  TetMesh mesh;
};
AdaptedScene adapted_scene(const Scene& scene, const Adaptation& adaptation, const std::filesystem::path& mesh_file);

/// A scene with `mesh.refine` on the mesh that it is refined to when it is opened, whose elements and nodes have the
/// numbers that the open scene, and so its events, have. Solves the scene as opening it does; throws as the functions above.
AdaptedScene refined_scene(Scene scene, const std::filesystem::path& mesh_file);

/// "1,600 tetrahedra, estimated error 46.9 %".
std::string text_of(const AdaptedMesh& mesh);

}  // namespace heml
