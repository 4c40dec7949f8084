#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/vector_json.hpp>
#include <limits>

namespace heml {
namespace {

std::vector<int> nodes_from(const Key& key) {
  std::vector<int> nodes;
  key.each([&](const Key& node) {
    nodes.push_back(static_cast<int>(node.integer(0, std::numeric_limits<int>::max())));
  });
  if (nodes.empty()) key.fail("is empty", "name at least one node, from 0");
  return nodes;
}

std::array<Vec3, 2> box_from(const Key& key) {
  if (key.size() != 2) key.refuse("must be two corners [[x, y, z], [x, y, z]]");
  const Vec3 low = key[0].vector(), high = key[1].vector();
  if ((low.array() > high.array()).any()) key.refuse("must name the lower corner first, in x, y and z");
  return {low, high};
}

std::pair<Vec3, double> sphere_from(const Key& key) {
  if (key.size() != 2) key.refuse("must be [[x, y, z], radius]");
  return {key[0].vector(), key[1].non_negative()};
}

Selection selection_from(const Key& key) {
  Selection selection;
  const std::string kind = key.only_one_of({"nodes", "box", "sphere"});
  if (kind == "nodes") selection.nodes = nodes_from(key["nodes"]);
  if (kind == "box") selection.box = box_from(key["box"]);
  if (kind == "sphere") selection.sphere = sphere_from(key["sphere"]);
  return selection;
}

Json selection_json(const Selection& where) {
  if (where.box) return {{"box", {vector_json((*where.box)[0]), vector_json((*where.box)[1])}}};
  if (where.sphere) return {{"sphere", {vector_json(where.sphere->first), where.sphere->second}}};
  return {{"nodes", where.nodes}};
}

}  // namespace

BoundaryEntry boundary_from(const Key& key) {
  key.allow({"nodes", "box", "sphere", "fix", "translate", "rotate", "over"});
  BoundaryEntry entry;
  entry.where = selection_from(key);
  const bool moved = key.has("translate") || key.has("rotate");
  const bool fixed = key.has("fix") && key["fix"].flag();
  if (fixed == moved)
    key.fail(fixed ? "is both fixed and moved" : "says nothing of its nodes", "give fix: true, or translate or rotate");
  if (const auto translate = key.find("translate")) entry.motion.translate = translate->vector();
  if (const auto rotate = key.find("rotate"))
    read_rotation(*rotate, entry.motion.axis, entry.motion.origin, entry.motion.degrees);
  if (const auto over = key.find("over")) entry.motion.over = over->non_negative();
  return entry;
}

LoadEntry load_from(const Key& key) {
  key.allow({"nodes", "box", "sphere", "force", "traction", "pressure", "over"});
  LoadEntry entry;
  entry.where = selection_from(key);
  const std::string kind = key.only_one_of({"force", "traction", "pressure"});
  if (kind == "force") {
    entry.load.kind = Load::Kind::force;
    entry.load.vector = key["force"].vector();
  } else if (kind == "traction") {
    entry.load.kind = Load::Kind::traction;
    entry.load.vector = key["traction"].vector();
  } else {
    entry.load.kind = Load::Kind::pressure;
    entry.load.pressure = key["pressure"].number();
  }
  if (const auto over = key.find("over")) entry.load.over = over->non_negative();
  return entry;
}

Json boundary_json(const BoundaryEntry& entry) {
  Json json = selection_json(entry.where);
  const Boundary& motion = entry.motion;
  if (motion.degrees == 0 && motion.origin.isZero(0) && motion.translate.isZero(0)) {
    json["fix"] = true;
  } else {
    json["translate"] = vector_json(motion.translate);
    json["rotate"] = rotation_json(motion.axis, motion.origin, motion.degrees);
  }
  json["over"] = motion.over;
  return json;
}

Json load_json(const LoadEntry& entry) {
  Json json = selection_json(entry.where);
  switch (entry.load.kind) {
    case Load::Kind::force: json["force"] = vector_json(entry.load.vector); break;
    case Load::Kind::traction: json["traction"] = vector_json(entry.load.vector); break;
    case Load::Kind::pressure: json["pressure"] = entry.load.pressure; break;
  }
  json["over"] = entry.load.over;
  return json;
}

}  // namespace heml
