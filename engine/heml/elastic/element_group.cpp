#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <heml/elastic/element_group.hpp>

namespace heml {

namespace {
const std::vector<double>& field_values(const TetMesh& mesh, const std::string& name, std::size_t components) {
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(), [&](const ElementField& field) {
    return field.name == name && field.components == components;
  });
  assert(found != mesh.fields.end());
  return found->values;
}
}  // namespace

template <class Real>
ElementGroup<Real> make_group(const TetMesh& mesh, const std::vector<int>& elements, const Material& material) {
  ElementGroup<Real> group;
  group.element = elements;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  const std::size_t padded = (elements.size() + lanes - 1) / lanes * lanes;
  for (auto& list : group.node) list.resize(padded);
  for (auto& list : group.A) list.resize(padded);
  group.volume.resize(padded);
  const bool has_fibre = find_law(material.law)->has_fibre || material.gives_fibre();
  if (has_fibre)
    for (auto& list : group.fibre) list.resize(padded);
  const std::vector<double>* directions =
      !material.fibre_field.empty() ? &field_values(mesh, material.fibre_field, 3) : nullptr;
  group.parameters.assign(material.fields.size(), std::vector<Real>(padded));
  for (std::size_t s = 0; s < padded; ++s) {
    const auto element = static_cast<std::size_t>(elements[std::min(s, elements.size() - 1)]);
    const Tet& tet = mesh.tets[element];
    std::array<Vec3, 4> X;
    for (std::size_t c = 0; c < 4; ++c) {
      group.node[c][s] = tet[c];
      X[c] = mesh.nodes[static_cast<std::size_t>(tet[c])];
    }
    Mat3 Dm;
    Dm << X[1] - X[0], X[2] - X[0], X[3] - X[0];
    const double scale = rest_scale(mesh, element);
    Dm *= scale;
    const Mat3 g = Dm.inverse();  // row a−1 is g_a, a = 1..3
    const Mat3 A = g * g.transpose();
    const double entries[6] = {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(0, 2), A(1, 2)};
    for (std::size_t i = 0; i < 6; ++i) group.A[i][s] = static_cast<Real>(entries[i]);
    if (has_fibre) {
      Vec3 fibre = material.fibre;
      if (directions) fibre = Eigen::Map<const Vec3>(&(*directions)[3 * element]).normalized();
      for (std::size_t i = 0; i < 3; ++i) group.fibre[i][s] = static_cast<Real>(g.row(static_cast<int>(i)).dot(fibre));
    }
    for (std::size_t k = 0; k < material.fields.size(); ++k)
      group.parameters[k][s] = static_cast<Real>(field_values(mesh, material.fields[k].field, 1)[element]);
    group.volume[s] = static_cast<Real>(scale * scale * scale * signed_volume(X[0], X[1], X[2], X[3]));
  }
  return group;
}

template <class Real>
void scale_rest_shape(ElementGroup<Real>& group, std::size_t s, Real factor) {
  for (auto& list : group.A) list[s] /= factor * factor;
  if (!group.fibre[0].empty())
    for (auto& list : group.fibre) list[s] /= factor;
  group.volume[s] *= factor * factor * factor;
}

template <class Real>
std::vector<std::size_t> keep_slots(ElementGroup<Real>& group, const std::vector<std::size_t>& slots) {
  gather_slots(group.element, slots);
  std::vector<std::size_t> from = slots;
  while (from.size() % ElementGroup<Real>::lanes != 0) from.push_back(slots.back());
  for (auto& list : group.node) gather_slots(list, from);
  for (auto& list : group.A) gather_slots(list, from);
  gather_slots(group.volume, from);
  if (!group.fibre[0].empty())
    for (auto& list : group.fibre) gather_slots(list, from);
  for (auto& list : group.parameters) gather_slots(list, from);
  return from;
}

template <class Real>
CornerMap map_corners(const std::vector<const ElementGroup<Real>*>& groups, std::size_t nodes) {
  CornerMap map;
  map.start.assign(nodes + 1, 0);
  for (const auto* group : groups)
    for (std::size_t s = 0; s < group->size(); ++s)
      for (const auto& list : group->node) ++map.start[static_cast<std::size_t>(list[s]) + 1];
  for (std::size_t n = 0; n < nodes; ++n) map.start[n + 1] += map.start[n];
  map.corners.resize(map.start[nodes]);
  std::vector<std::size_t> fill(map.start.begin(), map.start.end() - 1);
  for (const auto* group : groups)
    for (std::size_t s = 0; s < group->size(); ++s)
      for (std::size_t c = 0; c < 4; ++c)
        map.corners[fill[static_cast<std::size_t>(group->node[c][s])]++] = group->first_corner + 4 * s + c;
  return map;
}

template struct ElementGroup<float>;
template struct ElementGroup<double>;
template ElementGroup<float> make_group(const TetMesh&, const std::vector<int>&, const Material&);
template ElementGroup<double> make_group(const TetMesh&, const std::vector<int>&, const Material&);
template void scale_rest_shape(ElementGroup<float>&, std::size_t, float);
template void scale_rest_shape(ElementGroup<double>&, std::size_t, double);
template std::vector<std::size_t> keep_slots(ElementGroup<float>&, const std::vector<std::size_t>&);
template std::vector<std::size_t> keep_slots(ElementGroup<double>&, const std::vector<std::size_t>&);
template CornerMap map_corners(const std::vector<const ElementGroup<float>*>&, std::size_t);
template CornerMap map_corners(const std::vector<const ElementGroup<double>*>&, std::size_t);

}  // namespace heml
