#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/feb_mesh.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/surface.hpp>
#include <messages.hpp>
#include <set>

#include "engine/mesh/files.hpp"
#include "engine/mesh/samples.hpp"
#include "engine/scenario/feb_files.hpp"

namespace heml::feb_mesh_test {

namespace {

using Names = std::map<int, std::string>;

FebMesh mesh_of(const std::string& text) {
  const XmlDocument document("a.feb", text);
  return read_feb_mesh(feb_root(document));
}

Triangle sorted(Triangle face) {
  std::sort(face.begin(), face.end());
  return face;
}

bool refuses(const std::string& text, const std::string& part) {
  const std::string message = refusal([&] { mesh_of(text); });
  if (message.find(part) != message.npos) return true;
  MESSAGE("'", message, "' does not say '", part, "'");
  return false;
}

}  // namespace

TEST_CASE("reads nodes in their order, tetrahedra, and parts as regions with names, in every version") {
  const TetMesh cube = test::unit_cube();
  for (const char* version : {"2.5", "3.0", "4.0"}) {
    CAPTURE(version);
    test::FebText with;
    with.version = version;
    const FebMesh mesh = mesh_of(test::feb_cube(with));
    CHECK(mesh.read.mesh.nodes == cube.nodes);
    CHECK(mesh.read.mesh.tets == cube.tets);
    CHECK(mesh.read.mesh.regions == std::vector<int>{1, 1, 2, 2, 2});
    CHECK(mesh.read.mesh.region_names == Names{{1, "core"}, {2, "shell"}});
    CHECK(mesh.node_sets.at("x1") == std::vector<int>{1, 3, 5, 7});
    CHECK(mesh.node_sets.at("body").size() == 8);
    CHECK(mesh.surfaces.at("z0").triangles.size() == 2);
    CHECK(mesh.surfaces.at("z0").nodes == std::vector<int>{0, 1, 2, 3});
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[1].material == (std::string(version) == "2.5" ? "1" : "stuff"));
  }
}

TEST_CASE("the sample's tetrahedra have the nodes and parts of the other formats' samples") {
  const TetMesh mesh = read_feb("a.feb", samples::feb).mesh;
  CHECK(mesh.nodes == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}});
  CHECK(mesh.tets == std::vector<Tet>{{0, 1, 2, 3}, {1, 2, 3, 4}});
  CHECK(mesh.region_names == Names{{1, "left lobe"}, {2, "right"}});
}

TEST_CASE("a FEBio file serves as a mesh by its ending") {
  const TemporaryFolder folder;
  const TetMesh mesh = read_tet_mesh(folder.file("cube.feb", test::feb_cube({})));
  CHECK(mesh.tets == test::unit_cube().tets);
  CHECK(is_tet_mesh_file("model.FEB"));
}

TEST_CASE("ten-node tetrahedra have their mid-edge nodes in the order of FEBio") {
  std::string nodes;
  for (int n = 1; n <= 10; ++n) nodes += "<node id=\"" + std::to_string(n) + "\">" + std::to_string(n) + ",0,0</node>";
  const FebMesh mesh =
      mesh_of("<febio_spec version=\"4.0\"><Mesh><Nodes>" + nodes +
              "</Nodes><Elements type=\"tet10\" name=\"p\"><elem id=\"1\">1,2,3,4,5,6,7,8,9,10</elem>"
              "</Elements><Surface name=\"s\"><tri6 id=\"1\">1,2,3,5,6,7</tri6></Surface></Mesh></febio_spec>");
  CHECK(mesh.read.mesh.tets == std::vector<Tet>{{0, 1, 2, 3}});
  REQUIRE(mesh.read.midedges.size() == 1);
  // tet_edges are 01 02 03 12 13 23, the file's middles those of 01 12 20 03 13 23.
  CHECK(mesh.read.midedges[0] == std::array{4, 6, 7, 5, 8, 9});
  CHECK(mesh.surfaces.at("s").triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.surfaces.at("s").nodes == std::vector<int>{0, 1, 2, 4, 5, 6});
}

TEST_CASE("other solids are counted, and shells are no solids") {
  const std::string text = test::feb_cube({});
  const std::string brick = "<Elements type=\"hex20\" name=\"h\"><elem id=\"9\">1,2,3,4,5,6,7,8</elem></Elements>";
  CHECK(mesh_of(replaced(text, "<NodeSet", brick + "<NodeSet")).read.ignored == 1);
  CHECK(mesh_of(replaced(text, "<NodeSet", replaced(brick, "hex20", "quad4") + "<NodeSet")).read.ignored == 0);
}

TEST_CASE("bricks are divided, and the quadrilaterals of surfaces as their sides are") {
  for (const std::array<int, 8>& order : {std::array{1, 2, 4, 3, 5, 6, 8, 7}, std::array{7, 3, 1, 5, 8, 4, 2, 6}}) {
    std::string nodes, brick;  // node i + 2 j + 4 k + 1 at (i, j, k)
    for (int n = 0; n < 8; ++n)
      nodes += fmt::format("<node id=\"{}\">{},{},{}</node>", n + 1, n & 1, n >> 1 & 1, n >> 2 & 1);
    for (const int id : order) brick += fmt::format("{}{}", brick.empty() ? "" : ",", id);
    const FebMesh mesh =
        mesh_of("<febio_spec version=\"4.0\"><Mesh><Nodes>" + nodes +
                "</Nodes><Elements type=\"hex8\" name=\"p\"><elem id=\"1\">" + brick +
                "</elem></Elements><Surface name=\"top\"><quad4 id=\"1\">8,7,5,6</quad4></Surface>" +
                "<Surface name=\"other\"><quad8 id=\"1\">8,7,5,6,1,2,3,4</quad8></Surface></Mesh></febio_spec>");
    CHECK(mesh.read.mesh.tets.size() == 6);
    CHECK(mesh.read.mesh.regions == std::vector<int>(6, 1));
    CHECK(mesh.read.mesh.region_names.at(1) == "p");
    CHECK(mesh.parts[0].divided);
    CHECK(mesh.surfaces.at("top").nodes == std::vector<int>{4, 5, 6, 7});
    CHECK(mesh.surfaces.at("other").has_other_facets);
    std::set<Triangle> faces;  // by their sorted nodes
    for (const Triangle& face : extract_boundary(mesh.read.mesh).triangles) faces.insert(sorted(face));
    CHECK(faces.size() == 12);
    for (const Triangle& facet : mesh.surfaces.at("top").triangles) CHECK(faces.contains(sorted(facet)));
  }
}

TEST_CASE("a damaged mesh is refused with its line") {
  const std::string text = test::feb_cube({});
  CHECK(refuses("<html/>", "line 1: is no FEBio file"));
  CHECK(refuses("<febio_spec version=\"1.2\"/>", "is of version '1.2' (2.5, 3.0 or 4.0"));
  CHECK(refuses("<febio_spec version=\"4.0\"/>", "has no <Mesh>"));
  CHECK(refuses(replaced(text, "<Mesh>", "<Mesh from=\"other.feb\">"), "another file is included"));
  CHECK(refuses(replaced(text, "<node id=\"20\">", "<node id=\"10\">"), "node number 10 is given twice"));
  CHECK(refuses(replaced(text, "<node id=\"20\">", "<node id=\"9999999999\">"), "should be a whole number"));
  CHECK(refuses(replaced(text, "<node id=\"20\">1, 0, 0", "<node id=\"20\">1, 0"),
                "line 7: the place of a node should be 3"));
  CHECK(refuses(replaced(text, "<node id=\"20\">", "<node id=\"21\">"), "names node 20, which the file does not give"));
  CHECK(refuses(replaced(text, "<SolidDomain name=\"core\"", "<SolidDomain name=\"rind\""), "names the part 'rind'"));
  CHECK(refuses(replaced(text, "<NodeSet name=\"all\"", "<NodeSet"), "a <NodeSet> without a name"));
  CHECK(refuses(replaced(text, "<NodeSet", "<Part name=\"p\"/><NodeSet"), "a <Part>, of an assembly"));
}

}  // namespace heml::feb_mesh_test
