#pragma once
// Vertices at the same place.
#include <algorithm>
#include <array>
#include <cstdint>
#include <heml/math/types.hpp>
#include <numeric>
#include <span>
#include <vector>

namespace heml {

/// For each vertex, the lowest index of a vertex with exactly the same position.
inline std::vector<std::uint32_t> weld(std::span<const Vec3f> positions) {
  std::vector<std::uint32_t> order(positions.size()), result(positions.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](std::uint32_t v) { return std::array{positions[v].x(), positions[v].y(), positions[v].z()}; };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return place(a) < place(b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    result[order[i]] = i > 0 && place(order[i - 1]) == place(order[i]) ? result[order[i - 1]] : order[i];
  return result;
}

}  // namespace heml
