#include <Eigen/SVD>
#include <algorithm>
#include <heml/mesh/surface.hpp>
#include <heml/tools/tearing.hpp>
#include <tuple>

namespace heml {
namespace {

constexpr std::size_t grain = 2048;

std::size_t as_index(int n) { return static_cast<std::size_t>(n); }

Mat3 edges(const Tet& tet, const std::vector<Vec3>& x) {
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = x[as_index(tet[static_cast<std::size_t>(k) + 1])] - x[as_index(tet[0])];
  return D;
}

/// Whether a symmetric matrix is positive definite, by its leading minors.
bool is_positive(const Mat3& A) { return A(0, 0) > 0 && A(0, 0) * A(1, 1) > A(0, 1) * A(0, 1) && A.determinant() > 0; }

}  // namespace

Tearing::Tearing(const TearingSettings& settings, const TetMesh& mesh, const Topology& topology)
    : limit_(settings.stretch),
      around_(mesh, topology),
      elements_(topology.elements),
      is_overstretched_(elements_.size()) {
  for (const int t : elements_)
    inverse_rest_.push_back((rest_scale(mesh, as_index(t)) * edges(mesh.tets[as_index(t)], mesh.nodes)).inverse());
  on_surface_.assign(mesh.nodes.size(), false);
  for (const Triangle& face : extract_boundary(with_elements(mesh, elements_)).triangles)
    for (const int n : face) on_surface_[as_index(n)] = true;
}

Mat3 Tearing::gradient(const TetMesh& mesh, const std::vector<Vec3>& x, std::size_t element) const {
  return edges(mesh.tets[as_index(elements_[element])], x) * inverse_rest_[element];
}

/// Elements beyond the limit, the most stretched first.
std::vector<Tearing::TearCandidate> Tearing::overstretched_elements(const TetMesh& mesh, const std::vector<Vec3>& x,
                                                                    ThreadTeam& team) {
  team.parallel_for(elements_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const Mat3 F = gradient(mesh, x, e);
      is_overstretched_[e] = F.allFinite() && !is_positive(limit_ * limit_ * Mat3::Identity() - F.transpose() * F);
    }
  });
  std::vector<TearCandidate> torn;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (!is_overstretched_[e]) continue;
    const Eigen::JacobiSVD<Mat3> svd(gradient(mesh, x, e), Eigen::ComputeFullV);
    torn.push_back({svd.singularValues()[0], elements_[e], svd.matrixV().col(0)});
  }
  std::sort(torn.begin(), torn.end(), [](const TearCandidate& a, const TearCandidate& b) {
    return a.stretch != b.stretch ? a.stretch > b.stretch : a.element < b.element;
  });
  return torn;
}

/// Picks the element's node with the fewest elements round it, surface nodes first, since tears begin and go on there.
/// None where every node is constrained or has elements on one side of the plane only.
std::optional<TearOpening> Tearing::opening_of(const TearCandidate& torn, const TetMesh& mesh,
                                               const std::function<bool(int)>& is_constrained) const {
  std::optional<TearOpening> best;
  const auto rank = [this](int n) { return std::tuple(!on_surface_[as_index(n)], around_.of(n).size(), n); };
  for (const int n : mesh.tets[as_index(torn.element)]) {
    const TearOpening opening{n, torn.plane_normal};
    if (!is_constrained(n) && can_tear(opening, mesh, around_) && (!best || rank(n) < rank(best->node))) best = opening;
  }
  return best;
}

std::vector<TearOpening> Tearing::openings(const TetMesh& mesh, const std::vector<Vec3>& x,
                                           const std::function<bool(int)>& is_constrained, ThreadTeam& team) {
  std::vector<TearOpening> chosen;
  std::vector<int> taken;  // elements near those already chosen
  for (const TearCandidate& torn : overstretched_elements(mesh, x, team)) {
    if (!chosen.empty() && torn.stretch < overload * limit_) break;
    if (std::find(taken.begin(), taken.end(), torn.element) != taken.end()) continue;
    const auto opening = opening_of(torn, mesh, is_constrained);
    if (!opening) continue;
    for (const int n : mesh.tets[as_index(torn.element)])
      for (const int t : around_.of(n))
        for (const int m : mesh.tets[as_index(t)])
          taken.insert(taken.end(), around_.of(m).begin(), around_.of(m).end());
    chosen.push_back(*opening);
  }
  return chosen;
}

}  // namespace heml
