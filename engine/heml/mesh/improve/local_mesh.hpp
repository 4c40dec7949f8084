#pragma once
// A tetrahedral mesh for local operations. Each node knows its elements, from which faces and rings of edges are found;
// every change of topology replaces a few elements by others.
//
//      ring of edge ab, seen from b:        r1 ─ r0      element i of a sector: (a, b, r_i, r_i+1), positive
//                                          /  \ /  \     a constrained face (a, b, r) ends a sector: it belongs to
//                                         r2 ─ ab ─ r5   the boundary or to the interface of two regions
//                                          \  / \  /
//                                           r3 ─ r4
#include <heml/mesh/improve/shape.hpp>
#include <span>
#include <utility>
#include <vector>

namespace heml {

/// Of quality: what an operation has to gain, at least.
inline constexpr double smallest_gain = 1e-4;

struct RegionTet {
  Tet nodes;
  int region;
};

/// The elements round an edge between two constrained faces, or all of them if there is no such face.
struct RingSector {
  std::vector<int> nodes;  ///< one more than elements, unless closed
  std::vector<int> tets;
  bool is_closed = false;
};

class LocalMesh {
 public:
  /// Elements positive but for inverted ones; no face of more than two.
  LocalMesh(const TetMesh& mesh, const ShapeMeasure& measure);

  const Vec3& node(int n) const { return nodes_[n]; }
  int nodes() const { return static_cast<int>(nodes_.size()); }
  int slots() const { return static_cast<int>(tets_.size()); }  ///< of elements; some are free
  int count() const { return count_; }                          ///< elements
  bool exists(int t) const { return tets_[t][0] >= 0; }
  const Tet& tet(int t) const { return tets_[t]; }
  int region(int t) const { return regions_[t]; }
  double quality(int t) const { return qualities_[t]; }
  std::span<const int> star(int n) const { return stars_[n]; }  ///< elements of a node
  bool is_on_surface(int n) const { return on_surface_[n]; }    ///< boundary or interface

  const ShapeMeasure& measure() const { return measure_; }
  void set_measure(const ShapeMeasure& measure);  ///< evaluates all qualities again
  double quality_of(const Tet& tet) const { return measure_(corners(tet)); }
  Corners corners(const Tet& tet) const;
  double worst(std::span<const int> tets) const;

  /// The element across a face (node opposite: local number), or −1.
  int across(int t, int face) const;
  bool is_constrained(int t, int face) const;
  /// The constrained faces with a node, each once, the node first.
  std::vector<Triangle> surface_faces(int n) const;
  bool has_edge(int a, int b) const;
  /// Empty if the elements round the edge are not consistently joined.
  std::vector<RingSector> ring(int a, int b) const;

  void replace(std::span<const int> removed, std::span<const RegionTet> added);
  void move(int n, const Vec3& x);
  int add_node(const Vec3& x, bool is_on_surface);
  void remove_last_node();  ///< one without elements

  /// The nodes of elements that changed since the last call; some of them often.
  std::vector<int> take_changed_nodes() { return std::exchange(changed_, {}); }

  /// Nodes without elements are left out.
  TetMesh extract(const std::string& source) const;

 private:
  std::vector<Vec3> nodes_;
  std::vector<char> on_surface_;
  std::vector<std::vector<int>> stars_;
  std::vector<Tet> tets_;
  std::vector<int> regions_;
  std::vector<double> qualities_;
  std::vector<int> free_, changed_;
  int count_ = 0;
  ShapeMeasure measure_;
};

/// The elements of all sectors.
std::vector<int> elements_of(const std::vector<RingSector>& sectors);

}  // namespace heml
