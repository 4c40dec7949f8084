#include <doctest/doctest.h>

#include <cmath>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/refine.hpp>
#include <heml/mesh/reorder.hpp>
#include <heml/mesh/subdivide.hpp>
#include <heml/mesh/write.hpp>
#include <limits>

#include "engine/mesh/files.hpp"

namespace heml::write_test {

TEST_CASE("every format gives back nodes to the bit, tetrahedra and regions") {
  TetMesh mesh = make_box(Vec3(0.1, 0.2, 1.0 / 3), {3, 2, 2}, Vec3(-1e-3, 1e5, 0.7));
  mesh.nodes.emplace_back(4.9e-324, -0.0, 1.7976931348623157e308);  // an orphan with extreme coordinates
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.regions[t] = static_cast<int>(t % 3) - 1;
  const TemporaryFolder folder;
  for (const char* name : {"a.msh", "a.mesh", "a.vtk", "a.vtu", "a.node"}) {
    CAPTURE(name);
    write_tet_mesh(folder / name, mesh);
    const TetMesh back = read_tet_mesh(folder / name);
    CHECK(back.nodes == mesh.nodes);
    CHECK(std::signbit(back.nodes.back()[1]));
    CHECK(back.tets == mesh.tets);
    CHECK(back.regions == mesh.regions);
  }
}

TEST_CASE("Gmsh, VTK and VTU give back fields to the bit, their names and places without a number") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  mesh.fields = {{"young's modulus 100% <\"E\" & µ>", 1, {1.0 / 3, 4.9e-324, -0.0, 1e308, 5}},
                 {"fibre", 3, {}},
                 {"a  b", 1, std::vector<double>(5, 2)},
                 {"points", point_components, std::vector<double>(5 * point_components, 0.1)}};
  for (int i = 0; i < 15; ++i) mesh.fields[1].values.push_back(std::sin(i));
  mesh.fields[1].values[7] = std::numeric_limits<double>::quiet_NaN();
  mesh.fields[1].values[8] = -std::numeric_limits<double>::infinity();
  const TemporaryFolder folder;
  for (const char* name : {"a.msh", "a.vtk", "a.vtu"}) {
    CAPTURE(name);
    write_tet_mesh(folder / name, mesh);
    const TetMesh back = read_tet_mesh(folder / name);
    REQUIRE(back.fields.size() == mesh.fields.size());
    for (std::size_t f = 0; f < mesh.fields.size(); ++f) {
      CHECK(back.fields[f].name == mesh.fields[f].name);
      CHECK(back.fields[f].components == mesh.fields[f].components);
      for (std::size_t i = 0; i < mesh.fields[f].values.size(); ++i) {
        const double expected = mesh.fields[f].values[i], got = back.fields[f].values[i];
        CHECK(
            (std::isnan(expected) ? std::isnan(got) : got == expected && std::signbit(got) == std::signbit(expected)));
      }
    }
  }
}

TEST_CASE("Gmsh files give back names of regions, without what would break a line") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  mesh.regions = {3, 3, -1, -1, 3};
  mesh.region_names = {{-1, "Vena cava µ"}, {3, "the \"left\"\nlobe"}, {9, "not there"}};
  const TemporaryFolder folder;
  write_tet_mesh(folder / "a.msh", mesh);
  const TetMesh back = read_tet_mesh(folder / "a.msh");
  CHECK(back.regions == mesh.regions);
  CHECK(back.region_names == std::map<int, std::string>{{-1, "Vena cava µ"}, {3, "the  left  lobe"}, {9, "not there"}});
  mesh.region_names = {{3, "Le\xe9r \xf0\x80\x80\x80"}};  // Latin-1, and a character longer than it need be
  write_tet_mesh(folder / "b.msh", mesh);
  CHECK(read_tet_mesh(folder / "b.msh").region_names == std::map<int, std::string>{{3, "Le?r ????"}});
}

TEST_CASE("names of regions stay through orders, edits and refinement") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  mesh.region_names = {{0, "liver"}};
  CHECK(reordered(mesh, hilbert_order(mesh)).region_names == mesh.region_names);
  CHECK(with_elements(mesh, std::vector<int>{0, 1}).region_names == mesh.region_names);
  CHECK(subdivide_uniformly(mesh).mesh.region_names == mesh.region_names);
  CHECK(refine_longest_edge(mesh, {0}).mesh.region_names == mesh.region_names);
}

TEST_CASE("Medit and TetGen files leave fields out and keep the mesh") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  mesh.fields = {{"E", 1, {1, 2, 3, 4, 5}}};
  const TemporaryFolder folder;
  for (const char* name : {"a.mesh", "a.node"}) {
    write_tet_mesh(folder / name, mesh);
    const TetMesh back = read_tet_mesh(folder / name);
    CHECK(back.tets == mesh.tets);
    CHECK(back.fields.empty());
  }
}

TEST_CASE("refuses to write unknown endings and into folders that are not there") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  const TemporaryFolder folder;
  CHECK(refusal([&] { write_tet_mesh(folder / "a.obj", mesh); }).find("'.obj'") != std::string::npos);
  CHECK(refusal([&] { write_tet_mesh(folder / "none/a.msh", mesh); }).find("cannot be written") != std::string::npos);
  CHECK(refusal([&] { write_tet_mesh("/dev/full/a.msh", mesh); }).find("cannot be written") != std::string::npos);
}

}  // namespace heml::write_test
