#include <heml/scenario/view_json.hpp>

namespace heml {
namespace {

/// In the order of Field.
constexpr std::string_view field_names[] = {"none", "displacement", "stretch", "von_mises", "J", "error"};

}  // namespace

View view_from(const JsonCursor& key) {
  key.allow({"azimuth", "elevation", "zoom", "field", "wireframe"});
  View view;
  if (const auto azimuth = key.find("azimuth")) view.azimuth = azimuth->between(-360, 360);
  if (const auto elevation = key.find("elevation")) view.elevation = elevation->between(-90, 90);
  if (const auto zoom = key.find("zoom")) view.zoom = zoom->between(0.01, 100);
  if (const auto field = key.find("field")) view.field = static_cast<Field>(field->one_of(field_names));
  if (const auto wireframe = key.find("wireframe")) view.wireframe = wireframe->flag();
  return view;
}

Json view_json(const View& view) {
  Json json = {{"field", field_names[static_cast<std::size_t>(view.field)]}, {"wireframe", view.wireframe}};
  if (view.azimuth) json["azimuth"] = *view.azimuth;
  if (view.elevation) json["elevation"] = *view.elevation;
  if (view.zoom) json["zoom"] = *view.zoom;
  return json;
}

}  // namespace heml
