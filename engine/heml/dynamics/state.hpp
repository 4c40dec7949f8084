#pragma once
// State of a moving body; arrays are 3 #V, node after node, in inner order.
#include <cstddef>
#include <vector>

namespace heml {

/// What a state is taken back to.
template <class Real>
struct Motion {
  std::vector<Real> x;  ///< positions, m
  std::vector<Real> v;  ///< velocities, m/s
  double time = 0;      ///< s
};

template <class Real>
struct State : Motion<Real> {
  std::vector<Real> f;  ///< forces at x without reactions, gravity included, N
};

}  // namespace heml
