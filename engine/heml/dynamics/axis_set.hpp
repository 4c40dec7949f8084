#pragma once
// A set of coordinate axes: of a node, those in which it is held.
#include <array>
#include <cstddef>
#include <type_traits>

namespace heml {

struct AxisSet {
  std::array<bool, 3> has{true, true, true};

  static AxisSet none() { return {{false, false, false}}; }
  bool are_all() const { return has[0] && has[1] && has[2]; }
  bool are_none() const { return !has[0] && !has[1] && !has[2]; }
  AxisSet with(const AxisSet& other) const {
    return {{has[0] || other.has[0], has[1] || other.has[1], has[2] || other.has[2]}};
  }
  bool operator==(const AxisSet&) const = default;
};

/// Writes these coordinates of a node's value to values, 3 #V.
template <class Vector3, class Values>
void set_along(const AxisSet& axes, int node, const Vector3& value, Values& values) {
  using Scalar = std::remove_cvref_t<decltype(values[0])>;
  for (int i = 0; i < 3; ++i)
    if (axes.has[static_cast<std::size_t>(i)])
      values[static_cast<decltype(values.size())>(3 * node + i)] = static_cast<Scalar>(value[i]);
}

}  // namespace heml
