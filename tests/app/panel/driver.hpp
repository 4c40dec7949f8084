#pragma once
// Drives a panel without a window: moves the mouse, presses buttons, returns the panel's actions.
#include <doctest/doctest.h>
#include <imgui.h>

#include <app/panel/panel.hpp>
#include <app/panel/theme.hpp>
#include <string>

namespace heml::test {

class ImguiContext {
 public:
  ImguiContext(float width, float height, float scale) : context_(ImGui::CreateContext()) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    io.DeltaTime = 1.0f / 60;
    panel::apply_theme(scale);
    io.Fonts->Build();
  }
  ~ImguiContext() { ImGui::DestroyContext(context_); }
  ImguiContext(const ImguiContext&) = delete;
  ImguiContext& operator=(const ImguiContext&) = delete;

 private:
  ImGuiContext* context_;
};

/// One tetrahedron of soft tissue, with another material in region 2.
inline Scene small_scene() {
  Scene scene;
  scene.name = "small";
  const LameParameters lame = lame_parameters(1e4, 0.3);
  scene.materials = {{std::nullopt, {"neo_hookean", {lame.lambda, lame.mu}, 1000}}, {2, {"stvk", {2e4, 1e4}, 1100}}};
  scene.gravity = Vec3(0, -9.81, 0);
  return scene;
}

inline SurfaceMesh small_surface() {
  SurfaceMesh surface_mesh;
  surface_mesh.nodes = {10, 11, 12, 13};
  surface_mesh.rest = {{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, {0, 0, 0.1f}};
  surface_mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  surface_mesh.regions = {0, 0, 0, 0};
  return surface_mesh;
}

class Driver {
 public:
  explicit Driver(const Scene& scene = small_scene(), float width = 1280, float height = 760, float scale = 1,
                  std::map<int, std::string> region_names = {}, std::vector<int> regions = {})
      : context_(width, height, scale),
        panel(scene, small_surface(), std::move(region_names), std::move(regions)) {
    frame.positions = small_surface().rest;
    away();
    for (int k = 0; k < 3; ++k) draw();
  }

  panel::PanelActions draw() {
    panel.update(frame, 1.0f / 60);
    ImGui::NewFrame();
    panel::PanelActions actions = panel.draw(frame);
    ImGui::Render();
    return actions;
  }

  void move(ImVec2 to) { ImGui::GetIO().MousePos = to; }
  void away() { move({640, 700}); }
  void hold(bool down) { ImGui::GetIO().MouseDown[0] = down; }

  /// Moves the mouse down a column of the image until it is on the row or entry of that label; fails if there is none.
  ImVec2 find(const std::string& label, float x = 200) {
    for (float y = 2; y < ImGui::GetIO().DisplaySize.y; y += 4) {
      move({x, y});
      draw();
      if (panel.hovered() == label) return {x, y};
    }
    FAIL("no row called ", label);
    return {};
  }

  /// Clicks where the mouse is. Returns all actions of the frames it takes.
  panel::PanelActions click() {
    hold(true);
    panel::PanelActions all = draw();
    hold(false);
    for (int k = 0; k < 2; ++k) {
      const panel::PanelActions more = draw();
      all.commands.insert(all.commands.end(), more.commands.begin(), more.commands.end());
      all.requests.insert(all.requests.end(), more.requests.begin(), more.requests.end());
      if (more.show) all.show = more.show;
      if (more.open) all.open = more.open;
      if (more.mesh_options) all.mesh_options = more.mesh_options;
      if (more.list_folder) all.list_folder = more.list_folder;
      if (more.comparisons) all.comparisons = more.comparisons;
      if (more.seek_to) all.seek_to = more.seek_to;
      if (more.view) all.view = more.view;
      if (more.look) all.look = more.look;
      if (more.orthographic) all.orthographic = more.orthographic;
      if (more.save_view) all.save_view = more.save_view;
    }
    return all;
  }
  panel::PanelActions click(const std::string& label, float x = 200) {
    find(label, x);
    return click();
  }

  /// Opens a choice and clicks one of its entries.
  panel::PanelActions choose(const std::string& label, const std::string& entry) {
    click(label);
    return click(entry);
  }

 private:
  ImguiContext context_;

 public:
  panel::Panel panel;
  Frame frame;
};

}  // namespace heml::test
