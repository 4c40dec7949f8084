#include <algorithm>
#include <heml/mesh/quadratic.hpp>
#include <heml/world/step_strain.hpp>

namespace heml {
namespace {

// Elements flatter than this count as if they were not: laws that go on through J = 0 are evaluated there all the time,
// and no step is short enough for what is relative to nothing. Other laws keep elements from it.
constexpr double least_J_of_continued = 0.2, least_J_of_others = 0.01;
constexpr double small = 0.8;  // altitude, of the median
constexpr double least_move =
    0.02;  // of an altitude at rest, along an axis: e is small below it unless the element is flat

// Strain grows as waves come; those next to new contacts are looked at at once.
constexpr double part_between_looks = 0.25, most_between_looks = 8;

using Mat3 = Eigen::Matrix3d;

/// The edges from an element's first corner.
template <class At>
Mat3 edges(const Tet& tet, const At& at) {
  const Vec3 origin = at(tet[0]);
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = at(tet[static_cast<std::size_t>(k) + 1]) - origin;
  return D;
}

/// The least altitude (m) of an element with these edges.
double least_altitude(const Mat3& D) {
  const auto area = [](const Vec3& a, const Vec3& b) { return a.cross(b).norm(); };
  const Vec3 a = D.col(0), b = D.col(1), c = D.col(2);
  return D.determinant() / std::max({area(a, b), area(b, c), area(c, a), area(b - a, c - a)});
}

/// dF F⁻¹ = dD D⁻¹ of edges D.
double strain(const Mat3& D, const Mat3& dD, double least_volume) {
  Mat3 adjugate;
  adjugate << D.col(1).cross(D.col(2)).transpose(), D.col(2).cross(D.col(0)).transpose(),
      D.col(0).cross(D.col(1)).transpose();
  const double volume = std::max(adjugate.row(0).dot(D.col(0)), least_volume);
  const Mat3 relative = dD * adjugate;
  return (relative + relative.transpose()).norm() / (2 * volume);
}

}  // namespace

int steps_until_strain(double strain) {
  return static_cast<int>(
      std::clamp(part_between_looks * max_step_strain / std::max(strain, 1e-9), 1.0, most_between_looks));
}

template <class Real>
double StepStrain<Real>::largest(const std::vector<int>& nodes, bool with_small, const Real* before,
                                 const Real* after) {
  const auto in = [](const Real* x) {
    return [x](int n) -> Vec3 { return Eigen::Map<const Vector3<Real>>(x + 3 * n).template cast<double>(); };
  };
  const auto move = [&](int n) -> Vec3 { return in(after)(n)-in(before)(n); };
  double most = 0;
  ++searches_;
  const auto look_at = [&](int t) {
    const auto k = static_cast<std::size_t>(t);
    if (seen_[k] == searches_) return;
    seen_[k] = searches_;
    const Mat3 dD = edges(tets_[k], move);
    if (dD.cwiseAbs2().maxCoeff() < least_[k].square_move) return;
    most = std::max(most, strain(edges(tets_[k], in(before)), dD, least_[k].volume));
  };
  if (with_small)
    for (const int t : small_) look_at(t);
  for (const int n : nodes)
    for (const int t : around_.of(n)) look_at(t);
  return most;
}

template <class Real>
void StepStrain<Real>::adopt(const Model<Real>& model, const Topology& topology, bool is_continued) {
  if (version_ == topology.version) return;
  const double least_J = is_continued ? least_J_of_continued : least_J_of_others;
  const bool is_linear = model.midedges.empty();
  const TetMesh fine = is_linear ? TetMesh() : subdivided(model.mesh, model.midedges);
  const TetMesh& mesh = is_linear ? model.mesh : fine;
  tets_ = mesh.tets;
  least_.clear();
  std::vector<double> altitudes;
  for (const Tet& tet : tets_) {
    const Mat3 D = edges(tet, [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; });
    altitudes.push_back(least_altitude(D));
    const double move = least_move * altitudes.back();
    least_.push_back({least_J * D.determinant(), move * move});
  }
  small_.clear();
  if (!altitudes.empty()) {
    std::vector<double> sorted = altitudes;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    for (std::size_t t = 0; t < altitudes.size(); ++t)
      if (altitudes[t] < small * *middle) small_.push_back(static_cast<int>(t));
  }
  around_ = NodeToElements(mesh, full_topology(mesh));
  seen_.assign(tets_.size(), searches_);
  version_ = topology.version;
}

template class StepStrain<float>;
template class StepStrain<double>;

}  // namespace heml
