#include <fmt/format.h>

#include <algorithm>
#include <heml/math/bytes.hpp>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/world/mesh_editor.hpp>
#include <heml/world/stable_step.hpp>
#include <heml/world/world_queries.hpp>
#include <numeric>
#include <utility>

namespace heml {
namespace {

constexpr std::size_t max_undo = 20;  // edits; of earlier states only the start is kept

/// Appends nodes that the edit inserts between two nodes of the list, or copies from one.
void update_after_edit(const MeshEdit& edit, int nodes, std::vector<int>& list) {
  std::vector<int> sorted = list;
  std::sort(sorted.begin(), sorted.end());
  const auto has = [&](int n) { return std::binary_search(sorted.begin(), sorted.end(), n); };
  for (std::size_t k = 0; k < edit.nodes.size(); ++k)
    if (has(edit.nodes[k].from) && has(edit.nodes[k].to)) list.push_back(nodes + static_cast<int>(k));
}

/// Renumbers an edit by maps of nodes and elements; new ones keep their order, after all old ones.
MeshEdit in_numbers(MeshEdit edit, const std::vector<int>& node, const std::vector<int>& tet) {
  for (int& t : edit.removed) t = tet[static_cast<std::size_t>(t)];
  for (int& t : edit.parents) t = tet[static_cast<std::size_t>(t)];
  for (InsertedNode& n : edit.nodes)
    n = {node[static_cast<std::size_t>(n.from)], node[static_cast<std::size_t>(n.to)], n.weight};
  for (Tet& added : edit.added)
    for (int& n : added)
      if (n < static_cast<int>(node.size())) n = node[static_cast<std::size_t>(n)];
  return edit;
}

double worst_angle(const MeshEdit& edit, const TetMesh& mesh) {
  double worst = 180;
  for (const Tet& tet : edit.added) {
    std::array<Vec3, 4> X;
    for (std::size_t c = 0; c < 4; ++c) X[c] = mesh.nodes[static_cast<std::size_t>(tet[c])];
    worst = std::min(worst, min_dihedral(X));
  }
  return worst;
}

}  // namespace

template <class Real>
Status MeshEditor<Real>::remove(const RemoveElements& command) {
  MeshEdit edit;
  if (const Status made = make_removal_edit(command.which, s_.setup.mesh, *s_.topology, edit); !made.ok())
    return "remove: " + made.message();
  save();
  stroke_.clear();
  const auto mass = [this] { return std::accumulate(s_.mass.begin(), s_.mass.end(), 0.0); };
  EditReport& report = s_.edits.emplace_back(begin_report());
  report.removed = edit.removed.size();
  report.mass = mass();
  carry_out(edit);
  report.mass -= mass();
  end_report(report);
  return {};
}

template <class Real>
Status MeshEditor<Real>::cut(const CutTissue& command) {
  for (const auto& [tip, end] : command.sweep.blades)
    if (!tip.allFinite() || !end.allFinite()) return "cut: a place of the blade is not finite";
  if (command.sweep.blades.size() < 2) return "cut: the sweep needs the blade at two times at least";
  if (!command.continues_stroke) {
    stroke_.clear();
    in_stroke_ = false;
    missed_ = s_.ticks;
  }
  if (snap_ == 0) snap_ = snapping_distance(s_.setup.mesh);
  Cut cut;
  if (!make_cut(command.sweep, s_.setup.mesh, s_.positions(), *s_.topology, snap_, stroke_, cut).ok())
    return {};  // through the air
  stroke_ = cut.nodes;
  if (cut.edit.removed.empty()) return {};
  missed_.reset();
  if (!in_stroke_) {
    save();
    s_.edits.push_back(begin_report());
    s_.edits.back().min_angle = 180;
  }
  in_stroke_ = true;
  carry_out(cut.edit);
  EditReport& report = s_.edits.back();
  report.split += cut.edit.removed.size();
  report.pieces += cut.edit.added.size();
  report.area += cut.area;
  report.min_angle = std::min(report.min_angle, worst_angle(cut.edit, s_.setup.mesh));
  end_report(report);
  return {};
}

template <class Real>
Status MeshEditor<Real>::undo() {
  if (s_.edits.empty() && missed_)
    return fmt::format("undo: nothing was cut or removed; the cut of step {} parted nothing", *missed_);
  if (s_.edits.empty()) return "undo: nothing was cut or removed";
  if (saved_.empty()) return fmt::format("undo: only the last {} edits can be taken back", max_undo);
  s_.edits.pop_back();
  restore(*saved_.back());
  saved_.pop_back();
  return {};
}

template <class Real>
void MeshEditor<Real>::tear() {
  if (!s_.setup.tearing || s_.recovering() || s_.setup.solver.is_static()) return;
  if (!tearing_) tearing_.emplace(*s_.setup.tearing, s_.setup.mesh, *s_.topology);
  const std::vector<Vec3> x = s_.positions();
  const auto is_constrained = [this](int n) {
    return s_.inverse_mass[static_cast<std::size_t>(s_.model.order.new_node[static_cast<std::size_t>(n)])] == 0;
  };
  const std::vector<TearOpening> openings = tearing_->openings(s_.setup.mesh, x, is_constrained, s_.team);
  if (openings.empty()) return;
  if (s_.edits.empty() || s_.edits.back().torn == 0) {
    save();
    stroke_.clear();
    s_.edits.push_back(begin_report());
  }
  const Tear tear = make_tear(openings, s_.setup.mesh, x, tearing_->around());
  carry_out(tear.edit);
  s_.evaluate_forces();
  s_.edits.back().torn += tear.faces;
  s_.edits.back().area += tear.area;
  end_report(s_.edits.back());
}

template <class Real>
EditReport MeshEditor<Real>::begin_report() {
  EditReport report;
  report.tick = s_.ticks;
  report.before = s_.energies();
  report.step_before = s_.limit.stable;
  return report;
}

template <class Real>
void MeshEditor<Real>::end_report(EditReport& report) {
  find_stable_step(s_);
  report.after = s_.energies();
  report.step_after = s_.limit.stable;
}

/// Saves the state before an edit.
template <class Real>
void MeshEditor<Real>::save() {
  const bool solves = s_.implicit && !s_.implicit->equilibrium;
  saved_.push_back(std::make_shared<const Saved>(
      Saved{s_.setup.mesh, s_.setup.boundary, s_.setup.loads, s_.model, s_.topology, s_.body.snapshot(), s_.pins,
            s_.contacts.sutures, s_.grasps, s_.grasps_taken, s_.changes, s_.state, s_.limit, s_.lowest_frequency,
            solves ? std::optional(s_.implicit->snapshot()) : std::nullopt}));
  if (!whole_) whole_ = saved_.back();
  if (saved_.size() > max_undo) saved_.erase(saved_.begin());
  in_stroke_ = false;
}

/// Positions and velocities carry over to the nodes that a cut inserts; nodes of no element come to rest.
template <class Real>
void MeshEditor<Real>::carry_out(const MeshEdit& edit) {
  const auto file_nodes = static_cast<int>(s_.setup.mesh.nodes.size()),
             file_tets = static_cast<int>(s_.setup.mesh.tets.size());
  const MeshEdit inner = in_numbers(edit, s_.model.order.new_node, s_.model.order.new_tet);
  s_.topology = std::make_shared<const Topology>(apply_edit(*s_.topology, edit, file_tets));
  const std::size_t before = s_.model.mesh.tets.size();
  if (!edit.added.empty()) {
    append(edit, s_.setup.mesh);
    for (Boundary& entry : s_.setup.boundary) update_after_edit(edit, file_nodes, entry.nodes);
    for (Load& load : s_.setup.loads) update_after_edit(edit, file_nodes, load.nodes);
    for (PinnedPatch& pin : s_.pins) update_after_edit(inner, static_cast<int>(s_.mass.size()), pin.nodes);
    append(s_.setup, inner, s_.model);
    for (auto* values : {&s_.state.x, &s_.state.v, &s_.last_valid.x, &s_.last_valid.v}) append(inner, *values, 3);
    s_.state.f.resize(s_.state.x.size());
    if (s_.recovery) s_.recovery->append(inner);
    for (PinnedPatch& pin : s_.pins)
      for (std::size_t k = pin.positions.size(); k < pin.nodes.size(); ++k)
        pin.positions.emplace_back(
            Eigen::Map<const Vector3<Real>>(&s_.state.x[3 * static_cast<std::size_t>(pin.nodes[k])])
                .template cast<double>());
  }
  std::vector<bool> stays(s_.model.mesh.tets.size(), true);
  for (const int t : inner.removed) stays[static_cast<std::size_t>(t)] = false;
  std::vector<int> elements, origins;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (!stays[t]) continue;
    elements.push_back(static_cast<int>(t));
    origins.push_back(t < before ? static_cast<int>(t) : inner.parents[t - before]);
  }
  keep_elements(s_.setup, elements, s_.model);
  if (edit.added.empty())
    s_.body.keep_elements(elements);
  else
    s_.body.transfer_state(s_.model.mesh, s_.model.material_of, origins);
  rebuild_after_edit();
  if (s_.implicit && !(edit.added.empty() && s_.implicit->keep_elements(elements, s_.mass))) s_.implicit.reset();
}

/// Updates what depends on the set of elements.
template <class Real>
void MeshEditor<Real>::rebuild_after_edit() {
  s_.update_masses();
  tearing_.reset();
  s_.update_self_contact();
  s_.update_contact_surfaces();
  for (std::size_t n = 0; n < s_.mass.size(); ++n)
    if (s_.mass[n] == 0) Eigen::Map<Vector3<Real>>(&s_.state.v[3 * n]).setZero();
  s_.move_constrained();  // nodes of no element too
  if (s_.recovery) s_.recovery->set_mesh(s_.model.mesh, s_.mass);
  recovery_.rebuild_surrogate();
  s_.lowest_frequency.reset();
}

template <class Real>
void MeshEditor<Real>::restore(const Saved& saved) {
  s_.setup.mesh = saved.mesh;
  s_.setup.boundary = saved.boundary;
  s_.setup.loads = saved.loads;
  s_.model = saved.model;
  s_.topology = std::make_shared<const Topology>(Topology{s_.topology->version + 1, saved.topology->elements});
  s_.state.x = s_.last_valid.x = saved.state.x;
  s_.state.v = s_.last_valid.v = saved.state.v;
  s_.state.f = saved.state.f;
  if (s_.recovery) s_.recovery->last_good = s_.state;
  restore_grasp(saved);
  s_.pins = saved.pins;
  s_.contacts.sutures = saved.sutures;
  stroke_.clear();
  in_stroke_ = false;
  s_.body.restore(s_.model.mesh, s_.model.material_of, saved.body, s_.state.x.data());
  s_.implicit.reset();
  rebuild_after_edit();
  if (saved.changes == s_.changes) restore_exactly(saved);
}

/// Restores the grasp if it has been held ever since, by a tool that is where it is now.
template <class Real>
void MeshEditor<Real>::restore_grasp(const Saved& saved) {
  const bool since = !s_.grasps.empty() && s_.grasps_taken == saved.grasps_taken;
  const Vec3 target = since ? s_.grasps.front().target() : Vec3::Zero();
  s_.grasps.clear();
  if (!since) return;
  s_.grasps = saved.grasps;
  s_.grasps.front().move(target);
}

/// Only edits have happened since the state was saved: restores what would otherwise be computed again, so that the
/// body goes on to the same bits as if there had been no edit.
template <class Real>
void MeshEditor<Real>::restore_exactly(const Saved& saved) {
  s_.state = saved.state;
  s_.limit = saved.limit;
  s_.lowest_frequency = saved.lowest_frequency;
  if (saved.implicit) s_.implicit_state().restore(*saved.implicit);
  s_.is_evaluated = true;
}

template <class Real>
void MeshEditor<Real>::undo_all() {
  s_.edits.clear();
  missed_.reset();
  saved_.clear();
  if (whole_) restore(*whole_);
  whole_.reset();
}

template <class Real>
std::size_t MeshEditor<Real>::history_bytes() const {
  const auto of = [](const Saved& saved) {
    return bytes_of_mesh(saved.mesh) + bytes_of_model(saved.model) + saved.body.bytes() +
           bytes_of(saved.topology->elements, saved.state.x, saved.state.v, saved.state.f);
  };
  std::size_t sum = !saved_.empty() && saved_.front() == whole_ ? 0 : of(*whole_);
  for (const auto& saved : saved_) sum += of(*saved);
  return sum;
}

std::size_t removed_count(const World& world) {
  std::size_t removed = 0;
  for (const EditReport& edit : world.edits()) removed += edit.removed;
  return removed;
}

template class MeshEditor<float>;
template class MeshEditor<double>;

}  // namespace heml
