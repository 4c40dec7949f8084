#include <heml/mesh/faces.hpp>
#include <heml/mesh/surface.hpp>

namespace heml {

BoundaryFaces extract_boundary(const TetMesh& mesh) {
  const auto counts = face_counts(mesh.tets, static_cast<int>(mesh.nodes.size()));
  BoundaryFaces boundary;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (int f = 0; f < 4; ++f) {
      if (counts[4 * t + f] != 1) continue;
      const Tet& tet = mesh.tets[t];
      const auto& local = tet_faces[f];
      boundary.triangles.push_back({tet[local[0]], tet[local[1]], tet[local[2]]});
      boundary.tets.push_back(static_cast<int>(t));
    }
  return boundary;
}

}  // namespace heml
