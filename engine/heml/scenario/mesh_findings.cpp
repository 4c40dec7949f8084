#include <fmt/format.h>

#include <heml/base/error.hpp>
#include <heml/mesh/improve/orient.hpp>
#include <heml/scenario/mesh_findings.hpp>

namespace heml {
namespace {

using Finding = BareMeshChoices::Finding;

void add(std::vector<Finding>& findings, Finding finding) {
  if (finding.count > 0) findings.push_back(std::move(finding));
}

const char* plural(int count, const char* one, const char* many) { return count == 1 ? one : many; }

/// Elements that are turned inside out, not only listed in another order; none where their faces do not tell.
int count_inverted(TetMesh mesh) {
  try {
    return static_cast<int>(orient_elements(mesh).size());
  } catch (const InputError&) {
    return 0;
  }
}

void add_turned(std::vector<Finding>& findings, const TetMesh& mesh, const QualityReport& report, bool is_improved) {
  if (report.flipped == 0) return;
  const int inverted = count_inverted(mesh);
  if (inverted > 0)
    return add(findings, {inverted, plural(inverted, "inverted element", "inverted elements"),
                          is_improved ? "untangled" : "turned over", is_improved,
                          is_improved ? "Nodes were moved until each element had a volume."
                                      : "They overlap their neighbours. Another number of tetrahedra untangles them."});
  add(findings, {report.flipped, plural(report.flipped, "element wound inward", "elements wound inward"), "reordered",
                 true, "Their nodes were listed in the other order; the shapes are as in the file."});
}

void add_slivers(std::vector<Finding>& findings, const QualityReport& report, const QualityReport* improved) {
  const char* name = plural(report.slivers, "sliver", "slivers");
  const std::string before =
      fmt::format("Dihedral angles below 5°, the smallest {:.2g}°. They err, and explicit steps of them are short.",
                  report.worst_dihedral);
  if (!improved)
    return add(findings, {report.slivers, name, fmt::format("kept, thinnest {:.2g}°", report.worst_dihedral), false,
                          before + " Another number of tetrahedra improves the shapes."});
  const std::string after = fmt::format(" Now the smallest angle is {:.2g}°.", improved->worst_dihedral);
  if (improved->slivers == 0) return add(findings, {report.slivers, name, "improved", true, before + after});
  add(findings, {report.slivers, name, fmt::format("{} left", improved->slivers), false, before + after});
}

}  // namespace

std::vector<Finding> findings_of(const MendReport& report) {
  std::vector<Finding> findings;
  const FilledHoles& holes = report.holes;
  add(findings, {report.welded, plural(report.welded, "double node", "double nodes"), "merged", true,
                 "They lay beside others, within a millionth of the diagonal or along open edges."});
  add(findings, {report.flat, plural(report.flat, "flat triangle", "flat triangles"), "removed", true,
                 "Triangles without area."});
  add(findings, {report.duplicates, plural(report.duplicates, "double triangle", "double triangles"), "removed", true});
  add(findings, {report.split, plural(report.split, "T-junction", "T-junctions"), "edges split", true,
                 "Nodes that lay on edges of other triangles."});
  add(findings, {report.crumbs.parts, plural(report.crumbs.parts, "loose part", "loose parts"), "left out", true,
                 fmt::format("Below 0.2 % of the largest part's area; {} triangles in all.", report.crumbs.triangles)});
  add(findings, {report.walls.parts, plural(report.walls.parts, "inner wall", "inner walls"), "left out", true,
                 fmt::format("Walls and fins; {} triangles in all.", report.walls.triangles)});
  add(findings, {holes.sheets, plural(holes.sheets, "sheet", "sheets"), "left out", true, "They enclose nothing."});
  add(findings, {holes.holes, plural(holes.holes, "hole", "holes"), "closed", true,
                 fmt::format("The largest is {:.3g} around in the file's unit; its filling has {:.2g} % of the area.",
                             holes.longest, 100 * holes.largest_share)});
  add(findings, {report.turned, plural(report.turned, "triangle turned inward", "triangles turned inward"), "turned",
                 true, "They face outward now."});
  add(findings, {report.smoothed, plural(report.smoothed, "self-intersection", "self-intersections"), "smoothed apart",
                 true, "Pairs of triangles that crossed at creases; nodes were moved a little."});
  if (!report.unmended.empty()) {
    const bool crosses = report.crossings > 0;
    add(findings, {crosses ? report.crossings : 1,
                   crosses ? plural(report.crossings, "self-intersection", "self-intersections") : "surface not closed",
                   "meshed anew", true,
                   "No repair of triangles mends this: " + report.unmended + ". The space inside was meshed anew."});
  }
  return findings;
}

std::vector<Finding> findings_of(const TetMesh& mesh, const QualityReport& report, const QualityReport* improved) {
  std::vector<Finding> findings;
  add_turned(findings, mesh, report, improved != nullptr);
  add_slivers(findings, report, improved);
  if (report.components > 1)
    add(findings, {report.components, "separate bodies", "kept", false,
                   "They share no node. One that nothing holds falls or drifts."});
  add(findings, {report.duplicates, plural(report.duplicates, "double node", "double nodes"), "kept", false,
                 "Nodes at the very place of another: the body is open there."});
  add(findings, {report.nonmanifold_edges, plural(report.nonmanifold_edges, "edge", "edges"), "kept", false,
                 "Parts hang together by these edges alone."});
  add(findings, {report.orphans, plural(report.orphans, "lone node", "lone nodes"), improved ? "left out" : "kept",
                 improved != nullptr, "Nodes of no tetrahedron, without effect."});
  return findings;
}

}  // namespace heml
