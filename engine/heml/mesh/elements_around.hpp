#pragma once
// The elements that there are in an edited mesh, by their nodes.
#include <heml/mesh/edit.hpp>

namespace heml {

class ElementsAround {
 public:
  ElementsAround(const TetMesh& mesh, const Topology& topology);

  /// Elements that share a face with element t.
  std::vector<int> beside(int t) const;

  /// Of a point in the tetrahedron of element t; of 1 in all.
  Eigen::Vector4d weights(int t, const Vec3& x) const;

  /// Of an element and those beside it, one in which a point has no large weight: a flat piece of a cut element would
  /// throw a point above it far about.
  int suitable(int t, const Vec3& x) const;

 private:
  const Tet& corners(int t) const { return mesh_.tets[static_cast<std::size_t>(t)]; }

  const TetMesh& mesh_;
  std::vector<std::size_t> first_;  // #V+1, of elements_
  std::vector<int> elements_;
};

}  // namespace heml
