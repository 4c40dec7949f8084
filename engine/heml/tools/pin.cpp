#include <algorithm>
#include <heml/tools/pin.hpp>

namespace heml {

template <class Real>
PinnedPatch pin_patch(int center, double radius, std::span<const int> nodes, const std::vector<Vec3>& rest,
                      const Real* x, const std::vector<Real>& inverse_mass) {
  PinnedPatch pin{center, {}, {}};
  const auto X = [&](int n) { return rest[static_cast<std::size_t>(n)]; };
  for (const int n : nodes) {
    if (inverse_mass[static_cast<std::size_t>(n)] == 0) continue;
    if (n != center && !((X(n) - X(center)).norm() <= radius && radius > 0)) continue;
    pin.nodes.push_back(n);
    pin.positions.push_back(Eigen::Map<const Vector3<Real>>(x + 3 * n).template cast<double>());
  }
  return pin;
}

template <class Real>
PinnedPatch pin_list(std::span<const int> nodes, const Real* x, const std::vector<Real>& inverse_mass) {
  PinnedPatch pin{-1, {}, {}};
  for (const int n : nodes) {
    if (inverse_mass[static_cast<std::size_t>(n)] == 0) continue;
    if (pin.nodes.empty()) pin.center = n;
    pin.nodes.push_back(n);
    pin.positions.push_back(Eigen::Map<const Vector3<Real>>(x + 3 * n).template cast<double>());
  }
  return pin;
}

bool take_nodes(PinnedPatch& pin, std::span<const int> nodes) {
  PinnedPatch rest{pin.center, {}, {}};
  for (std::size_t k = 0; k < pin.nodes.size(); ++k) {
    if (std::binary_search(nodes.begin(), nodes.end(), pin.nodes[k])) continue;
    rest.nodes.push_back(pin.nodes[k]);
    rest.positions.push_back(pin.positions[k]);
  }
  const bool any = rest.nodes.size() < pin.nodes.size();
  const bool has_center = std::find(rest.nodes.begin(), rest.nodes.end(), rest.center) != rest.nodes.end();
  if (!has_center && !rest.nodes.empty()) rest.center = rest.nodes.front();
  pin = std::move(rest);
  return any;
}

template <class Real>
Vec3 pin_force(const PinnedPatch& pin, const Real* f) {
  Vec3 sum = Vec3::Zero();
  for (const int n : pin.nodes) sum -= Vec3(Eigen::Map<const Vector3<Real>>(f + 3 * n).template cast<double>());
  return sum;
}

template PinnedPatch pin_patch(int, double, std::span<const int>, const std::vector<Vec3>&, const float*,
                               const std::vector<float>&);
template PinnedPatch pin_patch(int, double, std::span<const int>, const std::vector<Vec3>&, const double*,
                               const std::vector<double>&);
template PinnedPatch pin_list(std::span<const int>, const float*, const std::vector<float>&);
template PinnedPatch pin_list(std::span<const int>, const double*, const std::vector<double>&);
template Vec3 pin_force(const PinnedPatch&, const float*);
template Vec3 pin_force(const PinnedPatch&, const double*);

}  // namespace heml
