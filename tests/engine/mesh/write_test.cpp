#include <doctest/doctest.h>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/write.hpp>

#include "engine/mesh/files.hpp"

using namespace heml;

TEST_CASE("every format gives back nodes to the bit, tetrahedra and regions") {
  TetMesh mesh = make_box(Vec3(0.1, 0.2, 1.0 / 3), {3, 2, 2}, Vec3(-1e-3, 1e5, 0.7));
  mesh.nodes.emplace_back(4.9e-324, -0.0, 1.7976931348623157e308);  // an orphan of extreme numbers
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

TEST_CASE("refuses to write unknown endings and into folders that are not there") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  const TemporaryFolder folder;
  CHECK(refusal([&] { write_tet_mesh(folder / "a.obj", mesh); }).find("'.obj'") != std::string::npos);
  CHECK(refusal([&] { write_tet_mesh(folder / "none/a.msh", mesh); }).find("cannot be written") != std::string::npos);
  CHECK(refusal([&] { write_tet_mesh("/dev/full/a.msh", mesh); }).find("cannot be written") != std::string::npos);
}
