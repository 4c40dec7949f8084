// Edits of the mesh in a running world: what is inside is laid out anew, what people hold and know stays as it is.
#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/world/typed_world.hpp>
#include <numeric>
#include <utility>

namespace heml {
namespace {

constexpr std::size_t most_undone = 20;  // edits; what was before them is forgotten, but for the start

/// Nodes that an edit adds between two of a list are of it too, and copies of its nodes.
void update_after_edit(const MeshEdit& edit, int nodes, std::vector<int>& list) {
  std::vector<int> sorted = list;
  std::sort(sorted.begin(), sorted.end());
  const auto has = [&](int n) { return std::binary_search(sorted.begin(), sorted.end(), n); };
  for (std::size_t k = 0; k < edit.nodes.size(); ++k)
    if (has(edit.nodes[k].from) && has(edit.nodes[k].to)) list.push_back(nodes + static_cast<int>(k));
}

/// An edit in other numbers of nodes and elements; new ones keep their order, after all old ones.
MeshEdit in_numbers(MeshEdit edit, const std::vector<int>& node, const std::vector<int>& tet) {
  for (int& t : edit.removed) t = tet[static_cast<std::size_t>(t)];
  for (int& t : edit.parents) t = tet[static_cast<std::size_t>(t)];
  for (InsertedNode& n : edit.nodes)
    n = {node[static_cast<std::size_t>(n.from)], node[static_cast<std::size_t>(n.to)], n.at};
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
std::optional<std::string> TypedWorld<Real>::execute(const RemoveElements& command) {
  MeshEdit edit;
  if (const auto problem = make_removal_edit(command.which, setup_.mesh, *topology_, edit))
    return "remove: " + *problem;
  save();
  stroke_.clear();
  const auto mass = [this] { return std::accumulate(mass_.begin(), mass_.end(), 0.0); };
  EditReport& report = edits_.emplace_back(begin_report());
  report.removed = edit.removed.size();
  report.mass = mass();
  carry_out(edit);
  report.mass -= mass();
  end_report(report);
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const CutTissue& command) {
  for (const auto& [tip, end] : command.sweep.blades)
    if (!tip.allFinite() || !end.allFinite()) return "cut: a place of the blade is not finite";
  if (command.sweep.blades.size() < 2) return "cut: the sweep needs the blade at two times at least";
  if (!command.continues_stroke) {
    stroke_.clear();
    in_stroke_ = false;
    missed_ = ticks_;
  }
  if (snap_ == 0) snap_ = snapping_distance(setup_.mesh);
  Cut cut;
  if (make_cut(command.sweep, setup_.mesh, positions(), *topology_, snap_, stroke_, cut))
    return std::nullopt;  // through the air
  stroke_ = cut.nodes;
  if (cut.edit.removed.empty()) return std::nullopt;
  missed_.reset();
  if (!in_stroke_) {
    save();
    edits_.push_back(begin_report());
    edits_.back().min_angle = 180;
  }
  in_stroke_ = true;
  carry_out(cut.edit);
  EditReport& report = edits_.back();
  report.split += cut.edit.removed.size();
  report.pieces += cut.edit.added.size();
  report.area += cut.area;
  report.min_angle = std::min(report.min_angle, worst_angle(cut.edit, setup_.mesh));
  end_report(report);
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const Undo&) {
  if (edits_.empty() && missed_)
    return fmt::format("undo: nothing was cut or removed; the cut of step {} parted nothing", *missed_);
  if (edits_.empty()) return "undo: nothing was cut or removed";
  if (saved_.empty()) return fmt::format("undo: only the last {} edits can be taken back", most_undone);
  edits_.pop_back();
  restore(*saved_.back());
  saved_.pop_back();
  return std::nullopt;
}

/// Before a tick. What tears until another edit comes is one, to undo.
template <class Real>
void TypedWorld<Real>::tear() {
  if (!tearing_) tearing_.emplace(*setup_.tearing, setup_.mesh, *topology_);
  const std::vector<Vec3> x = positions();
  const auto is_constrained = [this](int n) {
    return inverse_mass_[static_cast<std::size_t>(model_.order.new_node[static_cast<std::size_t>(n)])] == 0;
  };
  const std::vector<TearOpening> openings = tearing_->openings(setup_.mesh, x, is_constrained, team_);
  if (openings.empty()) return;
  if (edits_.empty() || edits_.back().torn == 0) {
    save();
    stroke_.clear();
    edits_.push_back(begin_report());
  }
  const Tear tear = make_tear(openings, setup_.mesh, x, tearing_->around());
  carry_out(tear.edit);
  evaluate_forces();
  edits_.back().torn += tear.faces;
  edits_.back().area += tear.area;
  end_report(edits_.back());
}

template <class Real>
EditReport TypedWorld<Real>::begin_report() {
  EditReport report;
  report.tick = ticks_;
  report.before = energies();
  report.step_before = stable_step_;
  return report;
}

template <class Real>
void TypedWorld<Real>::end_report(EditReport& report) {
  find_stable_step();
  report.after = energies();
  report.step_after = stable_step_;
}

/// Keeps what an edit may be taken back to.
template <class Real>
void TypedWorld<Real>::save() {
  const bool solves = implicit_ && !implicit_->equilibrium;
  saved_.push_back(std::make_shared<const Saved>(
      Saved{setup_.mesh, setup_.boundary, setup_.loads, model_, topology_, body_.memory(), pins_, contacts_.sutures,
            grasps_, grasps_taken_, changes_, state_, stable_step_, steps_since_bound_, bound_interval_,
            lowest_frequency_, solves ? std::optional(implicit_->memory()) : std::nullopt}));
  if (!whole_) whole_ = saved_.back();
  if (saved_.size() > most_undone) saved_.erase(saved_.begin());
  in_stroke_ = false;
}

/// Nodes of what is cut lie where they lay, and are as fast as they were; nodes of no element rest.
template <class Real>
void TypedWorld<Real>::carry_out(const MeshEdit& edit) {
  const auto file_nodes = static_cast<int>(setup_.mesh.nodes.size()),
             file_tets = static_cast<int>(setup_.mesh.tets.size());
  const MeshEdit inner = in_numbers(edit, model_.order.new_node, model_.order.new_tet);
  topology_ = std::make_shared<const Topology>(apply_edit(*topology_, edit, file_tets));
  const std::size_t before = model_.mesh.tets.size();
  if (!edit.added.empty()) {
    append(edit, setup_.mesh);
    for (Boundary& entry : setup_.boundary) update_after_edit(edit, file_nodes, entry.nodes);
    for (Load& load : setup_.loads) update_after_edit(edit, file_nodes, load.nodes);
    for (PinnedPatch& pin : pins_) update_after_edit(inner, static_cast<int>(mass_.size()), pin.nodes);
    append(setup_, inner, model_);
    for (auto* values : {&state_.x, &state_.v, &last_valid_.x, &last_valid_.v}) append(inner, *values, 3);
    state_.f.resize(state_.x.size());
    if (recovery_) recovery_->append(inner);
    for (PinnedPatch& pin : pins_)
      for (std::size_t k = pin.place.size(); k < pin.nodes.size(); ++k)
        pin.place.emplace_back(Eigen::Map<const Vector3<Real>>(&state_.x[3 * static_cast<std::size_t>(pin.nodes[k])])
                                   .template cast<double>());
  }
  std::vector<bool> stays(model_.mesh.tets.size(), true);
  for (const int t : inner.removed) stays[static_cast<std::size_t>(t)] = false;
  std::vector<int> elements, origins;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (!stays[t]) continue;
    elements.push_back(static_cast<int>(t));
    origins.push_back(t < before ? static_cast<int>(t) : inner.parents[t - before]);
  }
  keep_elements(setup_, elements, model_);
  if (edit.added.empty())
    body_.keep_elements(elements);
  else
    body_.transfer_state(model_.mesh, model_.material_of, origins);
  rebuild_after_edit();
  if (implicit_ && !(edit.added.empty() && implicit_->keep_elements(elements, mass_))) implicit_.reset();
}

/// What follows from other elements.
template <class Real>
void TypedWorld<Real>::rebuild_after_edit() {
  update_masses();
  tearing_.reset();
  update_self_contact();
  update_contact_surfaces();
  for (std::size_t n = 0; n < mass_.size(); ++n)
    if (mass_[n] == 0) Eigen::Map<Vector3<Real>>(&state_.v[3 * n]).setZero();
  move_constrained();  // nodes of no element too
  if (recovery_) recovery_->set_mesh(model_.mesh, mass_);
  if (recovering()) install_surrogate();
  lowest_frequency_.reset();
}

template <class Real>
void TypedWorld<Real>::restore(const Saved& saved) {
  setup_.mesh = saved.mesh;
  setup_.boundary = saved.boundary;
  setup_.loads = saved.loads;
  model_ = saved.model;
  topology_ = std::make_shared<const Topology>(Topology{topology_->version + 1, saved.topology->elements});
  state_.x = last_valid_.x = saved.state.x;
  state_.v = last_valid_.v = saved.state.v;
  state_.f = saved.state.f;
  if (recovery_) recovery_->last_good = state_;
  restore_grasp(saved);
  pins_ = saved.pins;
  contacts_.sutures = saved.sutures;
  stroke_.clear();
  in_stroke_ = false;
  body_.restore(model_.mesh, model_.material_of, saved.body, state_.x.data());
  implicit_.reset();
  rebuild_after_edit();
  if (saved.changes == changes_) restore_moment(saved);
}

/// What was grasped then is grasped as it was, where it has been ever since: by a tool that is where it is now.
template <class Real>
void TypedWorld<Real>::restore_grasp(const Saved& saved) {
  const bool since = !grasps_.empty() && grasps_taken_ == saved.grasps_taken;
  const Vec3 target = since ? grasps_.front().target() : Vec3::Zero();
  grasps_.clear();
  if (!since) return;
  grasps_ = saved.grasps;
  grasps_.front().move(target);
}

/// Nothing but edits has happened since it was saved, and they are taken back: to go on as if there had been none, to
/// the bit, nothing may be found anew.
template <class Real>
void TypedWorld<Real>::restore_moment(const Saved& saved) {
  state_ = saved.state;
  stable_step_ = saved.stable_step;
  steps_since_bound_ = saved.steps_since_bound;
  bound_interval_ = saved.bound_interval;
  lowest_frequency_ = saved.lowest_frequency;
  if (saved.implicit) implicit().restore(*saved.implicit);
  is_known_ = true;
}

template <class Real>
std::shared_ptr<PreconditionerBuild> TypedWorld<Real>::preconditioner_build() {
  if (!implicit_) return nullptr;
  preconditioner_build_ = implicit_->linear.preconditioner_build();
  preconditioner_version_ = topology_->version;
  return preconditioner_build_;
}

/// What another thread has made, where it is of the body as it is; else the same, made here and now.
template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const AdoptPreconditioner&) {
  const bool serves =
      preconditioner_build_ && preconditioner_build_->done() && preconditioner_version_ == topology_->version;
  const auto work = serves ? std::exchange(preconditioner_build_, nullptr) : preconditioner_build();
  preconditioner_build_.reset();
  if (!work || !implicit_ || !implicit_->linear.is_outdated()) return std::nullopt;
  if (!serves) work->run();
  implicit_->linear.adopt(*work);
  return std::nullopt;
}

template <class Real>
void TypedWorld<Real>::undo_edits() {
  edits_.clear();
  missed_.reset();
  saved_.clear();
  if (whole_) restore(*whole_);
  whole_.reset();
}

std::size_t removed_count(const World& world) {
  std::size_t removed = 0;
  for (const EditReport& edit : world.edits()) removed += edit.removed;
  return removed;
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
