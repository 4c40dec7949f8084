#pragma once
// The Pareto front of cost and error.
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace heml {

struct CostAndError {
  double cost, error;
};

/// Indices of the points that no other point dominates, ascending in cost.
inline std::vector<std::size_t> pareto_front(const std::vector<CostAndError>& points) {
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  for (const std::size_t k : order)
    if (front.empty() || points[k].error < points[front.back()].error) front.push_back(k);
  return front;
}

}  // namespace heml
