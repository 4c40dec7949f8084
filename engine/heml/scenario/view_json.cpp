#include <heml/scenario/entries_json.hpp>
#include <heml/scenario/mesh_json.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/standard_view.hpp>
#include <heml/scenario/vector_json.hpp>
#include <heml/scenario/view_json.hpp>
#include <heml/world/field_list.hpp>
#include <limits>

namespace heml {

View view_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("view"));
  View view;
  object.read("azimuth", view.azimuth);
  object.read("elevation", view.elevation);
  if (const auto side = object.find("side")) {
    if (view.azimuth || view.elevation) side->refuse("must stand without `azimuth` and `elevation`");
    const ViewAngles angles = angles_of(static_cast<StandardView>(side->one_of(standard_view_names)));
    view.azimuth = angles.azimuth;
    view.elevation = angles.elevation;
  }
  object.read("zoom", view.zoom);
  object.read("orthographic", view.orthographic);
  object.read("field", view.field);
  object.read("wireframe", view.wireframe);
  object.read("section", view.section);
  object.read("section_at", view.section_at);
  if (const auto range = object.find("range")) {
    if (range->size() != 2) range->refuse("must be two numbers [low, high]");
    view.range = {(*range)[0].number(), (*range)[1].number()};
    if (!((*view.range)[0] < (*view.range)[1])) range->refuse("must name the lower number first");
  }
  if (const auto hidden = object.find("hidden")) view.hidden = regions_from(*hidden);
  return view;
}

Json view_json(const View& view) {
  Json json = {{"field", info(view.field).name}, {"wireframe", view.wireframe}};
  if (view.azimuth) json["azimuth"] = *view.azimuth;
  if (view.elevation) json["elevation"] = *view.elevation;
  if (view.zoom) json["zoom"] = *view.zoom;
  if (view.orthographic) json["orthographic"] = true;
  if (view.section) {
    json["section"] = vector_json(*view.section);
    json["section_at"] = view.section_at;
  }
  if (view.range) json["range"] = *view.range;
  if (!view.hidden.empty()) json["hidden"] = view.hidden;
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
