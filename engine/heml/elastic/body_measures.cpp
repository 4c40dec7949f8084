// What is measured of a body at given positions: energies, states and stresses of elements.
#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <heml/elastic/error_estimate.hpp>
#include <numeric>

namespace heml {
namespace {

/// J σ = F S Fᵀ + wJ J I. Von Mises stress and largest stretch are invariant to rotation, so √C replaces F.
template <class Real>
ElementState<Real> state_of(const StressSum<Real>& stress, const Real C[6], Real J) {
  const auto e = symmetric_eigen3(C);
  const Real largest = std::max({e.value[0], e.value[1], e.value[2]});
  Real root[3], U[6], T[6];
  for (int i = 0; i < 3; ++i) root[i] = std::sqrt(std::max(e.value[i], Real(0)));
  spectral_sum3(e, root, U);
  const Real M[3][3] = {{U[0], U[3], U[4]}, {U[3], U[1], U[5]}, {U[4], U[5], U[2]}};
  congruence3(M, stress.S, T);
  const Real mean = (T[0] + T[1] + T[2]) / 3;
  for (int i = 0; i < 3; ++i) T[i] -= mean;
  return {J, std::sqrt(std::max(largest, Real(0))), std::sqrt(Real(1.5) * double_contraction3(T, T)) / std::abs(J)};
}

template <class Real>
bool is_finite(const Tensions<Real>& t) {
  return std::isfinite(t.wJ) && std::all_of(std::begin(t.T), std::end(t.T), [](Real T) { return std::isfinite(T); });
}

}  // namespace

/// Adds packets in ascending order, so that the sum does not depend on the threads.
template <class Real>
double ElasticBody<Real>::sum_energies(const Real* x, bool stored, ThreadTeam& team) {
  if (!stored) update_slots();
  double sum = 0;
  for (const Part& part : parts_) {
    packet_energy_.assign(part.group->packets(), 0.0);
    for (const auto& term : part.terms)
      if (term->stores() == stored)
        team.parallel_for(part.group->packets(), grain_ / part.group->lanes, [&](std::size_t begin, std::size_t end) {
          term->energies(*part.group, x, begin, end, 1.0, packet_energy_.data(), true);
        });
    if (stored && part.dilatation)
      team.parallel_for(part.group->packets(), grain_ / 4 / part.group->lanes, [&](std::size_t begin, std::size_t end) {
        part.dilatation->add_energies(*part.group, x, begin, end, packet_energy_.data());
      });
    for (const double of_packet : packet_energy_) sum += of_packet;
    if (!stored && part.flow) sum += part.flow->trial_potential(*part.group);
  }
  return sum;
}

template <class Real>
double ElasticBody<Real>::energy(const Real* x, ThreadTeam& team) {
  x = inner_positions(x, team);
  double sum = layout_->joints.springs.energy(x) + sum_energies(x, true, team);
  if (pressure_) sum += pressure_->energy(x);
  return sum;
}

template <class Real>
double ElasticBody<Real>::active_energy(const Real* x, ThreadTeam& team) {
  if (std::none_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.active; })) return 0;
  x = inner_positions(x, team);
  double sum = 0;
  for (const Part& part : parts_) {
    if (!part.active) continue;
    std::vector<double> of_packet(part.group->packets(), 0.0);
    part.active->energies(*part.group, x, 0, part.group->packets(), 1.0, of_packet.data(), true);
    sum = std::accumulate(of_packet.begin(), of_packet.end(), sum);
  }
  return sum;
}

template <class Real>
double ElasticBody<Real>::potential(const Real* x, ThreadTeam& team) {
  const double stored = energy(x, team);
  return stored + (has_internal_state() ? sum_energies(inner_positions(x, team), false, team) : 0.0);
}

template <class Real>
int ElasticBody<Real>::first_undefined(const Real* x) const {
  int first = -1;
  each_slot(x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics,
                   const RestShape<Real>& rest) {
    for (const auto& term : part.terms)
      if (first < 0 || part.group->element[s] < first)
        if (!term->valid(*part.group, s, kinematics) || !is_finite(term->tensions(*part.group, s, kinematics, rest)))
          first = part.group->element[s];
  });
  return first < 0 ? first : first / static_cast<int>(points_per_element());
}

template <class Real>
void ElasticBody<Real>::states(const Real* x, std::vector<ElementState<Real>>& out) const {
  out.resize(layout_->mesh.tets.size());
  each_slot(
      x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest) {
        StressSum<Real> stress;
        for (const auto& term : part.terms) stress.add(term->tensions(*part.group, s, kinematics, rest), rest);
        Real factor[3][3], C[6];
        cholesky3(rest.A, factor);
        into_rest_frame(factor, kinematics.G, C);
        out[static_cast<std::size_t>(part.group->element[s])] = state_of(stress, C, kinematics.at.J);
      });
}

template <class Real>
void ElasticBody<Real>::volume_ratios(const Real* x, std::vector<Real>& out) const {
  out.resize(layout_->mesh.tets.size());
  each_slot(x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics, const RestShape<Real>&) {
    out[static_cast<std::size_t>(part.group->element[s])] = kinematics.at.J;
  });
}

template <class Real>
std::vector<Mat3> ElasticBody<Real>::stresses(const Real* x, ThreadTeam& team) {
  x = inner_positions(x, team);
  std::vector<Real>& corner = corner_forces();
  std::fill(corner.begin(), corner.end(), Real(0));
  for (const Part& part : parts_)
    for (const auto& term : part.terms)
      if (term->stores())
        team.parallel_for(part.group->packets(), grain_ / part.group->lanes, [&](std::size_t begin, std::size_t end) {
          term->forces(*part.group, x, begin, end, corner.data(), true);
        });
  if (pressure_) pressure_->add_forces(x, corner.data(), team);
  each_dilatation(team, [&](const Part& part, std::size_t begin, std::size_t end) {
    part.dilatation->add_forces(*part.group, x, begin, end, corner.data());
  });
  std::vector<Mat3> P(layout_->mesh.tets.size(), Mat3::Zero());
  for (const Part& part : parts_)
    for (std::size_t s = 0; s < part.group->size(); ++s) {
      const auto t = static_cast<std::size_t>(part.group->element[s]);
      const auto X = [&](std::size_t a) {
        return layout_->mesh.nodes[static_cast<std::size_t>(part.group->node[a][s])];
      };
      const double scale = rest_scale(layout_->mesh, t);  // of X; the volume's is its third power
      const double volume = scale * scale * signed_volume(X(0), X(1), X(2), X(3));
      for (std::size_t a = 1; a < 4; ++a) {
        const Real* f = &corner[3 * (part.group->first_corner + 4 * s + a)];
        P[t] -= Vec3(f[0], f[1], f[2]) * (X(a) - X(0)).transpose() / volume;
      }
    }
  return P;
}

template <class Real>
std::vector<Mat3> ElasticBody<Real>::deformation_gradients(const Real* x) const {
  std::vector<Real> y;
  x = inner_positions(x, y);
  std::vector<Vec3> places;
  for (std::size_t n = 0; n < layout_->mesh.nodes.size(); ++n)
    places.push_back(Eigen::Map<const Vector3<Real>>(x + 3 * n).template cast<double>());
  return heml::deformation_gradients(layout_->mesh, places);
}

template double ElasticBody<float>::energy(const float*, ThreadTeam&);
template double ElasticBody<double>::energy(const double*, ThreadTeam&);
template double ElasticBody<float>::active_energy(const float*, ThreadTeam&);
template double ElasticBody<double>::active_energy(const double*, ThreadTeam&);
template double ElasticBody<float>::potential(const float*, ThreadTeam&);
template double ElasticBody<double>::potential(const double*, ThreadTeam&);
template int ElasticBody<float>::first_undefined(const float*) const;
template int ElasticBody<double>::first_undefined(const double*) const;
template void ElasticBody<float>::states(const float*, std::vector<ElementState<float>>&) const;
template void ElasticBody<double>::states(const double*, std::vector<ElementState<double>>&) const;
template void ElasticBody<float>::volume_ratios(const float*, std::vector<float>&) const;
template void ElasticBody<double>::volume_ratios(const double*, std::vector<double>&) const;
template std::vector<Mat3> ElasticBody<float>::deformation_gradients(const float*) const;
template std::vector<Mat3> ElasticBody<double>::deformation_gradients(const double*) const;
template std::vector<Mat3> ElasticBody<float>::stresses(const float*, ThreadTeam&);
template std::vector<Mat3> ElasticBody<double>::stresses(const double*, ThreadTeam&);

}  // namespace heml
