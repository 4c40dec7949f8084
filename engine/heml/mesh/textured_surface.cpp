#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/mesh/check_ply.hpp>
#include <heml/mesh/file_contents.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/mesher_process.hpp>
#include <heml/mesh/scanner.hpp>
#include <heml/mesh/textured_surface.hpp>
#include <numeric>

namespace heml {
namespace {

namespace fs = std::filesystem;

/// The image beside the surface; modelling programs write absolute paths of another machine too.
fs::path find_texture(const fs::path& surface, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  std::error_code failed;
  const fs::path given = surface.parent_path() / name, beside = surface.parent_path() / fs::path(name).filename();
  for (const fs::path& path : {given, beside})
    if (fs::is_regular_file(path, failed)) return path;
  throw InputError(surface.string(), "", fmt::format("names the texture '{}', which is not there", name),
                   "put it beside the surface, or name another one in the scene: \"skin\": {\"texture\": ...}");
}

/// Merges vertices that are equal in all that is told of them: readers give each triangle its own.
TexturedSurface with_shared_vertices(TexturedSurface surface) {
  const std::size_t count = surface.mesh.nodes.size();
  const auto key = [&](std::size_t n) {
    std::array<double, 8> all{};
    for (std::size_t i = 0; i < 3; ++i) all[i] = surface.mesh.nodes[n][static_cast<Eigen::Index>(i)];
    for (std::size_t i = 0; i < 2 && !surface.places.empty(); ++i)
      all[3 + i] = static_cast<double>(surface.places[n][i]);
    for (std::size_t i = 0; i < 3 && !surface.colours.empty(); ++i)
      all[5 + i] = static_cast<double>(surface.colours[n][static_cast<Eigen::Index>(i)]);
    return all;
  };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto x = key(a), y = key(b);
    return x != y ? x < y : a < b;
  });
  std::vector<std::size_t> first(count);  // the lowest of the vertices that are equal
  for (std::size_t k = 0; k < count; ++k)
    first[order[k]] = k > 0 && key(order[k - 1]) == key(order[k]) ? first[order[k - 1]] : order[k];
  TexturedSurface shared;
  shared.mesh.source = surface.mesh.source;
  std::vector<int> number(count);
  for (std::size_t n = 0; n < count; ++n) {
    number[n] = first[n] == n ? static_cast<int>(shared.mesh.nodes.size()) : number[first[n]];
    if (first[n] != n) continue;
    shared.mesh.nodes.push_back(surface.mesh.nodes[n]);
    if (!surface.places.empty()) shared.places.push_back(surface.places[n]);
    if (!surface.colours.empty()) shared.colours.push_back(surface.colours[n]);
  }
  for (Triangle t : surface.mesh.triangles) {
    for (int& n : t) n = number[static_cast<std::size_t>(n)];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) shared.mesh.triangles.push_back(t);
  }
  return shared;
}

}  // namespace

TexturedSurface read_textured_surface(const fs::path& path, bool with_texture) {
  HelperTask task{.subject = path.string(),
                  .doing = "reading it",
                  .arguments = {"skin", fs::absolute(path).string()},
                  .limits = {},
                  .remedy = "is a size that the file declares damaged?"};
  {
    const std::string text = file_contents(path);
    if (is_ply(text)) check_ply(task.subject, text);
    task.limits = surface_reading_limits(static_cast<double>(text.size()));
  }
  const std::string answer = run_mesher(task);
  Scanner in(task.subject + ", as read by the mesher", answer);
  const bool has_places = in.integer("whether it has texture coordinates") != 0;
  const bool has_colours = in.integer("whether it has colours") != 0;
  in.rest_of_line();
  const std::string texture(in.rest_of_line());
  TexturedSurface surface;
  surface.mesh.source = task.subject;
  const std::size_t nodes = in.count("the number of nodes", 8), triangles = in.count("the number of triangles", 3);
  for (std::size_t n = 0; n < nodes; ++n) {
    surface.mesh.nodes.push_back(in.point("a coordinate"));
    const std::array<float, 2> place{static_cast<float>(in.number("u")), static_cast<float>(in.number("v"))};
    const Vec3f colour = in.point("a colour").cast<float>().cwiseMax(0).cwiseMin(1);
    if (has_places) surface.places.push_back(place);
    if (has_colours) surface.colours.push_back(colour);
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    Triangle& triangle = surface.mesh.triangles.emplace_back();
    for (int& node : triangle) node = static_cast<int>(in.integer("a node", 0, static_cast<long long>(nodes) - 1));
  }
  surface = with_shared_vertices(std::move(surface));
  if (with_texture && has_places && !texture.empty()) surface.texture = find_texture(path, texture);
  return surface;
}

}  // namespace heml
