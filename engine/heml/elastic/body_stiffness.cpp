// The stiffness K: its evaluation, projection and products.
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
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = parts_[p];
    part.stiffness.resize(edge_entries * part.group->volume.size());
    for (std::size_t k = 0; k < part.terms.size(); ++k)
      team.parallel_for(part.group->packets(), grain_ / 4 / part.group->lanes, [&](std::size_t begin, std::size_t end) {
        part.terms[k]->stiffness(*part.group, x, begin, end, Real(1), part.stiffness.data(), k > 0);
      });
    if (part.flows_within_steps)
      team.parallel_for(part.group->packets(), grain_ / 16 / part.group->lanes,
                        [&](std::size_t begin, std::size_t end) {
                          part.flow->add_stiffness(*part.group, x, begin, end, part.stiffness.data());
                        });
    if (pressure_)
      team.parallel_for(part.group->packets(), grain_ / 4 / part.group->lanes, [&](std::size_t begin, std::size_t end) {
        pressure_->linearise_group(p, x, begin, end, part.stiffness.data());
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
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Part& part = parts_[p];
    if (part.dilatation) part.dilatation->project();
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
          if (pressure_) sum.wJ += pressure_->pressure(p, s);
          clamp_tension(sum, kinematics, rest, k);
        }
        write_edge_stiffness(k, s, part.stiffness.data(), false);
      }
    });
  }
}

template <class Real>
void ElasticBody<Real>::force_differential(const Real* at_nodes, Real* out, ThreadTeam& team) {
  const Real* dx = inner_positions(at_nodes, team);
  Real* corner = corner_forces().data();
  for (const Part& part : parts_)
    team.parallel_for(part.group->packets(), grain_ / part.group->lanes, [&](std::size_t begin, std::size_t end) {
      multiply_stiffness(part.stiffness.data(), *part.group, dx, begin, end, corner);
    });
  if (layout_->virtual_corners) {
    const VirtualCorners<Real>& corners = *layout_->virtual_corners;
    Real* of_element = nodal_forces();
    for (const Part& part : parts_) corners.at_nodes(*part.group, corner_, of_element, team);
    each_dilatation(team, [&](const Part& part, std::size_t begin, std::size_t end) {
      part.dilatation->add_force_differential(*part.group, corners, at_nodes, begin, end, of_element);
    });
    return corners.sum(of_element, out, false, team);
  }
  if (pressure_) pressure_->add_force_differential(dx, corner, team);
  gather_corners(layout_->joints.corners, out, false, team);
  if (!layout_->joints.springs.empty())
    layout_->joints.springs.add_force_differential(linearisation_point_.data(), dx, out, projected_, team);
}

template <class Real>
bool ElasticBody<Real>::assemble(BsrMatrix& rows, ThreadTeam& team) const {
  if (pressure_) return false;
  rows.begin_elements(team);
  for (const Part& part : parts_)
    if (!part.terms.empty())
      rows.add_elements(part.stiffness.data(), *part.group, team,
                        part.dilatation ? part.dilatation->outer_products() : nullptr);
  rows.end_elements(team);
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
  if (pressure_) pressure_->add_stiffness(p, s, k);
  expand_edges(k, K);
}

/// Σ_q BᵀKB over the points of an element.
template <class Real>
void ElasticBody<Real>::quadratic_stiffness(std::size_t p, std::size_t first_slot, QuadraticMatrix<Real>& K) const {
  if (const Part& part = parts_[p]; part.dilatation) part.dilatation->add_stiffness(first_slot, K);
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

template void ElasticBody<float>::linearise(const float*, ThreadTeam&);
template void ElasticBody<double>::linearise(const double*, ThreadTeam&);
template void ElasticBody<float>::project(Projection, ThreadTeam&);
template void ElasticBody<double>::project(Projection, ThreadTeam&);
template void ElasticBody<float>::force_differential(const float*, float*, ThreadTeam&);
template void ElasticBody<double>::force_differential(const double*, double*, ThreadTeam&);
template bool ElasticBody<float>::assemble(BsrMatrix&, ThreadTeam&) const;
template bool ElasticBody<double>::assemble(BsrMatrix&, ThreadTeam&) const;
template void ElasticBody<float>::element_stiffness(std::size_t, std::size_t, ElementMatrix<float>&) const;
template void ElasticBody<double>::element_stiffness(std::size_t, std::size_t, ElementMatrix<double>&) const;
template void ElasticBody<float>::quadratic_stiffness(std::size_t, std::size_t, QuadraticMatrix<float>&) const;
template void ElasticBody<double>::quadratic_stiffness(std::size_t, std::size_t, QuadraticMatrix<double>&) const;

}  // namespace heml
