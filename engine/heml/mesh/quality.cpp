#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/connected_parts.hpp>
#include <heml/mesh/coordinates.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/surface.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace heml {
namespace {

constexpr double sliver_degrees = 5;

std::string corners(const Tet& tet) { return fmt::format("{}, {}, {}, {}", tet[0], tet[1], tet[2], tet[3]); }

std::string element(std::size_t t) { return fmt::format("element {}", t); }

void check_nodes(const TetMesh& mesh) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3& x = mesh.nodes[n];
    if (!x.allFinite())
      throw InputError(mesh.source, fmt::format("node {}", n), "position " + shown(x) + " is not finite");
    if (x.cwiseAbs().maxCoeff() > max_coordinate)
      throw InputError(mesh.source, fmt::format("node {}", n), "position " + shown(x) + " is no place in metres",
                       fmt::format("coordinates up to {:.0e}", max_coordinate));
  }
}

void check_indices(const TetMesh& mesh) {
  if (mesh.tets.empty()) throw InputError(mesh.source, "", "has no tetrahedra", "a surface is filled by heml mesh");
  if (mesh.regions.size() != mesh.tets.size())
    throw InputError(mesh.source, "",
                     fmt::format("has {} regions for {} tetrahedra", mesh.regions.size(), mesh.tets.size()));
  for (const ElementField& field : mesh.fields)
    if (!is_field_size(field.components) || field.values.size() != field.components * mesh.tets.size())
      throw InputError(mesh.source, fmt::format("field '{}'", field.name),
                       fmt::format("has {} values of {} components for {} tetrahedra", field.values.size(),
                                   field.components, mesh.tets.size()));
  if (!mesh.burns.empty() && mesh.burns.size() != mesh.tets.size())
    throw InputError(mesh.source, "burns",
                     fmt::format("has {} for {} tetrahedra", mesh.burns.size(), mesh.tets.size()));
  const int nodes = static_cast<int>(mesh.nodes.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    for (int a = 0; a < 4; ++a) {
      if (tet[a] < 0 || tet[a] >= nodes)
        throw InputError(mesh.source, element(t), fmt::format("names node {}, the mesh has {}", tet[a], nodes),
                         "nodes count from 0");
      for (int b = 0; b < a; ++b)
        if (tet[a] == tet[b])
          throw InputError(mesh.source, element(t), fmt::format("has node {} twice (nodes {})", tet[a], corners(tet)),
                           "four different nodes");
    }
  }
}

// Repairs winding and sums volume. A volume counts as zero if rounding of the coordinates could cause it: ε × size ×
// edge².
void repair_winding(TetMesh& mesh, MidEdges* midedges, QualityReport& report) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Tet& tet = mesh.tets[t];
    double edge = 0, size = 0;
    for (int a = 0; a < 4; ++a) {
      size = std::max(size, mesh.nodes[tet[a]].cwiseAbs().maxCoeff());
      for (int b = 0; b < a; ++b) edge = std::max(edge, (mesh.nodes[tet[a]] - mesh.nodes[tet[b]]).norm());
    }
    const double volume = signed_volume(mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]);
    if (!(std::abs(volume) > 4 * epsilon * edge * edge * (edge + size)))
      throw InputError(mesh.source, element(t),
                       fmt::format("has no volume: {:.3g} m³ (nodes {})", volume, corners(tet)),
                       "remove it or move one of its nodes");
    if (volume < 0) {
      std::swap(tet[2], tet[3]);
      if (midedges && !midedges->empty()) {
        auto& middle = (*midedges)[t];
        std::swap(middle[edge_between(0, 2)], middle[edge_between(0, 3)]);
        std::swap(middle[edge_between(1, 2)], middle[edge_between(1, 3)]);
      }
      for (ElementField& field : mesh.fields)
        if (field.components == point_components) {  // points 2 and 3, which lie towards these corners
          double* values = &field.values[point_components * t];
          std::swap_ranges(values + 6, values + 9, values + 9);
        }
      ++report.flipped;
    }
    report.volume += std::abs(volume);
  }
}

void measure_shape(const TetMesh& mesh, QualityReport& report) {
  report.shortest_edge = std::numeric_limits<double>::infinity();
  report.worst_dihedral = 180;
  Eigen::AlignedBox3d box;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Vec3, 4> x;
    for (int a = 0; a < 4; ++a) {
      x[a] = mesh.nodes[mesh.tets[t][a]];
      box.extend(x[a]);
      for (int b = 0; b < a; ++b) {
        const double length = (x[a] - x[b]).norm();
        report.shortest_edge = std::min(report.shortest_edge, length);
        report.longest_edge = std::max(report.longest_edge, length);
      }
    }
    const double dihedral = min_dihedral(x);
    report.slivers += dihedral < sliver_degrees;
    if (dihedral < report.worst_dihedral) {
      report.worst_dihedral = dihedral;
      report.worst_tet = static_cast<int>(t);
    }
  }
  report.low = box.min();
  report.high = box.max();
}

// Counts orphans, and parts connected by nodes.
void count_components(const TetMesh& mesh, const MidEdges* midedges, QualityReport& report) {
  const std::vector<int> part = connected_parts(mesh, midedges ? *midedges : MidEdges());
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Tet& tet : mesh.tets)
    for (int node : tet) used[node] = 1;
  for (std::size_t t = 0; midedges && t < midedges->size(); ++t)
    for (int node : (*midedges)[t]) used[node] = 1;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    report.orphans += !used[n];
    report.components += used[n] && part[n] == static_cast<int>(n);
  }
}

int count_duplicates(const std::vector<Vec3>& nodes) {
  std::vector<Vec3> sorted = nodes;
  std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  int count = 0;
  for (std::size_t n = 1; n < sorted.size(); ++n) count += sorted[n] == sorted[n - 1];
  return count;
}

int count_nonmanifold_edges(const TetMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& face : extract_boundary(mesh).triangles)
    for (int a = 0; a < 3; ++a) edges.push_back(std::minmax(face[a], face[(a + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  int count = 0;
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    count += last - first != 2;
  }
  return count;
}

int count_crowded_faces(const TetMesh& mesh) {
  const auto counts = face_counts(mesh.tets, static_cast<int>(mesh.nodes.size()));
  return static_cast<int>(std::count_if(counts.begin(), counts.end(), [](int count) { return count > 2; }));
}

std::string counted(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void add_warnings(const TetMesh& mesh, QualityReport& report) {
  const QualityReport& r = report;
  const auto say = [&](std::string sentence) { report.warnings.push_back(std::move(sentence)); };
  if (r.flipped > 0) say(fmt::format("{} of {} tetrahedra inside out by their winding; repaired", r.flipped, r.tets));
  if (r.slivers > 0)
    say(fmt::format("{} (a dihedral angle under {}°); the worst, element {} (nodes {}), has {:.3g}°",
                    counted(r.slivers, "sliver", "slivers"), sliver_degrees, r.worst_tet,
                    corners(mesh.tets[r.worst_tet]), r.worst_dihedral));
  if (r.orphans > 0) say(counted(r.orphans, "node", "nodes") + " of no tetrahedron: at rest for good");
  if (r.duplicates > 0)
    say(counted(r.duplicates, "node", "nodes") + " at the very place of another: never merged, the body is open there");
  if (r.components > 1) say(fmt::format("{} bodies that share no node", r.components));
  if (r.nonmanifold_edges > 0)
    say(counted(r.nonmanifold_edges, "boundary edge", "boundary edges") +
        " of more than two boundary faces: parts hang together by an edge alone");
  if (count_crowded_faces(mesh) > 0) say("faces of more than two tetrahedra: elements overlap or are given twice");
}

}  // namespace

double min_dihedral(const std::array<Vec3, 4>& x) {
  std::array<Vec3, 4> outward;
  for (int f = 0; f < 4; ++f) {
    const auto& [a, b, c] = tet_faces[f];
    outward[f] = (x[b] - x[a]).cross(x[c] - x[a]);
  }
  double smallest = std::numbers::pi;
  for (int f = 0; f < 4; ++f)
    for (int g = 0; g < f; ++g)
      smallest = std::min(smallest, std::atan2(outward[f].cross(outward[g]).norm(), -outward[f].dot(outward[g])));
  return smallest * 180 / std::numbers::pi;
}

void check_connectivity(const TetMesh& mesh) {
  check_indices(mesh);
  check_nodes(mesh);
}

QualityReport check_tets(TetMesh& mesh, MidEdges* midedges) {
  check_connectivity(mesh);
  QualityReport report;
  report.nodes = static_cast<int>(mesh.nodes.size());
  report.tets = static_cast<int>(mesh.tets.size());
  report.regions = static_cast<int>(std::set<int>(mesh.regions.begin(), mesh.regions.end()).size());
  repair_winding(mesh, midedges, report);
  measure_shape(mesh, report);
  count_components(mesh, midedges, report);
  report.duplicates = count_duplicates(mesh.nodes);
  report.nonmanifold_edges = count_nonmanifold_edges(mesh);
  add_warnings(mesh, report);
  return report;
}

std::string to_text(const QualityReport& report) {
  const Vec3 size = report.high - report.low;
  std::string text = fmt::format(
      "{} nodes, {} tetrahedra, {} region{}\n"
      "volume {:.6g} m³, size {:.4g} × {:.4g} × {:.4g} m\n"
      "edges {:.4g} to {:.4g} m, smallest dihedral angle {:.3g}° (element {})\n",
      report.nodes, report.tets, report.regions, report.regions == 1 ? "" : "s", report.volume, size[0], size[1],
      size[2], report.shortest_edge, report.longest_edge, report.worst_dihedral, report.worst_tet);
  for (const std::string& warning : report.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace heml
