#include <algorithm>
#include <heml/elastic/node_patches.hpp>
#include <heml/elastic/quadratic_error.hpp>

namespace heml {
namespace {

constexpr std::size_t least_patch = 5;  // elements: 20 points, twice the unknowns of a quadratic fit
constexpr double flat_fit = 1e-6;       // of each moment: keeps the fit from following patches that are nearly flat

using Monomials = Eigen::Matrix<double, 10, 1>;
using Both = Eigen::Matrix<double, 18, 1>;  // F and P

Monomials monomials(const Vec3& d) {
  Monomials b;
  b << 1, d.x(), d.y(), d.z(), d.x() * d.x(), d.y() * d.y(), d.z() * d.z(), d.x() * d.y(), d.y() * d.z(), d.z() * d.x();
  return b;
}

Both both(const Mat3& F, const Mat3& P) {
  Both values;
  values << F.reshaped(), P.reshaped();
  return values;
}

std::array<Vec3, 4> corners_of(const TetMesh& mesh, std::size_t t) {
  std::array<Vec3, 4> X;
  for (std::size_t a = 0; a < 4; ++a) X[a] = mesh.nodes[static_cast<std::size_t>(mesh.tets[t][a])];
  return X;
}

Vec3 place_at(const std::array<Vec3, 4>& X, const std::array<double, 4>& place) {
  return place[0] * X[0] + place[1] * X[1] + place[2] * X[2] + place[3] * X[3];
}

/// A quadratic fit to the values at the points of a patch.
struct PatchFit {
  Vec3 middle = Vec3::Zero();
  double size = 1;  ///< m, that coordinates are relative to
  Eigen::Matrix<double, 10, 18> coefficients;

  PatchFit(const TetMesh& mesh, const std::vector<std::size_t>& patch, const std::vector<Mat3>& F,
           const std::vector<Mat3>& P) {
    double volume = 0;
    Eigen::AlignedBox3d box;
    for (const std::size_t t : patch) {
      const auto X = corners_of(mesh, t);
      const double of_element = signed_volume(X[0], X[1], X[2], X[3]);
      volume += of_element;
      middle += of_element * (X[0] + X[1] + X[2] + X[3]) / 4;
      for (const Vec3& corner : X) box.extend(corner);
    }
    middle /= volume;
    size = box.diagonal().norm() / 2;
    Eigen::Matrix<double, 10, 10> moments = Eigen::Matrix<double, 10, 10>::Zero();
    Eigen::Matrix<double, 10, 18> sums = Eigen::Matrix<double, 10, 18>::Zero();
    for (const std::size_t t : patch) {
      const auto X = corners_of(mesh, t);
      const double weight = signed_volume(X[0], X[1], X[2], X[3]) / volume;
      for (std::size_t q = 0; q < element_points; ++q) {
        const Monomials b = monomials((place_at(X, point_place(q)) - middle) / size);
        moments += weight * b * b.transpose();
        sums += weight * b * both(F[element_points * t + q], P[element_points * t + q]).transpose();
      }
    }
    for (int k = 1; k < 10; ++k) moments(k, k) *= 1 + flat_fit;
    coefficients = moments.ldlt().solve(sums);
  }
  Both at(const Vec3& X) const { return coefficients.transpose() * monomials((X - middle) / size); }
};

/// Where an element's ten nodes are in it.
constexpr std::array<std::array<double, 4>, 10> node_places = [] {
  std::array<std::array<double, 4>, 10> places{};
  for (std::size_t a = 0; a < 4; ++a) places[a][a] = 1;
  for (std::size_t e = 0; e < 6; ++e) places[4 + e][tet_edges[e][0]] = places[4 + e][tet_edges[e][1]] = 0.5;
  return places;
}();

/// ∫ N_a N_b dV / V × 420.
constexpr double mass_entry(std::size_t a, std::size_t b) {
  if (a == b) return a < 4 ? 6 : 32;
  if (a < 4 && b < 4) return 1;
  bool share_a_corner = false;
  for (std::size_t i = 0; i < 4; ++i) share_a_corner |= node_places[a][i] > 0 && node_places[b][i] > 0;
  if (a >= 4 && b >= 4) return share_a_corner ? 16 : 8;
  return share_a_corner ? -4 : -6;
}

/// e_t² of one element from the recovered values at its ten nodes.
double difference(const std::array<Both, 10>& smooth, const Mat3* F, const Mat3* P, double volume) {
  constexpr double near = point_coordinate(0, 0), far = point_coordinate(0, 1);
  std::array<Both, 10> d;
  for (std::size_t a = 0; a < 10; ++a) {
    d[a] = smooth[a];
    for (std::size_t q = 0; q < element_points; ++q)
      d[a] -= (node_places[a][q] - far) / (near - far) * both(F[q], P[q]);
  }
  double sum = 0;
  for (std::size_t a = 0; a < 10; ++a)
    for (std::size_t b = 0; b < 10; ++b) sum += mass_entry(a, b) * d[a].head<9>().dot(d[b].tail<9>());
  // In a softening material the product may be negative; it then estimates nothing.
  return std::max(0.0, volume / 420 * sum);
}

/// Adds up the errors of the elements of one material.
void add_errors(const TetMesh& mesh, const std::vector<std::size_t>& elements,
                const std::vector<Mat3>& F, const std::vector<Mat3>& P, std::vector<double>& errors) {
  std::vector<std::array<Both, 10>> smooth(elements.size());
  for (auto& of_element : smooth) of_element.fill(Both::Zero());
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> at_corner(mesh.nodes.size());  // index, local corner
  for (std::size_t k = 0; k < elements.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c)
      at_corner[static_cast<std::size_t>(mesh.tets[elements[k]][c])].emplace_back(k, c);
  NodePatches patches(mesh, elements, least_patch);
  for (std::size_t n = 0; n < at_corner.size(); ++n) {
    if (at_corner[n].empty()) continue;
    const PatchFit fit(mesh, patches.of(static_cast<int>(n)), F, P);
    for (const auto& [k, c] : at_corner[n]) {
      const auto X = corners_of(mesh, elements[k]);
      smooth[k][c] = fit.at(X[c]);
      for (std::size_t other = 0; other < 4; ++other)
        if (other != c) smooth[k][4 + edge_between(c, other)] += fit.at((X[c] + X[other]) / 2) / 2;
    }
  }
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const auto X = corners_of(mesh, elements[k]);
    const std::size_t first = element_points * elements[k];
    const double scale = rest_scale(mesh, elements[k]);
    errors[elements[k]] =
        difference(smooth[k], &F[first], &P[first], scale * scale * scale * signed_volume(X[0], X[1], X[2], X[3]));
  }
}

}  // namespace

std::vector<double> quadratic_recovery_errors(const TetMesh& mesh, const std::vector<int>& material_of,
                                              const std::vector<Mat3>& F, const std::vector<Mat3>& P) {
  std::vector<double> errors(mesh.tets.size(), 0.0);
  const int materials = material_of.empty() ? 0 : 1 + *std::max_element(material_of.begin(), material_of.end());
  std::vector<std::vector<std::size_t>> elements(static_cast<std::size_t>(materials));
  for (std::size_t t = 0; t < errors.size(); ++t) elements[static_cast<std::size_t>(material_of[t])].push_back(t);
  for (const auto& of_one : elements) add_errors(mesh, of_one, F, P, errors);
  return errors;
}

}  // namespace heml
