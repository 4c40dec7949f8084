#pragma once
// A mesh made finer where it errs: the body is solved, its error estimated (elastic/error_estimate.hpp), the few
// elements that have half of it are cut (mesh/refine.hpp), and so on until the estimate is as small as is asked for.
//
//     WorldSetup ──► at rest, or at a moment of its motion ──► estimate e_t² ──► half of Σ e_t² refined ─┐
//         ▲                                                                                             │
//         └─────────────────────────────────────────────────────────────────────────────────────────────┘
//
// Deterministic, and at rest deaf to events, so that a recording of such a scene comes to the same mesh when it is
// played.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <string>
#include <vector>

namespace heml {

/// One mesh on the way.
struct AdaptedMesh {
  std::size_t nodes, tets;
  double error;              ///< of the energy norm, as estimated
  double stored, potential;  ///< J: elastic energy; Π, that and the loads'
};

struct Adaptation {
  WorldSetup setup;                 ///< on the last mesh
  std::vector<int> origins;         ///< #T of the last mesh: the element of the first that each is a piece of
  std::vector<AdaptedMesh> meshes;  ///< from the first to the last
  bool reached = false;             ///< the last errs by no more than was asked for
};

/// setup: of the scene, on the mesh to begin with. moment: of the scene's motion, s, where its error is looked at;
/// none: at rest under all loads, whatever its events do. told: called with every mesh once its error is known. Throws
/// InputError where the scene cannot be solved so and where nothing deforms it there.
Adaptation adapt(const Scene& scene, WorldSetup setup, const RefineGoal& goal, const std::optional<double>& time,
                 const std::function<void(const AdaptedMesh&)>& told = {});

/// The scene on the last mesh, which the caller writes into the file named, with the fields the scene's mesh had.
/// Throws InputError where events name elements by number.
struct AdaptedScene {
  Scene scene;
  TetMesh mesh;
};
AdaptedScene adapted_scene(const Scene& scene, const Adaptation& adaptation, const std::filesystem::path& mesh_file);

/// "1,600 tetrahedra, error 46.9 %".
std::string text_of(const AdaptedMesh& mesh);

}  // namespace heml
