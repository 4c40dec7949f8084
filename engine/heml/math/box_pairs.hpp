#pragma once
// Which of many boxes intersect.
#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace heml {

/// All pairs of boxes with a common point, each once, the smaller index first, in no order that matters. Time grows
/// with the number of boxes and of pairs, whatever sizes the boxes have.
std::vector<std::pair<int, int>> intersecting_pairs(const std::vector<Eigen::AlignedBox3d>& boxes);

}  // namespace heml
