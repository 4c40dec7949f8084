// Scenes whose materials use fields of the mesh.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quadratic.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <limits>

namespace heml::material_fields_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A box of five tetrahedra with fields: element 0, the inner one, has a third of the volume, the others a sixth each.
TetMesh field_mesh() {
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {1, 1, 1});
  mesh.regions = {1, 1, 1, 2, 2};
  mesh.fields = {{"E", 1, {1000, 2000, 3000, 4000, 5000}},
                 {"nu", 1, {0.1, 0.2, 0.3, 0.4, 0.45}},
                 {"bad", 1, {1, nan, 1, -1, 1}},
                 {"holes", 3, {1, 0, 0, 1, 0, 0, 0, nan, 1, 1, 0, 0, 1, 0, 0}},
                 {"direction", 3, {2, 0, 0, 0, 3, 0, 0, 0, 4, 3, 0, 4, 0, 0, 0}}};
  return mesh;
}

class Body {
 public:
  explicit Body(const TetMesh& mesh = field_mesh()) { write_tet_mesh(folder_ / "body.vtu", mesh); }

  /// more: further keys of the scene.
  Scene scene(const std::string& materials, const std::string& more = "{}") const {
    Json json = Json::parse(test::scene_with(R"({"mesh": {"box": null, "file": "body.vtu"}, "boundary": []})"));
    json["materials"] = Json::parse(materials);
    json.merge_patch(Json::parse(more));
    return parse_scene(json.dump(), folder_ / "scene.json");
  }
  WorldSetup setup(const std::string& materials, const std::string& more = "{}") const {
    return load_setup(scene(materials, more));
  }
  std::string refusal_of(const std::string& materials, const std::string& more = "{}") const {
    return refusal([&] { setup(materials, more); });
  }

 private:
  TemporaryFolder folder_;
};

std::vector<std::string> names_of(const TetMesh& mesh) {
  std::vector<std::string> names;
  for (const ElementField& field : mesh.fields) names.push_back(field.name);
  return names;
}

constexpr const char* stvk_of_E = R"([{"law": "stvk", "lambda": 0, "mu": {"field": "E"}}])";

}  // namespace

TEST_CASE("a parameter that is a field has its mean by volume, and the mesh keeps the fields that are used") {
  const WorldSetup setup = Body().setup(stvk_of_E);
  CHECK(names_of(setup.mesh) == std::vector<std::string>{"E"});
  CHECK(setup.mesh.fields[0].values == field_mesh().fields[0].values);
  const double mean = (2 * 1000 + 2000 + 3000 + 4000 + 5000) / 6.0;
  CHECK(setup.materials[0].material.parameters[1] == doctest::Approx(mean).epsilon(1e-14));
}

TEST_CASE("the mean is over the region's own elements") {
  const WorldSetup setup = Body().setup(R"([{"law": "stvk", "lambda": 0, "mu": {"field": "E"}},
                                            {"region": 2, "law": "stvk", "lambda": 0, "mu": 7}])");
  CHECK(setup.materials[0].material.parameters[1] == doctest::Approx((2 * 1000 + 2000 + 3000) / 4.0).epsilon(1e-14));
}

TEST_CASE("young and poisson as fields become lambda and mu of each element") {
  const WorldSetup setup =
      Body().setup(R"([{"law": "neo_hookean", "young": {"field": "E"}, "poisson": {"field": "nu"}}])");
  REQUIRE(setup.mesh.fields.size() == 2);
  const Material& material = setup.materials[0].material;
  REQUIRE(material.fields.size() == 2);
  const ElementField* lambda = find_field(setup.mesh, material.fields[0].field);
  const ElementField* mu = find_field(setup.mesh, material.fields[1].field);
  REQUIRE(lambda);
  REQUIRE(mu);
  // E 3000 Pa, ν 0.3: λ = 900/(1.3·0.4), μ = 3000/2.6; E 5000 Pa, ν 0.45: λ = 2250/(1.45·0.1), μ = 5000/2.9.
  CHECK(lambda->values[2] == doctest::Approx(900 / 0.52).epsilon(1e-14));
  CHECK(mu->values[2] == doctest::Approx(3000 / 2.6).epsilon(1e-14));
  CHECK(lambda->values[4] == doctest::Approx(2250 / 0.145).epsilon(1e-14));
  CHECK(mu->values[4] == doctest::Approx(5000 / 2.9).epsilon(1e-14));
}

TEST_CASE("a body of two stiffnesses moves the same by a field as by regions") {
  TetMesh mesh = make_box(Vec3(0.2, 0.1, 0.1), {4, 2, 2});
  mesh.fields = {{"E", 1, {}}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.regions[t] = t % 3 == 0 ? 1 : 0;
    mesh.fields[0].values.push_back(t % 3 == 0 ? 3e4 : 1e4);
  }
  const Body body(mesh);
  const std::string more =
      R"({"gravity": [0, -9.81, 0], "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true}]})";
  const auto moved = [&](const std::string& materials) {
    const auto world = load_world(body.scene(materials, more));
    for (int tick = 0; tick < 10; ++tick) world->tick();
    REQUIRE(!world->halt());
    return world->positions();
  };
  const std::vector<Vec3> by_field = moved(R"([{"law": "neo_hookean", "young": {"field": "E"}, "poisson": 0.4}])");
  const std::vector<Vec3> by_region = moved(R"([{"law": "neo_hookean", "young": 1e4, "poisson": 0.4},
                {"region": 1, "law": "neo_hookean", "young": 3e4, "poisson": 0.4}])");
  const std::vector<Vec3> uniform = moved(R"([{"law": "neo_hookean", "young": 1e4, "poisson": 0.4}])");
  double difference = 0, effect = 0;
  for (std::size_t n = 0; n < by_field.size(); ++n) {
    difference = std::max(difference, (by_field[n] - by_region[n]).norm());
    effect = std::max(effect, (by_field[n] - uniform[n]).norm());
  }
  CHECK(difference < 1e-12);
  CHECK(effect > 1e-4);
}

TEST_CASE("fibres become unit vectors and turn with the mesh") {
  const std::string hgo = R"({"region": 1, "law": "hgo", "K1": 500, "kappa": 5e4, "k1": 800, "k2": 2,
                              "fibre": {"field": "direction"}})";
  const std::string rest = R"({"law": "stvk", "young": 1e3, "poisson": 0.3})";
  const std::string turned = R"({"mesh": {"rotate": {"axis": [0, 0, 1], "degrees": 90}}})";
  const WorldSetup setup = Body().setup("[" + hgo + "," + rest + "]", turned);
  REQUIRE(names_of(setup.mesh) == std::vector<std::string>{"direction"});
  const std::vector<double>& d = setup.mesh.fields[0].values;
  CHECK((Vec3(d[0], d[1], d[2]) - Vec3(0, 1, 0)).norm() < 1e-15);
  CHECK((Vec3(d[3], d[4], d[5]) - Vec3(-1, 0, 0)).norm() < 1e-15);
  CHECK((Vec3(d[6], d[7], d[8]) - Vec3(0, 0, 1)).norm() < 1e-15);
}

TEST_CASE(
    "quadratic elements take a fibre for each of their points, which turns with the mesh; linear ones refuse it") {
  TetMesh mesh = field_mesh();
  ElementField field{"points", point_components, std::vector<double>(5 * point_components, 0.0)};
  for (std::size_t k = 0; k < 20; ++k) field.values[3 * k + k % 3] = 2;
  mesh.fields = {field};
  const std::string muscle =
      R"([{"law": "stvk", "lambda": 0, "mu": 5, "active_stress": 9, "fibre": {"field": "points"}}])";
  const std::string quadratic =
      R"({"solver": {"element": "p2"}, "mesh": {"rotate": {"axis": [0, 0, 1], "degrees": 90}}})";
  const WorldSetup setup = Body(mesh).setup(muscle, quadratic);
  const TetMesh points = virtual_tets(setup.mesh, setup.midedges);
  REQUIRE(points.fields.size() == 1);
  CHECK(points.fields[0].components == 3);
  for (std::size_t k = 0; k < 20; ++k) {
    CAPTURE(k);
    const Vec3 expected = k % 3 == 0 ? Vec3::UnitY() : k % 3 == 1 ? Vec3(-1, 0, 0) : Vec3::UnitZ();
    CHECK((Eigen::Map<const Vec3>(&points.fields[0].values[3 * k]) - expected).norm() < 1e-15);
  }
  CHECK(
      says(Body(mesh).refusal_of(muscle), "has 12 numbers an element (3 are wanted; 12 are for \"element\": \"p2\")"));
  const std::string p2 = R"({"solver": {"element": "p2"}})";
  CHECK(says(
      Body().refusal_of(R"([{"law": "stvk", "lambda": 0, "mu": 5, "active_stress": 9, "fibre": {"field": "E"}}])", p2),
      "has 1 numbers an element (3 are wanted, or 12: at its integration points)"));
  for (const std::size_t i : {3 * 14u, 3 * 14u + 1, 3 * 14u + 2}) mesh.fields[0].values[i] = 0;
  CHECK(says(Body(mesh).refusal_of(muscle, p2), "the field 'points' is [0, 0, 0] in element 3"));
}

TEST_CASE("refuses fields the mesh has not, of other size, or with values that are wrong, naming the element") {
  const Body body;
  const auto refuses = [&](const std::string& material, std::initializer_list<const char*> parts) {
    const std::string message = body.refusal_of("[" + material + "]");
    CAPTURE(message);
    CHECK(says(message, "scene.json: materials[0]."));
    for (const char* part : parts) CHECK(says(message, part));
  };
  refuses(R"({"law": "stvk", "lambda": 0, "mu": {"field": "e"}})",
          {"materials[0].mu: ", "body.vtu has no field 'e'", "E (1), nu (1), bad (1), holes (3), direction (3)"});
  refuses(R"({"law": "stvk", "lambda": 0, "mu": {"field": "direction"}})",
       {"materials[0].mu: the field 'direction' of", "has 3 numbers an element (1 are wanted)"});
  refuses(R"({"law": "hgo", "K1": 5, "kappa": 500, "k1": 8, "k2": 2, "fibre": {"field": "E"}})",
       {"materials[0].fibre: the field 'E' of", "has 1 numbers an element (3 are wanted)"});
  refuses(R"({"law": "hgo", "K1": 5, "kappa": 500, "k1": 8, "k2": 2, "fibre": {"field": "direction"}})",
       {"materials[0].fibre: the field 'direction' is [0, 0, 0] in element 4", "not all of its numbers 0"});
  const auto muscle = [](const char* field) {
    return fmt::format(R"({{"law": "stvk", "lambda": 0, "mu": 5, "active_stress": 9, "fibre": {{"field": "{}"}}}})",
                       field);
  };
  refuses(muscle("dir"), {"materials[0].fibre: ", "body.vtu has no field 'dir'"});
  refuses(muscle("nu"), {"materials[0].fibre: the field 'nu' of", "has 1 numbers an element (3 are wanted)"});
  refuses(muscle("direction"), {"materials[0].fibre: the field 'direction' is [0, 0, 0] in element 4"});
  refuses(muscle("holes"), {"materials[0].fibre: the field 'holes' is [0, nan, 1] in element 2"});
  refuses(R"({"law": "stvk", "lambda": 0, "mu": {"field": "bad"}})",
       {"materials[0].mu: the field 'bad' in element 1: must be finite, is nan"});
  refuses(R"({"law": "stvk", "lambda": -900, "mu": {"field": "E"}})", {"materials[0].lambda: in element 0: "});
  refuses(R"({"law": "stvk", "young": {"field": "bad"}, "poisson": 0.3})",
       {"materials[0].young: the field 'bad' is nan in element 1 (must be greater than 0)"});
  refuses(R"({"law": "stvk", "young": 100, "poisson": {"field": "bad"}})",
       {"materials[0].poisson: the field 'bad' is 1 in element 0 (must be greater than -1 and less than 0.5)"});
  refuses(R"({"law": "stvk", "young": 100, "poisson": {"field": "Nu"}})", {"materials[0].poisson: ", "has no field 'Nu'"});
}

TEST_CASE("values of elements that do not use a field may be anything") {
  CHECK(Body().refusal_of(R"([{"region": 2, "law": "stvk", "lambda": 0, "mu": 5},
    {"law": "stvk", "lambda": 0, "mu": {"field": "bad"}}])") != "");
  TetMesh mesh = field_mesh();
  mesh.regions = {1, 2, 1, 2, 1};
  CHECK(Body(mesh).refusal_of(R"([{"region": 2, "law": "stvk", "lambda": 0, "mu": 5},
    {"law": "stvk", "lambda": 0, "mu": {"field": "bad"}}])") == "");
}

TEST_CASE("says that a mesh has no fields") {
  const std::string message = refusal([] {
    load_setup(test::small_scene_with(R"({"materials": [{"law": "stvk", "lambda": 0, "mu": {"field": "E"}}]})"));
  });
  CHECK(says(message, "has no field 'E' (it has none)"));
}

TEST_CASE("refuses fields in a switch of material") {
  const std::string message = refusal([] {
    test::small_scene_with(
        R"({"events": [{"step": 2, "material": {"law": "stvk", "lambda": 1, "mu": {"field": "E"}}}]})");
  });
  CHECK(says(message, "events[0].material: takes a field of the mesh"));
}

TEST_CASE("a recording knows the fields its materials use, and no others") {
  const Scene scene = Body().scene(stvk_of_E);
  const auto identity = [](const TetMesh& mesh) {
    const Body body(mesh);
    return mesh_fingerprint(body.setup(stvk_of_E).mesh);
  };
  TetMesh mesh = field_mesh();
  const MeshFingerprint before = identity(mesh);
  mesh.fields[1].values[0] = 0.11;
  CHECK(identity(mesh) == before);
  mesh.fields[0].values[0] = std::nextafter(1000, 2000);
  CHECK_FALSE(identity(mesh) == before);
}

TEST_CASE("nodal pressure is refused for laws without a volume term, and with different ones") {
  const auto told = [](const std::string& materials, const std::string& more) {
    Json json = Json::parse(test::scene_with(R"({"solver": {"element": "nodal_pressure"}})"));
    json["materials"] = Json::parse(materials);
    json.merge_patch(Json::parse(more));
    return refusal([&] { parse_scene(json.dump(), "scene.json"); });
  };
  const std::string iso = R"({"law": "neo_hookean_iso", "K1": 500, "kappa": 5e4})";
  const std::string stvk = R"({"region": 2, "law": "stvk", "lambda": 1, "mu": 1})";
  CHECK(told("[" + iso + "]", "{}") == "");
  CHECK(
      says(told("[" + iso + "," + stvk + "]", "{}"), "scene.json: materials[1].law: 'stvk' has no volume term"));
  CHECK(told("[" + iso + "," + stvk + "]", R"({"solver": {"element": "p1"}})") == "");
  CHECK(says(told("[" + iso + R"(, {"region": 2, "law": "gent", "mu": 1, "Jm": 3, "kappa": 9,
                        "volume_term": "logarithmic"}])",
                        "{}"),
                   "materials[1].volume_term: differs"));
  CHECK(says(told("[" + iso + "]", R"({"events": [{"step": 3, "material": )" + stvk + "}]}"),
                   "events: step 3: material.law: 'stvk'"));
}

}  // namespace heml::material_fields_test
