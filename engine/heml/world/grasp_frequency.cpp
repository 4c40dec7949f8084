#include <algorithm>
#include <cmath>
#include <heml/materials/material.hpp>
#include <heml/world/grasp_frequency.hpp>

namespace heml {
namespace {

constexpr double share_of_highest = 0.25;  // of the body's frequencies
constexpr double min_radius = 0.005;       // m, of the patch that sets the frequency

std::vector<bool> nodes_in_patch(const TetMesh& mesh, int center, double radius, const std::vector<int>& nodes) {
  std::vector<bool> in_patch(mesh.nodes.size(), false);
  const Vec3& middle = mesh.nodes[static_cast<std::size_t>(center)];
  for (const int n : nodes)
    in_patch[static_cast<std::size_t>(n)] = (mesh.nodes[static_cast<std::size_t>(n)] - middle).norm() < radius;
  in_patch[static_cast<std::size_t>(center)] = true;
  return in_patch;
}

/// Which entries of `materials` the elements have that have one of the nodes.
template <class Real>
std::vector<bool> materials_round(const std::vector<bool>& is_node, const Simulation<Real>& s) {
  const auto has_node = [&](const auto& element) {
    return std::any_of(element.begin(), element.end(), [&](int n) { return is_node[static_cast<std::size_t>(n)]; });
  };
  const Model<Real>& model = *s.model;
  std::vector<bool> is_there(s.setup->materials.size(), false);
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
    if (has_node(model.mesh.tets[t]) || (!model.midedges.empty() && has_node(model.midedges[t])))
      is_there[static_cast<std::size_t>(model.material_of[t])] = true;
  return is_there;
}

}  // namespace

template <class Real>
double grasp_frequency(const Simulation<Real>& s, int center, double radius, const std::vector<int>& nodes) {
  const std::vector<bool> is_held = materials_round(nodes_in_patch(s.model->mesh, center, radius, nodes), s);
  double speed = 0;  // of shear waves, m/s
  for (std::size_t m = 0; m < is_held.size(); ++m) {
    const Material& material = s.setup->materials[m].material;
    if (is_held[m]) speed = std::max(speed, std::sqrt(small_strain_moduli(material).shear / material.density));
  }
  const double highest = share_of_highest * static_cast<double>(s.rest_frequency);
  if (speed == 0) return highest;  // a net of springs: no continuum to ask
  return std::min(2 * speed / std::max(radius, min_radius), highest);
}

template double grasp_frequency(const Simulation<float>&, int, double, const std::vector<int>&);
template double grasp_frequency(const Simulation<double>&, int, double, const std::vector<int>&);

}  // namespace heml
