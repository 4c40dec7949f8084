// Numbers of a scene by path.
#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <heml/scenario/scene_numbers.hpp>

namespace heml::scene_numbers_test {

namespace {
Json scene() {
  return Json::parse(R"({"materials": [{"law": "stvk", "lambda": 6000, "mu": 4000}, {"law": "x", "C": [1, 2.5]}],
                         "gravity": [0, -9.81, 0], "mesh": {"file": "a.msh"}, "name": "body"})");
}
}  // namespace

TEST_CASE("scene numbers: are read and set by keys and indices") {
  Json json = scene();
  CHECK(number_at(json, "gravity[1]") == -9.81);
  CHECK(number_at(json, "materials[1].C[1]") == 2.5);
  CHECK(number_at(json, "mesh.scale") == 1);
  set_number(json, "gravity[1]", -1);
  set_number(json, "mesh.scale", 2);
  CHECK(json["gravity"][1] == -1);
  CHECK(json["mesh"]["scale"] == 2);
}

TEST_CASE("scene numbers: a path to nothing, to no number, or that is none, is refused by name") {
  for (const char* path : {"", "gravity[3]", "gravity", "name", "materials[2].mu", "materials[0]mu.", "a b",
                           "gravity[x]", "gravity[1", "materials[0].young", "[0]", "gravity[99999999999999999999]"}) {
    CAPTURE(path);
    CHECK_THROWS_AS(number_at(scene(), path), InputError);
  }
}

TEST_CASE("scene numbers: those that no equilibrium depends on are refused, as are paths of another spelling") {
  Json json = scene();
  json.merge_patch(Json::parse(R"({"solver": {"step": 1e-3}, "schema_version": 1,
    "loads": [{"nodes": [1, 2], "pressure": 5, "over": 1}, {"box": [[0, 0, 0], [1, 1, 1]], "force": [1, 2, 3]}],
    "boundary": [{"nodes": [3], "translate": [1, 2, 3], "rotate": {"axis": [1, 0, 0], "degrees": 9}, "over": 1}]})"));
  json["materials"][0]["region"] = 3;
  json["mesh"]["translate"] = {1, 2, 3};
  for (const char* path : {"loads[0].pressure", "loads[1].force[2]", "boundary[0].translate[0]", "materials[0].mu",
                           "boundary[0].rotate.axis[0]", "boundary[0].rotate.degrees"}) {
    CAPTURE(path);
    CHECK(number_at(json, path) != 0);
  }
  for (const char* path :
       {"solver.step", "schema_version", "loads[0].nodes[1]", "loads[0].over", "loads[1].box[1][0]", "boundary[0].over",
        "boundary[0].nodes[0]", "materials[0].region", "materials[0]mu", "mesh.translate[0]"}) {
    CAPTURE(path);
    CHECK_THROWS_WITH_AS(number_at(json, path), doctest::Contains("cannot be fitted"), InputError);
  }
}

TEST_CASE("scene numbers: moduli get the names of the path, and are the same") {
  Json json = scene();
  name_moduli(json, "materials[0].young");
  CHECK(number_at(json, "materials[0].young") == doctest::Approx(4000 * (3 * 6000 + 2 * 4000) / 1e4));
  CHECK(number_at(json, "materials[0].poisson") == doctest::Approx(0.3));
  CHECK(!json["materials"][0].contains("mu"));
  name_moduli(json, "materials[0].mu");
  CHECK(number_at(json, "materials[0].mu") == doctest::Approx(4000));
  CHECK(number_at(json, "materials[0].lambda") == doctest::Approx(6000));
  const Json before = json;
  name_moduli(json, "materials[1].young"), name_moduli(json, "materials[7].young"), name_moduli(json, "gravity[1]");
  CHECK(json == before);
}

}  // namespace heml::scene_numbers_test
