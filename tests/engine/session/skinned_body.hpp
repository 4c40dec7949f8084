#pragma once
// A box of 8 cm under a fine skin, and what edits make of both.
#include <heml/mesh/generate.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/session/skin_cutter.hpp>
#include <heml/session/surface_mesh.hpp>
#include <heml/world/world.hpp>
#include <stdexcept>

namespace heml::test {

struct SkinnedBody {
  static constexpr double side = 0.08;
  std::unique_ptr<World> world;
  std::shared_ptr<const SurfaceMesh> whole;
  std::shared_ptr<Skin> skin = std::make_shared<Skin>();

  /// The skin is a grid on each side of the box, `above` it; its triangles are a third of the body's.
  explicit SkinnedBody(double above) {
    WorldSetup setup;
    setup.mesh = make_box(Vec3::Constant(side), {6, 6, 6});
    setup.materials = {{std::nullopt, {"stvk", {2e4, 1e4}, 1000}}};
    world = make_world(setup);
    whole = make_surface_mesh(*world);
    take(shell(side + 2 * above, 17));
  }
  /// The surface of a cube about the same middle, of cells² squares a side.
  static TriangleMesh shell(double size, int cells) {
    const TetMesh fine = make_box(Vec3::Constant(size), {cells, cells, cells}, Vec3::Constant((side - size) / 2));
    TriangleMesh surface{{}, extract_boundary(fine).triangles, "shell"};
    std::vector<int> numbers(fine.nodes.size(), -1);
    for (Triangle& t : surface.triangles)
      for (int& n : t) {
        int& number = numbers[static_cast<std::size_t>(n)];
        if (number < 0) {
          number = static_cast<int>(surface.nodes.size());
          surface.nodes.push_back(fine.nodes[static_cast<std::size_t>(n)]);
        }
        n = number;
      }
    return surface;
  }
  void take(TriangleMesh surface) {
    skin->surface.mesh = std::move(surface);
    skin->embedding = embed(skin->surface.mesh.nodes, world->setup().mesh);
  }
  void apply(const Command& command) {
    if (const Status status = world->apply(command); !status.ok()) throw std::logic_error(status.message());
  }
  /// Through the whole box, along x = from at y = 0 to x = to at the other side.
  void sever(double from, double to) {
    const Vec3 a(from, -0.01, -0.01), b(to, side + 0.01, -0.01), up(0, 0, side + 0.02);
    apply(CutTissue{{{{a, a + up}, {b, b + up}}}, false});
  }
  std::shared_ptr<const SurfaceMesh> surface() const { return make_surface_mesh(*world, whole); }
  std::shared_ptr<const Skin> cut() const {
    return SkinCutter(skin, whole).cut(*surface(), *world->topology(), world->setup().mesh);
  }
};

inline double area(const TriangleMesh& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](int n) -> const Vec3& { return surface.nodes[static_cast<std::size_t>(n)]; };
    sum += (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
  }
  return sum;
}

}  // namespace heml::test
