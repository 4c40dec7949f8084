#include "app/render/grasp_pose.hpp"

#include <algorithm>
#include <app/render/placement.hpp>
#include <app/render/smooth_surface.hpp>
#include <cmath>


namespace heml::render {
namespace {

constexpr float jaw_length = 1.5f;      // of the forceps, in body radii
constexpr float half_opening = 0.016f;  // between the tips, in lengths
constexpr float open_jaws = 0.05f;      // the same of forceps that hold nothing
constexpr float tip_height = 0.006f;    // of the tips' middle over the skin, in lengths
constexpr float handle_lean = 0.8f;     // of the handle to the hand's side, against its rise along the normal
constexpr float full_pull = 0.4f;       // body radii from which the handle follows the pull most
constexpr float pull_lean = 0.8f;
constexpr float least_rise = 0.4f;      // sine of the handle's angle with the skin

Vec3f triangle_normal(const Triangle& triangle, const std::vector<Vec3f>& x) {
  const auto at = [&](std::size_t k) -> const Vec3f& { return x[static_cast<std::size_t>(triangle[k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0));  // as long as twice the area
}

Vec3f unit_or(const Vec3f& v, const Vec3f& otherwise) {
  const float length = v.norm();
  return length > 0 && std::isfinite(length) ? Vec3f(v / length) : otherwise;
}

/// The held point on the skin as it is drawn, which bulges over the flat triangle: the mean of the point's projections
/// onto the tangent planes of the corners (Boubekeur and Alexa, "Phong tessellation", SIGGRAPH Asia 2008). None: the
/// triangle is gone.
std::optional<HeldPatch> at_hold(const SurfacePoint& point, const Frame& frame, const SurfaceMesh& surface_mesh) {
  const auto corners = corners_of(point, frame, surface_mesh);
  if (!corners) return std::nullopt;
  const Vec3f flat = ((*corners)[1] - (*corners)[0]).cross((*corners)[2] - (*corners)[0]);
  std::array<Vec3f, 3> normals{Vec3f::Zero(), Vec3f::Zero(), Vec3f::Zero()};
  bool is_there = false;
  for (const Triangle& triangle : surface_mesh.triangles) {
    int shared = 0;
    for (const int corner : triangle)
      for (const int node : point.nodes) shared += surface_mesh.nodes[static_cast<std::size_t>(corner)] == node;
    if (shared == 0) continue;
    is_there = is_there || shared == 3;
    const Vec3f normal = triangle_normal(triangle, frame.positions);
    if (normal.dot(flat) < std::cos(crease_angle) * normal.norm() * flat.norm()) continue;  // beyond an edge
    for (const int corner : triangle)
      for (std::size_t k = 0; k < 3; ++k)
        if (surface_mesh.nodes[static_cast<std::size_t>(corner)] == point.nodes[k]) normals[k] += normal;
  }
  if (!is_there) return std::nullopt;
  const Vec3f face = unit_or(flat, Vec3f::UnitY()), x = point.among(*corners);
  Vec3f bulge = Vec3f::Zero(), normal = Vec3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f n = unit_or(normals[k], face);
    bulge -= point.weights[k] * (x - (*corners)[k]).dot(n) * n;
    normal += point.weights[k] * n;
  }
  constexpr float roundness = 0.75f;
  return HeldPatch{x + roundness * bulge, unit_or(normal, face)};
}

Vec3f node_normal(std::size_t index, const Frame& frame, const SurfaceMesh& surface_mesh) {
  Vec3f sum = Vec3f::Zero();
  for (const Triangle& triangle : surface_mesh.triangles)
    if (std::find(triangle.begin(), triangle.end(), static_cast<int>(index)) != triangle.end())
      sum += triangle_normal(triangle, frame.positions);
  return sum;
}

/// otherwise: m, the place where the node is not on the surface; it then faces the eye.
HeldPatch at_node(int node, const Vec3f& otherwise, const Frame& frame, const SurfaceMesh* surface_mesh,
                  const Vec3f& eye) {
  const auto index = surface_mesh ? surface_index(node, *surface_mesh) : std::nullopt;
  HeldPatch patch;
  patch.place = index ? frame.positions[*index] : otherwise;
  patch.normal = unit_or(index ? node_normal(*index, frame, *surface_mesh) : Vec3f(Vec3f::Zero()),
                         unit_or(eye - patch.place, Vec3f::UnitY()));
  return patch;
}

}  // namespace

HeldPatch held_patch(const GraspState& grasp, const std::optional<Hold>& hold, const Frame& frame,
                     const SurfaceMesh* surface_mesh, const Vec3f& eye) {
  if (surface_mesh && hold)
    if (auto patch = at_hold(hold->at, frame, *surface_mesh)) {
      patch->pull = hold->hand - patch->place;
      return *patch;
    }
  HeldPatch patch = at_node(grasp.node, grasp.grip.cast<float>(), frame, surface_mesh, eye);
  patch.pull = grasp.target.cast<float>() - patch.place;
  return patch;
}

std::optional<Hold> HandDrawing::hold_of(int hand) const {
  const auto found = std::find_if(holds.begin(), holds.end(), [&](const Hold& hold) { return hold.number == hand; });
  return found != holds.end() ? std::optional(*found) : std::nullopt;
}

HeldPatch free_patch(const Vec3f& tip, const Camera& camera) { return {tip, camera.backward(), Vec3f::Zero()}; }

Vec3f handle_axis(const HeldPatch& patch, const Camera& camera, float radius) {
  const Vec3f& n = patch.normal;
  const Vec3f hand = camera.up() + 0.55f * camera.right();
  Vec3f axis = (n + handle_lean * (hand - hand.dot(n) * n)).normalized();
  const float distance = patch.pull.norm();
  if (distance > 0) axis += pull_lean * std::min(1.0f, distance / (full_pull * radius)) / distance * patch.pull;
  const float rise = axis.dot(n);
  const Vec3f along = unit_or(axis - rise * n, Vec3f::Zero());
  if (rise >= least_rise * axis.norm()) return axis.normalized();
  return (least_rise * n + std::sqrt(1 - least_rise * least_rise) * along).normalized();
}

std::array<Mat4f, 2> clamp_models(const HeldPatch& patch, const Camera& camera, float radius) {
  constexpr float shape_length = 2.37f;  // of scissors_half() from tip to ring
  const float length = clamp_length / shape_length * radius;
  const Vec3f axis = handle_axis(patch, camera, radius);
  const Vec3f beside = unit_or(patch.normal.cross(axis), camera.right());
  const Vec3f pivot = patch.place + tip_height * jaw_length * radius * patch.normal + length * axis;
  std::array<Mat4f, 2> models;
  for (std::size_t k = 0; k < 2; ++k)
    models[k] = place_along(pivot, -axis, k == 0 ? beside : Vec3f(-beside), length, length);
  return models;
}

std::array<Mat4f, 2> jaw_models(const HeldPatch& patch, const Camera& camera, float radius, bool open) {
  const float length = jaw_length * radius;
  const Vec3f axis = handle_axis(patch, camera, radius);
  const Vec3f beside = unit_or(patch.normal.cross(axis), camera.right());  // in the skin: both tips touch it
  const Vec3f tips = patch.place + tip_height * length * patch.normal;
  const float opening = open ? open_jaws : half_opening;
  std::array<Mat4f, 2> models;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3f side = k == 0 ? beside : Vec3f(-beside);
    // Each jaw turns about the joint at the end of the handle until its tip stands beside the patch.
    models[k] = place_along(tips, axis, side, length, length) * turned_about(Vec3f::UnitY(), opening);
  }
  return models;
}

}  // namespace heml::render
