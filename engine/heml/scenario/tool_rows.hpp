#pragma once
// Rows of the table of commands: tools that hold, bear on and sew the body.
#include <heml/scenario/command_row.hpp>
#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>

namespace heml::command_rows {

/// A node by its number, or by a place that the schedule finds the nearest surface node of.
inline int node_from(const ObjectReader& object, Points& points) {
  if (object.key().only_one_of({"node", "point"}) == "node") return object.get<int>("node");
  points = {object.get<Vec3>("point")};
  return 0;
}

/// What the rows of commands that take hold of a patch of surface nodes have in common.
template <class Patch>
struct PatchRow : CommonRow {
  static constexpr std::string_view example = R"({"node": 3, "radius": 0.01})";
  static constexpr ValueForm value_form = object_form;
  static constexpr std::span<const KeyInfo> keys = patch_keys;
  static constexpr bool takes_up = true;
  static Command read(const JsonCursor& value, Points& points) {
    const ObjectReader object(value, keys);
    return patch_from(object, points);
  }
  static Patch patch_from(const ObjectReader& object, Points& points) {
    Patch patch;
    patch.node = node_from(object, points);
    object.read("radius", patch.radius);
    if (const auto hidden = object.find("hidden")) patch.hidden = regions_from(*hidden);
    return patch;
  }
  static Json write(const Patch& patch) {
    Json value = {{"node", patch.node}, {"radius", patch.radius}};
    if (!patch.hidden.empty()) value["hidden"] = patch.hidden;
    return value;
  }
};

template <>
struct Row<Grasp> : PatchRow<Grasp> {
  static constexpr std::string_view key = "grasp",
                                    meaning = "takes hold of surface nodes with a spring; replaces what the hand held";
  static constexpr KeyInfo grasp_keys[] = {node_row, point_row, radius_row, hidden_row, hand_row};
  static constexpr std::span<const KeyInfo> keys = grasp_keys;
  static Command read(const JsonCursor& value, Points& points) {
    const ObjectReader object(value, keys);
    Grasp grasp = patch_from(object, points);
    object.read("hand", grasp.hand);
    return grasp;
  }
  static Json write(const Grasp& grasp) {
    Json value = PatchRow::write(grasp);
    if (grasp.hand != 0) value["hand"] = grasp.hand;
    return value;
  }
  static constexpr std::optional<CommandTool> tool = CommandTool::grasp;
  static References references(Grasp& grasp) { return {{node_kind, &grasp.node, "grasp.node"}}; }
};

template <>
struct Row<MoveTool> : CommonRow {
  static constexpr std::string_view key = "move", example = "[0.1, 0, 0]", unit = "m",
                                    meaning = "moves the tool of the grasp there; of another hand than 0: "
                                              "`{\"to\": [x, y, z], \"hand\": 1}`";
  static constexpr ValueForm value_form = form::other("list of three numbers, or object");
  static constexpr KeyInfo move_keys[] = {{"to", form::vector, "m", required, "where the tool is from now on"},
                                          hand_row};
  static constexpr std::span<const KeyInfo> keys = move_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::grasp;
  static Command read(const JsonCursor& value, Points&) {
    if (!value.json().is_object()) return MoveTool{value_of<Vec3>(value, form::vector)};
    const ObjectReader object(value, keys);
    MoveTool move;
    object.read("hand", move.hand);
    move.target = object.get<Vec3>("to");
    return move;
  }
  static Json write(const MoveTool& move) {
    if (move.hand == 0) return vector_json(move.target);
    return {{"to", vector_json(move.target)}, {"hand", move.hand}};
  }
};

template <>
struct Row<Release> : CommonRow {
  static constexpr std::string_view key = "release", example = "true",
                                    meaning = "ends the grasp of hand 0; `{\"hand\": 1}`: of another hand; "
                                              "`\"grasps\"`: of all";
  static constexpr ValueForm value_form = form::other("`true`, object, or `\"grasps\"`");
  static constexpr KeyInfo release_keys[] = {hand_row};
  static constexpr std::span<const KeyInfo> keys = release_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::grasp;
  static Command read(const JsonCursor& value, Points& points);
  static Json write(const Release& release) {
    if (!release.hand) return "grasps";
    return *release.hand == 0 ? Json(true) : Json{{"hand", *release.hand}};
  }
};

inline constexpr std::string_view one_pinned = "one of `node`, `point`, `nodes`";
inline constexpr KeyInfo pin_nodes_row{"nodes", form::other("list of whole numbers ≥ 0"), "", one_pinned,
                                       "these, in the order of the mesh file, inner ones too"};
constexpr KeyInfo pinned_row(KeyInfo row) {
  row.usual = one_pinned;
  return row;
}

template <>
struct Row<PinTissue> : PatchRow<PinTissue> {
  static constexpr std::string_view key = "pin", meaning = "holds surface nodes exactly where they are";
  static constexpr KeyInfo pin_keys[] = {pinned_row(node_row), pinned_row(point_row), pin_nodes_row, radius_row,
                                         hidden_row};
  static constexpr std::span<const KeyInfo> keys = pin_keys;
  static Command read(const JsonCursor& value, Points& points) {
    const ObjectReader object(value, keys);
    if (value.only_one_of({"node", "point", "nodes"}) != "nodes") return patch_from(object, points);
    PinTissue pin;
    pin.nodes = numbers_from(object["nodes"], "node");
    for (const std::string_view of_patch : {"radius", "hidden"})
      if (const auto given = object.find(of_patch)) given->fail("stands with `nodes`", "these are pinned as they are");
    return pin;
  }
  static Json write(const PinTissue& pin) {
    return pin.nodes.empty() ? PatchRow::write(pin) : Json{{"nodes", pin.nodes}};
  }
  static constexpr std::optional<CommandTool> tool = CommandTool::pin;
  static References references(PinTissue& pin) { return {{node_kind, &pin.node, "pin.node"}}; }
};

template <>
struct Row<Unpin> : CommonRow {
  static constexpr std::string_view key = "release", example = R"({"node": 3})",
                                    meaning =
                                        "removes the pin that holds the node; of `nodes`: pins let go of these; "
                                        "`\"pins\"`: all pins";
  static constexpr ValueForm value_form = form::other("object, or `\"pins\"`");
  static constexpr KeyInfo unpin_keys[] = {pinned_row(node_row), pinned_row(point_row), pin_nodes_row};
  static constexpr std::span<const KeyInfo> keys = unpin_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::pin;
  static Command read_object(const JsonCursor& value, Points& points) {
    const ObjectReader object(value, keys);
    if (!object.find("nodes")) return Unpin{node_from(object, points)};
    value.only_one_of({"node", "point", "nodes"});
    return Unpin{std::nullopt, numbers_from(object["nodes"], "node")};
  }
  static Json write(const Unpin& unpin) {
    if (!unpin.nodes.empty()) return {{"nodes", unpin.nodes}};
    return unpin.node ? Json{{"node", *unpin.node}} : Json("pins");
  }
  static References references(Unpin& unpin) {
    return unpin.node ? References{{node_kind, &*unpin.node, "release.node"}} : References();
  }
};

template <>
struct Row<SetTables> : CommonRow {
  static constexpr std::string_view key = "tables",
                                    example = R"([{"point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0.3}])",
                                    meaning = "replaces all tables";
  static constexpr ValueForm value_form = form::other("list as of the scene's `tables`");
  static constexpr std::optional<CommandTool> tool = CommandTool::tables;
  static constexpr bool takes_up = true;
  static Command read(const JsonCursor& value, Points&) { return SetTables{tables_from(value)}; }
  static Json write(const SetTables& set) { return tables_json(set.tables); }
};

/// An event has its nodes by number: only the mesh tells which a place chooses.
inline std::vector<int> numbers_of(const Selection& where, const JsonCursor& entry) {
  if (where.nodes.empty()) entry.fail("chooses nodes by their place", "an event names them: nodes: [0, 1]");
  return where.nodes;
}

template <>
struct Row<SetBoundary> : CommonRow {
  static constexpr std::string_view key = "boundary", example = R"([{"nodes": [0, 3], "fix": true}])",
                                    meaning = "replaces what is held and moved; nodes go to their place at once";
  static constexpr ValueForm value_form = form::other("list as of the scene's `boundary`, with `nodes`");
  static Command read(const JsonCursor& value, Points&) {
    SetBoundary set;
    value.each([&](const JsonCursor& entry) {
      BoundaryEntry read = boundary_from(entry);
      read.motion.nodes = numbers_of(read.where, entry);
      set.entries.push_back(std::move(read.motion));
    });
    return set;
  }
  static Json write(const SetBoundary& set) {
    Json json = Json::array();
    for (const Boundary& motion : set.entries) {
      BoundaryEntry entry;
      entry.where.nodes = motion.nodes;
      entry.motion = motion;
      json.push_back(boundary_json(entry));
    }
    return json;
  }
};

template <>
struct Row<SetLoads> : CommonRow {
  static constexpr std::string_view key = "loads", example = R"([{"nodes": [3, 8], "force": [0, 0.1, 0]}])",
                                    meaning = "replaces all loads";
  static constexpr ValueForm value_form = form::other("list as of the scene's `loads`, with `nodes`");
  static Command read(const JsonCursor& value, Points&) {
    SetLoads set;
    value.each([&](const JsonCursor& entry) {
      LoadEntry read = load_from(entry);
      read.load.nodes = numbers_of(read.where, entry);
      set.entries.push_back(std::move(read.load));
    });
    return set;
  }
  static Json write(const SetLoads& set) {
    Json json = Json::array();
    for (const Load& load : set.entries) {
      LoadEntry entry;
      entry.where.nodes = load.nodes;
      entry.load = load;
      json.push_back(load_json(entry));
    }
    return json;
  }
};

template <>
struct Row<MoveProbe> : CommonRow {
  static constexpr std::string_view key = "probe",
                                    example = R"({"radius": 0.004, "path": [[0, 0.1, 0], [0, 0.05, 0]]})",
                                    meaning =
                                        "moves a rigid rod with round ends along a path, from where it is, or from the "
                                        "first place of the path";
  static constexpr ValueForm value_form = object_form;
  static constexpr KeyInfo probe_keys[] = {
      {"radius", form::positive, "m", required, "of the tip and the rod"},
      {"shaft", form::vector, "m", "", "from the tip's centre to the other end of the axis; 0: a ball"},
      scene_keys::friction_row,
      {"path", form::other("list of `[x, y, z]`, one or more"), "m", required, "places of the tip's centre"},
      {"speed", form::positive, "m/s", "", "along the path"}};
  static constexpr std::span<const KeyInfo> keys = probe_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::probe;
  static constexpr bool takes_up = true;
  static Command read(const JsonCursor& value, Points&) {
    const ObjectReader object(value, keys);
    MoveProbe probe;
    probe.radius = object.get<double>("radius");
    object.read("shaft", probe.shaft);
    object.read("friction", probe.friction);
    object.read("speed", probe.speed);
    object["path"].each([&](const JsonCursor& place) { probe.path.push_back(place.vector()); });
    if (probe.path.empty()) object["path"].fail("is empty", "give one place of the tip or more");
    return probe;
  }
  static Json write(const MoveProbe& probe) {
    Json path = Json::array();
    for (const Vec3& place : probe.path) path.push_back(vector_json(place));
    return {{"radius", probe.radius},
            {"shaft", vector_json(probe.shaft)},
            {"friction", probe.friction},
            {"path", std::move(path)},
            {"speed", probe.speed}};
  }
};

template <>
struct Row<WithdrawProbe> : CommonRow {
  static constexpr std::string_view key = "release", example = "\"probe\"", meaning = "takes the probe away";
  static constexpr ValueForm value_form = form::other("`\"probe\"`");
  static constexpr std::optional<CommandTool> tool = CommandTool::probe;
  static Json write(const WithdrawProbe&) { return "probe"; }
};

template <>
struct Row<SutureTissue> : CommonRow {
  static constexpr std::string_view key = "suture", example = R"({"nodes": [3, 8], "length": 0, "over": 0.5})",
                                    meaning = "ties two nodes by a stiff link that is drawn in";
  static constexpr ValueForm value_form = object_form;
  static constexpr std::string_view ends = "one of `nodes`, `points`";
  static constexpr KeyInfo suture_keys[] = {
      {"nodes", form::other("two whole numbers ≥ 0"), "", ends, "in the order of the mesh file"},
      {"points", form::other("`[[x, y, z], [x, y, z]]`"), "m", ends,
       "the nodes of the surface nearest to them at rest"},
      {"length", form::non_negative, "m", "", "of the link in the end"},
      {"over", form::non_negative, "s", "", "time of drawing in"}};
  static constexpr std::span<const KeyInfo> keys = suture_keys;
  static constexpr std::optional<CommandTool> tool = CommandTool::suture;
  static constexpr bool takes_up = true;
  static Command read(const JsonCursor& value, Points& points) {
    const ObjectReader object(value, keys);
    SutureTissue suture;
    const std::string kind = value.only_one_of({"nodes", "points"});
    if (value[kind].size() != 2) value[kind].refuse("must be two, one for each end");
    for (std::size_t end = 0; end < 2; ++end)
      if (kind == "nodes")
        suture.nodes[end] = value_of<int>(value[kind][end], node_row.form);
      else
        points.push_back(value[kind][end].vector());
    object.read("length", suture.length);
    object.read("over", suture.ramp_time);
    return suture;
  }
  static Json write(const SutureTissue& suture) {
    return {{"nodes", suture.nodes}, {"length", suture.length}, {"over", suture.ramp_time}};
  }
  static References references(SutureTissue& suture) {
    return {{node_kind, &suture.nodes[0], "suture.nodes"}, {node_kind, &suture.nodes[1], "suture.nodes"}};
  }
};

template <>
struct Row<CutSutures> : CommonRow {
  static constexpr std::string_view key = "release", example = "\"sutures\"", meaning = "takes out all sutures";
  static constexpr ValueForm value_form = form::other("`\"sutures\"`");
  static constexpr std::optional<CommandTool> tool = CommandTool::suture;
  static Json write(const CutSutures&) { return "sutures"; }
};

inline Command Row<Release>::read(const JsonCursor& value, Points& points) {
  if (value.json().is_object() && value.json().contains("hand"))
    return Release{ObjectReader(value, Row<Release>::keys).get<int>("hand")};
  if (value.json().is_object()) return Row<Unpin>::read_object(value, points);
  if (value.json().is_string()) {
    if (value.text() == "grasps") return Release{std::nullopt};
    if (value.text() == "pins") return Unpin{};
    if (value.text() == "probe") return WithdrawProbe{};
    if (value.text() == "sutures") return CutSutures{};
    value.refuse("must be true (the grasp), {\"hand\": n} (another hand's), \"grasps\", {\"node\": n} (a pin), "
                 "\"pins\", \"probe\", or \"sutures\"");
  }
  expect_true(value);
  return Release{};
}

}  // namespace heml::command_rows
