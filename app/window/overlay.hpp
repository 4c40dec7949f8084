#pragma once
// Marks over the image, under the panel: ring of the tool, field value, forces, suture end, bad element.
#include <app/panel/camera_controller.hpp>
#include <app/panel/measure.hpp>
#include <app/render/field_colours.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/render/pick.hpp>
#include <app/render/section.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heml::window {

/// A ring of the tool's radius (m) on the surface at a hit; red at a constrained node.
void draw_ring(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh,
               const panel::CameraController& controller, double radius);

/// The field's value at a hit, with the unit of a colour range, and the nearest node. Nothing if the frame has no
/// field.
void draw_reading(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh,
                  const panel::CameraController& controller, const render::Range& range);

/// Forces (N) next to active grasps, pins, probe and sutures, kept beside the panel.
void draw_forces(const Frame& frame, const render::HandDrawing& hands, const panel::CameraController& controller);

/// Marks on the body are left out with the part of it that this plane, if there is one, leaves out.
using Section = std::optional<render::SectionPlane>;

/// The first end of an unfinished suture. node: mesh-file number.
void draw_suture_end(int node, const Frame& frame, const SurfaceMesh& surface_mesh, const Section& section,
                     const panel::CameraController& controller);

/// Selected nodes (mesh-file numbers, ascending) that the surface has, as dots.
void draw_nodes(const std::vector<int>& nodes, const Frame& frame, const SurfaceMesh& surface_mesh,
                const Section& section, const panel::CameraController& controller);

/// The forces (N) of loads on nodes, as arrows from the middle of theirs, the longest a quarter of the body's radius;
/// without those on `except`, which have an arrow of their own.
void draw_loads(const std::vector<Load>& loads, const std::vector<int>& except, const Frame& frame,
                const SurfaceMesh& surface_mesh, const panel::CameraController& controller);

/// Mean place (m) of nodes (mesh-file numbers) that the surface has; none: it has none of them.
std::optional<Vec3f> middle_of(const std::vector<int>& nodes, const Frame& frame, const SurfaceMesh& surface_mesh);

/// A labelled arrow between two points, m.
void draw_arrow(const Vec3f& from, const Vec3f& to, const std::string& text, std::uint32_t colour,
                const panel::CameraController& controller);

/// Radius of the handle at the tip of an arrow that can be dragged, em.
inline constexpr float arrow_handle = 0.8f;

void draw_arrow_handle(const Vec3f& tip, bool hovered, const panel::CameraController& controller);

/// A closed line, pixels.
void draw_outline(const std::vector<render::Vec2f>& outline);

/// The points of a measure and their lines, with the numbers beside them.
void draw_measured(const panel::Measured& measured, const Section& section, const panel::CameraController& controller);

/// The point (m) that the camera turns about.
void draw_pivot(const Vec3f& point, const panel::CameraController& controller);

/// The edges of the first bad element of a frame's recovery, drawn over the body.
void draw_bad_element(const Frame& frame, const panel::CameraController& controller);

/// Radius of the handle of a section plane, em.
inline constexpr float section_handle = 0.8f;

/// The frame of a section plane about its handle, and the handle. radius: m, of the body.
void draw_section(const render::SectionPlane& plane, const Vec3f& handle, float radius, bool hovered,
                  const panel::CameraController& controller);

}  // namespace heml::window
