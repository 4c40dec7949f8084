#include <algorithm>
#include <heml/world/edit_transfer.hpp>
#include <set>

namespace heml {
namespace {

/// Appends nodes that the edit inserts between nodes of the list, or copies from one.
void update_after_edit(const MeshEdit& edit, int nodes, std::vector<int>& list) {
  std::vector<int> sorted = list;
  std::sort(sorted.begin(), sorted.end());
  const auto has = [&](int n) { return std::binary_search(sorted.begin(), sorted.end(), n); };
  for (std::size_t k = 0; k < edit.nodes.size(); ++k)
    if (edit.nodes[k].lies_among(has)) list.push_back(nodes + static_cast<int>(k));
}

/// Appends the middles of an edit's edges whose ends are in the list: a load acts on faces whatever is said of these.
void add_middles(const MeshEdit& edit, const WorldSetup& setup, std::vector<int>& list) {
  if (setup.midedges.empty()) return;
  std::set<int> has(list.begin(), list.end());
  for (const int t : edit.removed)
    for (std::size_t e = 0; e < 6; ++e) {
      const Tet& tet = setup.mesh.tets[static_cast<std::size_t>(t)];
      const int middle = setup.midedges[static_cast<std::size_t>(t)][e];
      if (has.contains(tet[tet_edges[e][0]]) && has.contains(tet[tet_edges[e][1]]) && has.insert(middle).second)
        list.push_back(middle);
    }
}

/// Renumbers an edit by maps of nodes and elements; new ones keep their order, after all old ones.
MeshEdit in_numbers(MeshEdit edit, const std::vector<int>& node, const std::vector<int>& tet) {
  for (int& t : edit.removed) t = tet[static_cast<std::size_t>(t)];
  for (int& t : edit.parents) t = tet[static_cast<std::size_t>(t)];
  const auto renumber = [&](int& n) {
    if (n < static_cast<int>(node.size())) n = node[static_cast<std::size_t>(n)];
  };
  for (InsertedNode& inserted : edit.nodes) {
    renumber(inserted.from);
    renumber(inserted.to);
    for (NodeShare& share : inserted.sum) renumber(share.node);
  }
  for (Tet& added : edit.added)
    for (int& n : added) renumber(n);
  for (auto& of_element : edit.midedges)
    for (int& n : of_element) renumber(n);
  return edit;
}

/// Appends what the edit adds to setup, model, motion and pins. inner: the edit in inner numbers.
template <class Real>
void append_pieces(const MeshEdit& edit, const MeshEdit& inner, Simulation<Real>& s) {
  const auto file_nodes = static_cast<int>(s.setup->mesh.nodes.size());
  WorldSetup& setup = s.setup.write();
  append(edit, setup.mesh);
  setup.midedges.insert(setup.midedges.end(), edit.midedges.begin(), edit.midedges.end());
  for (Boundary& entry : setup.boundary) update_after_edit(edit, file_nodes, entry.nodes);
  for (Load& load : setup.loads) {
    add_middles(edit, setup, load.nodes);
    update_after_edit(edit, file_nodes, load.nodes);
  }
  for (PinnedPatch& pin : s.pins) update_after_edit(inner, static_cast<int>(s.masses->lumped.size()), pin.nodes);
  append(setup, inner, s.model.write());
  for (auto* values : {&s.state.x, &s.state.v, &s.last_valid.x, &s.last_valid.v}) append(inner, *values, 3);
  s.state.f.resize(s.state.x.size());
  if (s.recovery) s.recovery->append(inner);
  for (PinnedPatch& pin : s.pins)
    for (std::size_t k = pin.positions.size(); k < pin.nodes.size(); ++k)
      pin.positions.emplace_back(Eigen::Map<const Vector3<Real>>(&s.state.x[3 * static_cast<std::size_t>(pin.nodes[k])])
                                     .template cast<double>());
}

}  // namespace

template <class Real>
EditTransfer transfer_edit(const MeshEdit& edit, Simulation<Real>& s) {
  const auto file_tets = static_cast<int>(s.setup->mesh.tets.size());
  const MeshEdit inner = in_numbers(edit, s.model->order.new_node, s.model->order.new_tet);
  s.topology = std::make_shared<const Topology>(apply_edit(*s.topology, edit, file_tets));
  const std::size_t before = s.model->mesh.tets.size();
  if (!edit.added.empty()) append_pieces(edit, inner, s);
  std::vector<bool> stays(s.model->mesh.tets.size(), true);
  for (const int t : inner.removed) stays[static_cast<std::size_t>(t)] = false;
  EditTransfer kept;
  std::vector<int> origins;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (!stays[t]) continue;
    kept.elements.push_back(static_cast<int>(t));
    origins.push_back(t < before ? static_cast<int>(t) : inner.parents[t - before]);
  }
  keep_elements(*s.setup, kept.elements, s.model.write());
  kept.only_removes = edit.added.empty() && s.model->midedges.empty();
  if (kept.only_removes)
    s.body.keep_elements(kept.elements);
  else
    s.body.transfer_state(s.model->mesh, s.model->material_of, origins, s.model->midedges, s.state.x.data());
  return kept;
}

template EditTransfer transfer_edit(const MeshEdit&, Simulation<float>&);
template EditTransfer transfer_edit(const MeshEdit&, Simulation<double>&);

}  // namespace heml
