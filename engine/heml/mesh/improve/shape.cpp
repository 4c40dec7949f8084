#include <algorithm>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/improve/shape.hpp>

namespace heml {
namespace {

/// What dihedral angles and altitudes are computed from.
struct Measures {
  double determinant;             ///< six times the volume
  std::array<Vec3, 4> normals;    ///< outward, length twice the area
  std::array<double, 4> areas2;   ///< twice the area of the face opposite each corner
  std::array<double, 6> lengths;  ///< of tet_edges
};

Measures measure(const Corners& x) {
  Measures m;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& [a, b, c] = tet_faces[f];
    m.normals[f] = (x[b] - x[a]).cross(x[c] - x[a]);
    m.areas2[f] = m.normals[f].norm();
  }
  m.determinant = m.normals[0].dot(x[1] - x[0]);
  for (std::size_t e = 0; e < 6; ++e) m.lengths[e] = (x[tet_edges[e][0]] - x[tet_edges[e][1]]).norm();
  return m;
}

/// The sine of the dihedral angle at an edge: 6V l / (2A · 2A') of the faces that share it.
double sine(const Measures& m, std::size_t edge) {
  const auto& [f, g] = tet_edges[5 - edge];
  return m.determinant * m.lengths[edge] / (m.areas2[f] * m.areas2[g]);
}

/// ∇ log |N| of a face by one of its corners.
Vec3 log_area_gradient(const Corners& x, const Measures& m, std::size_t face, int corner) {
  const auto& nodes = tet_faces[face];
  for (std::size_t k = 0; k < 3; ++k)
    if (nodes[k] == corner)
      return (x[nodes[(k + 1) % 3]] - x[nodes[(k + 2) % 3]]).cross(m.normals[face]) / (m.areas2[face] * m.areas2[face]);
  return Vec3::Zero();
}

}  // namespace

double ShapeMeasure::operator()(const Corners& x) const {
  const Measures m = measure(x);
  if (volume_rate > 0) return volume_rate * m.determinant / 6;
  const double largest = *std::max_element(m.areas2.begin(), m.areas2.end());
  if (!(*std::min_element(m.areas2.begin(), m.areas2.end()) > 0)) return -1;
  double worst = goal + altitude_rate * std::max(m.determinant / largest, 0.0);
  for (std::size_t e = 0; e < 6; ++e) worst = std::min(worst, sine(m, e));
  return worst;
}

void ShapeMeasure::append_terms(const Corners& x, int corner, double limit, std::vector<ShapeTerm>& terms) const {
  const Measures m = measure(x);
  if (volume_rate > 0) {
    const double value = volume_rate * m.determinant / 6;
    if (value < limit) terms.push_back({value, -m.normals[corner] * (volume_rate / 6)});
    return;
  }
  if (!(*std::min_element(m.areas2.begin(), m.areas2.end()) > 0)) return;
  for (std::size_t e = 0; e < 6; ++e) {
    const double value = sine(m, e);
    if (!(value < limit)) continue;
    const auto& [f, g] = tet_edges[5 - e];
    Vec3 gradient = -m.normals[corner] * (m.lengths[e] / (m.areas2[f] * m.areas2[g]));
    gradient -= value * (log_area_gradient(x, m, f, corner) + log_area_gradient(x, m, g, corner));
    for (std::size_t k = 0; k < 2; ++k)
      if (static_cast<int>(tet_edges[e][k]) == corner)
        gradient += value * (x[corner] - x[tet_edges[e][1 - k]]) / (m.lengths[e] * m.lengths[e]);
    terms.push_back({value, gradient});
  }
  if (!(altitude_rate > 0) || !(m.determinant > 0)) return;
  for (std::size_t f = 0; f < 4; ++f) {
    const double altitude = m.determinant / m.areas2[f], value = goal + altitude_rate * altitude;
    if (value < limit)
      terms.push_back(
          {value, altitude_rate * (-m.normals[corner] / m.areas2[f] - altitude * log_area_gradient(x, m, f, corner))});
  }
}

double smallest_altitude(const Corners& x) {
  const Measures m = measure(x);
  const double largest = *std::max_element(m.areas2.begin(), m.areas2.end());
  return largest > 0 ? m.determinant / largest : 0;
}

}  // namespace heml
