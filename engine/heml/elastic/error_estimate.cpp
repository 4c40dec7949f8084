#include <algorithm>
#include <cmath>
#include <heml/elastic/error_estimate.hpp>
#include <heml/elastic/node_patches.hpp>

namespace heml {
namespace {

constexpr std::size_t min_patch = 8;  // elements: twice the unknowns of a linear fit
constexpr double flat_patch = 1e-6;   // of the spread: keeps the fit from following patches that are nearly flat

const Vec3& at(const std::vector<Vec3>& x, const Tet& tet, std::size_t corner) {
  return x[static_cast<std::size_t>(tet[corner])];
}

Mat3 edges(const std::vector<Vec3>& x, const Tet& tet) {
  Mat3 D;
  for (int a = 0; a < 3; ++a) D.col(a) = at(x, tet, static_cast<std::size_t>(a + 1)) - at(x, tet, 0);
  return D;
}

Mat3 rest_edges(const TetMesh& mesh, std::size_t t) { return rest_scale(mesh, t) * edges(mesh.nodes, mesh.tets[t]); }

double volume_of(const TetMesh& mesh, std::size_t t) { return rest_edges(mesh, t).determinant() / 6; }

Vec3 centroid(const TetMesh& mesh, std::size_t t) {
  const Tet& tet = mesh.tets[t];
  return (at(mesh.nodes, tet, 0) + at(mesh.nodes, tet, 1) + at(mesh.nodes, tet, 2) + at(mesh.nodes, tet, 3)) / 4;
}

/// The fields of one material at nodes, #V.
struct Recovered {
  std::vector<Mat3> F, P;
};

/// At a node X: the weighted linear fit of a patch, which is a weighted sum of its values. With the patch's volume V,
/// centroid c and second moments M, an element t weighs V_t (1/V + (c_t − c) · M⁻¹ (X − c)).
Recovered recover(const TetMesh& mesh, const std::vector<std::size_t>& elements, const std::vector<Mat3>& F,
                  const std::vector<Mat3>& P) {
  const std::size_t nodes = mesh.nodes.size();
  Recovered result{std::vector<Mat3>(nodes, Mat3::Zero()), std::vector<Mat3>(nodes, Mat3::Zero())};
  NodePatches patches(mesh, elements, min_patch);
  for (std::size_t n = 0; n < nodes; ++n) {
    const std::vector<std::size_t>& patch = patches.of(static_cast<int>(n));
    double volume = 0;
    Vec3 middle = Vec3::Zero();
    for (const std::size_t t : patch) volume += volume_of(mesh, t), middle += volume_of(mesh, t) * centroid(mesh, t);
    if (!(volume > 0)) continue;
    middle /= volume;
    Mat3 moments = Mat3::Zero();
    for (const std::size_t t : patch) {
      const Vec3 d = centroid(mesh, t) - middle;
      moments += volume_of(mesh, t) * d * d.transpose();
    }
    const double spread = moments.trace();
    moments.diagonal().array() += flat_patch * spread;
    const Vec3 slope = spread > 0 ? Vec3(moments.llt().solve(mesh.nodes[n] - middle)) : Vec3::Zero();
    for (const std::size_t t : patch) {
      const double weight = volume_of(mesh, t) * (1 / volume + (centroid(mesh, t) - middle).dot(slope));
      result.F[n] += weight * F[t];
      result.P[n] += weight * P[t];
    }
  }
  return result;
}

/// e_t² of one element, J, with ∫ N_a N_b dV = V/20, or V/10 where a = b.
double difference(const Mat3& F, const Mat3& P, double volume, const Tet& tet, const Recovered& smooth) {
  Mat3 dF[4], dP[4], sum_F = Mat3::Zero(), sum_P = Mat3::Zero();
  double same = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto n = static_cast<std::size_t>(tet[a]);
    dF[a] = smooth.F[n] - F;
    dP[a] = smooth.P[n] - P;
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
  std::vector<std::vector<std::size_t>> elements(static_cast<std::size_t>(materials));
  for (std::size_t t = 0; t < errors.size(); ++t) elements[static_cast<std::size_t>(material_of[t])].push_back(t);
  for (const auto& of_one : elements) {
    const Recovered smooth = recover(mesh, of_one, F, P);
    for (const std::size_t t : of_one) errors[t] = difference(F[t], P[t], volume_of(mesh, t), mesh.tets[t], smooth);
  }
  return errors;
}

std::vector<Mat3> deformation_gradients(const TetMesh& mesh, const std::vector<Vec3>& x) {
  std::vector<Mat3> F(mesh.tets.size());
  for (std::size_t t = 0; t < F.size(); ++t) F[t] = edges(x, mesh.tets[t]) * rest_edges(mesh, t).inverse();
  return F;
}

}  // namespace heml
