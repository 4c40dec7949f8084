#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/check_ply.hpp>
#include <heml/mesh/file_contents.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/merge_nodes.hpp>
#include <heml/mesh/mesher_process.hpp>
#include <heml/mesh/scanner.hpp>
#include <heml/mesh/shells.hpp>
#include <iterator>

namespace heml {
namespace {

// The text exchanged with the helper (mesher/exchange.hpp).

std::string request_of(const TriangleMesh& surface, const std::vector<Vec3>& holes) {
  std::string text;
  const auto out = std::back_inserter(text);
  const auto add = [&](const Vec3& x) { fmt::format_to(out, "{:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]); };
  fmt::format_to(out, "{} {} {}\n", surface.nodes.size(), surface.triangles.size(), holes.size());
  for (const Vec3& x : surface.nodes) add(x);
  for (const Triangle& t : surface.triangles) fmt::format_to(out, "{} {} {}\n", t[0], t[1], t[2]);
  for (const Vec3& x : holes) add(x);
  return text;
}

template <std::size_t N>
void read_answer(const std::string& subject, const std::string& text, std::vector<Vec3>& nodes,
                 std::vector<std::array<int, N>>& rows) {
  Scanner in(subject + ", as read by the mesher", text);
  nodes.resize(in.count("the number of nodes", 3));
  rows.resize(in.count("the number of elements", N));
  for (Vec3& node : nodes) node = in.point("a coordinate");
  for (auto& row : rows)
    for (int& node : row) node = static_cast<int>(in.integer("a node", 0, static_cast<long long>(nodes.size()) - 1));
}

}  // namespace

void check_options(const TriangleMesh& surface, const TetgenOptions& options) {
  if (!(options.radius_edge_ratio >= 1) || !std::isfinite(options.radius_edge_ratio))
    throw InputError(surface.source, "tetgen.radius_edge_ratio", fmt::format("is {}", options.radius_edge_ratio),
                     "a number from 1, e.g. 1.4");
  if (options.max_volume && (!(*options.max_volume > 0) || !std::isfinite(*options.max_volume)))
    throw InputError(surface.source, "tetgen.max_volume", fmt::format("is {}", *options.max_volume),
                     "a volume in m³ greater than 0");
}

// assimp needs up to a hundred bytes per byte of the file, more if it is compressed; a corrupt size makes it allocate
// much more or loop for hours.
ProcessLimits surface_reading_limits(double file_bytes) {
  return {20 + file_bytes / 5e6, 120 + file_bytes / 5e6, std::min(256e6 + 1000 * file_bytes, 4e9)};
}

TriangleMesh read_surface(const std::filesystem::path& path) {
  HelperTask task{.subject = path.string(),
                  .doing = "reading it",
                  .arguments = {"read", std::filesystem::absolute(path).string()},
                  .limits = {},
                  .remedy = "is a size that the file declares damaged?"};
  {
    const std::string text = file_contents(path);
    if (is_ply(text)) check_ply(task.subject, text);
    task.limits = surface_reading_limits(static_cast<double>(text.size()));
  }
  TriangleMesh surface;
  surface.source = task.subject;
  read_answer(surface.source, run_mesher(task), surface.nodes, surface.triangles);
  return merge_nodes(surface, equal_nodes(surface));
}

TetMesh tetrahedralize(const TriangleMesh& surface, const TetgenOptions& options) {
  check_options(surface, options);
  TriangleMesh checked = surface;
  check_surface(checked);
  const HelperTask task{.subject = surface.source,
                        .doing = "filling it",
                        .arguments = {"fill", fmt::format("{:.17g}", options.radius_edge_ratio),
                                      options.max_volume ? fmt::format("{:.17g}", *options.max_volume) : "none"},
                        .limits = {options.time_limit, options.time_limit, options.memory_limit},
                        .remedy = "a coarser surface, a larger radius_edge_ratio or max_volume"};
  TetMesh mesh;
  mesh.source = surface.source;
  const std::vector<Vec3> holes = cavity_points(checked, orient_consistently(checked));
  read_answer(mesh.source, run_mesher(task, request_of(checked, holes)), mesh.nodes, mesh.tets);
  if (mesh.tets.empty() || mesh.nodes.size() < surface.nodes.size())
    throw InputError(surface.source, "", "TetGen filled nothing", "repair or simplify the surface");
  std::copy(checked.nodes.begin(), checked.nodes.end(), mesh.nodes.begin());
  std::size_t too_large = 0;
  for (auto& [a, b, c, d] : mesh.tets) {
    const double volume = signed_volume(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c], mesh.nodes[d]);
    if (volume < 0) std::swap(c, d);
    too_large += options.max_volume && std::abs(volume) > 1.001 * *options.max_volume;
  }
  if (too_large > 0)
    warn("{}: {} of {} tetrahedra are larger than max_volume: the surface's triangles are kept and too large for it",
         mesh.source, too_large, mesh.tets.size());
  mesh.regions.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace heml
