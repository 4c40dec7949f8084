// Edits of an existing body: other meshes and materials, removed and divided elements.
#include <algorithm>
#include <cassert>
#include <heml/elastic/body.hpp>
#include <heml/elastic/viscoelastic_term.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

std::array<Vec3, 4> places(const TetMesh& mesh, int element) {
  std::array<Vec3, 4> X;
  for (std::size_t c = 0; c < 4; ++c)
    X[c] = mesh.nodes[static_cast<std::size_t>(mesh.tets[static_cast<std::size_t>(element)][c])];
  return X;
}

std::array<Vec3, element_points> point_places(const TetMesh& mesh, const std::array<int, 10>& nodes) {
  std::array<Vec3, element_points> X;
  for (std::size_t q = 0; q < element_points; ++q) {
    X[q].setZero();
    const std::array<double, 10> N = shape_functions(point_place(q));
    for (std::size_t a = 0; a < 10; ++a) X[q] += N[a] * mesh.nodes[static_cast<std::size_t>(nodes[a])];
  }
  return X;
}

/// The point that each point of a quadratic element's piece inherits from: the nearest at rest. A mean of several would
/// be no state that the material can have: plastic flow would not keep the volume.
std::array<std::size_t, element_points> nearest_points(const TetMesh& mesh, const std::array<int, 10>& piece,
                                                       const std::array<int, 10>& whole) {
  const auto of_piece = point_places(mesh, piece), of_whole = point_places(mesh, whole);
  std::array<std::size_t, element_points> nearest{};
  for (std::size_t q = 0; q < element_points; ++q)
    for (std::size_t p = 1; p < element_points; ++p)
      if ((of_whole[p] - of_piece[q]).norm() < (of_whole[nearest[q]] - of_piece[q]).norm()) nearest[q] = p;
  return nearest;
}

/// Appends the slots of further elements.
template <class Real>
void append(const ElementGroup<Real>& more, ElementGroup<Real>& group) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  const std::size_t before = group.size();
  group.element.insert(group.element.end(), more.element.begin(), more.element.end());
  const auto add = [&](auto& list, const auto& from) {
    if (from.empty()) return;
    list.resize(before);  // without padding
    list.insert(list.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(more.size()));
    const auto last = list.back();
    list.resize((list.size() + lanes - 1) / lanes * lanes, last);
  };
  for (std::size_t i = 0; i < group.node.size(); ++i) add(group.node[i], more.node[i]);
  for (std::size_t i = 0; i < group.A.size(); ++i) add(group.A[i], more.A[i]);
  add(group.volume, more.volume);
  for (std::size_t i = 0; i < group.fibre.size(); ++i) add(group.fibre[i], more.fibre[i]);
  for (std::size_t i = 0; i < group.parameters.size(); ++i) add(group.parameters[i], more.parameters[i]);
}

}  // namespace

template <class Real>
void ElasticBody<Real>::set_mesh(const TetMesh& mesh, const std::vector<int>& material_of) {
  assert(!layout_->virtual_corners);
  set_elements(mesh, material_of, {});
  make_parts();
  make_fans();
  reset_history(at_rest().data());
}

template <class Real>
void ElasticBody<Real>::set_material(std::size_t index, const Material& material, const Real* x) {
  update_slots();
  fans_.forget_state();
  const Material before = std::exchange(materials_[index], material);
  std::vector<Real> y;
  x = inner_positions(x, y);
  for (Part& part : parts_) {
    if (part.material != index) continue;
    part = remake_part(index, before, part.group_at_rest());
    part.reset_history(x);
  }
  join_parts();
  if (!fans_.update_laws(fan_parts(), options_.continuation)) make_fans();
}

template <class Real>
void ElasticBody<Real>::set_material_of(const std::vector<Material>& materials, const std::vector<int>& material_of,
                                        const Real* x) {
  update_slots();
  const std::vector<int> before = layout_->material_of;
  std::vector<int> now;
  for (const int material : material_of) now.insert(now.end(), points_per_element(), material);
  layout_.write().material_of = std::move(now);
  materials_ = materials;
  std::vector<int> same(before.size());
  std::iota(same.begin(), same.end(), 0);
  std::vector<Real> y;
  x = inner_positions(x, y);
  const std::vector<Part> old_parts = std::exchange(parts_, {});
  make_parts();
  for (Part& part : parts_) {
    part.reset_history(x);
    const auto old = std::find_if(old_parts.begin(), old_parts.end(),
                                  [&](const Part& other) { return other.material == part.material; });
    const auto& elements = part.group->element;
    const bool gains = std::any_of(elements.begin(), elements.end(), [&](int element) {
      return before[static_cast<std::size_t>(element)] != static_cast<int>(part.material);
    });
    if (!gains && old != old_parts.end() && materials_[part.material].has_internal_state())
      transfer_slot_states(*old, layout_->mesh, same, {}, part);
  }
  step_weights_.reset();
  make_pressure();
  make_fans();
}

template <class Real>
void ElasticBody<Real>::set_burns(const std::vector<Burn>& burns) {
  update_slots();
  const Shared<BodyLayout<Real>> before = layout_;
  std::vector<Burn>& now = layout_.write().mesh.burns;
  now.clear();
  for (const Burn& burn : burns) now.insert(now.end(), points_per_element(), burn);
  bool changes = false;
  for (Part& part : parts_) {
    const std::size_t size = part.group->size();
    for (std::size_t s = 0; s < part.group->volume.size(); ++s) {
      const auto t = static_cast<std::size_t>(part.group->element[std::min(s, size - 1)]);
      const double factor = rest_scale(layout_->mesh, t) / rest_scale(before->mesh, t);
      if (factor == 1) continue;
      changes = true;
      scale_rest_shape(part.group.write(), s, static_cast<Real>(factor));
      if (part.flow) part.flow->scale_rest_shape(s, static_cast<Real>(factor));
    }
  }
  if (!changes) return make_pressure();  // which refers to the layout, written to above
  join_parts();
  std::vector<int> same(before->mesh.tets.size());
  std::iota(same.begin(), same.end(), 0);
  update_fans(before->mesh, same);
}

/// Renumbers the elements of a part and drops the removed ones. number: new number of each old element, −1 if removed.
template <class Real>
void ElasticBody<Real>::keep_numbered(Part& part, const std::vector<int>& number) {
  std::vector<std::size_t> slots;
  ElementGroup<Real>& group = part.group.write();
  for (std::size_t s = 0; s < group.size(); ++s) {
    int& element = group.element[s];
    element = number[static_cast<std::size_t>(element)];
    if (element >= 0) slots.push_back(s);
  }
  if (slots.size() == group.size()) return;
  if (slots.empty()) {
    group = {};
    group.density = static_cast<Real>(materials_[part.material].density);
    group.parameters.resize(materials_[part.material].fields.size());
    return;
  }
  const std::vector<std::size_t> from = keep_slots(group, slots);
  for (const auto& term : part.terms)
    for (const SlotState<Real>& state : term->slot_states()) gather_slots(*state.values, from, state.each);
  if (part.flow) part.flow->gather_slots(from);
}

template <class Real>
void ElasticBody<Real>::keep_elements(const std::vector<int>& elements) {
  assert(!layout_->virtual_corners);
  update_slots();
  std::vector<int> number(layout_->mesh.tets.size(), -1);
  for (std::size_t k = 0; k < elements.size(); ++k) number[static_cast<std::size_t>(elements[k])] = static_cast<int>(k);
  for (Part& part : parts_) keep_numbered(part, number);
  std::erase_if(parts_, [](const Part& part) { return part.group->size() == 0; });
  const Shared<BodyLayout<Real>> before = layout_;
  BodyLayout<Real> left;
  left.mesh = with_elements(before->mesh, elements);
  left.material_of = with_elements(before->material_of, elements);
  layout_ = std::move(left);
  join_parts();
  update_fans(before->mesh, elements);
}

/// Parts with internal state, and those of quadratic elements, are rebuilt and inherit it from the old part; the others
/// keep the slots of unchanged elements.
template <class Real>
void ElasticBody<Real>::transfer_state(const TetMesh& mesh, const std::vector<int>& material_of,
                                       const std::vector<int>& element_origins, const MidEdges& midedges,
                                       const Real* x) {
  assert(midedges.empty() == !layout_->virtual_corners);
  update_slots();
  const Shared<BodyLayout<Real>> old_layout = layout_;
  const TetMesh& before = old_layout->mesh;
  const auto& whole = old_layout->virtual_corners;
  std::vector<Part> old_parts = std::exchange(parts_, {});
  set_elements(mesh, material_of, midedges);
  PointsInEdit points;
  std::vector<int> origins = element_origins;
  if (whole) {
    points = {{}, whole->positions(x), layout_->virtual_corners->positions(x)};
    origins = point_origins(mesh, *whole, element_origins, points.is_of_piece);
  }
  std::vector<int> number(before.tets.size(), -1);
  std::vector<std::vector<int>> all(materials_.size()), pieces(materials_.size());
  for (std::size_t t = 0; t < layout_->mesh.tets.size(); ++t) {
    const auto origin = static_cast<std::size_t>(origins[t]),
               material = static_cast<std::size_t>(layout_->material_of[t]);
    all[material].push_back(static_cast<int>(t));
    if (layout_->mesh.tets[t] == before.tets[origin])
      number[origin] = static_cast<int>(t);
    else
      pieces[material].push_back(static_cast<int>(t));
  }
  for (Part& old : old_parts) {
    const std::size_t material = old.material;
    if (all[material].empty()) continue;
    if (materials_[material].has_internal_state() || layout_->virtual_corners) {
      parts_.push_back(make_part(material, all[material]));
      transfer_slot_states(old, before, origins, points, parts_.back());
      continue;
    }
    keep_numbered(old, number);
    if (!pieces[material].empty())
      append(make_group<Real>(layout_->mesh, pieces[material], materials_[material]), old.group.write());
    if (old.group->size() > 0) parts_.push_back(std::move(old));
  }
  join_parts();
  update_fans(before, origins);
}

/// The point of the mesh before that each integration point inherits from; says which are of pieces.
template <class Real>
std::vector<int> ElasticBody<Real>::point_origins(const TetMesh& mesh, const VirtualCorners<Real>& whole,
                                                  const std::vector<int>& element_origins,
                                                  std::vector<bool>& is_of_piece) const {
  std::vector<int> origins;
  for (std::size_t t = 0; t < element_origins.size(); ++t) {
    const auto &nodes = layout_->virtual_corners->nodes_of(t),
               &of_whole = whole.nodes_of(static_cast<std::size_t>(element_origins[t]));
    const bool is_piece = nodes != of_whole;
    std::array<std::size_t, element_points> from{0, 1, 2, 3};
    if (is_piece) from = nearest_points(mesh, nodes, of_whole);
    for (const std::size_t q : from)
      origins.push_back(static_cast<int>(element_points) * element_origins[t] + static_cast<int>(q));
    is_of_piece.insert(is_of_piece.end(), element_points, is_piece);
  }
  return origins;
}

template <class Real>
void ElasticBody<Real>::transfer_slot_states(const Part& old, const TetMesh& before, const std::vector<int>& origins,
                                             const PointsInEdit& points, Part& part) const {
  std::vector<std::size_t> slot(before.tets.size());
  for (std::size_t s = 0; s < old.group->size(); ++s) slot[static_cast<std::size_t>(old.group->element[s])] = s;
  std::vector<std::size_t> from, of_pieces;
  std::vector<SubelementMap<Real>> subelement_maps;
  for (std::size_t s = 0; s < part.group->volume.size(); ++s) {
    const int element = part.group->element[std::min(s, part.group->size() - 1)];
    const int origin = origins[static_cast<std::size_t>(element)];
    from.push_back(slot[static_cast<std::size_t>(origin)]);
    subelement_maps.emplace_back(places(before, origin), places(layout_->mesh, element));
    if (!points.is_of_piece.empty() && points.is_of_piece[static_cast<std::size_t>(element)]) of_pieces.push_back(s);
  }
  if (part.flow) part.flow->transfer_state(*old.flow, *old.group, from, subelement_maps, part.group.write());
  for (std::size_t k = 0; k < part.terms.size(); ++k) {
    const SlotStates<Real> to = part.terms[k]->slot_states(), whole = old.terms[k]->slot_states();
    for (std::size_t list = 0; list < to.size(); ++list) {
      *to[list].values = *whole[list].values;
      gather_slots(*to[list].values, from, to[list].each);
    }
    auto* memory = of_pieces.empty() ? nullptr : dynamic_cast<ViscoelasticTerm<Real>*>(part.terms[k].get());
    for (const std::size_t s : memory ? of_pieces : std::vector<std::size_t>())
      memory->add_present(*old.group, from[s], points.before.data(), Real(-1), memory->state_of(s));
    part.terms[k]->reshape(subelement_maps);
    for (const std::size_t s : memory ? of_pieces : std::vector<std::size_t>())
      memory->add_present(*part.group, s, points.after.data(), Real(1), memory->state_of(s));
  }
}

template void ElasticBody<float>::set_mesh(const TetMesh&, const std::vector<int>&);
template void ElasticBody<double>::set_mesh(const TetMesh&, const std::vector<int>&);
template void ElasticBody<float>::set_material(std::size_t, const Material&, const float*);
template void ElasticBody<double>::set_material(std::size_t, const Material&, const double*);
template void ElasticBody<float>::set_material_of(const std::vector<Material>&, const std::vector<int>&, const float*);
template void ElasticBody<double>::set_material_of(const std::vector<Material>&, const std::vector<int>&,
                                                   const double*);
template void ElasticBody<float>::set_burns(const std::vector<Burn>&);
template void ElasticBody<double>::set_burns(const std::vector<Burn>&);
template void ElasticBody<float>::keep_elements(const std::vector<int>&);
template void ElasticBody<double>::keep_elements(const std::vector<int>&);
template void ElasticBody<float>::transfer_state(const TetMesh&, const std::vector<int>&, const std::vector<int>&,
                                                 const MidEdges&, const float*);
template void ElasticBody<double>::transfer_state(const TetMesh&, const std::vector<int>&, const std::vector<int>&,
                                                  const MidEdges&, const double*);

}  // namespace heml
