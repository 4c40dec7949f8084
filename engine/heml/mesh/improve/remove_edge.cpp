#include <algorithm>
#include <heml/mesh/improve/remove_edge.hpp>

namespace heml {
namespace {

constexpr std::size_t max_ring = 14;  // nodes; longer ones hardly ever get better, at a cost cubic in the length

/// The best triangulation of the polygon of a sector's nodes.
class RingTriangulation {
 public:
  RingTriangulation(const LocalMesh& mesh, int a, int b, const RingSector& sector)
      : mesh_(mesh), a_(a), b_(b), ring_(sector.nodes), region_(mesh.region(sector.tets.front())) {
    const std::size_t n = ring_.size();
    for (std::size_t width = 2; width < n; ++width)
      for (std::size_t i = 0; i + width < n; ++i) {
        Part& part = parts_[i][i + width];
        for (std::size_t k = i + 1; k < i + width; ++k) {
          const double below = std::min(parts_[i][k].quality, parts_[k][i + width].quality);
          if (below <= part.quality && part.middle > 0) continue;
          const double quality = std::min(below, quality_of(i, k, i + width));
          if (part.middle == 0 || quality > part.quality) part = {quality, k};
        }
      }
  }

  double quality() const { return parts_[0][ring_.size() - 1].quality; }

  void append(std::vector<RegionTet>& tets) const { append(0, ring_.size() - 1, tets); }

 private:
  struct Part {
    double quality = 1;
    std::size_t middle = 0;  ///< 0: an edge of the polygon
  };

  Tet upper(std::size_t i, std::size_t k, std::size_t j) const { return {ring_[i], ring_[k], ring_[j], b_}; }
  Tet lower(std::size_t i, std::size_t k, std::size_t j) const { return {ring_[i], ring_[j], ring_[k], a_}; }
  double quality_of(std::size_t i, std::size_t k, std::size_t j) const {
    return std::min(mesh_.quality_of(upper(i, k, j)), mesh_.quality_of(lower(i, k, j)));
  }
  void append(std::size_t i, std::size_t j, std::vector<RegionTet>& tets) const {
    if (j < i + 2) return;
    const std::size_t k = parts_[i][j].middle;
    tets.push_back({upper(i, k, j), region_});
    tets.push_back({lower(i, k, j), region_});
    append(i, k, tets);
    append(k, j, tets);
  }

  const LocalMesh& mesh_;
  int a_, b_;
  const std::vector<int>& ring_;
  int region_;
  std::array<std::array<Part, max_ring>, max_ring> parts_;
};

/// Whether an edge of the surface can become the edge between the other ends of its two faces.
bool may_flip(const LocalMesh& mesh, const SurfaceGuard& guard, int a, int b, const std::vector<RingSector>& sectors) {
  std::vector<Triangle> faces;
  for (const Triangle& face : mesh.surface_faces(a))
    if (face[1] == b || face[2] == b) faces.push_back(face);
  if (faces.size() != 2) return false;
  if (faces[0][1] != b) std::swap(faces[0], faces[1]);
  if (faces[0][1] != b || faces[1][2] != b) return false;
  const int c = faces[0][2], d = faces[1][1];  // faces (a, b, c) and (a, d, b): the flipped edge is cd
  const bool flat = std::any_of(sectors.begin(), sectors.end(), [](const auto& s) { return s.tets.size() == 1; });
  if (c == d || (!flat && mesh.has_edge(c, d))) return false;
  if (flat)
    for (const Triangle& face : mesh.surface_faces(c))
      if (face[1] == d || face[2] == d) return false;
  const auto normal = [](const std::array<Vec3, 3>& t) { return Vec3((t[1] - t[0]).cross(t[2] - t[0])); };
  const Patch before = patch_of(mesh, faces), after = patch_of(mesh, {{a, d, c}, {d, b, c}});
  return !is_crease(normal(before[0]), normal(before[1])) && !is_crease(normal(after[0]), normal(after[1])) &&
         guard.allows(before, after);
}

bool is_removable(const std::vector<RingSector>& sectors) {
  for (const RingSector& sector : sectors)
    if (sector.nodes.size() > max_ring || (sector.is_closed && sector.nodes.size() < 3)) return false;
  if (sectors.size() == 1) return true;
  return sectors.size() == 2 && sectors[0].nodes.back() == sectors[1].nodes.front() &&
         sectors[1].nodes.back() == sectors[0].nodes.front();
}

}  // namespace

bool remove_edge(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b) {
  const auto sectors = mesh.ring(a, b);
  if (!is_removable(sectors)) return false;
  const std::vector<int> removed = elements_of(sectors);
  const double before = mesh.worst(removed);
  std::vector<RegionTet> added;
  for (const RingSector& sector : sectors) {
    const RingTriangulation best(mesh, a, b, sector);
    if (!(best.quality() > before + smallest_gain)) return false;
    best.append(added);
  }
  if (!sectors.front().is_closed && !may_flip(mesh, guard, a, b, sectors)) return false;
  for (const int n : {a, b}) {  // a corner that loses its only element
    std::size_t left = mesh.star(n).size() - removed.size();
    for (const RegionTet& tet : added) left += std::find(tet.nodes.begin(), tet.nodes.end(), n) != tet.nodes.end();
    if (left == 0) return false;
  }
  mesh.replace(removed, added);
  return true;
}

}  // namespace heml
