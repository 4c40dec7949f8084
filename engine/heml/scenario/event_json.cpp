#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/scenario/command_table.hpp>
#include <heml/scenario/event_json.hpp>
#include <heml/scenario/vector_json.hpp>

namespace heml {
namespace {

constexpr double last_tick = script_time_keys[0].form.high;

/// Keys of an entry: of all kinds, and those that say which kind it is.
const std::vector<std::string_view> entry_keys = [] {
  std::vector<std::string_view> keys = names_of(script_time_keys);
  keys.insert(keys.end(), event_keys().begin(), event_keys().end());
  for (const KeyInfo& key : checkpoint_keys) keys.push_back(key.name);
  for (const KeyInfo& key : end_keys) keys.push_back(key.name);
  return keys;
}();
const std::vector<std::string_view> kinds_of_entry = [] {
  std::vector<std::string_view> keys(event_keys().begin(), event_keys().end());
  keys.insert(keys.end(), {checkpoint_keys[0].name, end_keys[0].name});
  return keys;
}();

long tick_from(const JsonCursor& key, double tick_length) {
  const ObjectReader entry(key, script_time_keys, entry_keys);
  if (key.only_one_of({"step", "at"}) == "step") return entry.get<long>("step");
  const double tick = std::round(entry.get<double>("at") / tick_length);
  if (!(tick <= last_tick)) key["at"].refuse(fmt::format("must be at most {} ticks", static_cast<long>(last_tick)));
  return static_cast<long>(tick);
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

Checkpoint checkpoint_from(const JsonCursor& key, long tick) {
  const auto nodes = key.find("nodes");
  return {tick, key["checkpoint"].hash(), nodes ? node_hashes_from(*nodes) : std::vector<std::uint16_t>()};
}

RecordedEnd end_from(const JsonCursor& key, long tick) {
  const ObjectReader entry(key, end_keys, entry_keys);
  if (!entry["end"].flag()) key["end"].refuse("must be true, or leave the entry out");
  RecordedEnd end{tick, {}, {}, {}, {}};
  entry.read("checkpoints", end.checkpoints);
  if (const auto hash = entry.find("hash")) end.hash = hash->hash();
  entry.read("halt", end.halt);
  if (const auto halted = entry.find("halted")) end.halted = halted->flag();
  return end;
}

/// Keys that belong to an entry of one kind alone. kind: its table, beginning with the key that names it.
void expect_only_with(const JsonCursor& key, std::span<const KeyInfo> kind, std::string_view seen) {
  for (const KeyInfo& info : kind.subspan(1))
    if (kind[0].name != seen && key.has(info.name))
      key[info.name].fail(fmt::format("stands without '{}'", kind[0].name), "take it away");
}

}  // namespace

void read_script_entry(const JsonCursor& key, double tick_length, Script& script) {
  const long tick = tick_from(key, tick_length);
  const std::string kind = key.only_one_of(kinds_of_entry);
  expect_only_with(key, checkpoint_keys, kind);
  expect_only_with(key, end_keys, kind);
  if (kind == "checkpoint") {
    script.checkpoints.push_back(checkpoint_from(key, tick));
  } else if (kind == "end") {
    if (script.end) key.fail("a second end", "keep one of them");
    script.end = end_from(key, tick);
  } else {
    Script::Entry entry;
    entry.event = {tick, command_with(kind).read(key[kind], entry.points)};
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

Json event_json(const Event& event, const std::vector<Vec3>& points) {
  Json json = {{"step", event.tick}};
  const CommandInfo& info = info_of(event.command);
  Json& value = json[std::string(info.key)] = info.write(event.command);
  if (points.empty()) return json;
  if (value.erase("node")) value["point"] = vector_json(points.front());
  if (value.erase("nodes"))
    for (const Vec3& point : points) value["points"].push_back(vector_json(point));
  return json;
}

std::string event_line(const Event& event) { return json_text(event_json(event), ""); }

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
  if (end.halted) json["halted"] = *end.halted;
  return json_text(json, "");
}

}  // namespace heml
