// The stiffness K: its evaluation, projection and products, and bounds of its eigenvalues.
#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <heml/elastic/bsr_matrix.hpp>
#include <heml/elastic/clamp.hpp>
#include <heml/elastic/stiffness_product.hpp>
#include <mutex>

namespace heml {
template <class Real>
void ElasticBody<Real>::linearise(const Real* x, ThreadTeam& team) {
  update_slots();
  x = inner_positions(x, team);
  linearisation_point_.assign(x, x + 3 * layout_->mesh.nodes.size());
  projected_ = false;
  if (pressure_) pressure_->linearise(x, team);
  for (Part& part : parts_) {
    part.stiffness.resize(edge_entries * part.group->volume.size());
    for (std::size_t k = 0; k < part.terms.size(); ++k)
      team.parallel_for(part.group->packets(), grain_ / 4 / part.group->lanes, [&](std::size_t begin, std::size_t end) {
        part.terms[k]->stiffness(*part.group, x, begin, end, part.stiffness.data(), k > 0);
      });
    if (part.flows_within_steps)
      team.parallel_for(part.group->packets(), grain_ / 16 / part.group->lanes,
                        [&](std::size_t begin, std::size_t end) {
                          part.flow->add_stiffness(*part.group, x, begin, end, part.stiffness.data());
                        });
    if (part.dilatation) part.dilatation->resize(*part.group);
  }
  each_dilatation(team, [&](Part& part, std::size_t begin, std::size_t end) {
    part.dilatation->linearise(*part.group, x, begin, end, part.stiffness.data());
  });
}

template <class Real>
void ElasticBody<Real>::project(Projection projection, ThreadTeam& team) {
  if (projection != Projection::element && projection != Projection::tension) return;
  projected_ = true;
  for (Part& part : parts_)
    team.parallel_for(part.group->volume.size(), grain_ / 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        Real k[edge_entries];
        read_edge_stiffness(part.stiffness.data(), s, k);
        if (projection == Projection::element) {
          clamp_element(k);
        } else {
          const auto rest = rest_shape(*part.group, s);
          const auto kinematics = full_kinematics(*part.group, linearisation_point_.data(), s, rest);
          Tensions<Real> sum{};
          for (const auto& term : part.terms) {
            const Tensions<Real> t = term->tensions(*part.group, s, kinematics, rest);
            for (int i = 0; i < 6; ++i) sum.T[i] += t.T[i];
            sum.wJ += t.wJ;
          }
          if (part.dilatation) sum.wJ += part.dilatation->pressure(s);
          clamp_tension(sum, kinematics, rest, k);
        }
        write_edge_stiffness(k, s, part.stiffness.data(), false);
      }
    });
}

template <class Real>
void ElasticBody<Real>::force_differential(const Real* dx, Real* out, ThreadTeam& team) {
  dx = inner_positions(dx, team);
  Real* corner = corner_forces().data();
  for (const Part& part : parts_)
    team.parallel_for(part.group->packets(), grain_ / part.group->lanes, [&](std::size_t begin, std::size_t end) {
      multiply_stiffness(part.stiffness.data(), *part.group, dx, begin, end, corner);
    });
  const Real* x = linearisation_point_.data();
  if (layout_->virtual_corners) {
    each_dilatation(team, [&](const Part& part, std::size_t begin, std::size_t end) {
      part.dilatation->add_force_differential(*part.group, x, dx, projected_, begin, end, corner);
    });
    return layout_->virtual_corners->gather(corner_, of_element_, out, team);
  }
  if (pressure_) pressure_->add_force_differential(x, dx, corner, team);
  gather_corners(layout_->joints.corners, out, false, team);
  if (!layout_->joints.springs.empty()) layout_->joints.springs.add_force_differential(x, dx, out, projected_, team);
}

template <class Real>
bool ElasticBody<Real>::add_stiffness(BsrMatrix& rows, ThreadTeam& team) const {
  if (pressure_ || layout_->virtual_corners) return false;
  for (const Part& part : parts_)
    if (!part.terms.empty()) rows.add_elements(part.stiffness.data(), *part.group, team);
  each_spring_stiffness([&](int a, int b, const Real(&block)[3][3]) {
    Mat3 B;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) B(i, j) = static_cast<double>(block[i][j]);
    rows.add_edge(a, b, B);
  });
  return true;
}

template <class Real>
void ElasticBody<Real>::element_stiffness(std::size_t p, std::size_t s, ElementMatrix<Real>& K) const {
  const Part& part = parts_[p];
  Real k[edge_entries];
  read_edge_stiffness(part.stiffness.data(), s, k);
  if (pressure_) pressure_->add_stiffness(p, linearisation_point_.data(), s, k);
  expand_edges(k, K);
}

/// Σ_q BᵀKB over the points of an element.
template <class Real>
void ElasticBody<Real>::quadratic_stiffness(std::size_t p, std::size_t first_slot, QuadraticMatrix<Real>& K) const {
  if (const Part& part = parts_[p]; part.dilatation)
    part.dilatation->add_stiffness(*part.group, linearisation_point_.data(), projected_, first_slot, K);
  for (std::size_t q = 0; q < element_points; ++q) {
    ElementMatrix<Real> of_point = {};
    element_stiffness(p, first_slot + q, of_point);
    for (std::size_t c = 0; c < 4; ++c)
      for (const auto& [a, weight_a] : virtual_corner(q, c))
        for (std::size_t d = 0; d < 4; ++d)
          for (const auto& [b, weight_b] : virtual_corner(q, d)) {
            const Real weight = static_cast<Real>(weight_a * weight_b);
            for (std::size_t i = 0; i < 3; ++i)
              for (std::size_t j = 0; j < 3; ++j) K[3 * a + i][3 * b + j] += weight * of_point[3 * c + i][3 * d + j];
          }
  }
}

/// Maximum over the parts of the sum of the bounds of their terms.
template <class Real>
template <class Bound>
Real ElasticBody<Real>::max_bound(ThreadTeam& team, const Bound& bound) const {
  Real of_all = 0;
  std::mutex mutex;  // a maximum does not depend on the order it is taken in
  for (const Part& part : parts_) {
    Real of_part = 0;
    for (const auto& term : part.terms) {
      Real largest = 0;
      team.parallel_for(part.group->packets(), grain_ / part.group->lanes, [&](std::size_t begin, std::size_t end) {
        const Real value = bound(*term, *part.group, begin, end);
        std::lock_guard lock(mutex);
        largest = value > largest || std::isnan(value) ? value : largest;
      });
      of_part += largest;
    }
    of_all = of_part > of_all || std::isnan(of_part) ? of_part : of_all;
  }
  return of_all;
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team) {
  x = inner_positions(x, team);
  Real bound = max_bound(team, [x](const auto& term, const auto& group, std::size_t begin, std::size_t end) {
    return term.frequency_bound(group, x, begin, end);
  });
  if (fans_.needs_state()) fans_.read_state(fan_slots());
  bound += fans_.state_bound(fan_slots());
  if (pressure_) bound += pressure_->frequency_bound(x, team);
  Real of_elements = 0;
  std::mutex mutex;
  each_dilatation(team, [&](const Part& part, std::size_t begin, std::size_t end) {
    const Real value = part.dilatation->frequency_bound(*part.group, x, begin, end);
    std::lock_guard lock(mutex);
    of_elements = value > of_elements || std::isnan(value) ? value : of_elements;
  });
  bound += of_elements;
  if (!layout_->joints.springs.empty()) bound += layout_->joints.springs.frequency_bound(masses());
  return bound;
}

template <class Real>
Real ElasticBody<Real>::damping_bound(const Real* x, ThreadTeam& team) {
  if (!has_internal_state()) return 0;
  x = inner_positions(x, team);
  return max_bound(team, [x](const auto& term, const auto& group, std::size_t begin, std::size_t end) {
    return term.damping_bound(group, x, begin, end);
  });
}

template <class Real>
std::vector<Real> ElasticBody<Real>::element_bounds(const Real* x) const {
  std::vector<Real> bounds(layout_->mesh.tets.size(), Real(0));
  each_slot(
      x, [&](const Part& part, std::size_t s, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest) {
        for (const auto& term : part.terms)
          bounds[static_cast<std::size_t>(part.group->element[s])] +=
              term->slot_frequency_bound(*part.group, s, kinematics, rest);
      });
  if (layout_->virtual_corners) {
    for (std::size_t t = 0; t < elements(); ++t)
      bounds[t] = *std::max_element(&bounds[element_points * t], &bounds[element_points * t] + element_points);
    bounds.resize(elements());
  }
  return bounds;
}

template void ElasticBody<float>::linearise(const float*, ThreadTeam&);
template void ElasticBody<double>::linearise(const double*, ThreadTeam&);
template void ElasticBody<float>::project(Projection, ThreadTeam&);
template void ElasticBody<double>::project(Projection, ThreadTeam&);
template void ElasticBody<float>::force_differential(const float*, float*, ThreadTeam&);
template void ElasticBody<double>::force_differential(const double*, double*, ThreadTeam&);
template bool ElasticBody<float>::add_stiffness(BsrMatrix&, ThreadTeam&) const;
template bool ElasticBody<double>::add_stiffness(BsrMatrix&, ThreadTeam&) const;
template void ElasticBody<float>::element_stiffness(std::size_t, std::size_t, ElementMatrix<float>&) const;
template void ElasticBody<double>::element_stiffness(std::size_t, std::size_t, ElementMatrix<double>&) const;
template void ElasticBody<float>::quadratic_stiffness(std::size_t, std::size_t, QuadraticMatrix<float>&) const;
template void ElasticBody<double>::quadratic_stiffness(std::size_t, std::size_t, QuadraticMatrix<double>&) const;
template float ElasticBody<float>::frequency_bound(const float*, ThreadTeam&);
template double ElasticBody<double>::frequency_bound(const double*, ThreadTeam&);
template float ElasticBody<float>::damping_bound(const float*, ThreadTeam&);
template double ElasticBody<double>::damping_bound(const double*, ThreadTeam&);
template std::vector<float> ElasticBody<float>::element_bounds(const float*) const;
template std::vector<double> ElasticBody<double>::element_bounds(const double*) const;

}  // namespace heml
