#include <algorithm>
#include <app/window/clamps.hpp>
#include <app/window/device_hand.hpp>
#include <app/window/free_nodes.hpp>
#include <utility>

namespace heml::window {
namespace {

constexpr float speed = 0.5f;        // heights of the view a second, at full deflection: a fitted body in two seconds
constexpr float turn_speed = 0.5f;   // the same as travel of the mouse: a quarter turn
constexpr float zoom_speed = 6;      // notches of the wheel a second
constexpr float longest_picture = 0.1f;  // s: a picture that took longer moves the hand no further
constexpr float depth_of_view = 1;       // heights of the view before and behind the middle of the view
constexpr float least_reach = 0.02f;     // heights of the view
constexpr float first_gap = 0.1f;        // likewise: from the tissue in the middle to where the hand appears

}  // namespace

bool DeviceHand::adopt(const HandState& state) {
  grasp_pressed_ = grasp_pressed_ || (state.grasp && !state_.grasp);
  clamp_pressed_ = clamp_pressed_ || (state.clamp && !state_.clamp);
  const bool was_idle = std::exchange(state_, state).is_idle();
  return !was_idle || !state.is_idle();
}

Status DeviceHand::act(float seconds, bool moves_view, const Scene& scene, std::vector<Command>& out) {
  notice_loss(scene.frame, out);
  const bool grasps = std::exchange(grasp_pressed_, false), leaves = std::exchange(clamp_pressed_, false);
  if (state_.is_idle() && !grasps && !leaves) return {};
  const float time = std::min(seconds, longest_picture);
  has_moved_ = true;
  turn_view(time);
  if (moves_view) move_view(time);
  if (moves_view && !held_) {
    tip_.reset();
    return {};
  }
  if (!tip_) appear(scene);
  if (!moves_view && move(time) && held_)
    out.emplace_back(MoveTool{(*tip_ + held_->tool_offset).cast<double>(), number_});
  if (leaves) return leave_clamp(scene.frame, out);
  if (!grasps) return {};
  if (!held_) return grasp(scene, out);
  let_go(out);
  return {};
}

/// Before the tissue in the middle of what the panel leaves free of the pane.
void DeviceHand::appear(const Scene& scene) {
  const panel::Pane& pane = controller_.pane();
  const float free = static_cast<float>(pane.size.width) - pane.covered.left - pane.covered.right;
  const render::Vec2f middle(static_cast<float>(pane.left) + pane.covered.left + free / 2,
                             static_cast<float>(pane.top) + height() / 2);
  const render::Ray ray = controller_.ray(middle);
  const auto hit = render::pick(scene.frame, scene.surface_mesh, ray, scene.section);
  const Vec3f place = hit ? hit->point : controller_.drag(middle, controller_.camera().target());
  tip_ = place - first_gap * height() * metres_per_pixel(place) * ray.direction;
}

float DeviceHand::metres_per_pixel(const Vec3f& at) const {
  const render::Vec2f pixel = controller_.pixel(at);
  return (controller_.drag(pixel + render::Vec2f(0, 1), at) - controller_.drag(pixel, at)).norm();
}

/// Keeps the tips in view. Returns whether they moved.
bool DeviceHand::move(float seconds) {
  if (state_.move.isZero(0)) return false;
  const render::Camera camera = controller_.camera();
  const Vec3f target = camera.target(), away = camera.backward();
  const float whole = height() * metres_per_pixel(target);  // m, what the view shows there
  const Vec3f step = seconds * speed * whole * state_.move;
  const float ahead = away.dot(*tip_ - target);
  const float further = std::clamp(ahead + step.z(), -depth_of_view * whole, depth_of_view * whole) - ahead;
  Vec3f tip = *tip_ + step.x() * camera.right() + step.y() * camera.up() + further * away;
  const panel::Pane& pane = controller_.pane();
  const render::Vec2f at = controller_.pixel(tip);
  if (!at.allFinite()) return false;
  const float left = static_cast<float>(pane.left), top = static_cast<float>(pane.top);
  const float right = left + static_cast<float>(pane.size.width) - pane.covered.right;
  const render::Vec2f within(std::min(std::max(at.x(), left + pane.covered.left), right),
                             std::clamp(at.y(), top, top + height()));
  if (within != at) tip = controller_.drag(within, tip);
  return std::exchange(*tip_, tip) != tip;
}

void DeviceHand::turn_view(float seconds) {
  const float travel = seconds * turn_speed * height();
  if (state_.turn_right != 0 || state_.turn_down != 0)
    controller_.orbit(travel * state_.turn_right, travel * state_.turn_down);
}

void DeviceHand::move_view(float seconds) {
  const float travel = seconds * speed * height();
  controller_.pan(travel * state_.move.x(), -travel * state_.move.y());
  controller_.zoom(seconds * zoom_speed * state_.move.z());
}

float DeviceHand::reach(const Scene& scene) const {
  return std::max(static_cast<float>(scene.radius), least_reach * height() * metres_per_pixel(*tip_));
}

std::optional<render::Hit> DeviceHand::in_reach(const Scene& scene) const {
  if (!tip_ || held_) return std::nullopt;
  return render::nearest_surface(scene.frame, scene.surface_mesh, *tip_, reach(scene), scene.section);
}

Status DeviceHand::grasp(const Scene& scene, std::vector<Command>& out) {
  if (take_up_clamp(scene, out)) return {};
  const auto hit = in_reach(scene);
  if (!hit) return "No tissue is in reach of these forceps: a ring on it shows where they take hold.";
  const FreeNodes free(scene.frame, scene.surface_mesh);
  const auto index = free.nearest(*hit, scene.radius);
  if (!index) return free.why_none(*hit);
  const auto nearest = static_cast<std::size_t>(*index);
  const Grasp grasp{scene.surface_mesh.nodes[nearest], scene.radius, number_, scene.surface_mesh.hidden};
  if (const Status taken = held_by_another(grasp, scene.frame); !taken.ok()) return taken;
  tip_ = hit->point;
  held_ = Held{grasp, render::surface_point(*hit, scene.frame, scene.surface_mesh),
               scene.frame.positions[nearest] - hit->point, scene.frame.refusals};
  has_grasped_ = true;
  out.emplace_back(grasp);
  return {};
}

/// Takes a clamp into this hand, which moves it from where it is. In reach is its tissue, or where it is pulled to:
/// there the tips are that have just left it.
bool DeviceHand::take_up_clamp(const Scene& scene, std::vector<Command>& out) {
  const Frame& frame = scene.frame;
  for (const GraspState& clamp : tools_of<GraspState>(frame.tools)) {
    const auto index = render::surface_index(clamp.node, scene.surface_mesh);
    if (!render::is_clamp(clamp) || !index) continue;
    const Vec3f& place = frame.positions[*index];
    const auto hit = render::nearest_surface(frame, scene.surface_mesh, place, 0);
    const Vec3f target = clamp.target.cast<float>();
    if (!hit || std::min((place - *tip_).norm(), (target - *tip_).norm()) > reach(scene)) continue;
    tip_ = target;
    held_ = Held{{clamp.node, clamp.radius, number_, scene.surface_mesh.hidden},
                 render::surface_point(*hit, frame, scene.surface_mesh), Vec3f::Zero(), frame.refusals};
    has_grasped_ = true;
    out.emplace_back(held_->grasp);
    return true;
  }
  return false;
}

void DeviceHand::notice_loss(const Frame& frame, std::vector<Command>& out) {
  if (!held_) return;
  const GraspState* now = find_grasp(frame.tools, number_);
  if (now && now->node == held_->grasp.node) {
    held_->is_seen = true;
  } else if (held_->is_seen) {
    held_.reset();
  } else if (frame.refusals > held_->refusals) {
    let_go(out);  // the refused command may have been another
  }
}

Status DeviceHand::leave_clamp(const Frame& frame, std::vector<Command>& out) {
  if (!held_) return "Grasp tissue first: then this leaves the grasp there as a clamp.";
  const auto hand = free_hand(frame);
  if (!hand) return no_free_hand;
  out.emplace_back(Grasp{held_->grasp.node, held_->grasp.radius, *hand, held_->grasp.hidden});
  *tip_ += held_->tool_offset;  // to the clamp: from there it can be taken up again
  held_.reset();
  return {};
}

void DeviceHand::let_go(std::vector<Command>& out) {
  if (held_) out.emplace_back(Release{number_});
  held_.reset();
}

std::string DeviceHand::unplug(const Frame& frame, std::vector<Command>& out) {
  const bool held = holds(), is_clamp = leave_clamp(frame, out).ok();
  let_go(out);
  hide();
  state_ = {};
  has_moved_ = false;
  return !held ? "" : is_clamp ? "what it held is left as a clamp." : "it let go, since there is no hand for a clamp.";
}

void DeviceHand::hide() {
  held_.reset();
  tip_.reset();
  grasp_pressed_ = clamp_pressed_ = false;
}

std::optional<render::Hold> DeviceHand::hold() const {
  if (!held_) return std::nullopt;
  return render::Hold{held_->at, *tip_, number_};
}

}  // namespace heml::window
