#include <algorithm>
#include <cmath>
#include <heml/elastic/error_estimate.hpp>

namespace heml {
namespace {

const Vec3& at(const std::vector<Vec3>& x, const Tet& tet, std::size_t corner) {
  return x[static_cast<std::size_t>(tet[corner])];
}

Mat3 edges(const std::vector<Vec3>& x, const Tet& tet) {
  Mat3 D;
  for (int a = 0; a < 3; ++a) D.col(a) = at(x, tet, static_cast<std::size_t>(a + 1)) - at(x, tet, 0);
  return D;
}

double volume_of(const TetMesh& mesh, std::size_t t) { return edges(mesh.nodes, mesh.tets[t]).determinant() / 6; }

/// Sums over the elements of one material at every node.
struct Means {
  std::vector<Mat3> F, P;
  std::vector<double> volume;
};

void add(const Mat3& F, const Mat3& P, double volume, const Tet& tet, Means& sums) {
  for (const int node : tet) {
    const auto n = static_cast<std::size_t>(node);
    sums.F[n] += volume * F, sums.P[n] += volume * P, sums.volume[n] += volume;
  }
}

/// e_t² of one element, J, with ∫ N_a N_b dV = V/20, or V/10 where a = b.
double difference(const Mat3& F, const Mat3& P, double volume, const Tet& tet, const Means& means) {
  Mat3 dF[4], dP[4], sum_F = Mat3::Zero(), sum_P = Mat3::Zero();
  double same = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto n = static_cast<std::size_t>(tet[a]);
    dF[a] = means.F[n] / means.volume[n] - F;
    dP[a] = means.P[n] / means.volume[n] - P;
    same += dF[a].cwiseProduct(dP[a]).sum();
    sum_F += dF[a], sum_P += dP[a];
  }
  // In a softening material the product may be negative; it then estimates nothing.
  return std::max(0.0, volume / 20 * (same + sum_F.cwiseProduct(sum_P).sum()));
}

}  // namespace

double ErrorEstimate::relative() const {
  const double whole = 2 * stored + squared;
  return whole > 0 ? std::sqrt(squared / whole) : 0;
}

std::vector<double> ErrorEstimate::densities(const TetMesh& mesh) const {
  std::vector<double> result(of_element.size(), 0.0);
  double volume = 0;
  for (std::size_t t = 0; t < result.size(); ++t) volume += volume_of(mesh, t);
  const double mean = (2 * stored + squared) / volume;
  if (mean > 0)
    for (std::size_t t = 0; t < result.size(); ++t) result[t] = std::sqrt(of_element[t] / volume_of(mesh, t) / mean);
  return result;
}

std::vector<double> recovery_errors(const TetMesh& mesh, const std::vector<int>& material_of,
                                    const std::vector<Mat3>& F, const std::vector<Mat3>& P) {
  std::vector<double> errors(mesh.tets.size(), 0.0);
  const int materials = material_of.empty() ? 0 : 1 + *std::max_element(material_of.begin(), material_of.end());
  const std::size_t nodes = mesh.nodes.size();
  for (int m = 0; m < materials; ++m) {
    Means sums{std::vector<Mat3>(nodes, Mat3::Zero()), std::vector<Mat3>(nodes, Mat3::Zero()),
               std::vector<double>(nodes, 0.0)};
    for (std::size_t t = 0; t < errors.size(); ++t)
      if (material_of[t] == m) add(F[t], P[t], volume_of(mesh, t), mesh.tets[t], sums);
    for (std::size_t t = 0; t < errors.size(); ++t)
      if (material_of[t] == m) errors[t] = difference(F[t], P[t], volume_of(mesh, t), mesh.tets[t], sums);
  }
  return errors;
}

std::vector<Mat3> deformation_gradients(const TetMesh& mesh, const std::vector<Vec3>& x) {
  std::vector<Mat3> F(mesh.tets.size());
  for (std::size_t t = 0; t < F.size(); ++t) F[t] = edges(x, mesh.tets[t]) * edges(mesh.nodes, mesh.tets[t]).inverse();
  return F;
}

}  // namespace heml
