#include <fmt/format.h>

#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/event_json.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/solver_json.hpp>
#include <heml/scenario/vector_json.hpp>
#include <heml/scenario/view_json.hpp>

namespace heml {
namespace {

void put_text(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

Json scene_json(const Scene& scene, const std::filesystem::path& folder) {
  Json json = {{"schema_version", 1}};
  put_text(json, "name", scene.name);
  put_text(json, "title", scene.title);
  put_text(json, "description", scene.description);
  json["mesh"] = mesh_json(scene.mesh, folder);
  json["materials"] = Json::array();
  for (const RegionMaterial& material : scene.materials) json["materials"].push_back(material_json(material));
  for (const RegionTag& tag : scene.regions) json["regions"].push_back(region_tag_json(tag));
  json["boundary"] = Json::array();
  for (const BoundaryEntry& entry : scene.boundary) json["boundary"].push_back(boundary_json(entry));
  json["loads"] = Json::array();
  for (const LoadEntry& entry : scene.loads) json["loads"].push_back(load_json(entry));
  if (!scene.tables.empty()) json["tables"] = tables_json(scene.tables);
  if (scene.self_contact) json["self_contact"] = self_contact_json(*scene.self_contact);
  if (scene.tearing) json["tearing"] = tearing_json(*scene.tearing);
  json["gravity"] = vector_json(scene.gravity);
  json["solver"] = solver_json(scene.solver);
  json["outputs"] = {{"times", scene.output_times}, {"positions", scene.output_positions}, {"vtu", scene.output_vtu}};
  for (const MarkerEntry& entry : scene.markers) json["outputs"]["markers"].push_back(marker_json(entry));
  if (scene.output_history) json["outputs"]["history"] = true;
  if (scene.output_every > 0) json["outputs"]["every"] = scene.output_every;
  json["initial"] = {{"velocity", vector_json(scene.initial_velocity)}};
  if (!scene.initial_positions.empty()) json["initial"]["positions"] = path_text(scene.initial_positions, folder);
  json["view"] = view_json(scene.view);
  if (scene.skin) json["skin"] = skin_json(*scene.skin, folder);
  if (scene.recorded_mesh)
    json["recorded"] = {{"nodes", scene.recorded_mesh->nodes},
                        {"tets", scene.recorded_mesh->tets},
                        {"mesh", fmt::format("{:016x}", scene.recorded_mesh->hash)}};
  if (scene.recorded_mesh && scene.recorded_instructions)
    json["recorded"]["instructions"] = name_of(*scene.recorded_instructions);
  if (scene.recorded_mesh && scene.recorded_by.format > 1) {
    json["recorded"]["format"] = scene.recorded_by.format;
    json["recorded"]["kernel_revision"] = scene.recorded_by.kernel_revision;
    json["recorded"]["build"] = scene.recorded_by.build;
  }
  return json;
}

/// An event with the places it was given.
Json placed_event(const Scene& scene, std::size_t index) {
  const auto points = scene.points.find(index);
  return event_json(scene.events[index], points == scene.points.end() ? std::vector<Vec3>() : points->second);
}

}  // namespace

std::string scene_line(const Scene& scene, const std::filesystem::path& folder) {
  return json_text(scene_json(scene, folder), scene.file);
}

std::string recording_text(const Scene& scene, const std::filesystem::path& folder) {
  std::string text = scene_line(scene, folder) + '\n';
  for (std::size_t k = 0; k < scene.events.size(); ++k) text += json_text(placed_event(scene, k), scene.file) + '\n';
  for (const Checkpoint& checkpoint : scene.checkpoints) text += checkpoint_line(checkpoint) + '\n';
  if (scene.recorded_end) text += end_line(*scene.recorded_end) + '\n';
  return text;
}

std::string scene_text(const Scene& scene, const std::filesystem::path& folder) {
  Json json = scene_json(scene, folder);
  json.erase("recorded");
  if (!scene.events.empty()) json["events"] = Json::array();
  for (std::size_t k = 0; k < scene.events.size(); ++k) json["events"].push_back(placed_event(scene, k));
  return json_text(json, scene.file, true) + "\n";
}

}  // namespace heml
