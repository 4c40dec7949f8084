// The table of commands: its examples, and what is read and written by it.
#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/command_table.hpp>
#include <heml/scenario/scene_reference.hpp>
#include <heml/scenario/schedule.hpp>
#include <set>

namespace heml::command_table_test {
namespace {

Scene scene_with_event(const std::string& key, const Json& value) {
  return test::small_scene_with(Json{{"events", {{{"step", 1}, {key, value}}}}}.dump());
}

Json example_of(const CommandInfo& command) { return Json::parse(command.example); }

std::string refused(const CommandInfo& command, const Json& value) {
  return refusal([&] { scene_with_event(std::string(command.key), value); });
}

}  // namespace

TEST_CASE("the example of every command reads as that command, and reads back as it is written") {
  for (std::size_t k = 0; k < command_table().size(); ++k) {
    const CommandInfo& row = command_table()[k];
    CAPTURE(row.meaning);
    const Scene scene = scene_with_event(std::string(row.key), example_of(row));
    REQUIRE(scene.events.size() == 1);
    CHECK(scene.events[0].command.index() == k);
    CHECK(&info_of(scene.events[0].command) == &row);
    const std::string line = event_line(scene.events[0]);
    const Json written = Json::parse(line);
    CHECK(written.size() == 2);
    CHECK(written.contains(std::string(row.key)));
    CHECK(event_line(scene_with_event(std::string(row.key), written[std::string(row.key)]).events[0]) == line);
  }
}

TEST_CASE("every key of a command that its table describes is read, and has a value where it is not given") {
  for (const CommandInfo& row : command_table())
    for (const KeyInfo& key : row.keys) {
      CAPTURE(row.meaning);
      CAPTURE(std::string(key.name));
      CHECK(usual_text(row, key) != "");
      Json value = example_of(row);
      if (!value.is_object()) value = Json::object();  // the example is the short form
      for (const KeyInfo& other : row.keys)
        if (other.usual == key.usual && key.usual.starts_with("one of")) value.erase(std::string(other.name));
      value[std::string(key.name)] = {{"zzz", 1}};
      CHECK(says(refused(row, value), std::string(row.key) + "." + std::string(key.name)));
    }
}

TEST_CASE("commands of another hand than 0 read back as they are written, and those of hand 0 are short") {
  for (const auto& [key, value] : std::vector<std::pair<std::string, Json>>{
           {"grasp", {{"node", 1}, {"radius", 0.5}, {"hand", 3}}},
           {"grasp", {{"node", 1}, {"radius", 0.5}, {"hidden", {2, 5}}}},
           {"pin", {{"node", 1}, {"radius", 0.5}, {"hidden", {-2}}}},
           {"grasp", {{"node", 1}, {"radius", 0.5}}},
           {"move", {{"to", {1, 2, 3}}, {"hand", 15}}},
           {"move", {1, 2, 3}},
           {"release", {{"hand", 3}}},
           {"release", true},
           {"release", "grasps"}}) {
    const Json written = Json::parse(event_line(scene_with_event(key, value).events[0]));
    CHECK(written.at(key) == value);
  }
  CHECK(std::get<Release>(scene_with_event("release", {{"hand", 0}}).events[0].command).hand == 0);
  CHECK(std::get<MoveTool>(scene_with_event("move", {{"to", {1, 2, 3}}}).events[0].command).hand == 0);
  for (const Json& hand : {Json(-1), Json(16), Json(0.5), Json("left")}) {
    CHECK(says(refusal([&] { scene_with_event("release", {{"hand", hand}}); }), "release.hand"));
    CHECK(says(refusal([&] { scene_with_event("move", {{"to", {1, 2, 3}}, {"hand", hand}}); }), "move.hand"));
  }
}

TEST_CASE("commands that name nodes take places for them") {
  const TetMesh mesh = load_setup(test::small_scene_with("{}")).mesh;
  for (const CommandInfo& row : command_table()) {
    std::set<std::string_view> names;
    for (const KeyInfo& key : row.keys) names.insert(key.name);
    Command command = scene_with_event(std::string(row.key), example_of(row)).events[0].command;
    const auto references = row.references(command);
    CAPTURE(row.meaning);
    const bool names_nodes = !references.empty() && references[0].kind == MeshReference::Kind::node;
    CHECK(names_nodes == (names.contains("point") || names.contains("points")));
    if (!names_nodes) continue;
    set_nodes(command, mesh, {mesh.nodes.back(), mesh.nodes.back()});
    for (const MeshReference& reference : references)
      CHECK(*reference.number == static_cast<int>(mesh.nodes.size()) - 1);
  }
}

TEST_CASE("edits are the commands that change the elements that there are, and undo") {
  std::set<std::string_view> edits;
  for (const CommandInfo& row : command_table())
    if (row.is_edit) edits.insert(row.key);
  CHECK(edits == std::set<std::string_view>{"remove", "cut", "cauterize", "undo"});
}

TEST_CASE("tools are listed in the order of their enumeration, each with a command that takes it up") {
  for (std::size_t k = 0; k < tool_table().size(); ++k) {
    const ToolInfo& tool = tool_table()[k];
    CHECK(static_cast<std::size_t>(tool.tool) == k);
    bool taken_up = false;
    for (const CommandInfo& row : command_table())
      taken_up |= row.tool == tool.tool &&
                  row.takes_up(scene_with_event(std::string(row.key), example_of(row)).events[0].command);
    CHECK(taken_up);
  }
}

}  // namespace heml::command_table_test
