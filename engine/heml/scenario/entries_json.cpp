#include <fmt/format.h>

#include <algorithm>
#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>
#include <limits>

namespace heml {
namespace {

std::array<Vec3, 2> box_from(const JsonCursor& key) {
  if (key.size() != 2) key.refuse("must be two corners [[x, y, z], [x, y, z]]");
  const Vec3 low = key[0].vector(), high = key[1].vector();
  if ((low.array() > high.array()).any()) key.refuse("must name the lower corner first, in x, y and z");
  return {low, high};
}

std::pair<Vec3, double> sphere_from(const JsonCursor& key) {
  if (key.size() != 2) key.refuse("must be [[x, y, z], radius]");
  return {key[0].vector(), key[1].non_negative()};
}

Selection selection_from(const JsonCursor& key) {
  Selection selection;
  const std::string kind = key.only_one_of({"nodes", "box", "sphere"});
  if (kind == "nodes") selection.nodes = numbers_from(key["nodes"], "node");
  if (kind == "box") selection.box = box_from(key["box"]);
  if (kind == "sphere") selection.sphere = sphere_from(key["sphere"]);
  return selection;
}

Json box_json(const std::array<Vec3, 2>& box) { return {vector_json(box[0]), vector_json(box[1])}; }

Json sphere_json(const std::pair<Vec3, double>& sphere) { return {vector_json(sphere.first), sphere.second}; }

Json selection_json(const Selection& where) {
  if (where.box) return {{"box", box_json(*where.box)}};
  if (where.sphere) return {{"sphere", sphere_json(*where.sphere)}};
  return {{"nodes", where.nodes}};
}

/// kind: the key that chooses.
ElementSelection elements_by(const std::string& kind, const JsonCursor& key) {
  ElementSelection which;
  if (kind == "tets") which.tets = numbers_from(key["tets"], "element");
  if (kind == "region") which.region = value_of<int>(key["region"], scene_keys::region);
  if (kind == "box") which.box = box_from(key["box"]);
  if (kind == "sphere") which.sphere = sphere_from(key["sphere"]);
  return which;
}

AxisSet axes_from(const JsonCursor& key) {
  const auto text = key.text();
  AxisSet axes = AxisSet::none();
  for (const char letter : text) {
    const auto i = static_cast<std::size_t>(letter - 'x');
    if (i > 2 || axes.has[i]) key.refuse("must be some of x, y and z, each once: \"xz\"");
    axes.has[i] = true;
  }
  if (axes.are_none()) key.refuse("must be some of x, y and z, each once: \"xz\"");
  return axes;
}

std::string axes_text(const AxisSet& axes) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i)
    if (axes.has[i]) text += "xyz"[i];
  return text;
}

}  // namespace

std::vector<int> numbers_from(const JsonCursor& key, const char* what) {
  std::vector<int> numbers;
  key.each([&](const JsonCursor& number) {
    numbers.push_back(static_cast<int>(number.integer(0, std::numeric_limits<int>::max())));
  });
  if (numbers.empty()) key.fail("is empty", fmt::format("name at least one {}, from 0", what));
  return numbers;
}

RegionTag region_tag_from(const JsonCursor& key, std::span<const KeyInfo> keys) {
  const ObjectReader object(key, keys);
  RegionTag tag;
  const std::string kind = key.only_one_of({"nodes", "tets", "region", "box", "sphere"});
  if (kind == "nodes")
    tag.nodes = numbers_from(key["nodes"], "node");
  else
    tag.which = elements_by(kind, key);
  tag.name = object.get<std::string>("name");
  object.read("number", tag.number);
  return tag;
}

Json region_tag_json(const RegionTag& tag) {
  Json json = tag.nodes.empty() ? elements_json(tag.which) : Json{{"nodes", tag.nodes}};
  json["name"] = tag.name;
  if (tag.number) json["number"] = *tag.number;
  return json;
}

BoundaryEntry boundary_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("boundary[]"));
  BoundaryEntry entry;
  entry.where = selection_from(key);
  const bool moved = key.has("translate") || key.has("rotate");
  bool fixed = false;
  object.read("fix", fixed);
  if (fixed == moved)
    key.fail(fixed ? "is both fixed and moved" : "says nothing of its nodes", "give fix: true, or translate or rotate");
  object.read("translate", entry.motion.translate);
  if (const auto rotate = object.find("rotate"))
    read_rotation(*rotate, entry.motion.axis, entry.motion.origin, entry.motion.degrees);
  if (const auto axes = object.find("axes")) entry.motion.axes = axes_from(*axes);
  if (key.has("rotate") && !entry.motion.axes.are_all())
    key["axes"].refuse("must be all, or left out, where nodes are rotated");
  object.read("over", entry.motion.ramp_time);
  return entry;
}

LoadEntry load_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("loads[]"));
  LoadEntry entry;
  entry.where = selection_from(key);
  const std::string kind = key.only_one_of({"force", "traction", "pressure"});
  if (kind == "force") {
    entry.load.kind = Load::Kind::force;
    entry.load.vector = object.get<Vec3>("force");
  } else if (kind == "traction") {
    entry.load.kind = Load::Kind::traction;
    entry.load.vector = object.get<Vec3>("traction");
  } else {
    entry.load.kind = Load::Kind::pressure;
    entry.load.pressure = object.get<double>("pressure");
  }
  object.read("over", entry.load.ramp_time);
  return entry;
}

MarkerEntry marker_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("outputs.markers[]"));
  MarkerEntry entry;
  entry.where = selection_from(key);
  object.read("name", entry.name);
  if (entry.name.find_first_of(",\"\n\r") != std::string::npos)
    key["name"].refuse("must do in a table: without commas, quotes and line ends");
  return entry;
}

Json marker_json(const MarkerEntry& entry) {
  Json json = selection_json(entry.where);
  if (!entry.name.empty()) json["name"] = entry.name;
  return json;
}

Json boundary_json(const BoundaryEntry& entry) {
  Json json = selection_json(entry.where);
  const Boundary& motion = entry.motion;
  if (motion.degrees == 0 && motion.origin.isZero(0) && motion.translate.isZero(0)) {
    json["fix"] = true;
  } else {
    json["translate"] = vector_json(motion.translate);
    if (motion.axes.are_all()) json["rotate"] = rotation_json(motion.axis, motion.origin, motion.degrees);
  }
  if (!motion.axes.are_all()) json["axes"] = axes_text(motion.axes);
  json["over"] = motion.ramp_time;
  return json;
}

Json load_json(const LoadEntry& entry) {
  Json json = selection_json(entry.where);
  switch (entry.load.kind) {
    case Load::Kind::force:
      json["force"] = vector_json(entry.load.vector);
      break;
    case Load::Kind::traction:
      json["traction"] = vector_json(entry.load.vector);
      break;
    case Load::Kind::pressure:
      json["pressure"] = entry.load.pressure;
      break;
  }
  json["over"] = entry.load.ramp_time;
  return json;
}

std::vector<Table> tables_from(const JsonCursor& key) {
  std::vector<Table> tables;
  key.each([&](const JsonCursor& entry) {
    const ObjectReader object(entry, keys_of("tables[]"));
    Table table;
    table.point = object.get<Vec3>("point");
    table.normal = object.get<Vec3>("normal");
    object.read("friction", table.friction);
    tables.push_back(table);
  });
  return tables;
}

Json tables_json(const std::vector<Table>& tables) {
  Json json = Json::array();
  for (const Table& table : tables)
    json.push_back(
        {{"point", vector_json(table.point)}, {"normal", vector_json(table.normal)}, {"friction", table.friction}});
  return json;
}

std::optional<SelfContactSettings> self_contact_from(const JsonCursor& key) {
  if (key.json().is_boolean()) return key.flag() ? std::optional(SelfContactSettings{}) : std::nullopt;
  if (!key.json().is_object())
    key.refuse("must be true, false, or {\"friction\": coefficient, \"within_bodies\": true or false}");
  const ObjectReader object(key, keys_of("self_contact"));
  SelfContactSettings settings;
  object.read("friction", settings.friction);
  if (const auto within = object.find("within_bodies")) settings.within_bodies = within->flag();
  return settings;
}

TearingSettings tearing_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("tearing"));
  const double stretch = object["stretch"].number();
  if (!(stretch > 1)) key["stretch"].refuse("must be more than 1, the stretch at rest");
  return {stretch};
}

Json tearing_json(const TearingSettings& settings) { return {{"stretch", settings.stretch}}; }

Json self_contact_json(const SelfContactSettings& settings) {
  Json json{{"friction", settings.friction}};
  if (!settings.within_bodies) json["within_bodies"] = false;
  return json;
}

std::vector<int> regions_from(const JsonCursor& key) {
  std::vector<int> regions;
  key.each([&](const JsonCursor& region) {
    regions.push_back(
        static_cast<int>(region.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max())));
  });
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  return regions;
}

ElementSelection elements_from(const JsonCursor& key) {
  const ObjectReader object(key, scene_keys::elements);
  return elements_by(key.only_one_of({"tets", "region", "box", "sphere"}), key);
}

Json elements_json(const ElementSelection& which) {
  if (which.region) return {{"region", *which.region}};
  if (which.box) return {{"box", box_json(*which.box)}};
  if (which.sphere) return {{"sphere", sphere_json(*which.sphere)}};
  return {{"tets", which.tets}};
}

}  // namespace heml
