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

}  // namespace heml
