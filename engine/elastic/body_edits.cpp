// Other elements in a body that lives.
#include <algorithm>
#include <heml/elastic/body.hpp>
#include <heml/elastic/memory_term.hpp>
#include <heml/elastic/reshape.hpp>

namespace heml {
namespace {

std::array<Vec3, 4> places(const TetMesh& mesh, int element) {
  std::array<Vec3, 4> X;
  for (std::size_t c = 0; c < 4; ++c)
    X[c] = mesh.nodes[static_cast<std::size_t>(mesh.tets[static_cast<std::size_t>(element)][c])];
  return X;
}

}  // namespace

template <class Real>
void ElasticBody<Real>::set_mesh(const TetMesh& mesh, const std::vector<int>& material_of) {
  mesh_ = mesh;
  material_of_ = material_of;
  make_parts();
  forget(at_rest().data());
}

template <class Real>
void ElasticBody<Real>::keep_elements(const std::vector<int>& elements) {
  std::vector<int> number(mesh_.tets.size(), -1);  // that an element has from now on
  for (std::size_t k = 0; k < elements.size(); ++k) number[static_cast<std::size_t>(elements[k])] = static_cast<int>(k);
  for (Part& part : parts_) {
    std::vector<std::size_t> slots;
    for (std::size_t s = 0; s < part.group.size(); ++s) {
      int& element = part.group.element[s];
      element = number[static_cast<std::size_t>(element)];
      if (element >= 0) slots.push_back(s);
    }
    if (slots.size() == part.group.size()) continue;
    if (slots.empty()) {
      part.group.element.clear();
      continue;
    }
    const std::vector<std::size_t> from = keep_slots(part.group, slots);
    for (const auto& term : part.terms) term->take_slots(from);
    if (part.flow) part.flow->take_slots(from);
  }
  std::erase_if(parts_, [](const Part& part) { return part.group.size() == 0; });
  mesh_ = with_elements(mesh_, elements);
  material_of_ = with_elements(material_of_, elements);
  join_parts();
}

/// Parts are made anew; then those that remember take it from the part their elements were in.
template <class Real>
void ElasticBody<Real>::take_pieces(const TetMesh& mesh, const std::vector<int>& material_of,
                                    const std::vector<int>& origins) {
  const TetMesh old_mesh = std::exchange(mesh_, mesh);
  const std::vector<Part> old_parts = std::exchange(parts_, {});
  material_of_ = material_of;
  make_parts();
  if (!has_memory()) return;
  std::vector<std::size_t> slot(old_mesh.tets.size());
  for (const Part& part : old_parts)
    for (std::size_t s = 0; s < part.group.size(); ++s) slot[static_cast<std::size_t>(part.group.element[s])] = s;
  for (Part& part : parts_) {
    const auto old = std::find_if(old_parts.begin(), old_parts.end(),
                                  [&](const Part& other) { return other.material == part.material; });
    std::vector<std::size_t> from;
    std::vector<Reshape<Real>> reshapes;
    for (std::size_t s = 0; s < part.group.volume.size(); ++s) {
      const int element = part.group.element[std::min(s, part.group.size() - 1)];
      const int origin = origins[static_cast<std::size_t>(element)];
      from.push_back(slot[static_cast<std::size_t>(origin)]);
      reshapes.emplace_back(places(old_mesh, origin), places(mesh_, element));
    }
    for (std::size_t k = 0; k < part.terms.size(); ++k) {
      auto* memory = dynamic_cast<MemoryTerm<Real>*>(part.terms[k].get());
      if (!memory) continue;
      memory->take_pieces(dynamic_cast<const MemoryTerm<Real>&>(*old->terms[k]), from, reshapes);
    }
    if (part.flow) part.flow->take_pieces(*old->flow, old->group, from, reshapes, part.group);
  }
}

template void ElasticBody<float>::set_mesh(const TetMesh&, const std::vector<int>&);
template void ElasticBody<double>::set_mesh(const TetMesh&, const std::vector<int>&);
template void ElasticBody<float>::keep_elements(const std::vector<int>&);
template void ElasticBody<double>::keep_elements(const std::vector<int>&);
template void ElasticBody<float>::take_pieces(const TetMesh&, const std::vector<int>&, const std::vector<int>&);
template void ElasticBody<double>::take_pieces(const TetMesh&, const std::vector<int>&, const std::vector<int>&);

}  // namespace heml
