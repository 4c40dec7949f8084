// Bounds of the eigenvalues of stiffness and damping.
#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <mutex>

namespace heml {

/// Maximum over the packets of the sum of the bounds of their terms.
template <class Real>
template <class Bound>
Real ElasticBody<Real>::max_bound(ThreadTeam& team, PacketBounds<Real>& packets, int steps, const Bound& bound) const {
  std::size_t count = 0, first = 0;
  for (const Part& part : parts_) count += part.group->packets();
  packets.begin(count, steps);
  auto due = packets.due().begin();
  for (const Part& part : parts_) {
    const std::size_t end = first + part.group->packets();
    const auto due_end = std::lower_bound(due, packets.due().end(), static_cast<int>(end));
    team.parallel_for(static_cast<std::size_t>(due_end - due), grain_ / 8 / part.group->lanes,
                      [&](std::size_t begin, std::size_t last) {
                        for (auto k = due + static_cast<long>(begin); k < due + static_cast<long>(last); ++k) {
                          const auto packet = static_cast<std::size_t>(*k) - first;
                          Real sum = 0;
                          for (const auto& term : part.terms) sum += bound(*term, *part.group, packet, packet + 1);
                          packets.set(static_cast<std::size_t>(*k), sum);
                        }
                      });
    due = due_end;
    first = end;
  }
  return packets.end();
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team) {
  PacketBounds<Real> all;
  return frequency_bound(x, team, all, 0);
}

template <class Real>
Real ElasticBody<Real>::damping_bound(const Real* x, ThreadTeam& team) {
  PacketBounds<Real> all;
  return damping_bound(x, team, all, 0);
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team, PacketBounds<Real>& packets, int steps) {
  x = inner_positions(x, team);
  Real bound =
      max_bound(team, packets, steps, [x](const auto& term, const auto& group, std::size_t begin, std::size_t end) {
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
Real ElasticBody<Real>::damping_bound(const Real* x, ThreadTeam& team, PacketBounds<Real>& packets, int steps) {
  if (!has_internal_state()) return 0;
  x = inner_positions(x, team);
  return max_bound(team, packets, steps, [x](const auto& term, const auto& group, std::size_t begin, std::size_t end) {
    return term.damping_bound(group, x, begin, end);
  });
}

template <class Real>
std::vector<int> ElasticBody<Real>::packets_near(const Vec3& place, double radius) const {
  std::vector<int> near;
  int first = 0;
  for (const Part& part : parts_) {
    const ElementGroup<Real>& group = *part.group;
    for (std::size_t p = 0; p < group.packets(); ++p) {
      bool is_near = false;
      for (const auto& nodes : group.node)
        for (std::size_t s = p * group.lanes; s < (p + 1) * group.lanes; ++s)
          is_near |= (layout_->mesh.nodes[static_cast<std::size_t>(nodes[s])] - place).squaredNorm() <= radius * radius;
      if (is_near) near.push_back(first + static_cast<int>(p));
    }
    first += static_cast<int>(group.packets());
  }
  return near;
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

template float ElasticBody<float>::frequency_bound(const float*, ThreadTeam&);
template float ElasticBody<float>::frequency_bound(const float*, ThreadTeam&, PacketBounds<float>&, int);
template double ElasticBody<double>::frequency_bound(const double*, ThreadTeam&);
template double ElasticBody<double>::frequency_bound(const double*, ThreadTeam&, PacketBounds<double>&, int);
template float ElasticBody<float>::damping_bound(const float*, ThreadTeam&);
template float ElasticBody<float>::damping_bound(const float*, ThreadTeam&, PacketBounds<float>&, int);
template std::vector<int> ElasticBody<float>::packets_near(const Vec3&, double) const;
template double ElasticBody<double>::damping_bound(const double*, ThreadTeam&);
template double ElasticBody<double>::damping_bound(const double*, ThreadTeam&, PacketBounds<double>&, int);
template std::vector<int> ElasticBody<double>::packets_near(const Vec3&, double) const;
template std::vector<float> ElasticBody<float>::element_bounds(const float*) const;
template std::vector<double> ElasticBody<double>::element_bounds(const double*) const;

}  // namespace heml
