#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/mesh/burn.hpp>
#include <heml/mesh/quadratic_edit.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/world/edit_transfer.hpp>
#include <heml/world/edit_undo.hpp>
#include <heml/world/mesh_editor.hpp>
#include <heml/world/stable_step.hpp>
#include <heml/world/world_queries.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace heml {
namespace {

constexpr std::size_t max_undo = 20;        // edits; of earlier states only the start is kept
constexpr double contraction_rate = 2;      // 1/s, of first lengths: a fifth within 0.1 s, slower than waves pass
constexpr double contraction_stage = 0.01;  // s

Status places_problem(const char* what, const Sweep& sweep) {
  for (const auto& [tip, end] : sweep.blades)
    if (!tip.allFinite() || !end.allFinite()) return fmt::format("{}: a place of the blade is not finite", what);
  return {};
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
  if (const Status made = make_removal_edit(command.which, s_.setup->mesh, *s_.topology, edit); !made.ok())
    return "remove: " + made.message();
  save();
  history_.stroke = {};
  const auto mass = [this] {
    const std::vector<Real>& heavy = s_.masses->heavy();
    return std::accumulate(heavy.begin(), heavy.end(), 0.0);
  };
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
  if (const Status status = places_problem("cut", command.sweep); !status.ok()) return status;
  if (command.sweep.blades.size() < 2) return "cut: the sweep needs the blade at two times at least";
  if (!command.continues_stroke) begin_stroke(fmt::format("the cut of step {} parted nothing", s_.ticks));
  return part(command.sweep);
}

template <class Real>
Status MeshEditor<Real>::cauterize(const CauterizeTissue& command) {
  const auto& [radius, shrink] = command.heat;
  if (const Status status = places_problem("cauterize", command.sweep); !status.ok()) return status;
  if (command.sweep.blades.empty()) return "cauterize: the electrode is nowhere; give it one place or more";
  if (!(radius > 0) || !std::isfinite(radius))
    return fmt::format("cauterize: the radius must be more than 0 m, is {}", radius);
  if (!(shrink >= 0 && shrink <= max_shrink))
    return fmt::format("cauterize: shrink must be 0 to {}, is {}", max_shrink, shrink);
  if (!command.continues_stroke) begin_stroke(fmt::format("the electrode of step {} burnt nothing", s_.ticks));
  if (command.sweep.blades.size() > 1)
    if (const Status status = part(command.sweep); !status.ok()) return status;
  burn(command.heat, command.sweep);
  return {};
}

/// missed: what is to be told if it changes nothing.
template <class Real>
void MeshEditor<Real>::begin_stroke(std::string missed) {
  history_.stroke = {};
  history_.in_stroke = false;
  history_.missed = std::move(missed);
}

/// The report of the stroke under way, which its first change begins.
template <class Real>
EditReport& MeshEditor<Real>::stroke_report() {
  history_.missed.clear();
  if (!history_.in_stroke) {
    save();
    s_.edits.push_back(begin_report());
    s_.edits.back().min_angle = 180;
  }
  history_.in_stroke = true;
  return s_.edits.back();
}

/// Parts the tissue along a sweep.
template <class Real>
Status MeshEditor<Real>::part(const Sweep& sweep) {
  if (history_.snap == 0) history_.snap = snapping_distance(s_.setup->mesh);
  Cut cut;
  if (!make_cut(sweep, s_.setup->mesh, s_.positions(), *s_.topology, history_.snap, history_.stroke, cut).ok()) {
    move_front(sweep);  // through the air, or within an element
    return {};
  }
  if (const Status complete = add_midedge_nodes(cut.edit); !complete.ok()) return complete;
  history_.stroke = cut.stroke;
  if (cut.edit.removed.empty()) {
    move_front(sweep);
    return {};
  }
  EditReport& report = stroke_report();
  carry_out(cut.edit);
  move_front(sweep);
  report.split += cut.edit.removed.size();
  report.pieces += cut.edit.added.size();
  report.area += cut.area;
  report.min_angle = std::min(report.min_angle, worst_angle(cut.edit, s_.setup->mesh));
  end_report(report);
  return {};
}

/// Coagulates the tissue about a sweep. Its rest shape shrinks in the ticks to come; where no time passes, at once.
template <class Real>
void MeshEditor<Real>::burn(const Heat& heat, const Sweep& sweep) {
  std::vector<Burn> burns = burns_after(heat, sweep, s_.setup->mesh, s_.positions(), *s_.topology);
  std::vector<Burn> before = s_.setup->mesh.burns;
  before.resize(burns.size());
  if (burns == before) return;
  EditReport& report = stroke_report();
  for (std::size_t t = 0; t < burns.size(); ++t) report.burnt += burns[t].level > 0 && before[t].level == 0 ? 1 : 0;
  if (s_.setup->solver.is_static()) heml::contract(burns, std::numeric_limits<double>::infinity());
  set_burns(std::move(burns));
  s_.topology = std::make_shared<const Topology>(Topology{s_.topology->version + 1, s_.topology->elements});
  end_report(report);
}

/// By stages, since each one changes the layout of the forces.
template <class Real>
void MeshEditor<Real>::contract() {
  if (s_.setup->mesh.burns.empty() || s_.setup->solver.is_static()) return;
  const double tick = s_.setup->solver.tick();
  const auto stages_to = [&](long ticks) { return std::floor(static_cast<double>(ticks) * tick / contraction_stage); };
  const double stages = stages_to(s_.ticks + 1) - stages_to(s_.ticks);
  if (!(stages > 0)) return;
  if (!are_contracting(s_.setup->mesh.burns)) return;
  std::vector<Burn> burns = s_.setup->mesh.burns;
  heml::contract(burns, stages * contraction_stage * contraction_rate);
  set_burns(std::move(burns));
  s_.evaluate_forces();
  find_stable_step(s_);
}

template <class Real>
void MeshEditor<Real>::set_burns(std::vector<Burn> burns) {
  std::vector<Burn>& inner = s_.model.write().mesh.burns;
  inner.clear();
  for (const int t : s_.model->order.file_tet) inner.push_back(burns[static_cast<std::size_t>(t)]);
  s_.body.set_burns(inner);
  s_.setup.write().mesh.burns = std::move(burns);
  if (s_.setup->solver.mass_scaling > 0) s_.update_masses();  // factors are of rest shapes
  s_.implicit.reset();
  follow_rest_shapes();
}

/// Completes an edit of the corners where elements are quadratic.
template <class Real>
Status MeshEditor<Real>::add_midedge_nodes(MeshEdit& edit) const {
  if (s_.setup->midedges.empty()) return {};
  heml::add_midedge_nodes(s_.setup->mesh, s_.setup->midedges, edit);
  const int inverted = count_inverted_points(s_.setup->mesh, edit);
  if (inverted == 0) return {};
  return fmt::format(
      "cut: {} integration points of the pieces would be inverted at rest, since the elements are curved; cut "
      "elsewhere, or take a mesh with straight edges",
      inverted);
}

/// Attaches the blade to the tissue where a sweep ends. A sweep that cut nothing, of a blade in the tissue, leaves the
/// front where it is.
template <class Real>
void MeshEditor<Real>::move_front(const Sweep& sweep) {
  BladeFront& front = history_.stroke.front;
  if (front.in_tissue())
    front.pass(sweep);
  else
    front = BladeFront(sweep.blades.back(), s_.setup->mesh, s_.positions(), *s_.topology);
}

template <class Real>
Status MeshEditor<Real>::undo() {
  if (s_.edits.empty() && !history_.missed.empty())
    return "undo: nothing was cut, burnt or removed; " + history_.missed;
  if (s_.edits.empty()) return "undo: nothing was cut, burnt or removed";
  if (history_.saved.empty()) return fmt::format("undo: only the last {} edits can be taken back", max_undo);
  s_.edits.pop_back();
  undo_to(*history_.saved.back());
  history_.saved.pop_back();
  return {};
}

template <class Real>
void MeshEditor<Real>::tear() {
  if (!s_.setup->tearing || s_.recovering() || s_.setup->solver.is_static()) return;
  if (!tearing_) tearing_.emplace(*s_.setup->tearing, s_.setup->mesh, *s_.topology);
  const std::vector<Vec3> x = s_.positions();
  const auto is_constrained = [this](int n) {
    return s_.masses->inverse[static_cast<std::size_t>(s_.model->order.new_node[static_cast<std::size_t>(n)])] == 0;
  };
  const std::vector<TearOpening> openings = tearing_->openings(s_.setup->mesh, x, is_constrained, s_.team);
  if (openings.empty()) return;
  if (s_.edits.empty() || s_.edits.back().torn == 0) {
    save();
    history_.stroke = {};
    s_.edits.push_back(begin_report());
  }
  const Tear tear = make_tear(openings, s_.setup->mesh, x, tearing_->around());
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
  history_.saved.push_back(std::make_shared<const SimulationSnapshot<Real>>(take_snapshot(s_)));
  if (!history_.whole) history_.whole = history_.saved.back();
  if (history_.saved.size() > max_undo) history_.saved.erase(history_.saved.begin());
  history_.in_stroke = false;
}

template <class Real>
void MeshEditor<Real>::carry_out(const MeshEdit& edit) {
  const EditTransfer kept = transfer_edit(edit, s_);
  rebuild_after_edit();
  if (s_.implicit &&
      !(kept.only_removes && s_.implicit->keep_elements(s_.model->mesh, kept.elements, s_.masses->lumped)))
    s_.implicit.reset();
}

/// Updates what depends on the set of elements. Nodes of no element come to rest.
template <class Real>
void MeshEditor<Real>::rebuild_after_edit() {
  s_.update_masses();
  s_.update_self_contact();
  s_.update_contact_surfaces();
  for (std::size_t n = 0; n < s_.masses->lumped.size(); ++n)
    if (s_.masses->lumped[n] == 0) Eigen::Map<Vector3<Real>>(&s_.state.v[3 * n]).setZero();
  s_.move_constrained();  // nodes of no element too
  follow_rest_shapes();
}

/// Updates what depends on rest shapes alone.
template <class Real>
void MeshEditor<Real>::follow_rest_shapes() {
  tearing_.reset();
  if (s_.recovery) s_.recovery->reference = make_recovery_reference(*s_.model, s_.masses->lumped);
  recovery_.follow_change();
  s_.lowest_frequency.reset();
}

/// Where only edits have happened since, back to the bits of a body without the edit.
template <class Real>
void MeshEditor<Real>::undo_to(const SimulationSnapshot<Real>& before) {
  if (before.values.changes == s_.changes) {
    heml::restore(before, s_);
    s_.is_evaluated = true;
    tearing_.reset();
  } else {
    restore_before_edit(before, s_);
    rebuild_after_edit();
  }
  history_.stroke = {};
  history_.in_stroke = false;
}

template <class Real>
void MeshEditor<Real>::undo_all() {
  s_.edits.clear();
  const auto whole = std::exchange(history_, {}).whole;
  if (!whole) return;
  restore_before_edit(*whole, s_);
  rebuild_after_edit();
}

template <class Real>
void MeshEditor<Real>::restore_history(const EditHistory<Real>& history) {
  history_ = history;
  tearing_.reset();
}

template <class Real>
std::size_t MeshEditor<Real>::history_bytes() const {
  const auto& [whole, saved, stroke, in_stroke, missed, snap] = history_;
  std::size_t sum = !saved.empty() && saved.front() == whole ? 0 : whole->bytes();
  for (const auto& before : saved) sum += before->bytes();
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
