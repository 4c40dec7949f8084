#pragma once
// Where a stroke's blade stopped, in the tissue. The tissue moves between two sweeps; the next sweep starts at the
// front as it lies then, so that the two share it and leave no gap:
//
//     blade      front, moved      next blade
//       ●─────┐       ┌──────────────●
//       ●      ╲       ╲             ●      the curve has its corners on the faces of the elements, so that it stays
//       ●      ╱       ╱             ●      straight in each of them: no edge of an element passes it unnoticed
//       ●─────┘       └──────────────●
//
// Tissue that has come upon a blade since it stopped outside is cut too: the blade starts from where it then was beside
// the nearest node.
#include <heml/mesh/edit.hpp>
#include <heml/mesh/sweep.hpp>

namespace heml {

class BladeFront {
 public:
  /// The front of a stroke that has not begun.
  BladeFront() = default;
  /// Attaches a blade to the elements of a topology. x: deformed positions, #V×3, m.
  BladeFront(const std::array<Vec3, 2>& blade, const TetMesh& mesh, const std::vector<Vec3>& x,
             const Topology& topology);

  bool in_tissue() const { return !points_.empty(); }

  /// The sweep from the front, as it lies now, to the end of the given sweep, by way of those that passed. It starts
  /// with the first blade that is ahead of the whole front, so that it does not fold back over the cut; empty if none
  /// is. The given sweep itself if it does not start within `tolerance`, m, of where the last one ended. heading: of
  /// the blade at the front.
  OrientedSweep join(const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x, const Topology& topology,
                     double tolerance, const Heading& heading = {}) const;

  /// The blade moves on by a sweep that crosses no edge: the front stays.
  void pass(const Sweep& sweep);

 private:
  /// A point of the blade in an element or on one of its faces.
  struct Point {
    double along;                   ///< 0 at the blade's first end, 1 at its second
    Tet nodes;                      ///< as numbered in the mesh file
    std::array<double, 4> weights;  ///< barycentric
  };
  /// A corner of the front as it lies now.
  struct CurvePoint {
    double along;
    Vec3 place;  ///< m
    bool in_tissue;
  };
  std::vector<CurvePoint> curve_now(const std::vector<Vec3>& x) const;
  static bool is_ahead(const std::array<Vec3, 2>& before, const std::array<Vec3, 2>& blade,
                       const std::vector<CurvePoint>& curve);
  void attach_beside(const std::vector<Vec3>& x, const Topology& topology, const TetMesh& mesh);
  void add_point(double along, const Tet& tet, const std::array<Vec3, 4>& corners);

  std::vector<std::array<Vec3, 2>> path_;  ///< m, the blade at the front, then where it passed; empty: not begun
  std::vector<Point> points_;              ///< in the order of `along`
  int beside_ = -1;                        ///< of a blade outside the tissue: the node nearest to it
  Vec3 beside_place_ = Vec3::Zero();       ///< m, of that node when the blade stopped
};

}  // namespace heml
