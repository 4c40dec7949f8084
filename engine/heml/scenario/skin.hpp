#pragma once
// A fine surface that is drawn in place of the body's own (scene key `skin`). It is no part of the physics.
#include <cstdint>
#include <heml/mesh/embedding.hpp>
#include <heml/mesh/textured_surface.hpp>
#include <heml/scenario/scene.hpp>
#include <memory>

namespace heml {

/// The place on the body's surface nearest to a vertex.
struct SkinAnchor {
  Triangle nodes;                ///< mesh-file numbers
  std::array<float, 3> weights;  ///< of 1 in all
  int region;                    ///< of the element behind
};

/// Immutable, shared by frames.
struct Skin {
  TexturedSurface surface;  ///< as placed, m, outward
  Embedding embedding;      ///< of its vertices, in the mesh at rest
  // Of the skin of an edited body (session/skin_cutter.hpp); empty otherwise:
  std::vector<SkinAnchor> anchors = {};  ///< #V
  std::vector<std::uint32_t> same = {};  ///< #V: the lowest vertex at the same place and on the same side of all cuts
};

/// The skin of a scene; null if it names none. mesh: as load_setup() returns it. Scaled, turned and moved as the mesh
/// is. Warns of a surface far from the body. Throws InputError for files that are missing or of another kind.
std::shared_ptr<const Skin> load_skin(const Scene& scene, const TetMesh& mesh);

}  // namespace heml
