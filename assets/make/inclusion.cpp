// A cube with a ball of another material in it.
#include <heml/mesh/generate.hpp>

#include "organ.hpp"

namespace heml::make {

TetMesh inclusion() {
  constexpr double size = 0.1, radius = 0.02;
  const Vec3 middle(0.05, 0.055, 0.05);
  TetMesh mesh = make_box(Vec3(size, size, size), {7, 7, 7});
  mesh.source = "inclusion";
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 centroid = Vec3::Zero();
    for (const int node : mesh.tets[t]) centroid += mesh.nodes[static_cast<std::size_t>(node)] / 4;
    mesh.regions[t] = (centroid - middle).norm() < radius ? 2 : 1;
  }
  return mesh;
}

}  // namespace heml::make
