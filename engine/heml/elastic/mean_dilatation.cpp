#include <algorithm>
#include <cmath>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/mean_dilatation.hpp>
#include <heml/elastic/virtual_corners.hpp>
#include <heml/elastic/volume_function.hpp>
#include <heml/materials/parameter_slots.hpp>

namespace heml {
namespace {

constexpr double point_share = 13.0 / 6;  // κ/μ at Poisson's ratio 0.3

template <class Real>
ElementKinematics<Real> volume_kinematics_of(const ElementGroup<Real>& group, const Real* x, std::size_t s) {
  const SlotNodes<Real> n(group, x, s);
  return element_kinematics<false, true, false, false>(n.x0, n.x1, n.x2, n.x3, rest_shape(group, s));
}

/// V and V J̄ of the element whose first slot is s.
template <class Real>
std::array<Real, 2> element_volumes(const ElementGroup<Real>& group, const Real* x, std::size_t s) {
  std::array<Real, 2> sum{0, 0};
  for (std::size_t q = s; q < s + element_points; ++q) {
    sum[0] += group.volume[q];
    sum[1] += group.volume[q] * volume_kinematics_of(group, x, q).at.J;
  }
  return sum;
}

/// The same of both elements of each packet, and their forces by pressure(packet's element, V, V J̄).
template <class Real, class Pressure>
[[gnu::always_inline]] inline void packet_forces(const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                                                 std::size_t end, Real* corner, const Pressure& pressure) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real volume[lanes], of_point[lanes], out[12][lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      volume[l] =
          packet.volume[l] *
          element_kinematics<false, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], packet.rest(l)).at.J;
    }
    for (std::size_t first = 0; first < lanes; first += element_points) {
      Real rest = 0, deformed = 0;
      for (std::size_t l = first; l < first + element_points; ++l) {
        rest += packet.volume[l];
        deformed += volume[l];
      }
      std::fill_n(of_point + first, element_points, pressure(p * lanes + first, rest, deformed));
    }
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const auto kinematics =
          element_kinematics<false, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], packet.rest(l));
      Real f[12];
      forces_from_tensions<true>(Tensions<Real>{{}, of_point[l]}, kinematics.e, kinematics.cross, f);
      for (int i = 0; i < 12; ++i) out[i][l] = f[i];
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), true);
  }
}

template <class Real, class Pressure>
HEML_WIDE void wide_packet_forces(const ElementGroup<Real>& group, const Real* x, std::size_t begin, std::size_t end,
                                  Real* corner, const Pressure& pressure) {
  packet_forces<Real>(group, x, begin, end, corner, pressure);
}

/// V_q ∂J_q/∂y of the corners of one slot: minus the forces of unit pressure.
template <class Real>
void volume_gradient(const ElementGroup<Real>& group, const Real* x, std::size_t s, Real (&out)[12]) {
  const auto kinematics = volume_kinematics_of(group, x, s);
  forces_from_tensions<true>(Tensions<Real>{{}, -1}, kinematics.e, kinematics.cross, out);
}

/// g of the ten nodes of the element whose first slot is s.
template <class Real>
void element_volume_gradient(const ElementGroup<Real>& group, const Real* x, std::size_t s, Real (&out)[30]) {
  std::fill_n(out, 30, Real(0));
  for (std::size_t q = 0; q < element_points; ++q) {
    Real of_point[12];
    volume_gradient(group, x, s + q, of_point);
    for (std::size_t c = 0; c < 4; ++c)
      for (const auto& [node, weight] : virtual_corner(q, c))
        for (std::size_t i = 0; i < 3; ++i) out[3 * node + i] += static_cast<Real>(weight) * of_point[3 * c + i];
  }
}

}  // namespace

template <class Real>
std::vector<Real> volume_moduli(const ElementGroup<Real>& group, const Material& material) {
  const std::size_t parameter = *volume_parameter(material, *find_law(material.law));
  for (std::size_t k = 0; k < material.fields.size(); ++k)
    if (material.fields[k].parameter == parameter) return group.parameters[k];
  return std::vector<Real>(group.volume.size(), static_cast<Real>(material.parameters[parameter]));
}

template <class Real>
std::vector<Real> split_volume_modulus(Material& material, Shared<ElementGroup<Real>>& group) {
  std::vector<Real> rest = volume_moduli(*group, material);
  const std::size_t parameter = *volume_parameter(material, *find_law(material.law));
  Material of_slot = material;
  of_slot.fields.clear();
  double limit = point_share * small_strain_moduli(of_slot).shear;
  for (std::size_t s = 0; s < rest.size(); ++s) {
    if (!material.fields.empty()) {
      for (std::size_t k = 0; k < material.fields.size(); ++k)
        of_slot.parameters[material.fields[k].parameter] = static_cast<double>(group->parameters[k][s]);
      limit = point_share * small_strain_moduli(of_slot).shear;
    }
    rest[s] = std::max(rest[s] - static_cast<Real>(limit), Real(0));
  }
  if (material.fields.empty()) {
    material.parameters[parameter] = std::min(material.parameters[parameter], limit);
    return rest;
  }
  // The points' share follows from the shear modulus, so it differs between elements even where κ does not.
  const auto is_kappa = [&](const FieldParameter& field) { return field.parameter == parameter; };
  const auto found = std::find_if(material.fields.begin(), material.fields.end(), is_kappa);
  const auto field = static_cast<std::size_t>(found - material.fields.begin());
  ElementGroup<Real>& own = group.write();
  if (found == material.fields.end()) {
    own.parameters.push_back(volume_moduli(own, material));
    material.fields.push_back({parameter, ""});
  }
  for (std::size_t s = 0; s < rest.size(); ++s) own.parameters[field][s] -= rest[s];
  return rest;
}

template <class Real>
bool MeanDilatation<Real>::add_forces(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                      Real* corner) const {
  bool defined = true;
  const auto pressure = [&](std::size_t s, Real rest, Real deformed) {
    const Real J = deformed / rest;
    defined &= volume_term_defined(term_, continuation_, J);
    return kappa_[s] * unit_volume_term(term_, continuation_, J).w1;
  };
  if (has_avx2())
    wide_packet_forces<Real>(group, x, begin, end, corner, pressure);
  else
    packet_forces<Real>(group, x, begin, end, corner, pressure);
  return defined;
}

template <class Real>
void MeanDilatation<Real>::add_energies(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                        double* of_packet) const {
  for (std::size_t p = begin; p < end; ++p)
    for (std::size_t s = p * Group::lanes; s < std::min((p + 1) * Group::lanes, group.size()); s += element_points) {
      const auto [rest, deformed] = element_volumes(group, x, s);
      of_packet[p] += static_cast<double>(rest * kappa_[s]) *
                      static_cast<double>(unit_volume_term(term_, continuation_, deformed / rest).w);
    }
}

template <class Real>
typename MeanDilatation<Real>::Value MeanDilatation<Real>::value(const Group& group, const Real* x,
                                                                 std::size_t s) const {
  const auto [rest, deformed] = element_volumes(group, x, s);
  const auto psi = unit_volume_term(term_, continuation_, deformed / rest);
  return {kappa_[s] * psi.w1, kappa_[s] * psi.w2 / rest};
}

template <class Real>
void MeanDilatation<Real>::linearise(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* K) {
  constexpr std::size_t lanes = Group::lanes;
  for (std::size_t s = begin * lanes; s < end * lanes; s += element_points) {
    const Value at = value(group, x, s);
    pressure_[s / element_points] = at.pressure;
    OuterProduct<Real>& outer = outer_[s / element_points];
    outer.k = at.stiffness;
    element_volume_gradient(group, x, s, outer.g);
    for (std::size_t q = s; q < s + element_points; ++q) {
      Real k[edge_entries] = {};
      add_geometric_stiffness(Tensions<Real>{{}, pressure(q)}, volume_kinematics_of(group, x, q).e, k);
      Real* to = K + edge_entries * lanes * (q / lanes) + q % lanes;
      for (std::size_t i = 0; i < edge_entries; ++i) to[lanes * i] += k[i];
    }
  }
}

template <class Real>
void MeanDilatation<Real>::project() {
  for (OuterProduct<Real>& outer : outer_) outer.k = std::max(outer.k, Real(0));
}

template <class Real>
void MeanDilatation<Real>::add_force_differential(const Group& group, const VirtualCorners<Real>& corners,
                                                  const Real* dx, std::size_t begin, std::size_t end,
                                                  Real* of_element) const {
  for (std::size_t s = begin * Group::lanes; s < std::min(end * Group::lanes, group.size()); s += element_points) {
    const auto& [k, g] = outer_[s / element_points];
    const std::size_t e = element_at(group, s);
    const QuadraticNodes& nodes = corners.nodes_of(e);
    Real change = 0;
    for (std::size_t a = 0; a < 10; ++a)
      for (std::size_t i = 0; i < 3; ++i) change += g[3 * a + i] * dx[3 * static_cast<std::size_t>(nodes[a]) + i];
    change *= k;
    for (std::size_t i = 0; i < 30; ++i) of_element[30 * e + i] -= change * g[i];
  }
}

template <class Real>
void MeanDilatation<Real>::add_stiffness(std::size_t s, QuadraticMatrix<Real>& K) const {
  const auto& [k, g] = outer_[s / element_points];
  for (std::size_t r = 0; r < 30; ++r)
    for (std::size_t c = 0; c < 30; ++c) K[r][c] += k * g[r] * g[c];
}

/// κ̄ψ''/V g·Z⁻¹M⁻¹g of an element, exact for its part of the stiffness, and |d²J| ≤ 2 σ1 |dF|² at the worst point.
template <class Real>
void MeanDilatation<Real>::add_frequency_bounds(const Group& group, const VirtualCorners<Real>& corners,
                                                const StepWeights<Real>& weights, const Real* x, std::size_t begin,
                                                std::size_t end, Real* bounds) const {
  for (std::size_t s = begin * Group::lanes; s < std::min(end * Group::lanes, group.size()); s += element_points) {
    const Value at = value(group, x, s);
    const std::size_t e = element_at(group, s);
    const QuadraticNodes& nodes = corners.nodes_of(e);
    Real g[30], square = 0, mass = 0, least = std::numeric_limits<Real>::infinity();
    element_volume_gradient(group, x, s, g);
    for (std::size_t i = 0; i < 30; ++i)
      square += g[i] * g[i] * weights.node[static_cast<std::size_t>(nodes[i / 3])] * Real(i < 12 ? 36 : 27.0 / 4);
    for (std::size_t q = s; q < s + element_points; ++q) {
      mass += group.density * static_cast<Real>(frequency_ratio) * group.volume[q];
      least = std::min(least, group.volume[q]);
    }
    // The bound of a point counts as much as its volume.
    const Real share = mass / (4 * group.density * static_cast<Real>(frequency_ratio) * least);
    const Real exact = std::max(at.stiffness, Real(0)) * square / (mass * weights.factor[e]) * share;
    for (std::size_t q = s; q < s + element_points; ++q) {
      const auto rest = rest_shape(group, q);
      const Real stretch = std::sqrt(stretch_bounds(full_kinematics(group, x, q, rest).at).max);
      const Real gamma = max_gradient(rest.A, CornerWeights<Real>{});
      bounds[q - begin * Group::lanes] += 8 / group.density * std::abs(at.pressure) * stretch * gamma + exact;
    }
  }
}

template std::vector<float> volume_moduli(const ElementGroup<float>&, const Material&);
template std::vector<double> volume_moduli(const ElementGroup<double>&, const Material&);
template std::vector<float> split_volume_modulus(Material&, Shared<ElementGroup<float>>&);
template std::vector<double> split_volume_modulus(Material&, Shared<ElementGroup<double>>&);
template class MeanDilatation<float>;
template class MeanDilatation<double>;

}  // namespace heml
