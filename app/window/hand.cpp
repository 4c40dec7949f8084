#include <algorithm>
#include <app/window/hand.hpp>

namespace heml::window {

std::optional<render::Hit> Hand::under(const render::Vec2f& at, const Frame& frame, const Skin& skin) const {
  return render::pick(frame, skin, eye_.camera().ray(at.x(), at.y(), eye_.size()));
}

bool Hand::press(MouseButton button, const render::Vec2f& at, bool shift, const Frame& frame, const Skin& skin,
                 double radius, std::vector<Command>& out) {
  if (doing_ != Doing::nothing) return false;
  button_ = button;
  last_ = at;
  if (button == MouseButton::left)
    if (const auto hit = under(at, frame, skin)) return !grasp(*hit, frame, skin, radius, out);
  const bool pans = button == MouseButton::middle || (button == MouseButton::right && shift);
  doing_ = pans ? Doing::panning : Doing::orbiting;
  return false;
}

bool Hand::grasp(const render::Hit& hit, const Frame& frame, const Skin& skin, double radius,
                 std::vector<Command>& out) {
  const auto held = [&](int node) { return std::binary_search(skin.held.begin(), skin.held.end(), node); };
  int node = hit.node;
  for (const int corner : skin.triangles[static_cast<std::size_t>(hit.triangle)])
    if (held(node)) node = corner;
  if (held(node)) return false;
  doing_ = Doing::grasping;
  held_point_ = hit.point;
  node_offset_ = frame.positions[static_cast<std::size_t>(node)] - hit.point;
  out.emplace_back(Grasp{skin.nodes[static_cast<std::size_t>(node)], radius});
  return true;
}

void Hand::move(const render::Vec2f& at, std::vector<Command>& out) {
  const render::Vec2f travel = at - last_;
  last_ = at;
  if (travel == render::Vec2f::Zero()) return;
  if (doing_ == Doing::orbiting) eye_.orbit(travel.x(), travel.y());
  if (doing_ == Doing::panning) eye_.pan(travel.x(), travel.y());
  if (doing_ == Doing::grasping) {
    const Vec3f point = eye_.camera().drag(at.x(), at.y(), eye_.size(), held_point_);
    out.emplace_back(MoveTool{(point + node_offset_).cast<double>()});
  }
}

void Hand::release(MouseButton button, std::vector<Command>& out) {
  if (button == button_) let_go(out);
}

void Hand::let_go(std::vector<Command>& out) {
  if (doing_ == Doing::grasping) out.emplace_back(Release{});
  doing_ = Doing::nothing;
}

}  // namespace heml::window
