#pragma once
// A box with a cut from its top, in the state in which the cut was made: its lips lie together.
#include <heml/mesh/generate.hpp>
#include <heml/session/original_skin.hpp>
#include <heml/session/surface_mesh.hpp>

namespace heml {

struct CutBody {
  static constexpr double side = 0.08;
  std::shared_ptr<const SurfaceMesh> whole, cut;

  /// An oblique plane to half the depth of the box, which passes beside the nodes of the mesh.
  CutBody() {
    WorldSetup setup;
    setup.mesh = make_box(Vec3::Constant(side), {8, 8, 8});
    setup.materials = {{std::nullopt, {"stvk", {2e4, 1e4}, 1000}}};
    const auto world = make_world(setup);
    whole = make_surface_mesh(*world);
    const Vec3 from(0.033, -0.01, 0.041), to(0.047, 0.09, 0.041), up(0, 0, 0.06);
    if (!world->apply(CutTissue{{{{from, from + up}, {to, to + up}}}, false}).ok()) throw std::logic_error("no cut");
    cut = make_surface_mesh(*world, whole);
  }

  /// Distance from the plane of the cut, m.
  static float beside(const Vec3f& x) {
    const Vec3f normal = Vec3f(0.1f, -0.014f, 0).normalized();
    return std::abs(normal.dot(x - Vec3f(0.033f, -0.01f, 0)));
  }
};

}  // namespace heml
