#include <cmath>
#include <heml/dynamics/prolongation.hpp>

namespace heml {
namespace {

constexpr double strength_threshold = 0.02;  // |a_ij|/√(a_ii a_jj) from which two unknowns are strongly connected
constexpr double smoothing = 4.0 / 3;

/// Strongly connected neighbours of each unknown and their strengths.
struct Neighbours {
  std::vector<std::size_t> start{0};
  std::vector<int> node;
  std::vector<double> strength;

  explicit Neighbours(const ScalarMatrix& A) {
    const Eigen::VectorXd diagonal = A.diagonal();
    for (int i = 0; i < A.outerSize(); ++i) {
      for (ScalarMatrix::InnerIterator entry(A, i); entry; ++entry) {
        const auto j = static_cast<int>(entry.col());
        const double s = std::abs(entry.value()) / std::sqrt(diagonal[i] * diagonal[j]);
        if (j == i || !(s >= strength_threshold)) continue;
        node.push_back(j);
        strength.push_back(s);
      }
      start.push_back(node.size());
    }
  }
};

/// The aggregate of each unknown; count: number of aggregates. Three passes: (1) a neighbourhood without assigned
/// unknowns becomes an aggregate; (2) a remaining unknown joins the aggregate of its strongest assigned neighbour; (3)
/// one without such a neighbour forms an aggregate with its unassigned neighbours.
std::vector<int> aggregate(const Neighbours& neighbours, int& count) {
  constexpr int unassigned = -1;
  const std::size_t size = neighbours.start.size() - 1;
  std::vector<int> of(size, unassigned);
  count = 0;
  const auto each = [&](std::size_t i, const auto& visit) {
    for (std::size_t k = neighbours.start[i]; k < neighbours.start[i + 1]; ++k)
      visit(of[static_cast<std::size_t>(neighbours.node[k])], neighbours.strength[k]);
  };
  for (std::size_t i = 0; i < size; ++i) {
    bool is_isolated = of[i] == unassigned;
    each(i, [&](int other, double) { is_isolated = is_isolated && other == unassigned; });
    if (!is_isolated || neighbours.start[i] == neighbours.start[i + 1]) continue;
    of[i] = count;
    each(i, [&](int& other, double) { other = count; });
    ++count;
  }
  std::vector<int> joined = of;
  for (std::size_t i = 0; i < size; ++i) {
    if (of[i] != unassigned) continue;
    double max_strength = 0;
    each(i, [&](int other, double strength) {
      if (other == unassigned || strength <= max_strength) return;
      max_strength = strength;
      joined[i] = other;
    });
  }
  of = std::move(joined);
  for (std::size_t i = 0; i < size; ++i) {
    if (of[i] != unassigned) continue;
    of[i] = count;
    each(i, [&](int& other, double) {
      if (other == unassigned) other = count;
    });
    ++count;
  }
  return of;
}

}  // namespace

std::vector<double> absolute_row_sums(const ScalarMatrix& A) {
  std::vector<double> sums(static_cast<std::size_t>(A.rows()), 0.0);
  for (int i = 0; i < A.outerSize(); ++i)
    for (ScalarMatrix::InnerIterator entry(A, i); entry; ++entry)
      sums[static_cast<std::size_t>(i)] += std::abs(entry.value());
  return sums;
}

ScalarMatrix smoothed_prolongation(const ScalarMatrix& A) {
  int count = 0;
  const std::vector<int> of = aggregate(Neighbours(A), count);
  ScalarMatrix constant(A.rows(), count);
  constant.reserve(Eigen::VectorXi::Ones(A.rows()));
  for (std::size_t i = 0; i < of.size(); ++i) constant.insert(static_cast<int>(i), of[i]) = 1;
  ScalarMatrix scaled = A;
  const std::vector<double> D = absolute_row_sums(A);
  for (int i = 0; i < scaled.outerSize(); ++i)
    for (ScalarMatrix::InnerIterator entry(scaled, i); entry; ++entry)
      entry.valueRef() *= -smoothing / D[static_cast<std::size_t>(i)];
  return constant + ScalarMatrix(scaled * constant);
}

}  // namespace heml
