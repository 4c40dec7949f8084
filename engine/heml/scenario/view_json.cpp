#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>
#include <heml/scenario/view_json.hpp>
#include <heml/world/field_list.hpp>

namespace heml {

View view_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("view"));
  View view;
  object.read("azimuth", view.azimuth);
  object.read("elevation", view.elevation);
  object.read("zoom", view.zoom);
  object.read("field", view.field);
  object.read("wireframe", view.wireframe);
  object.read("section", view.section);
  object.read("section_at", view.section_at);
  return view;
}

Json view_json(const View& view) {
  Json json = {{"field", info(view.field).name}, {"wireframe", view.wireframe}};
  if (view.azimuth) json["azimuth"] = *view.azimuth;
  if (view.elevation) json["elevation"] = *view.elevation;
  if (view.zoom) json["zoom"] = *view.zoom;
  if (view.section) {
    json["section"] = vector_json(*view.section);
    json["section_at"] = view.section_at;
  }
  return json;
}

SkinSpec skin_from(const JsonCursor& key, const std::filesystem::path& folder) {
  const ObjectReader object(key, keys_of("skin"));
  SkinSpec skin;
  skin.file = path_from(object["file"], folder);
  if (const auto texture = object.find("texture")) skin.texture = path_from(*texture, folder);
  return skin;
}

Json skin_json(const SkinSpec& skin, const std::filesystem::path& folder) {
  Json json = {{"file", path_text(skin.file, folder)}};
  if (!skin.texture.empty()) json["texture"] = path_text(skin.texture, folder);
  return json;
}

}  // namespace heml
