// Edits of the mesh in a running world: what is inside is laid out anew, what people hold and know stays as it is.
#include <heml/world/typed_world.hpp>
#include <numeric>
#include <utility>

namespace heml {

template <class Real>
std::optional<std::string> TypedWorld<Real>::take(const RemoveElements& command) {
  MeshEdit edit;
  if (const auto problem = make_removal(command.which, setup_.mesh, *topology_, edit)) return "remove: " + *problem;
  const auto mass = [this] { return std::accumulate(mass_.begin(), mass_.end(), 0.0); };
  EditReport report{ticks_, edit.removed.size(), mass(), energies(), {}};
  carry_out(edit);
  report.mass -= mass();
  report.after = energies();
  edits_.push_back(report);
  return std::nullopt;
}

/// Positions and velocities are left alone, but for nodes of no element, which rest.
template <class Real>
void TypedWorld<Real>::carry_out(const MeshEdit& edit) {
  if (!whole_model_) whole_model_ = std::make_unique<const Model<Real>>(model_);
  std::vector<bool> stays(model_.mesh.tets.size(), true);
  for (const int file : edit.removed)
    stays[static_cast<std::size_t>(model_.order.new_tet[static_cast<std::size_t>(file)])] = false;
  std::vector<int> elements;
  for (std::size_t t = 0; t < stays.size(); ++t)
    if (stays[t]) elements.push_back(static_cast<int>(t));

  topology_ = std::make_shared<const Topology>(edited(*topology_, edit));
  keep_elements(setup_, elements, model_);
  body_.keep_elements(elements);
  take_masses();
  for (std::size_t n = 0; n < mass_.size(); ++n)
    if (mass_[n] == 0) Eigen::Map<Vector3<Real>>(&state_.v[3 * n]).setZero();
  move_held();  // nodes of no element too
  if (recovery_) recovery_->set_mesh(model_.mesh, mass_);
  if (recovering()) stand_in();
  if (implicit_ && !implicit_->keep_elements(elements, mass_)) implicit_.reset();
  lowest_frequency_.reset();
}

template <class Real>
std::shared_ptr<FactorWork> TypedWorld<Real>::factor_work() {
  if (!implicit_) return nullptr;
  factor_work_ = implicit_->linear.factor_work();
  factor_version_ = topology_->version;
  return factor_work_;
}

/// What another thread has made, where it is of the body as it is; else the same, made here and now.
template <class Real>
std::optional<std::string> TypedWorld<Real>::take(const TakeFactor&) {
  const bool serves = factor_work_ && factor_work_->done() && factor_version_ == topology_->version;
  const auto work = serves ? std::exchange(factor_work_, nullptr) : factor_work();
  factor_work_.reset();
  if (!work || !implicit_ || !implicit_->linear.is_outdated()) return std::nullopt;
  if (!serves) work->run();
  implicit_->linear.take(*work);
  return std::nullopt;
}

template <class Real>
void TypedWorld<Real>::undo_edits() {
  edits_.clear();
  if (!whole_model_) return;
  implicit_.reset();
  lowest_frequency_.reset();
  model_ = *whole_model_;
  whole_model_.reset();
  topology_ = std::make_shared<const Topology>(whole(setup_.mesh, topology_->version + 1));
  body_.set_mesh(model_.mesh, model_.material_of);
  take_masses();
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
