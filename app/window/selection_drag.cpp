#include <algorithm>
#include <app/render/pick_grid.hpp>
#include <app/window/selection_drag.hpp>
#include <iterator>
#include <tuple>

namespace heml::window {
namespace {

constexpr float min_drag = 4;      // pixels
constexpr float tolerance = 1e-3f;  // of the distance from the eye: a node is seen where a ray to it ends

/// Whether a polygon holds a point, by the number of its sides to the right of it.
bool holds(const std::vector<render::Vec2f>& polygon, const render::Vec2f& at) {
  bool inside = false;
  for (std::size_t k = 0, last = polygon.size() - 1; k < polygon.size(); last = k++) {
    const render::Vec2f &a = polygon[k], &b = polygon[last];
    if ((a.y() > at.y()) == (b.y() > at.y())) continue;
    if (at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

/// picks: of the pane, whose corner is at `corner`, pixels.
bool is_seen(int node, const render::Vec2f& corner, const render::PickGrid& picks, const SelectionDrag::View& view) {
  const Vec3f& place = view.frame.positions[static_cast<std::size_t>(node)];
  const render::Vec2f at = view.controller.pixel(place);
  const render::Ray ray = view.controller.ray(at);
  const auto hit = picks.pick(at - corner, view.section);
  if (!hit) return !view.section || view.section->beyond(place) <= 0;  // at the rim
  const float distance = (place - ray.origin).norm();
  return (hit->point - ray.origin).norm() > (1 - tolerance) * distance;
}

/// Adds nodes to a list; both ascend, as the result does.
void add(const std::vector<int>& nodes, std::vector<int>& list) {
  std::vector<int> all;
  std::set_union(list.begin(), list.end(), nodes.begin(), nodes.end(), std::back_inserter(all));
  list = std::move(all);
}

/// Corners of shown elements that are below the surface and that `takes(node)` is true of.
template <class Takes>
std::vector<int> inside_where(const SelectionDrag::View& view, const Takes& takes) {
  if (!view.frame.solid) return {};
  std::vector<bool> is_inside(view.frame.solid->rest.size(), false);
  for (const Tet& tet : view.frame.solid->tets)
    for (const int n : tet) is_inside[static_cast<std::size_t>(n)] = true;
  for (const int n : view.surface_mesh.nodes) is_inside.at(static_cast<std::size_t>(n)) = false;
  std::vector<int> nodes;
  for (std::size_t n = 0; n < is_inside.size(); ++n)
    if (is_inside[n] && takes(n)) nodes.push_back(static_cast<int>(n));
  return nodes;
}

}  // namespace

void SelectionDrag::press(const render::Vec2f& at, const Settings& settings, const View& view) {
  on_ = true;
  settings_ = settings;
  path_ = {at};
  painted_ = {};
  if (settings_.drag == Drag::paint) paint(at, view);
}

void SelectionDrag::move(const render::Vec2f& at, const View& view) {
  if (!on_) return;
  if (settings_.drag == Drag::rectangle && path_.size() > 1) path_.pop_back();
  path_.push_back(at);
  if (settings_.drag == Drag::paint) paint(at, view);
}

bool SelectionDrag::is_click() const {
  return std::all_of(path_.begin(), path_.end(),
                     [&](const render::Vec2f& at) { return (at - path_.front()).norm() < min_drag; });
}

/// Takes the node under a pixel and those within the radius of it at rest.
void SelectionDrag::paint(const render::Vec2f& at, const View& view) {
  const auto hit = render::pick(view.frame, view.surface_mesh, view.controller.ray(at), view.section);
  if (!hit) return;
  const auto& [rest, nodes] = std::tie(view.surface_mesh.rest, view.surface_mesh.nodes);
  const Vec3f& centre = rest[static_cast<std::size_t>(hit->node)];
  const auto is_near = [&](const Vec3f& place) {
    return static_cast<double>((place - centre).norm()) <= settings_.radius;
  };
  std::vector<int> near;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (static_cast<int>(n) == hit->node || is_near(rest[n])) near.push_back(nodes[n]);
  add(near, painted_.surface);
  add(inside_where(view, [&](std::size_t n) { return is_near(view.frame.solid->rest[n]); }), painted_.inside);
}

std::vector<render::Vec2f> SelectionDrag::outline() const {
  if (!on_ || settings_.drag == Drag::paint || is_click()) return {};
  if (settings_.drag == Drag::lasso) return path_;
  const render::Vec2f &a = path_.front(), &b = path_.back();
  return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
}

SelectionDrag::Nodes SelectionDrag::release(const View& view) {
  const std::vector<render::Vec2f> polygon = outline();
  on_ = false;
  if (settings_.drag == Drag::paint) return painted_;
  Nodes found;
  if (polygon.empty()) {
    const auto hit = render::pick(view.frame, view.surface_mesh, view.controller.ray(path_.front()), view.section);
    if (hit) found.surface.push_back(view.surface_mesh.nodes[static_cast<std::size_t>(hit->node)]);
    return found;
  }
  const auto is_within = [&](const Vec3f& place) {
    const render::Vec2f at = view.controller.pixel(place);
    return at.allFinite() && holds(polygon, at);
  };
  if (settings_.through)
    found.inside = inside_where(view, [&](std::size_t n) { return is_within(view.frame.solid_positions[n]); });
  const panel::Pane& pane = view.controller.pane();
  const render::Vec2f corner(static_cast<float>(pane.left), static_cast<float>(pane.top));
  std::optional<render::PickGrid> picks;
  if (!settings_.through) picks.emplace(view.frame, view.surface_mesh, view.controller.camera(), pane.size);
  for (std::size_t n = 0; n < view.surface_mesh.nodes.size(); ++n) {
    if (!is_within(view.frame.positions[n])) continue;
    if (!picks || is_seen(static_cast<int>(n), corner, *picks, view))
      found.surface.push_back(view.surface_mesh.nodes[n]);
  }
  return found;
}

}  // namespace heml::window
