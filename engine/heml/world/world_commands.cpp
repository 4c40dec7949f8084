#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/materials/material.hpp>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {
constexpr double grip_reach = 0.25;  // of the body's size: how far a spring of a grasp can be drawn out before it slips

/// ω of a grasp, 1/s: about as stiff as the patch of tissue it holds, whose own frequency is √(μ/ρ)/radius, and never
/// so stiff that it shortens the step much.
double tool_frequency(const WorldSetup& setup, double radius, double highest) {
  double speed = 0;  // of shear waves, m/s
  for (const RegionMaterial& entry : setup.materials)
    speed = std::max(speed, std::sqrt(small_strain_moduli(entry.material).shear / entry.material.density));
  if (speed == 0) return 0.25 * highest;  // a net of springs: no continuum to ask
  return std::min(2 * speed / std::max(radius, 0.005), 0.25 * highest);
}

bool finite(const Vec3& v) { return v.allFinite(); }

bool is_edit(const Command& command) {
  return std::holds_alternative<RemoveElements>(command) || std::holds_alternative<CutTissue>(command) ||
         std::holds_alternative<Undo>(command);
}

std::optional<std::string> patch_problem(const char* tool, int node, double radius, std::size_t nodes) {
  if (node < 0 || static_cast<std::size_t>(node) >= nodes)
    return fmt::format("{}: node {} does not exist; the body has nodes 0 to {}", tool, node, nodes - 1);
  if (!(radius >= 0) || !std::isfinite(radius))
    return fmt::format("{}: radius must be 0 m or more, is {}", tool, radius);
  return std::nullopt;
}
}  // namespace

template <class Real>
std::optional<std::string> TypedWorld<Real>::apply(const Command& command) {
  const FlushDenormals flush;
  if (!is_edit(command)) ++changes_;
  is_known_ = false;
  if (implicit_ && implicit_->equilibrium) implicit_->equilibrium->invalidate();
  auto problem = std::visit([this](const auto& c) { return execute(c); }, command);
  if (!problem && !halt_ && !is_known_) {
    if (!evaluate_forces()) restore_last_valid(StopReason::Cause::out_of_range);
    find_stable_step();
  }
  return problem;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const Grasp& command) {
  if (auto problem = patch_problem("grasp", command.node, command.radius, mass_.size())) return problem;
  const int center = model_.order.new_node[static_cast<std::size_t>(command.node)];
  GraspSpring<Real> grasp(
      center, static_cast<Real>(command.radius), surface_with(center), model_.mesh.nodes, state_.x.data(),
      inverse_mass_, static_cast<Real>(tool_frequency(setup_, command.radius, static_cast<double>(rest_frequency_))),
      grip_reach * model_.diagonal);
  if (grasp.empty()) return fmt::format("grasp: node {} is constrained, or belongs to no element", command.node);
  grasps_.assign(1, std::move(grasp));
  ++grasps_taken_;
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const MoveTool& command) {
  if (grasps_.empty()) return "move: nothing is grasped";
  if (!finite(command.target)) return "move: the target is not finite";
  grasps_.front().move(command.target);
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const Release&) {
  grasps_.clear();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const PinTissue& command) {
  if (auto problem = patch_problem("pin", command.node, command.radius, mass_.size())) return problem;
  const int center = model_.order.new_node[static_cast<std::size_t>(command.node)];
  if (inverse_mass_[static_cast<std::size_t>(center)] == 0)
    return fmt::format("pin: node {} is constrained, or belongs to no element", command.node);
  pins_.push_back(
      pin_patch(center, command.radius, surface_with(center), model_.mesh.nodes, state_.x.data(), inverse_mass_));
  update_constraints();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const Unpin& command) {
  if (!command.node) {
    pins_.clear();
    update_constraints();
    return std::nullopt;
  }
  const auto holds = [&](const PinnedPatch& pin) {
    return std::any_of(pin.nodes.begin(), pin.nodes.end(),
                       [&](int n) { return model_.order.file_node[static_cast<std::size_t>(n)] == *command.node; });
  };
  const auto pin = std::find_if(pins_.begin(), pins_.end(), holds);
  if (pin == pins_.end()) return fmt::format("release: no pin holds node {}", *command.node);
  pins_.erase(pin);
  update_constraints();
  return std::nullopt;
}

/// Nodes of the surface, inner numbers, ascending; and one more, which may be of them.
template <class Real>
std::vector<int> TypedWorld<Real>::surface_with(int node) const {
  std::vector<int> nodes = model_.surface_nodes;
  const auto place = std::lower_bound(nodes.begin(), nodes.end(), node);
  if (place == nodes.end() || *place != node) nodes.insert(place, node);
  return nodes;
}

/// What follows from other nodes being held.
template <class Real>
void TypedWorld<Real>::update_constraints() {
  update_masses();
  update_contact_boundary();
  move_constrained();
  implicit_.reset();
  lowest_frequency_.reset();
  if (recovering()) install_surrogate();
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetMaterial& command) {
  const auto entry = std::find_if(setup_.materials.begin(), setup_.materials.end(),
                                  [&](const RegionMaterial& m) { return m.region == command.region; });
  if (entry == setup_.materials.end())
    return command.region ? fmt::format("material: no entry for region {}", *command.region)
                          : std::string("material: there is no default entry; name a region");
  const LawInfo* law = find_law(command.material.law);
  if (setup_.solver.nodal_pressure && law && !law->has_volume_term)
    return fmt::format("material.law: '{}' has no separate volume term, which nodal pressure needs", law->name);
  for (const RegionMaterial& other : setup_.materials)
    if (setup_.solver.nodal_pressure && &other != &*entry && other.material.volume_term != command.material.volume_term)
      return "material.volume_term: with nodal pressure it must be that of the other materials";
  if (!command.material.fields.empty() || !command.material.fibre_field.empty())
    return "material: a switched material takes numbers, not fields";
  if (const auto problem = material_problem(command.material))
    return fmt::format("material.{}: {}", problem->first, problem->second);
  entry->material = command.material;
  body_.set_material(static_cast<std::size_t>(entry - setup_.materials.begin()), command.material, state_.x.data());
  update_masses();
  implicit_.reset();
  lowest_frequency_.reset();
  if (recovering()) install_surrogate();
  find_stable_step();
  method_ = choose_method();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetDamping& command) {
  if (!(command.damping >= 0) || !std::isfinite(command.damping))
    return fmt::format("damping: must be 0 1/s or more, is {}", command.damping);
  setup_.solver.damping = command.damping;
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetGravity& command) {
  if (!finite(command.gravity)) return "gravity: not finite";
  setup_.gravity = command.gravity;
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetIntegrator& command) {
  if ((command.integrator == Integrator::static_equilibrium) != setup_.solver.is_static())
    return "integrator: a scene is static from its start or not at all";
  setup_.solver.integrator = command.integrator;
  implicit_.reset();
  method_ = choose_method();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const Reset&) {
  undo_edits();
  start();
  return std::nullopt;
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
