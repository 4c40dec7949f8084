// Forces at the nodes, and the kernels that evaluate them.
#include <algorithm>
#include <atomic>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/body.hpp>
#include <heml/elastic/viscoelastic_term.hpp>

namespace heml {
namespace {

/// Instruction set of the HEML_WIDE loops on this processor.
std::string_view wide_instructions() {
#if defined(__x86_64__)
  if (has_avx2()) return "avx2";
#endif
  return "portable";
}

}  // namespace

template <class Real>
void ElasticBody<Real>::gather_corners(const CornerMap& corners, Real* f, bool add, ThreadTeam& team) const {
  team.parallel_for(nodes(), grain_ / 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Real sum[3] = {0, 0, 0};
      for (std::size_t k = corners.start[n]; k < corners.start[n + 1]; ++k) {
        const Real* corner = &corner_[3 * corners.corners[k]];
        for (int i = 0; i < 3; ++i) sum[i] += corner[i];
      }
      for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] = add ? f[3 * n + i] + sum[i] : sum[i];
    }
  });
}

/// Of quadratic elements by loops over virtual corners, at which terms add up, into f; or added to it.
template <class Real>
bool ElasticBody<Real>::virtual_corner_forces(const Real* x, Real* f, bool add, ThreadTeam& team) {
  const VirtualCorners<Real>& corners = *layout_->virtual_corners;
  const Real* y = inner_positions(x, team);
  Real* corner = corner_forces().data();
  Real* of_element = nodal_forces();
  std::atomic<bool> valid{true};
  const auto note = [&](bool defined) {
    if (!defined) valid.store(false, std::memory_order_relaxed);
  };
  for (const Part& part : parts_) {
    const ElementGroup<Real>& group = *part.group;
    if (part.in_points()) {  // whose kernels have all of it
      for (std::size_t s = 0; s < group.size(); s += element_points)
        std::fill_n(of_element + 30 * element_at(group, s), 30, Real(0));
      continue;
    }
    for (std::size_t k = 0; k < part.terms.size(); ++k)
      team.parallel_for(group.packets(), grain_ / group.lanes, [&](std::size_t begin, std::size_t end) {
        note(part.terms[k]->forces(group, y, begin, end, corner, k > 0));
      });
    if (part.dilatation)
      team.parallel_for(group.packets(), grain_ / 4 / group.lanes, [&](std::size_t begin, std::size_t end) {
        note(part.dilatation->add_forces(group, y, begin, end, corner));
      });
    corners.at_nodes(group, corner_, of_element, team);
  }
  corners.sum(of_element, f, add, team);
  return valid;
}

/// Volume term, active stress, and the state of viscosity and relaxation, whose next one is written by kernels.
template <class Real>
PointTerms<Real> ElasticBody<Real>::Part::terms_of_points() const {
  PointTerms<Real> result = points.terms;
  if (points.kappa_field) result.kappa_of = group->parameters[*points.kappa_field].data();
  if (memory) memory->put_in_points(result);
  if (active) result.active = active->stress();
  if (flow) result.mises = flow->mises_stress();
  return result;
}

template <class Real>
bool ElasticBody<Real>::points_remember() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& part) { return part.in_points() && (part.memory || part.flow); });
}

/// Of quadratic elements: point kernels, or loops over virtual corners where a material has none.
template <class Real>
bool ElasticBody<Real>::quadratic_forces(const Real* x, Real* f, ThreadTeam& team) {
  const PointLayout& points = layout_->joints.points;
  std::vector<PointTerms<Real>> terms;
  for (const Part& part : parts_) terms.push_back(part.in_points() ? part.terms_of_points() : PointTerms<Real>());
  if (points_remember()) {
    evaluated_x_.assign(x, x + 3 * nodes());
    evaluated_ = true;
  }
  std::atomic<bool> valid{true};
  shared_force_.resize(3 * points.nodes.shared_slots);
  team.parallel_for(points.blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const Part& part = parts_[points.blocks[b].part];
      const PointTerms<Real> of_part = of_block(terms[points.blocks[b].part], points.blocks[b]);
      const PointBlock<Real> block =
          point_block<Real>(*part.group, points, b, part.points.parameters,
                            part.dilatation ? part.dilatation->kappa() : nullptr, shared_force_.data());
      if (!part.points.kernel(part.points.law.get(), block, of_part, x, f))
        valid.store(false, std::memory_order_relaxed);
    }
  });
  const bool has_points = !points.blocks.empty();
  if (has_points) points.nodes.template sum_shared<3>(shared_force_.data(), f, team);
  const bool has_loops = std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return !part.in_points(); });
  if (has_loops && !virtual_corner_forces(x, f, has_points, team)) valid = false;
  return valid;
}

template <class Real>
bool ElasticBody<Real>::forces(const Real* x, Real* f, ThreadTeam& team) {
  if (layout_->virtual_corners) return quadratic_forces(x, f, team);
  std::atomic<bool> valid{true};
  const bool pressure_in_fans = this->pressure_in_fans(), loops_for_pressure = pressure_ && !pressure_in_fans;
  const Real* pressure = nullptr;
  if (pressure_in_fans) {
    node_volume_.resize(nodes());
    fans_.node_volumes(x, node_volume_.data(), team);
    pressure = pressure_->at_volumes(node_volume_, team);
    if (!pressure_->is_defined()) valid = false;
  }
  if (fans_.needs_state()) fans_.read_state(fan_slots());
  std::size_t in_fans = 0;
  for (const Part& part : parts_)
    if (part.in_fans) fans_.set_active_stress(in_fans++, part.active ? part.active->stress() : Real(0));
  if (!fans_.empty() && !fans_.forces(x, f, team, pressure)) valid = false;
  const bool has_loops = !layout_->joints.force_corners.corners.empty();
  Real* corner = has_loops ? corner_forces().data() : nullptr;
  for (const Part& part : parts_) {
    const std::size_t first = part.first_loop(), corners = part.group->first_corner;
    for (std::size_t k = first; k < part.terms.size(); ++k)
      team.parallel_for(part.group->packets(), grain_ / part.group->lanes, [&](std::size_t begin, std::size_t end) {
        if (!part.terms[k]->forces(*part.group, x, begin, end, corner, k > first))
          valid.store(false, std::memory_order_relaxed);
      });
    if (loops_for_pressure && part.terms.size() == first)  // no term has written these corners
      std::fill_n(corner + 3 * corners, 12 * part.group->volume.size(), Real(0));
  }
  if (loops_for_pressure && !pressure_->add_forces(x, corner, team)) valid = false;
  if (fans_.empty() || !layout_->joints.force_corners.corners.empty())
    gather_corners(layout_->joints.force_corners, f, !fans_.empty(), team);
  if (!layout_->joints.springs.empty()) layout_->joints.springs.add_forces(x, f, team);
  return valid;
}

template <class Real>
std::vector<KernelInfo> ElasticBody<Real>::kernels() const {
  // Bytes per element and term of the loops: constants and nodes, corner forces written and gathered, positions and
  // forces.
  const double corners = 4 * sizeof(int) + 7 * sizeof(Real) + 4 * (6 * sizeof(Real) + sizeof(std::size_t)) +
                         static_cast<double>(6 * sizeof(Real) * nodes()) / static_cast<double>(elements());
  // The same a point of point kernels, which write and gather ten nodes for four points.
  const double of_points = 2.5 * sizeof(int) + 7 * sizeof(Real) + 2.5 * (6 * sizeof(Real) + sizeof(std::size_t)) +
                           static_cast<double>(6 * sizeof(Real) * nodes()) / static_cast<double>(4 * elements());
  std::vector<KernelInfo> result;
  std::size_t part_in_fans = 0;
  for (const Part& part : parts_) {
    const Material& material = materials_[part.material];
    KernelInfo info{part.material, material.law, "corners", "portable", part.group->size(), 0};
    if (part.terms.empty()) {
      info.kernel = "springs";
    } else {
      const bool has_loops = part.has_loops(options_.nodal_pressure && !pressure_in_fans());
      if (part.in_fans) {
        info.kernel = has_loops ? "fans and corners" : "fans";
        info.instructions = name_of(fans_.instruction_set());
        info.bytes_per_tet = fans_.bytes_per_tet(part_in_fans++);
      } else {
        info.instructions = part.in_points() ? name_of(part.points.instruction_set) : wide_instructions();
      }
      if (part.points.law) info.kernel = "points";
      info.bytes_per_tet +=
          (part.in_points() ? of_points : 0) + corners * static_cast<double>(part.terms.size() - part.first_loop());
      if (part.in_points() && part.memory)
        info.bytes_per_tet += static_cast<double>(2 * sizeof(Real) * part.memory->numbers_a_slot());
      info.elements /= points_per_element();
      info.bytes_per_tet *= static_cast<double>(points_per_element());
    }
    result.push_back(std::move(info));
  }
  return result;
}

template void ElasticBody<float>::gather_corners(const CornerMap&, float*, bool, ThreadTeam&) const;
template void ElasticBody<double>::gather_corners(const CornerMap&, double*, bool, ThreadTeam&) const;
template bool ElasticBody<float>::forces(const float*, float*, ThreadTeam&);
template bool ElasticBody<double>::forces(const double*, double*, ThreadTeam&);
template std::vector<KernelInfo> ElasticBody<float>::kernels() const;
template std::vector<KernelInfo> ElasticBody<double>::kernels() const;

}  // namespace heml
