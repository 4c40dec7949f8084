#pragma once
// A square of two triangles in z = 0, 0.2 m wide, that faces the camera at +z: what the mouse and devices act on.
#include <app/panel/camera_controller.hpp>
#include <heml/session/frame.hpp>

namespace heml::test {

struct Sheet {
  static constexpr render::Size size{640, 360};
  SurfaceMesh surface_mesh;
  Frame frame;
  panel::CameraController controller;

  Sheet() {
    surface_mesh.nodes = {20, 21, 22, 23};
    surface_mesh.rest = {{-0.1f, -0.1f, 0}, {0.1f, -0.1f, 0}, {0.1f, 0.1f, 0}, {-0.1f, 0.1f, 0}};
    surface_mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    frame.positions = surface_mesh.rest;
    View view;
    view.azimuth = view.elevation = 0;
    controller.fit(view, surface_mesh, size, {});
  }
};

}  // namespace heml::test
