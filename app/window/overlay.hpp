#pragma once
// Marks over the picture, under the panel: what would be grasped, and how hard the tool pulls.
#include <app/panel/camera_controller.hpp>
#include <app/render/field_colours.hpp>
#include <app/render/pick.hpp>

namespace heml::window {

/// A ring on the surface round the point under the mouse, of the grasp's radius (m); red where the body cannot be
/// taken.
void draw_ring(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh,
               const panel::CameraController& controller, double radius);

/// What the colours say at the point under the mouse: the field's value there, in the unit of a colour range, and the
/// nearest node. Nothing where the body shows no field.
void draw_reading(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh,
                  const panel::CameraController& controller, const render::Range& range);

/// Forces in newtons beside the tools that are at work: grasp, pins, probe, sutures.
void draw_forces(const Frame& frame, const panel::CameraController& controller);

/// The end of a suture that waits for its other one. node: mesh-file number.
void draw_suture_end(int node, const Frame& frame, const SurfaceMesh& surface_mesh,
                     const panel::CameraController& controller);

/// The edges of the first bad element of a frame's recovery, over everything that hides it.
void draw_bad_element(const Frame& frame, const panel::CameraController& controller);

}  // namespace heml::window
