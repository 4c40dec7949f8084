#pragma once
// What changes while a body moves. Everything is 3 numbers a node, node after node, in inner order.
#include <cstddef>
#include <vector>

namespace heml {

template <class Real>
struct State {
  std::vector<Real> x;  ///< positions, m
  std::vector<Real> v;  ///< velocities, m/s
  std::vector<Real> f;  ///< forces at x from all sides but supports, gravity included, N
  double time = 0;      ///< s
};

}  // namespace heml
