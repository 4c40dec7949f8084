#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/placement.hpp>
#include <heml/scenario/selection.hpp>
#include <heml/scenario/skin.hpp>

namespace heml {
namespace {

constexpr double far_from_body = 0.1;  // of the body's diagonal

void expect_png(const Scene& scene, const std::filesystem::path& image, const std::string& place) {
  constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
  std::string begin(signature.size(), '\0');
  std::ifstream(image, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin != signature)
    throw InputError(scene.file, place, fmt::format("'{}' is no PNG image", image.string()),
                     "convert it, and name it: \"skin\": {\"texture\": \"image.png\"}");
}

/// Turns all triangles over where they enclose less than nothing.
void turn_outward(TriangleMesh& surface) {
  const auto [low, high] = bounds_of(surface.nodes);
  const Vec3 inside = (low + high) / 2;
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles)
    volume += signed_volume(inside, surface.nodes[static_cast<std::size_t>(a)],
                            surface.nodes[static_cast<std::size_t>(b)], surface.nodes[static_cast<std::size_t>(c)]);
  if (volume < 0)
    for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
}

}  // namespace

std::shared_ptr<const Skin> load_skin(const Scene& scene, const TetMesh& mesh) {
  if (!scene.skin) return nullptr;
  Skin skin;
  const bool names_texture = !scene.skin->texture.empty();
  skin.surface = read_textured_surface(find_file(scene, "skin.file", scene.skin->file), !names_texture);
  if (names_texture) {
    if (skin.surface.places.empty())
      throw InputError(scene.file, "skin.texture", "the surface has no texture coordinates",
                       "unwrap it (UV) and export it anew, or leave the texture out");
    skin.surface.texture = find_file(scene, "skin.texture", scene.skin->texture);
  }
  if (!skin.surface.texture.empty()) expect_png(scene, skin.surface.texture, "skin.texture");
  const Placement placement(scene.mesh);
  for (Vec3& node : skin.surface.mesh.nodes) node = placement(node);
  turn_outward(skin.surface.mesh);
  skin.embedding = embed(skin.surface.mesh.nodes, mesh);
  const auto [low, high] = bounds_of(mesh.nodes);
  const double diagonal = (high - low).norm();
  if (skin.embedding.farthest > far_from_body * diagonal)
    warn(
        "{}: skin.file: a vertex is {:.3g} m from the body, which is {:.3g} m large: is the surface in the place and "
        "unit of the mesh?",
        scene.file, skin.embedding.farthest, diagonal);
  return std::make_shared<const Skin>(std::move(skin));
}

}  // namespace heml
