#pragma once
// State of a moving body; arrays are 3 #V, node after node, in inner order.
#include <cstddef>
#include <vector>

namespace heml {

template <class Real>
struct State {
  std::vector<Real> x;  ///< positions, m
  std::vector<Real> v;  ///< velocities, m/s
  std::vector<Real> f;  ///< forces at x without reactions, gravity included, N
  double time = 0;      ///< s
};

}  // namespace heml
