#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/intersections.hpp>
#include <heml/mesh/mend/clean_triangles.hpp>
#include <heml/mesh/mend/mend.hpp>
#include <heml/mesh/mend/remesh.hpp>
#include <heml/mesh/mesher_process.hpp>
#include <heml/mesh/shells.hpp>

namespace heml {
namespace {

constexpr std::size_t max_triangles = 4'000'000;
constexpr double weld_of_diagonal = 1e-6;
constexpr double max_sheet_area = 0.5;       // of the surface, that may be left out
constexpr double min_volume_of_area = 1e-6;  // of area^1.5; a sphere has 0.094, a plate a thousandth thick 3e-4

/// Which way triangles are turned, by their nodes' positions in ascending order.
class Turns {
 public:
  explicit Turns(const TriangleMesh& surface) {
    for (const Triangle& t : surface.triangles) turns_.push_back(turn_of(surface, t));
    std::sort(turns_.begin(), turns_.end());
  }
  /// The number of triangles of another surface that are here too, turned the other way.
  int count_turned(const TriangleMesh& surface) const {
    int count = 0;
    for (const Triangle& t : surface.triangles) {
      Turn turn = turn_of(surface, t);
      if (std::binary_search(turns_.begin(), turns_.end(), turn)) continue;
      turn.second = !turn.second;
      count += std::binary_search(turns_.begin(), turns_.end(), turn);
    }
    return count;
  }

 private:
  using Turn = std::pair<std::array<std::array<double, 3>, 3>, bool>;
  static Turn turn_of(const TriangleMesh& surface, const Triangle& t) {
    Turn turn;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = surface.nodes[t[i]];
      turn.first[i] = {x[0], x[1], x[2]};
    }
    auto& [a, b, c] = turn.first;
    bool odd = false;
    const auto sort = [&odd](auto& one, auto& other) {
      if (!(other < one)) return;
      std::swap(one, other);
      odd = !odd;
    };
    sort(a, b);
    sort(b, c);
    sort(a, b);
    turn.second = odd;
    return turn;
  }
  std::vector<Turn> turns_;
};

/// What check_surface() finds wrong, without the file and the remedy; empty: nothing, and the surface is as it leaves
/// it. Counts in the report what crosses.
std::string problem_of(TriangleMesh& surface, MendReport& report) {
  TriangleMesh checked = surface;
  report.crossings = 0;
  try {
    check_surface(checked);
  } catch (const InputError& error) {
    if (const auto* crossing = dynamic_cast<const SelfIntersection*>(&error))
      report.crossings = static_cast<int>(crossing->pairs());
    std::string text = error.what();
    if (text.starts_with(surface.source + ": ")) text.erase(0, surface.source.size() + 2);
    return text.substr(0, text.rfind(" ("));
  }
  if (checked.nodes != surface.nodes) report.smoothed = static_cast<int>(self_intersections(surface).pairs);
  surface = std::move(checked);
  return "";
}

double diagonal_of(const TriangleMesh& surface) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : surface.triangles)
    for (const int n : t) box.extend(surface.nodes[n]);
  return box.diagonal().norm();
}

void clean(TriangleMesh& surface, MendReport& report) {
  const auto tidy = [&] {
    report.flat += remove_flat_triangles(surface);
    report.duplicates += remove_duplicate_triangles(surface);
  };
  const auto weld = [&](auto welding) {
    const std::size_t before = surface.triangles.size();
    report.welded += welding();
    report.flat += static_cast<int>(before - surface.triangles.size());  // to an edge or a point
    tidy();
  };
  weld([&] { return weld_nodes(surface, weld_of_diagonal * diagonal_of(surface)); });
  weld([&] { return weld_cracks(surface); });
  report.split = split_at_nodes(surface);
  tidy();
}

void close_holes(TriangleMesh& surface, MendReport& report) {
  report.crumbs = remove_crumbs(surface);
  report.walls = remove_walls(surface);
  if (surface.triangles.empty()) throw InputError(surface.source, "", "no triangle has an area", "a closed surface");
  report.holes = fill_holes(surface);
  if (report.holes.sheet_area > max_sheet_area)
    throw InputError(
        surface.source, "",
        fmt::format("the surface is open: {:.0f} % of it is sheets, whose openings are as large as they are",
                    100 * report.holes.sheet_area),
        "a surface round a body; holes in it may be open");
}

void expect_volume(const TriangleMesh& surface) {
  double volume = 0, area = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3& origin = surface.nodes[surface.triangles[0][0]];
    volume += signed_volume(origin, surface.nodes[a], surface.nodes[b], surface.nodes[c]);
    area += 0.5 * (surface.nodes[b] - surface.nodes[a]).cross(surface.nodes[c] - surface.nodes[a]).norm();
  }
  if (!(volume > min_volume_of_area * std::pow(area, 1.5)))
    throw InputError(surface.source, "", "the surface encloses next to no volume", "a surface round a body");
}

std::string of_area(double share) { return fmt::format("{:.2g} % of its area", 100 * share); }

}  // namespace

std::vector<std::string> to_lines(const MendReport& report) {
  std::vector<std::string> lines;
  const auto add = [&](bool is_so, std::string line) {
    if (is_so) lines.push_back(std::move(line));
  };
  const FilledHoles& holes = report.holes;
  add(report.welded > 0, fmt::format("welded {} nodes to others beside them", report.welded));
  add(report.flat + report.duplicates > 0,
      fmt::format("removed {} triangles without area and {} that were there twice", report.flat, report.duplicates));
  add(report.split > 0, fmt::format("split edges at {} nodes that lay on them (T-junctions)", report.split));
  add(report.crumbs.parts > 0,
      fmt::format("left out {} loose parts ({} triangles), the largest with {}", report.crumbs.parts,
                  report.crumbs.triangles, of_area(report.crumbs.largest_share)));
  add(report.walls.parts > 0,
      fmt::format("left out {} inner walls or fins ({} triangles)", report.walls.parts, report.walls.triangles));
  add(holes.sheets > 0, fmt::format("left out {} sheets, which enclose nothing", holes.sheets));
  add(holes.holes > 0,
      fmt::format("closed {} hole{} ({} edges), the largest {:.3g} around, its filling {}", holes.holes,
                  holes.holes == 1 ? "" : "s", holes.edges, holes.longest, of_area(holes.largest_share)));
  add(report.turned > 0, fmt::format("turned {} triangles outward", report.turned));
  add(!report.unmended.empty(),
      fmt::format("no repair of triangles mends what is left ({}): the space inside is meshed "
                  "anew",
                  report.unmended));
  return lines;
}

MendedSurface mend_surface(TriangleMesh surface) {
  check_numbers(surface);
  const Turns before(surface);
  MendedSurface mended{std::move(surface), {}};
  if (const std::string problem = problem_of(mended.surface, mended.report); !problem.empty()) {
    if (mended.surface.triangles.size() > max_triangles)
      throw InputError(
          mended.surface.source, "",
          fmt::format("{}; with {} triangles it is too large to mend", problem, mended.surface.triangles.size()),
          fmt::format("{} triangles at most", max_triangles));
    clean(mended.surface, mended.report);
    close_holes(mended.surface, mended.report);
    mended.report.unmended = problem_of(mended.surface, mended.report);
    if (mended.report.unmended.empty())
      expect_volume(mended.surface);
    else
      orient_by_sky(mended.surface);
  }
  mended.report.turned = before.count_turned(mended.surface);
  for (const std::string& line : to_lines(mended.report)) warn("{}: {}", mended.surface.source, line);
  return mended;
}

TetMesh tetrahedralize(const MendedSurface& mended, const TetgenOptions& options) {
  check_options(mended.surface, options);
  if (!mended.report.unmended.empty()) return remesh(mended.surface, options.max_volume);
  try {
    return tetrahedralize(mended.surface, options);
  } catch (const MesherFailure& failure) {
    warn("{}: the space inside is meshed anew", failure.what());
    return remesh(mended.surface, options.max_volume);
  }
}

}  // namespace heml
