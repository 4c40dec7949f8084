#pragma once
// Which of many boxes intersect.
#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace heml {

/// Whether two boxes have a common point once each is widened by `margin` to each side.
inline bool are_near(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double margin) {
  for (int i = 0; i < 3; ++i)
    if (a.min()[i] - margin > b.max()[i] + margin || b.min()[i] - margin > a.max()[i] + margin) return false;
  return true;
}

/// All pairs of boxes with a common point, each once, the smaller index first, in no order that matters. Time grows
/// with the number of boxes and of pairs, whatever sizes the boxes have.
/// group: of each box, from 0; empty: all are of one. between: by how much boxes of different groups are widened to
/// each side before they are compared; ≥ 0. within: false leaves out the pairs of two boxes of one group.
std::vector<std::pair<int, int>> intersecting_pairs(const std::vector<Eigen::AlignedBox3d>& boxes,
                                                    const std::vector<int>& group = {}, double between = 0,
                                                    bool within = true);

}  // namespace heml
