#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/event_json.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/solver_json.hpp>
#include <heml/scenario/vector_json.hpp>
#include <limits>

namespace heml {
namespace {

constexpr long last_tick = 1'000'000'000'000;
constexpr long max_budget_iterations = 1000;  // of a stage

long tick_from(const JsonCursor& key, double tick_length) {
  if (key.only_one_of({"step", "at"}) == "step") return key["step"].integer(0, last_tick);
  const double tick = std::round(key["at"].non_negative() / tick_length);
  if (!(tick <= static_cast<double>(last_tick))) key["at"].refuse(fmt::format("must be at most {} ticks", last_tick));
  return static_cast<long>(tick);
}

/// A node by its number, or by a place that the schedule finds the nearest surface node of.
int node_from(const JsonCursor& key, std::vector<Vec3>& points) {
  if (key.only_one_of({"node", "point"}) == "node")
    return static_cast<int>(key["node"].integer(0, std::numeric_limits<int>::max()));
  points = {key["point"].vector()};
  return 0;
}

Grasp grasp_from(const JsonCursor& key, std::vector<Vec3>& points) {
  key.allow({"node", "point", "radius"});
  Grasp grasp;
  grasp.node = node_from(key, points);
  if (const auto radius = key.find("radius")) grasp.radius = radius->non_negative();
  return grasp;
}

PinTissue pin_from(const JsonCursor& key, std::vector<Vec3>& points) {
  key.allow({"node", "point", "radius"});
  PinTissue pin{node_from(key, points)};
  if (const auto radius = key.find("radius")) pin.radius = radius->non_negative();
  return pin;
}

void expect_true(const JsonCursor& key) {
  if (!key.flag()) key.refuse("must be true, or leave the entry out");
}

std::vector<std::uint16_t> node_hashes_from(const JsonCursor& key) {
  const std::string digits = key.text();
  std::vector<std::uint16_t> hashes(digits.size() / 4);
  bool right = digits.size() % 4 == 0;
  for (std::size_t i = 0; i < hashes.size() && right; ++i) {
    const char* begin = digits.data() + 4 * i;
    right = std::from_chars(begin, begin + 4, hashes[i], 16).ptr == begin + 4;
  }
  if (!right) key.refuse("must be 4 hexadecimal digits a node");
  return hashes;
}

MoveProbe probe_from(const JsonCursor& key) {
  key.allow({"radius", "shaft", "friction", "path", "speed"});
  MoveProbe probe;
  probe.radius = key["radius"].positive();
  if (const auto shaft = key.find("shaft")) probe.shaft = shaft->vector();
  if (const auto friction = key.find("friction")) probe.friction = friction->non_negative();
  if (const auto speed = key.find("speed")) probe.speed = speed->positive();
  key["path"].each([&](const JsonCursor& place) { probe.path.push_back(place.vector()); });
  if (probe.path.empty()) key["path"].fail("is empty", "give one place of the tip or more");
  return probe;
}

SutureTissue suture_from(const JsonCursor& key, std::vector<Vec3>& points) {
  key.allow({"nodes", "points", "length", "over"});
  SutureTissue suture;
  const std::string kind = key.only_one_of({"nodes", "points"});
  if (key[kind].size() != 2) key[kind].refuse("must be two, one for each end");
  for (std::size_t end = 0; end < 2; ++end)
    if (kind == "nodes")
      suture.nodes[end] = static_cast<int>(key[kind][end].integer(0, std::numeric_limits<int>::max()));
    else
      points.push_back(key[kind][end].vector());
  if (const auto length = key.find("length")) suture.length = length->non_negative();
  if (const auto ramp_time = key.find("over")) suture.ramp_time = ramp_time->non_negative();
  return suture;
}

/// true: the grasp; "pins": all of them; a node: the pin that holds it; "probe" and "sutures" likewise.
Command release_from(const JsonCursor& key, std::vector<Vec3>& points) {
  if (key.json().is_object()) {
    key.allow({"node", "point"});
    return Unpin{node_from(key, points)};
  }
  if (key.json().is_string()) {
    if (key.text() == "pins") return Unpin{};
    if (key.text() == "probe") return WithdrawProbe{};
    if (key.text() == "sutures") return CutSutures{};
    key.refuse("must be true (the grasp), \"pins\", \"probe\", \"sutures\", or {\"node\": n} of a pin");
  }
  expect_true(key);
  return Release{};
}

CutTissue cut_from(const JsonCursor& key) {
  key.allow({"sweep", "goes_on"});
  CutTissue cut;
  key["sweep"].each([&](const JsonCursor& blade) {
    if (blade.size() != 2) blade.refuse("must be the two ends of the blade, [[x, y, z], [x, y, z]]");
    cut.sweep.blades.push_back({blade[0].vector(), blade[1].vector()});
  });
  if (cut.sweep.blades.size() < 2) key["sweep"].refuse("must have the blade at two times at least");
  if (const auto continues_stroke = key.find("goes_on")) cut.continues_stroke = continues_stroke->flag();
  return cut;
}

/// The command an action of that name stands for.
Command command_from(const JsonCursor& key, const std::string& action, std::vector<Vec3>& points) {
  const JsonCursor value = key[action];
  if (action == "grasp") return grasp_from(value, points);
  if (action == "tables") return SetTables{tables_from(value)};
  if (action == "probe") return probe_from(value);
  if (action == "suture") return suture_from(value, points);
  if (action == "pin") return pin_from(value, points);
  if (action == "release") return release_from(value, points);
  if (action == "move") return MoveTool{value.vector()};
  if (action == "damping") return SetDamping{value.non_negative()};
  if (action == "gravity") return SetGravity{value.vector()};
  if (action == "integrator") return SetIntegrator{integrator_from(value)};
  if (action == "budget") return SetBudget{static_cast<int>(value.integer(1, max_budget_iterations))};
  if (action == "step_cost") return SetStepCost{value.positive()};
  if (action == "remove") return RemoveElements{elements_from(value)};
  if (action == "cut") return cut_from(value);
  if (action == "material") {
    const RegionMaterial entry = material_from(value);
    if (uses_fields(entry.material)) value.fail("takes a field of the mesh", "a material switched to takes numbers");
    return SetMaterial{entry.region, entry.material};
  }
  expect_true(value);
  if (action == "undo") return Undo{};
  if (action == "factor") return AdoptPreconditioner{};
  return Reset{};
}

RecordedEnd end_from(const JsonCursor& key, long tick) {
  expect_true(key["end"]);
  RecordedEnd end{tick, {}, {}, {}};
  if (const auto count = key.find("checkpoints")) end.checkpoints = count->integer(0, last_tick);
  if (const auto hash = key.find("hash")) end.hash = hash->hash();
  if (const auto halt = key.find("halt")) end.halt = halt->text();
  return end;
}

/// Keys that belong to an entry of one kind alone.
void expect_only_with(const JsonCursor& key, std::string_view action, std::string_view seen,
                      std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (action != seen && key.has(name)) key[name].fail(fmt::format("stands without '{}'", action), "take it away");
}

Json command_json(const Grasp& grasp) { return {{"grasp", {{"node", grasp.node}, {"radius", grasp.radius}}}}; }
Json command_json(const MoveTool& move) { return {{"move", vector_json(move.target)}}; }
Json command_json(const Release&) { return {{"release", true}}; }
Json command_json(const PinTissue& pin) { return {{"pin", {{"node", pin.node}, {"radius", pin.radius}}}}; }
Json command_json(const Unpin& unpin) { return {{"release", unpin.node ? Json{{"node", *unpin.node}} : Json("pins")}}; }
Json command_json(const SetTables& set) { return {{"tables", tables_json(set.tables)}}; }
Json command_json(const MoveProbe& probe) {
  Json path = Json::array();
  for (const Vec3& place : probe.path) path.push_back(vector_json(place));
  return {{"probe",
           {{"radius", probe.radius},
            {"shaft", vector_json(probe.shaft)},
            {"friction", probe.friction},
            {"path", std::move(path)},
            {"speed", probe.speed}}}};
}
Json command_json(const WithdrawProbe&) { return {{"release", "probe"}}; }
Json command_json(const SutureTissue& suture) {
  return {{"suture", {{"nodes", suture.nodes}, {"length", suture.length}, {"over", suture.ramp_time}}}};
}
Json command_json(const CutSutures&) { return {{"release", "sutures"}}; }
Json command_json(const SetMaterial& set) { return {{"material", material_json({set.region, set.material})}}; }
Json command_json(const SetDamping& set) { return {{"damping", set.damping}}; }
Json command_json(const SetGravity& set) { return {{"gravity", vector_json(set.gravity)}}; }
Json command_json(const SetIntegrator& set) { return {{"integrator", integrator_name(set.integrator)}}; }
Json command_json(const SetBudget& set) { return {{"budget", set.iterations}}; }
Json command_json(const SetStepCost& set) { return {{"step_cost", set.nanoseconds}}; }
Json command_json(const RemoveElements& remove) { return {{"remove", elements_json(remove.which)}}; }
Json command_json(const CutTissue& cut) {
  Json sweep = Json::array();
  for (const auto& [tip, end] : cut.sweep.blades) sweep.push_back({vector_json(tip), vector_json(end)});
  Json json = {{"sweep", std::move(sweep)}};
  if (cut.continues_stroke) json["goes_on"] = true;
  return {{"cut", std::move(json)}};
}
Json command_json(const Undo&) { return {{"undo", true}}; }
Json command_json(const AdoptPreconditioner&) { return {{"factor", true}}; }
Json command_json(const Reset&) { return {{"reset", true}}; }

}  // namespace

void read_script_entry(const JsonCursor& key, double tick_length, Script& script) {
  key.allow({"step",     "at",      "grasp",      "move",       "release", "pin",         "tables", "probe", "suture",
             "material", "damping", "gravity",    "integrator", "budget",  "step_cost",   "remove", "cut",   "factor",
             "undo",     "reset",   "checkpoint", "nodes",      "end",     "checkpoints", "hash",   "halt"});
  const long tick = tick_from(key, tick_length);
  const std::string action = key.only_one_of(
      {"grasp",      "move",   "release",   "pin",    "tables", "probe",  "suture", "material", "damping",    "gravity",
       "integrator", "budget", "step_cost", "remove", "cut",    "factor", "undo",   "reset",    "checkpoint", "end"});
  expect_only_with(key, "checkpoint", action, {"nodes"});
  expect_only_with(key, "end", action, {"checkpoints", "hash", "halt"});
  if (action == "checkpoint") {
    const auto nodes = key.find("nodes");
    script.checkpoints.push_back(
        {tick, key["checkpoint"].hash(), nodes ? node_hashes_from(*nodes) : std::vector<std::uint16_t>()});
  } else if (action == "end") {
    if (script.end) key.fail("a second end", "keep one of them");
    script.end = end_from(key, tick);
  } else {
    Script::Entry entry;
    entry.event = {tick, command_from(key, action, entry.points)};
    script.entries.push_back(std::move(entry));
  }
}

void install_script(Script script, Scene& scene) {
  std::stable_sort(script.entries.begin(), script.entries.end(),
                   [](const Script::Entry& a, const Script::Entry& b) { return a.event.tick < b.event.tick; });
  std::stable_sort(script.checkpoints.begin(), script.checkpoints.end(),
                   [](const Checkpoint& a, const Checkpoint& b) { return a.tick < b.tick; });
  for (const Script::Entry& entry : script.entries) {
    if (!entry.points.empty()) scene.points[scene.events.size()] = entry.points;
    scene.events.push_back(entry.event);
  }
  scene.recorded_end = script.end;
  if (script.end) {
    scene.recorded_ticks = script.end->tick;
  } else if (!script.checkpoints.empty()) {  // ended by a crash: as far as its lines go
    const long event_end = scene.events.empty() ? 0 : scene.events.back().tick + 1;
    scene.recorded_ticks = std::max(script.checkpoints.back().tick, event_end);
  }
  scene.checkpoints = std::move(script.checkpoints);
}

std::string event_line(const Event& event) {
  Json json = {{"step", event.tick}};
  json.update(std::visit([](const auto& command) { return command_json(command); }, event.command));
  return json_text(json, "");
}

std::string checkpoint_line(const Checkpoint& checkpoint) {
  Json json = {{"step", checkpoint.tick}, {"checkpoint", fmt::format("{:016x}", checkpoint.hash)}};
  std::string digits;
  for (const std::uint16_t hash : checkpoint.nodes) fmt::format_to(std::back_inserter(digits), "{:04x}", hash);
  if (!digits.empty()) json["nodes"] = digits;
  return json_text(json, "");
}

std::string end_line(const RecordedEnd& end) {
  Json json = {{"step", end.tick}, {"end", true}};
  if (end.checkpoints) json["checkpoints"] = *end.checkpoints;
  if (end.hash) json["hash"] = fmt::format("{:016x}", *end.hash);
  if (end.halt) json["halt"] = *end.halt;
  return json_text(json, "");
}

}  // namespace heml
