// The tables of keys: what they describe is what is read.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/scene_reference.hpp>
#include <stdexcept>

namespace heml::scene_keys_test {

TEST_CASE("every key of a scene that the tables describe is read, and has a value where it is not given") {
  for (const ObjectInfo& object : scene_objects) {
    CAPTURE(std::string(object.path));
    CHECK_NOTHROW(parse_scene(smallest_scene(object).dump(), "scene.json"));
    for (const KeyInfo& key : object.keys) {
      CAPTURE(std::string(key.name));
      CHECK(usual_text(object, key) != "");
      Json scene = smallest_scene(object);
      Json& place = object_in(scene, object);
      for (const KeyInfo& other : object.keys)
        if (other.usual == key.usual && key.usual != required) place.erase(std::string(other.name));
      place[std::string(key.name)] = {{"zzz", 1}};
      const std::string message = refusal([&] { parse_scene(scene.dump(), "scene.json"); });
      CAPTURE(message);
      CHECK(says(message, key.name.data()));
    }
  }
}

TEST_CASE("what is usual is what a scene has that does not say it") {
  const auto usual = [](std::string_view path, std::string_view name) {
    for (const ObjectInfo& object : scene_objects)
      for (const KeyInfo& key : object.keys)
        if (object.path == path && key.name == name) return usual_text(object, key);
    return std::string("no such key");
  };
  CHECK(usual("solver", "integrator") == "`\"verlet\"`");
  CHECK(usual("mesh.tetgen", "radius_edge_ratio") == "`1.4`");
  CHECK(usual("materials[]", "density") == "`1000`");
  CHECK(usual("boundary[]", "over") == "`0`");
  CHECK(usual("mesh.rotate", "origin") == "`[0, 0, 0]`");
  CHECK(usual("mesh.rotate", "axis") == "required");
  // Those that depend on others are told in words.
  CHECK(usual("solver", "rate") == "1000; implicit methods 100, `static` 30");
  const auto rate = [](const char* integrator) {
    return test::small_scene_with(R"({"solver": {"rate": null, "integrator": ")" + std::string(integrator) + "\"}}")
        .solver.rate;
  };
  CHECK(rate("verlet") == 1000);
  CHECK(rate("bdf2") == 100);
  CHECK(rate("static") == 30);
}

TEST_CASE("reading what a table does not have, or has in another form, is an error of the program") {
  constexpr KeyInfo keys[] = {{"size", form::positive, "m", "", "of it"}};
  const Json json = {{"size", 2}};
  const ObjectReader object(JsonCursor(json, "a.json"), keys);
  double size = 0;
  object.read("size", size);
  CHECK(size == 2);
  bool flag = false;
  CHECK_THROWS_AS(object.read("size", flag), std::logic_error);
  CHECK_THROWS_AS(object.read("colour", size), std::logic_error);
}

}  // namespace heml::scene_keys_test
