#include <algorithm>
#include <heml/mesh/elements_around.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr double far_weight = 1.5;  // of a vertex in an element, beyond which another one beside it may be better
constexpr int rings_searched = 2;   // of elements round that one

}  // namespace

ElementsAround::ElementsAround(const TetMesh& mesh, const Topology& topology)
    : mesh_(mesh), first_(mesh.nodes.size() + 1, 0) {
  for (const int t : topology.elements)
    for (const int n : corners(t)) ++first_[static_cast<std::size_t>(n) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  elements_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const int t : topology.elements)
    for (const int n : corners(t)) elements_[next[static_cast<std::size_t>(n)]++] = t;
}

std::vector<int> ElementsAround::beside(int t) const {
  std::vector<int> found;
  const Tet& c = corners(t);
  const auto is_shared = [&](int n) { return std::find(c.begin(), c.end(), n) != c.end(); };
  for (std::size_t i = 0; i < 2; ++i) {  // of any three corners one is among the first two
    const auto node = static_cast<std::size_t>(c[i]);
    for (std::size_t k = first_[node]; k < first_[node + 1]; ++k) {
      const Tet& other = corners(elements_[k]);
      if (std::count_if(other.begin(), other.end(), is_shared) == 3 &&
          std::find(found.begin(), found.end(), elements_[k]) == found.end())
        found.push_back(elements_[k]);
    }
  }
  return found;
}

Eigen::Vector4d ElementsAround::weights(int t, const Vec3& x) const {
  const Tet& n = corners(t);
  const auto X = [&](std::size_t i) -> const Vec3& { return mesh_.nodes[static_cast<std::size_t>(n[i])]; };
  return Eigen::Vector4d(signed_volume(x, X(1), X(2), X(3)), signed_volume(X(0), x, X(2), X(3)),
                         signed_volume(X(0), X(1), x, X(3)), signed_volume(X(0), X(1), X(2), x)) /
         signed_volume(X(0), X(1), X(2), X(3));
}

int ElementsAround::suitable(int t, const Vec3& x) const {
  std::vector<int> seen{t};
  int best = t;
  double least = weights(t, x).cwiseAbs().maxCoeff();
  std::size_t begin = 0;
  for (int ring = 0; least > far_weight && ring < rings_searched; ++ring)
    for (const std::size_t end = seen.size(); begin < end; ++begin)
      for (const int other : beside(seen[begin])) {
        if (std::find(seen.begin(), seen.end(), other) != seen.end()) continue;
        seen.push_back(other);
        const double most = weights(other, x).cwiseAbs().maxCoeff();
        if (most < least) best = other, least = most;
      }
  return best;
}

}  // namespace heml
