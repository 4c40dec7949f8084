#pragma once
// Memory of containers in bytes: contents, not the container objects themselves.
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <vector>

namespace heml {

template <class Value, class Allocator>
std::size_t bytes_of(const std::vector<Value, Allocator>& list) {
  return list.capacity() * sizeof(Value);
}
template <class Value>
std::size_t bytes_of(const std::vector<std::vector<Value>>& lists) {
  std::size_t sum = 0;
  for (const auto& list : lists) sum += bytes_of(list);
  return sum;
}
template <class Value, std::size_t count>
std::size_t bytes_of(const std::array<std::vector<Value>, count>& lists) {
  std::size_t sum = 0;
  for (const auto& list : lists) sum += bytes_of(list);
  return sum;
}
template <class Derived>
std::size_t bytes_of(const Eigen::PlainObjectBase<Derived>& matrix) {
  return static_cast<std::size_t>(matrix.size()) * sizeof(typename Derived::Scalar);
}
template <class Value, int options, class Index>
std::size_t bytes_of(const Eigen::SparseMatrix<Value, options, Index>& matrix) {
  return static_cast<std::size_t>(matrix.nonZeros()) * (sizeof(Value) + sizeof(Index)) +
         static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(Index);
}

/// Sum over several containers.
template <class First, class Second, class... More>
std::size_t bytes_of(const First& first, const Second& second, const More&... more) {
  return bytes_of(first) + bytes_of(second) + (std::size_t{0} + ... + bytes_of(more));
}

}  // namespace heml
