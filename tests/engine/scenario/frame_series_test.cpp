#include <doctest/doctest.h>
#include <fmt/format.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/base/error.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/scenario/frame_series.hpp>
#include <heml/scenario/text_file.hpp>
#include <sstream>

namespace heml::frame_series_test {
namespace {

/// The part of `text` between `from` and `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  REQUIRE(begin != std::string::npos);
  return text.substr(begin + from.size(), text.find(to, begin) - begin - from.size());
}

std::vector<double> array_of(const std::string& vtu, const std::string& name) {
  const std::string array = between(vtu, fmt::format("Name=\"{}\"", name), "</DataArray>");
  std::istringstream numbers(array.substr(array.find('>') + 1));
  std::vector<double> values;
  for (double value = 0; numbers >> value;) values.push_back(value);
  return values;
}

}  // namespace

TEST_CASE("a body written for ParaView is read back as it is, with its fields beside it") {
  const TemporaryFolder folder;
  const auto world = load_world(test::small_scene_with(R"({"gravity": [0, -9.81, 0]})"));
  for (int k = 0; k < 20; ++k) world->tick();
  write_frame(folder / "body.vtu", *world);
  const TetMesh mesh = read_tet_mesh(folder / "body.vtu");
  CHECK(mesh.nodes == world->positions());
  CHECK(mesh.tets == world->setup().mesh.tets);
  const std::string text = read_text_file(folder / "body.vtu");
  const std::vector<double> displacement = array_of(text, "displacement"), J = array_of(text, "J");
  REQUIRE(displacement.size() == 3 * mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    for (int i = 0; i < 3; ++i)
      CHECK(displacement[3 * n + static_cast<std::size_t>(i)] == mesh.nodes[n][i] - world->setup().mesh.nodes[n][i]);
  CHECK(J == world->volume_ratios());
  const std::vector<double> stress = array_of(text, "stress");
  REQUIRE(stress.size() == 9 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const auto& [a, b] : {std::pair(1, 3), std::pair(2, 6), std::pair(5, 7)})
      CHECK(stress[9 * t + static_cast<std::size_t>(a)] ==
            doctest::Approx(stress[9 * t + static_cast<std::size_t>(b)]).epsilon(1e-9));
  CHECK(array_of(text, "velocity").size() == 3 * mesh.nodes.size());
  for (const char* name : {"stretch", "von_mises"}) CHECK(array_of(text, name).size() == mesh.nodes.size());
}

TEST_CASE("a surface written as PLY or OBJ is the boundary of what is there, deformed") {
  const TemporaryFolder folder;
  const auto world = load_world(test::small_scene_with(R"({"gravity": [0, -9.81, 0]})"));
  for (int k = 0; k < 20; ++k) world->tick();
  const std::size_t faces = extract_boundary(world->setup().mesh).triangles.size();
  write_frame(folder / "skin.ply", *world);
  write_frame(folder / "skin.obj", *world);
  const std::string ply = read_text_file(folder / "skin.ply"), obj = read_text_file(folder / "skin.obj");
  CHECK(std::stoul(between(ply, "element face ", "\n")) == faces);
  std::size_t lines = 0;
  for (std::size_t at = obj.find("\nf "); at != std::string::npos; at = obj.find("\nf ", at + 1)) ++lines;
  CHECK(lines == faces);
  for (const char* name : {"displacement", "stretch", "von_mises", "volume_ratio"})
    CHECK(ply.find(fmt::format("property double {}", name)) != std::string::npos);
  CHECK_THROWS_AS(write_frame(folder / "skin.stl", *world), InputError);
}

TEST_CASE("a series lists its frames with their times, also while it grows") {
  const TemporaryFolder folder;
  const auto world = load_world(test::small_scene_with("{}"));
  FrameSeries series(folder / "frames", "vtu");
  series.add_frame(*world);
  world->tick();
  series.add_frame(*world);
  CHECK(series.taken() == 2);
  const std::string list = read_text_file(folder / "frames" / "frames.pvd");
  CHECK(list.find("timestep=\"0\" part=\"0\" file=\"frame_00000.vtu\"") != std::string::npos);
  CHECK(std::stod(between(list.substr(list.find("frame_00000")), "timestep=\"", "\"")) == world->time());
  CHECK(std::filesystem::exists(folder / "frames" / "frame_00001.vtu"));
}

}  // namespace heml::frame_series_test
