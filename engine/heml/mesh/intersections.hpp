#pragma once
// Self-intersections of a surface.
#include <cstddef>
#include <heml/base/error.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Intersections {
  std::size_t pairs = 0;        ///< intersecting pairs of triangles; the search stops at `max_pairs`
  int first = -1, second = -1;  ///< lexicographically first pair found
  std::vector<int> triangles;   ///< all triangles in a pair, ascending
};
inline constexpr std::size_t max_pairs = 10'000;

/// What check_surface() throws for a surface that runs through itself.
class SelfIntersection : public InputError {
 public:
  SelfIntersection(const InputError& error, std::size_t pairs) : InputError(error), pairs_(pairs) {}
  std::size_t pairs() const { return pairs_; }  ///< Intersections::pairs

 private:
  std::size_t pairs_;
};

/// Finds pairs of triangles that cross, overlap or touch outside the nodes and edges they share. Requires triangles of
/// nonzero area and at most two per edge. Cases that round-off leaves undecided count as touching. Uses a tree of
/// bounding boxes: O(n log n) for n well-shaped triangles.
Intersections self_intersections(const TriangleMesh& surface);

}  // namespace heml
