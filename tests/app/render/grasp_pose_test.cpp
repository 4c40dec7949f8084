#include "app/render/grasp_pose.hpp"

#include <doctest/doctest.h>

#include <app/render/solid_mesh.hpp>

#include "shapes.hpp"

namespace heml::render::grasp_pose_test {
namespace {

constexpr float radius = 0.05f;

Camera camera_on_ball() {
  Camera camera;
  camera.fit(Vec3f::Zero(), radius, {640, 480});
  return camera;
}

/// Where a ray to the origin from far away along `direction` meets the surface.
Hit hit_from(const Vec3f& direction, const Frame& frame) {
  const auto hit = pick(frame, *frame.surface_mesh, {10 * radius * direction, -direction});
  REQUIRE(hit);
  return *hit;
}

/// Least distance (m) of both jaws from the origin.
float nearest_to_origin(const std::array<Mat4f, 2>& jaws) {
  float nearest = 1;
  for (const Mat4f& jaw : jaws)
    for (const SolidShape::Vertex& vertex : forceps_jaw().vertices)
      nearest = std::min(nearest, (jaw * vertex.position.homogeneous()).head<3>().norm());
  return nearest;
}

Vec3f tip_of(const Mat4f& jaw) { return jaw.block<3, 1>(0, 3); }

}  // namespace

TEST_CASE("jaws stand on the skin where the mouse took hold, on both sides of it, and none of them goes through it") {
  const Frame frame = frame_at_rest(ball_surface(3, radius));
  const Camera camera = camera_on_ball();
  const Vec3f toward = (camera.eye() - camera.target()).normalized();
  for (const Vec3f& aside : {Vec3f(0, 0, 0), Vec3f(0.5f, 0.2f, 0), Vec3f(-0.4f, -0.6f, 0), Vec3f(0, 0.8f, 0)})
    for (const Vec3f& pull : {Vec3f(0, 0, 0), Vec3f(0.03f, 0, 0), Vec3f(-0.03f, -0.03f, 0), Vec3f(0, 0, -0.2f)}) {
      const Hit hit = hit_from((toward + aside).normalized(), frame);
      const GraspState grasp{.node = hit.node};
      const Hold hold{surface_point(hit, frame, *frame.surface_mesh), hit.point + pull};
      const HeldPatch patch = held_patch(grasp, hold, frame, frame.surface_mesh.get(), camera.eye());
      CHECK((patch.place - hit.point).norm() < 0.01f * radius);
      CHECK(patch.place.norm() > 0.995f * radius);  // the drawn skin is rounder than the triangle
      CHECK(patch.normal.dot(patch.place.normalized()) > 0.99f);
      const auto jaws = jaw_models(patch, camera, radius);
      CHECK(nearest_to_origin(jaws) > 0.99f * radius);
      const Vec3f apart = tip_of(jaws[0]) - tip_of(jaws[1]), middle = (tip_of(jaws[0]) + tip_of(jaws[1])) / 2;
      CHECK(apart.norm() > 0.03f * radius);
      CHECK(std::abs(apart.normalized().dot(patch.normal)) < 1e-3f);  // along the skin
      CHECK((middle - patch.place).norm() < 0.03f * radius);
    }
}

TEST_CASE("jaws follow the tissue and not the hand, and the pull is what lies between them") {
  Frame frame = frame_at_rest(ball_surface(3, radius));
  const Camera camera = camera_on_ball();
  const Hit hit = hit_from(Vec3f(0.3f, 0.4f, 1).normalized(), frame);
  const Vec3f hand = hit.point + Vec3f(0.04f, 0.05f, 0);
  const Hold hold{surface_point(hit, frame, *frame.surface_mesh), hand};
  const GraspState grasp{.node = hit.node, .target = hand.cast<double>()};
  const auto patch = [&] { return held_patch(grasp, hold, frame, frame.surface_mesh.get(), camera.eye()); };
  const HeldPatch before = patch();
  const Vec3f moved(0.01f, 0.02f, 0.005f);
  for (Vec3f& x : frame.positions) x += moved;
  const HeldPatch after = patch();
  CHECK((after.place - before.place - moved).norm() < 1e-6f);
  CHECK((after.place + after.pull - hand).norm() < 1e-6f);
  CHECK((before.place + before.pull - hand).norm() < 1e-6f);
}

TEST_CASE("each hand has the hold of its number") {
  const HandDrawing hands{{{{}, Vec3f(1, 0, 0), 0}, {{}, Vec3f(2, 0, 0), 14}}, {}};
  REQUIRE(hands.hold_of(14));
  CHECK(hands.hold_of(14)->hand.x() == 2);
  CHECK(hands.hold_of(0)->hand.x() == 1);
  CHECK_FALSE(hands.hold_of(1));
}

TEST_CASE("forceps that hold nothing are open, with their tips at the place and their handle towards the eye") {
  const Camera camera = camera_on_ball();
  const Vec3f tip(0.01f, -0.02f, 0.03f);
  const HeldPatch patch = free_patch(tip, camera);
  const auto free = jaw_models(patch, camera, radius, true), closed = jaw_models(patch, camera, radius);
  const auto gap = [](const std::array<Mat4f, 2>& jaws) { return (tip_of(jaws[0]) - tip_of(jaws[1])).norm(); };
  CHECK(gap(free) > 2 * gap(closed));
  CHECK(((tip_of(free[0]) + tip_of(free[1])) / 2 - tip).norm() < 0.05f * radius);
  CHECK(handle_axis(patch, camera, radius).dot(camera.backward()) > 0.3f);
}

TEST_CASE("without a mouse, or where its triangle is gone, the jaws hold the grasped node") {
  const Frame frame = frame_at_rest(ball_surface(2, radius));
  const Vec3f eye(0, 0, 1);
  const Vec3f target(0.1f, 0, 0);
  const GraspState grasp{.node = 7, .target = target.cast<double>(), .grip = Vec3(0.01, 0.02, 0.03)};
  const HeldPatch scripted = held_patch(grasp, std::nullopt, frame, frame.surface_mesh.get(), eye);
  CHECK(scripted.place == frame.positions[7]);
  CHECK(scripted.normal.dot(frame.positions[7].normalized()) > 0.99f);
  CHECK((scripted.place + scripted.pull - target).norm() < 1e-6f);
  const Hold lost{{{0, 1, 7}, {0.2f, 0.4f, 0.4f}}, Vec3f::Zero()};  // no triangle has these corners
  CHECK(held_patch(grasp, lost, frame, frame.surface_mesh.get(), eye).place == scripted.place);
  const HeldPatch inside = held_patch({.node = 999, .grip = grasp.grip}, std::nullopt, frame, frame.surface_mesh.get(),
                                      eye);
  CHECK(inside.place == grasp.grip.cast<float>());
  CHECK(inside.normal.dot((eye - inside.place).normalized()) > 0.999f);
  CHECK(held_patch(grasp, std::nullopt, frame, nullptr, eye).place == grasp.grip.cast<float>());
}

TEST_CASE("a clamp stands on the grasped node with its rings away from the skin") {
  const Frame frame = frame_at_rest(ball_surface(3, radius));
  const Camera camera = camera_on_ball();
  for (const int node : {0, 5, 40, 100}) {
    const Vec3 place = frame.positions[static_cast<std::size_t>(node)].cast<double>();
    const GraspState clamp{.hand = 3, .node = node, .target = place};
    CHECK(is_clamp(clamp));
    for (const int person : {0, first_device_hand, max_hands - 1}) CHECK_FALSE(is_clamp({.hand = person}));
    const HeldPatch patch = held_patch(clamp, std::nullopt, frame, frame.surface_mesh.get(), camera.eye());
    CHECK(patch.place == frame.positions[static_cast<std::size_t>(node)]);
    float nearest = 1, to_node = 1, farthest = 0;
    for (const Mat4f& half : clamp_models(patch, camera, radius))
      for (const SolidShape::Vertex& vertex : scissors_half().vertices) {
        const Vec3f x = (half * vertex.position.homogeneous()).head<3>();
        nearest = std::min(nearest, x.norm());
        to_node = std::min(to_node, (x - patch.place).norm());
        farthest = std::max(farthest, (x - patch.place).norm());
      }
    CHECK(nearest > 0.985f * radius);
    CHECK(to_node < 0.03f * radius);
    CHECK(farthest == doctest::Approx(clamp_length * radius).epsilon(0.06));
  }
}

TEST_CASE("beyond an edge of a box the skin is not drawn rounder, and the jaws stand on the flat face") {
  const Frame frame = frame_at_rest(cube_surface());
  const Vec3f point(0.2f, 0.1f, 0.5f);
  const auto hit = pick(frame, *frame.surface_mesh, {{0.2f, 0.1f, 5}, {0, 0, -1}});
  REQUIRE(hit);
  const Hold hold{surface_point(*hit, frame, *frame.surface_mesh), point};
  const HeldPatch patch = held_patch({.node = hit->node}, hold, frame, frame.surface_mesh.get(), {0, 0, 5});
  CHECK((patch.place - point).norm() < 1e-5f);
  CHECK((patch.normal - Vec3f::UnitZ()).norm() < 1e-5f);
}

}  // namespace heml::render::grasp_pose_test
