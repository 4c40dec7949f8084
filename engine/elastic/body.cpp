#include <algorithm>
#include <atomic>
#include <cmath>
#include <heml/elastic/body.hpp>

namespace heml {

template <class Real>
ElasticBody<Real>::ElasticBody(const TetMesh& mesh, const std::vector<int>& material_of,
                               const std::vector<Material>& materials, bool continuation)
    : continuation_(continuation) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    std::vector<int> elements;
    for (std::size_t t = 0; t < material_of.size(); ++t)
      if (material_of[t] == static_cast<int>(m)) elements.push_back(static_cast<int>(t));
    if (elements.empty()) continue;
    parts_.push_back({m, make_group<Real>(mesh, elements), make_group_law<Real>(materials[m], continuation)});
    parts_.back().group.density = static_cast<Real>(materials[m].density);
  }
  std::vector<ElementGroup<Real>*> groups;
  for (Part& part : parts_) groups.push_back(&part.group);
  corners_ = map_corners(groups, mesh.nodes.size());
  corner_.assign(3 * corner_count(groups), Real(0));
}

template <class Real>
bool ElasticBody<Real>::forces(const Real* x, Real* f, ThreadTeam& team) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  std::atomic<bool> valid{true};
  for (const Part& part : parts_)
    team.for_ranges(part.group.packets(), grain_ / lanes, [&](std::size_t begin, std::size_t end) {
      if (!part.law->forces(part.group, x, begin, end, corner_.data())) valid.store(false, std::memory_order_relaxed);
    });
  team.for_ranges(nodes(), grain_ / 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Real sum[3] = {0, 0, 0};
      for (std::size_t k = corners_.start[n]; k < corners_.start[n + 1]; ++k) {
        const Real* corner = &corner_[3 * corners_.corners[k]];
        for (int i = 0; i < 3; ++i) sum[i] += corner[i];
      }
      for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] = sum[i];
    }
  });
  return valid;
}

template <class Real>
double ElasticBody<Real>::energy(const Real* x) const {
  double sum = 0;
  for (const Part& part : parts_) sum += part.law->energy(part.group, x);
  return sum;
}

template <class Real>
Real ElasticBody<Real>::frequency_bound(const Real* x, ThreadTeam& team) {
  Real largest = 0;
  std::mutex mutex;  // a maximum does not depend on the order it is taken in
  for (const Part& part : parts_)
    team.for_ranges(part.group.packets(), grain_ / ElementGroup<Real>::lanes, [&](std::size_t begin, std::size_t end) {
      const Real bound = part.law->frequency_bound(part.group, x, begin, end);
      std::lock_guard lock(mutex);
      largest = bound > largest || std::isnan(bound) ? bound : largest;
    });
  return largest;
}

template <class Real>
int ElasticBody<Real>::first_invalid(const Real* x) const {
  int first = -1;
  for (const Part& part : parts_) {
    const std::size_t s = part.law->first_invalid(part.group, x);
    if (s < part.group.size() && (first < 0 || part.group.element[s] < first)) first = part.group.element[s];
  }
  return first;
}

template <class Real>
void ElasticBody<Real>::states(const Real* x, std::vector<ElementState<Real>>& out) const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.group.size();
  out.resize(count);
  std::vector<ElementState<Real>> of_part;
  for (const Part& part : parts_) {
    of_part.resize(part.group.size());
    part.law->states(part.group, x, of_part.data());
    for (std::size_t s = 0; s < of_part.size(); ++s) out[static_cast<std::size_t>(part.group.element[s])] = of_part[s];
  }
}

template <class Real>
void ElasticBody<Real>::set_material(std::size_t index, const Material& material) {
  for (Part& part : parts_)
    if (part.material == index) {
      part.law = make_group_law<Real>(material, continuation_);
      part.group.density = static_cast<Real>(material.density);
    }
}

template <class Real>
std::vector<Real> ElasticBody<Real>::masses() const {
  std::vector<double> mass(nodes(), 0.0);
  for (const Part& part : parts_)
    for (std::size_t s = 0; s < part.group.size(); ++s)
      for (const auto& list : part.group.node)
        mass[static_cast<std::size_t>(list[s])] +=
            static_cast<double>(part.group.density) * static_cast<double>(part.group.volume[s]) / 4;
  return {mass.begin(), mass.end()};
}

template class ElasticBody<float>;
template class ElasticBody<double>;

}  // namespace heml
