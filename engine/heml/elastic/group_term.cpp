#include <algorithm>
#include <cmath>
#include <heml/elastic/term_parts.hpp>
#include <heml/elastic/viscoelastic_term.hpp>
#include <limits>

namespace heml {

template <class Real>
void StressSum<Real>::add(const Tensions<Real>& t, const RestShape<Real>& rest) {
  Real L[3][3], more[6];
  cholesky3(rest.A, L);
  const Real i0 = 1 / L[0][0], i1 = 1 / L[1][1], i2 = 1 / L[2][2];
  const Real low = -L[1][0] * i0 * i1;
  const Real inverse[3][3] = {{i0, 0, 0}, {low, i1, 0}, {-(L[2][0] * i0 + L[2][1] * low) * i2, -L[2][1] * i1 * i2, i2}};
  congruence3(inverse, t.T, more);
  for (int i = 0; i < 6; ++i) S[i] += more[i] / rest.volume;
  wJ += t.wJ;
}

template <class Real>
bool GroupTerm<Real>::forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
                             bool add) const {
  bool all_valid = true;
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s) {
    const auto rest = rest_shape(group, s);
    const auto kinematics = full_kinematics(group, x, s, rest);
    Real f[12];
    forces_from_tensions<true>(tensions(group, s, kinematics, rest), kinematics.e, kinematics.cross, f);
    write_slot_forces(f, group, s, corner, add);
    all_valid &= valid(group, s, kinematics);
  }
  return all_valid;
}

template <class Real>
void GroupTerm<Real>::stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real scale,
                                Real* K, bool add) const {
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s) {
    const auto rest = rest_shape(group, s);
    const auto kinematics = full_kinematics(group, x, s, rest);
    const auto t = tensions(group, s, kinematics, rest);
    Real k[edge_entries] = {};
    add_columns(
        [&](const Real(&de)[3][3], Real* f) {
          corner_force_differential(
              t, tension_differential(group, s, kinematics, rest, kinematics_differential(kinematics, de, rest.volume)),
              kinematics, de, f);
        },
        k);
    for (Real& entry : k) entry *= scale;
    write_edge_stiffness(k, s, K, add);
  }
}

template <class Real>
void GroupTerm<Real>::energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double scale,
                               double* of_packet, bool add) const {
  for (std::size_t p = begin; p < end; ++p) {
    double sum = add ? of_packet[p] : 0.0;
    for (std::size_t s = p * Group::lanes; s < std::min((p + 1) * Group::lanes, group.size()); ++s) {
      const auto rest = rest_shape(group, s);
      sum += scale * energy(group, s, full_kinematics(group, x, s, rest), rest);
    }
    of_packet[p] = sum;
  }
}

template <class Real>
void GroupTerm<Real>::packet_tensions(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                                      Real* of_packets) const {
  for (std::size_t p = begin; p < end; ++p)
    for (std::size_t l = 0; l < Group::lanes; ++l) {
      const std::size_t s = p * Group::lanes + l;
      const auto rest = rest_shape(group, s);
      const Tensions<Real> t = tensions(group, s, full_kinematics(group, x, s, rest), rest);
      Real* of_slot = of_packets + tension_entries * Group::lanes * (p - begin) + l;
      for (std::size_t i = 0; i < 6; ++i) of_slot[Group::lanes * i] = t.T[i];
      of_slot[Group::lanes * 6] = t.wJ;
    }
}

template <class Real>
void GroupTerm<Real>::mises_bounds(const Group&, const Real*, std::size_t begin, std::size_t end, Real* bounds) const {
  std::fill_n(bounds, (end - begin) * Group::lanes, std::numeric_limits<Real>::infinity());
}

template <class Real>
void GroupTerm<Real>::frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin,
                                       std::size_t end, Real* bounds, bool add) const {
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s, ++bounds) {
    const auto rest = rest_shape(group, s);
    *bounds = (add ? *bounds : 0) + slot_frequency_bound(group, s, full_kinematics(group, x, s, rest), rest,
                                                         weights_of_slot(group, weights, s));
  }
}

template <class Real>
std::vector<std::unique_ptr<GroupTerm<Real>>> make_terms(const Material& material, bool continuation,
                                                         bool without_volume) {
  std::vector<std::unique_ptr<GroupTerm<Real>>> terms;
  const LawInfo& info = *find_law(material.law);
  if (!info.is_continuum) return terms;
  const bool own_volume_term = material.volume_term == VolumeTerm::quadratic && !without_volume;
  terms.push_back(make_law_term<Real>(material, continuation, !own_volume_term));
  if (!own_volume_term && !without_volume) terms.push_back(make_volume_term<Real>(material, continuation));
  if (material.viscosity > 0 || material.bulk_viscosity > 0 || !material.relaxation.empty())
    terms.push_back(std::make_unique<ViscoelasticTerm<Real>>(
        make_law_term<Real>(material, continuation, info.has_volume_term), material));
  return terms;
}

template struct StressSum<float>;
template struct StressSum<double>;
template class GroupTerm<float>;
template class GroupTerm<double>;
template std::vector<std::unique_ptr<GroupTerm<float>>> make_terms(const Material&, bool, bool);
template std::vector<std::unique_ptr<GroupTerm<double>>> make_terms(const Material&, bool, bool);

}  // namespace heml
