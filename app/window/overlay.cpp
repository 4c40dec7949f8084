#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <app/panel/measure_section.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/theme.hpp>
#include <app/render/bounds.hpp>
#include <app/window/label_place.hpp>
#include <app/window/overlay.hpp>
#include <cmath>
#include <numbers>

namespace heml::window {

void draw_ring(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh,
               const panel::CameraController& controller, double radius) {
  const Triangle& triangle = surface_mesh.triangles[static_cast<std::size_t>(hit.triangle)];
  const auto corner = [&](int k) {
    return frame.positions[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)])];
  };
  const Vec3f normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  const Vec3f across = normal.unitOrthogonal(), along = normal.cross(across);
  const render::Vec2f middle = controller.pixel(hit.point);
  const bool constrained =
      std::binary_search(surface_mesh.constrained.begin(), surface_mesh.constrained.end(), hit.node);
  const ImU32 colour = constrained ? panel::colours::danger : panel::colours::text;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  constexpr int pieces = 40;
  float widest = 0;
  for (int i = 0; i < pieces; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / pieces;
    const Vec3f point = hit.point + static_cast<float>(radius) * (std::cos(angle) * across + std::sin(angle) * along);
    const render::Vec2f pixel = controller.pixel(point);
    widest = std::max(widest, (pixel - middle).norm());
    list.PathLineTo({pixel.x(), pixel.y()});
  }
  if (widest > panel::em(0.4f) && std::isfinite(widest))
    list.PathStroke((colour & 0x00ffffffu) | 0xb0000000u, ImDrawFlags_Closed, panel::em(0.11f));
  else
    list.PathClear();
  list.AddCircleFilled({middle.x(), middle.y()}, panel::em(0.16f), colour, 12);
}

namespace {

/// What the panel leaves free of the current pane.
panel::Area free_of(const panel::CameraController& controller) {
  const panel::Pane& pane = controller.pane();
  const auto left = static_cast<float>(pane.left), top = static_cast<float>(pane.top);
  return {
      {left + pane.covered.left, top},
      {left + static_cast<float>(pane.size.width) - pane.covered.right, top + static_cast<float>(pane.size.height)}};
}

ImVec2 label_pad() { return {panel::em(0.5f), panel::em(0.25f)}; }  // round its text

/// A label with its text at a pixel.
void draw_label_at(const ImVec2& from, const std::string& text, ImU32 colour) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pad = label_pad();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({from.x - pad.x, from.y - pad.y}, {from.x + size.x + pad.x, from.y + size.y + pad.y},
                     panel::colours::background, panel::em(0.4f));
  list.AddText(from, colour, text.c_str());
}

/// A label to the right of a point of the body, within what the panel leaves free of the pane.
void draw_label(const Vec3f& place, const std::string& text, ImU32 colour, const panel::CameraController& controller) {
  const render::Vec2f at = controller.pixel(place);
  if (!at.allFinite()) return;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pad = label_pad();
  const panel::Area free = free_of(controller);
  const auto within = [](float wanted, float low, float high) { return std::max(low, std::min(wanted, high)); };
  draw_label_at({within(at.x() + panel::em(1.4f), free.from.x + pad.x, free.to.x - size.x - pad.x),
                 within(at.y() - size.y / 2, free.from.y + pad.y, free.to.y - size.y - pad.y)},
                text, colour);
}

void draw_force(const Vec3& force, const Vec3& place, const panel::CameraController& controller) {
  draw_label(place.cast<float>(), panel::newtons(force.norm()), panel::colours::accent, controller);
}

}  // namespace

void draw_reading(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh,
                  const panel::CameraController& controller, const render::Range& range) {
  const auto value = render::value_at(hit, frame, surface_mesh);
  if (!value) return;
  const render::FieldLabel label = render::field_label(frame.field, range);
  draw_label(hit.point,
             fmt::format("{:.3g}{}{}, node {}", *value * label.scale, label.unit.empty() ? "" : " ", label.unit,
                         surface_mesh.nodes[static_cast<std::size_t>(hit.node)]),
             panel::colours::text, controller);
}

void draw_forces(const Frame& frame, const render::HandDrawing& hands, const panel::CameraController& controller) {
  const auto label = [&](const Vec3& force, const Vec3& place) { draw_force(force, place, controller); };
  const auto held = [&](const GraspState& grasp) -> Vec3 {
    const Vec3f eye = controller.camera().eye();
    return render::held_patch(grasp, hands.hold_of(grasp.hand), frame, frame.surface_mesh.get(), eye)
        .place.cast<double>();
  };
  const ByKind labels{[&](const GraspState& grasp) { label(grasp.force, held(grasp)); },
                      [&](const PinState& pin) { label(pin.force, pin.place); },
                      [&](const ProbeState& probe) { label(probe.force, probe.tip); },
                      [&](const SutureState& suture) { label(suture.force, (suture.ends[0] + suture.ends[1]) / 2); },
                      [](const TableState&) {},  // in the panel: a table has no one place
                      [](const SelfContactState&) {}};
  for (const ToolState& tool : frame.tools) std::visit(labels, tool);
}

void draw_suture_end(int node, const Frame& frame, const SurfaceMesh& surface_mesh, const Section& section,
                     const panel::CameraController& controller) {
  const auto place = std::find(surface_mesh.nodes.begin(), surface_mesh.nodes.end(), node);
  if (place == surface_mesh.nodes.end()) return;
  const auto k = static_cast<std::size_t>(place - surface_mesh.nodes.begin());
  if (render::is_left_out(section, frame.positions[k])) return;
  const render::Vec2f at = controller.pixel(frame.positions[k]);
  if (!at.allFinite()) return;
  ImGui::GetBackgroundDrawList()->AddCircle({at.x(), at.y()}, panel::em(0.45f), panel::colours::warning, 16,
                                            panel::em(0.16f));
}

void draw_measured(const panel::Measured& measured, const Section& section, const panel::CameraController& controller) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto pixel = [&](const Vec3f& place) -> ImVec2 {
    const render::Vec2f at = controller.pixel(place);
    return {at.x(), at.y()};
  };
  const auto is_unknown = [&](const Vec3f& place) { return !controller.pixel(place).allFinite(); };
  if (std::any_of(measured.places.begin(), measured.places.end(), is_unknown)) return;
  std::vector<ImVec2> points;
  for (const Vec3f& place : measured.places)
    if (!render::is_left_out(section, place)) points.push_back(pixel(place));
  std::vector<std::array<ImVec2, 2>> lines;
  for (std::size_t k = 1; k < measured.places.size(); ++k)
    if (const auto part = render::part_left_in(section, measured.places[k - 1], measured.places[k]))
      lines.push_back({pixel((*part)[0]), pixel((*part)[1])});
  for (const auto& [colour, width] : {std::pair(panel::colours::background, 0.3f), {panel::colours::warning, 0.14f}})
    for (const auto& [from, to] : lines) list.AddLine(from, to, colour, panel::em(width));
  for (const ImVec2& at : points) {
    list.AddCircleFilled(at, panel::em(0.3f), panel::colours::background, 20);
    list.AddCircleFilled(at, panel::em(0.2f), panel::colours::warning, 20);
  }
  const std::string text = panel::measured_text(measured);
  if (text.empty() || points.empty()) return;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), pad = label_pad();
  const ImVec2 whole(size.x + 2 * pad.x, size.y + 2 * pad.y);
  const ImVec2 from = place_beside(points, whole, free_of(controller), panel::em(0.6f));
  draw_label_at({from.x + pad.x, from.y + pad.y}, text, panel::colours::warning);
}

void draw_pivot(const Vec3f& point, const panel::CameraController& controller) {
  const render::Vec2f at = controller.pixel(point);
  if (!at.allFinite()) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircleFilled({at.x(), at.y()}, panel::em(0.18f), panel::colours::accent, 16);
  list.AddCircle({at.x(), at.y()}, panel::em(0.5f), panel::colours::accent, 24, panel::em(0.1f));
}

void draw_bad_element(const Frame& frame, const panel::CameraController& controller) {
  if (!frame.recovery || frame.recovery->element < 0) return;
  std::array<render::Vec2f, 4> at;
  for (std::size_t c = 0; c < 4; ++c) {
    at[c] = controller.pixel(frame.recovered_element[c]);
    if (!at[c].allFinite()) return;
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b)
      list.AddLine({at[a].x(), at[a].y()}, {at[b].x(), at[b].y()}, panel::colours::danger, panel::em(0.14f));
}

void draw_section(const render::SectionPlane& plane, const Vec3f& handle, float radius, bool hovered,
                  const panel::CameraController& controller) {
  const Vec3f across = plane.normal.unitOrthogonal(), along = plane.normal.cross(across);
  const ImU32 colour = hovered ? panel::colours::text : panel::colours::accent;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto pixel = [&](const Vec3f& point) -> ImVec2 {
    const render::Vec2f at = controller.pixel(point);
    return {at.x(), at.y()};
  };
  const auto is_drawable = [](const ImVec2& at) { return std::abs(at.x) < 1e5f && std::abs(at.y) < 1e5f; };
  std::array<ImVec2, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const float a = k == 0 || k == 3 ? -radius : radius, b = k < 2 ? -radius : radius;
    corners[k] = pixel(handle + a * across + b * along);
    if (!is_drawable(corners[k])) return;
  }
  list.AddPolyline(corners.data(), 4, (colour & 0x00ffffffu) | 0x60000000u, ImDrawFlags_Closed, panel::em(0.08f));
  const ImVec2 middle = pixel(handle), tip = pixel(handle + 0.25f * radius * plane.normal);
  if (!is_drawable(middle) || !is_drawable(tip)) return;
  list.AddLine(middle, tip, colour, panel::em(0.14f));
  list.AddCircleFilled(middle, panel::em(0.5f), panel::colours::background, 24);
  list.AddCircle(middle, panel::em(0.5f), colour, 24, panel::em(hovered ? 0.2f : 0.14f));
}

void draw_nodes(const std::vector<int>& nodes, const Frame& frame, const SurfaceMesh& surface_mesh,
                const Section& section, const panel::CameraController& controller) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const int node : nodes) {
    const auto index = render::surface_index(node, surface_mesh);
    if (!index || render::is_left_out(section, frame.positions[*index])) continue;
    const render::Vec2f at = controller.pixel(frame.positions[*index]);
    if (!at.allFinite()) continue;
    list.AddCircleFilled({at.x(), at.y()}, panel::em(0.24f), panel::colours::background, 10);
    list.AddCircleFilled({at.x(), at.y()}, panel::em(0.17f), panel::colours::accent, 10);
  }
}

std::optional<Vec3f> middle_of(const std::vector<int>& nodes, const Frame& frame, const SurfaceMesh& surface_mesh) {
  Vec3f sum = Vec3f::Zero();
  float count = 0;
  for (const int node : nodes)
    if (const auto index = render::surface_index(node, surface_mesh)) {
      sum += frame.positions[*index];
      ++count;
    }
  return count > 0 ? std::optional<Vec3f>(sum / count) : std::nullopt;
}

void draw_arrow(const Vec3f& from, const Vec3f& to, const std::string& text, std::uint32_t colour,
                const panel::CameraController& controller) {
  const render::Vec2f a = controller.pixel(from), b = controller.pixel(to);
  if (!a.allFinite() || !b.allFinite()) return;
  const render::Vec2f along = (b - a).normalized(), across(-along.y(), along.x());
  const float head = panel::em(0.6f);
  const render::Vec2f left = b - head * along + 0.5f * head * across, right = b - head * along - 0.5f * head * across;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddLine({a.x(), a.y()}, {b.x(), b.y()}, colour, panel::em(0.14f));
  if ((b - a).norm() > head)
    list.AddTriangleFilled({b.x(), b.y()}, {left.x(), left.y()}, {right.x(), right.y()}, colour);
  draw_label(to, text, colour, controller);
}

void draw_arrow_handle(const Vec3f& tip, bool hovered, const panel::CameraController& controller) {
  const render::Vec2f at = controller.pixel(tip);
  if (!at.allFinite()) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircle({at.x(), at.y()}, panel::em(0.5f), hovered ? panel::colours::text : panel::colours::accent, 24,
                 panel::em(hovered ? 0.2f : 0.14f));
}

void draw_loads(const std::vector<Load>& loads, const std::vector<int>& except, const Frame& frame,
                const SurfaceMesh& surface_mesh, const panel::CameraController& controller) {
  constexpr double longest = 0.25;  // of the body's size
  double most = 0;
  for (const Load& load : loads)
    if (load.kind == Load::Kind::force) most = std::max(most, load.vector.norm());
  if (!(most > 0)) return;
  const double reach = longest * static_cast<double>(render::bounding_sphere(surface_mesh.rest).radius);
  for (const Load& load : loads) {
    if (load.kind != Load::Kind::force || load.vector.norm() == 0 || load.nodes == except) continue;
    const auto from = middle_of(load.nodes, frame, surface_mesh);
    if (!from) continue;
    draw_arrow(*from, *from + (reach / most * load.vector).cast<float>(), panel::quantity(load.vector.norm(), "N"),
               panel::colours::warning, controller);
  }
}

void draw_outline(const std::vector<render::Vec2f>& outline) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const render::Vec2f& at : outline) list.PathLineTo({at.x(), at.y()});
  list.PathStroke(panel::colours::accent, ImDrawFlags_Closed, panel::em(0.11f));
}

}  // namespace heml::window
