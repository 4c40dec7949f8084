#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/elements_around.hpp>
#include <heml/session/remaining_skin.hpp>
#include <heml/session/skin_cutter.hpp>
#include <heml/session/skin_split.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace heml {
namespace {

constexpr double least_strip = 10;   // height of a strip between skin and wound, in OriginalSkin::tolerance()
constexpr double step_inward = 0.1;  // from a vertex to the middle of a triangle, to tell the side it is on
constexpr double curtain_reach = 3;  // in distances of the skin: a curtain on an edge of the body leans

}  // namespace

/// One cut of the skin.
class SkinCutter::Cut {
 public:
  Cut(const SkinCutter& cutter, const SurfaceMesh& surface, const Topology& topology, const TetMesh& mesh)
      : cutter_(cutter),
        base_(*cutter.skin_),
        surface_(surface),
        mesh_(mesh),
        original_(surface),
        left_(surface, original_),
        around_(mesh, topology),
        result_(*cutter.skin_) {
    result_.anchors = cutter.anchors_;
    result_.same = cutter.same_;
    const double reach = curtain_reach * cutter.reach_ + 100 * original_.tolerance();
    split_ = split_along(wound_rim(surface, original_.exposed()),
                         {cutter.tree_, cutter.same_, cutter.first_, cutter.around_}, reach);
    find_loose(topology);
  }

  Skin run() {
    lay_out();
    join_corners();
    choose_sides();
    hang_vertices();
    add_parts();
    add_strips();
    return std::move(result_);
  }

 private:
  /// A triangle of the new skin, while it is made: one of the skin as it was, or a part of one.
  struct Face {
    int triangle;
    int part;                    // −1: whole
    std::array<int, 3> corners;  // base vertices; points from #V on
    double area;
    int tile;  // at its edge along the cut, or below its middle; −1: none, the tissue there is gone
  };
  /// What is one vertex by shape: a welded vertex of the base, or a point on one side of the cut.
  struct Site {
    Vec3 place, foot;
    std::vector<int> faces;
    int tile = -1, element = -1;
  };

  std::size_t vertices() const { return base_.surface.mesh.nodes.size(); }
  Vec3 place(int corner) const {
    const auto c = static_cast<std::size_t>(corner);
    return c < vertices() ? base_.surface.mesh.nodes[c] : split_.points[c - vertices()].place;
  }

  /// Marks welded vertices that cannot stay as they are: their element or the face below them is gone, or they are near
  /// the cut and may be on its other side.
  void find_loose(const Topology& topology) {
    std::vector<char> present(mesh_.tets.size(), 0);
    for (const int t : topology.elements) present[static_cast<std::size_t>(t)] = 1;
    const std::vector<int> kept = left_.kept_of(*cutter_.whole_);
    for (const int f : cutter_.faces_) tiles_.push_back(kept[static_cast<std::size_t>(f)]);
    loose_.assign(vertices(), 0);
    for (std::size_t v = 0; v < vertices(); ++v)
      if (!present[static_cast<std::size_t>(base_.embedding.tets[v])] || tiles_[v] < 0) loose_[cutter_.same_[v]] = 1;
    const auto loosen = [&](int triangle) {
      for (const int v : base_.surface.mesh.triangles[static_cast<std::size_t>(triangle)])
        loose_[cutter_.same_[static_cast<std::size_t>(v)]] = 1;
    };
    for (const SplitSkin::Part& part : split_.parts) loosen(part.triangle);
    for (const int triangle : split_.near) loosen(triangle);
  }

  /// The original face, still there, below a point; −1: none.
  int tile_below(const Vec3& x) const {
    const SurfaceTree::Nearest foot = cutter_.body_.nearest(x);
    return left_.at(foot.point);
  }

  void add_face(int triangle, int part, const std::array<int, 3>& corners) {
    const Vec3 a = place(corners[0]), b = place(corners[1]), c = place(corners[2]);
    std::optional<int> tile;
    for (std::size_t k = 0; k < 3 && !tile; ++k)
      if (const auto face = rim_face(corners[k], corners[(k + 1) % 3])) tile = left_.tile_of(*face);
    if (!tile) tile = tile_below((a + b + c) / 3);
    faces_.push_back({triangle, part, corners, (b - a).cross(c - a).norm() / 2, *tile});
  }

  /// Lists the faces at loose vertices; all others stay as they are.
  void lay_out() {
    const std::vector<Triangle>& triangles = base_.surface.mesh.triangles;
    std::vector<char> divided(triangles.size(), 0);
    for (std::size_t p = 0; p < split_.parts.size(); ++p) {
      const SplitSkin::Part& part = split_.parts[p];
      divided[static_cast<std::size_t>(part.triangle)] = 1;
      add_face(part.triangle, static_cast<int>(p), part.corners);
    }
    result_.surface.mesh.triangles.clear();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (divided[t]) continue;
      const bool is_loose = std::any_of(triangles[t].begin(), triangles[t].end(),
                                        [&](int v) { return loose_[cutter_.same_[static_cast<std::size_t>(v)]] != 0; });
      if (is_loose)
        add_face(static_cast<int>(t), -1, triangles[t]);
      else
        result_.surface.mesh.triangles.push_back(triangles[t]);
    }
    std::erase_if(faces_, [](const Face& face) { return face.tile < 0; });
  }

  /// The face of the surface on the left of an edge that parts the skin, −1 where there is none; empty: it does not.
  std::optional<int> rim_face(int from, int to) const {
    const int first = static_cast<int>(vertices());
    const auto found = split_.along_rim.find({from - first, to - first});
    return found == split_.along_rim.end() ? std::nullopt : std::optional(found->second);
  }
  int welded(int corner) const {
    return static_cast<std::size_t>(corner) < vertices()
               ? static_cast<int>(cutter_.same_[static_cast<std::size_t>(corner)])
               : corner;
  }

  std::size_t root(std::size_t corner) {
    while (joined_[corner] != corner) corner = joined_[corner] = joined_[joined_[corner]];
    return corner;
  }

  /// Joins corners at a point that lie on the same side of the cut: their faces meet at an edge that does not part.
  void join_corners() {
    joined_.resize(3 * faces_.size());
    std::iota(joined_.begin(), joined_.end(), std::size_t{0});
    std::map<std::array<int, 2>, std::array<std::size_t, 2>> seen;  // corners at the lower and higher end of an edge
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = 3 * f + k, to = 3 * f + (k + 1) % 3;
        const int a = welded(faces_[f].corners[k]), b = welded(faces_[f].corners[(k + 1) % 3]);
        if (rim_face(a, b)) continue;
        const std::array ends = a < b ? std::array{from, to} : std::array{to, from};
        const auto [other, is_new] = seen.try_emplace({std::min(a, b), std::max(a, b)}, ends);
        if (is_new) continue;
        joined_[root(ends[0])] = root(other->second[0]);
        joined_[root(ends[1])] = root(other->second[1]);
      }
  }

  /// The site of a corner: of its welded vertex, or of its side of the cut.
  std::size_t site_of(std::size_t face, std::size_t k) {
    const int corner = faces_[face].corners[k];
    const bool is_point = static_cast<std::size_t>(corner) >= vertices();
    const std::size_t key = is_point ? vertices() + root(3 * face + k) : static_cast<std::size_t>(welded(corner));
    const auto [known, is_new] = sites_by_key_.try_emplace(key, sites_.size());
    if (is_new) {
      Site& site = sites_.emplace_back();
      site.place = site.foot = place(corner);
      if (is_point)
        site.foot = split_.points[static_cast<std::size_t>(corner) - vertices()].foot;
      else
        site.foot = cutter_.body_.nearest(site.place).point;
    }
    return known->second;
  }

  /// Finds the sites of all corners. Those at an edge along the cut are on the side of the body that has that edge.
  void find_sites() {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t s = site_of(f, k);
        corner_sites_.push_back(s);
        sites_[s].faces.push_back(static_cast<int>(f));
        const auto v = static_cast<std::size_t>(faces_[f].corners[k]);
        if (v < vertices() && !loose_[cutter_.same_[v]])  // stays as it is
          sites_[s].tile = tiles_[v];
      }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto face = rim_face(faces_[f].corners[k], faces_[f].corners[(k + 1) % 3]); face && *face >= 0)
          for (const std::size_t s : {corner_sites_[3 * f + k], corner_sites_[3 * f + (k + 1) % 3]})
            if (sites_[s].tile < 0) {
              sites_[s].tile = left_.tile_of(*face);
              known_.push_back(s);
            }
  }

  /// Finds for each site the original face below it, and a suitable element behind that, on its side of the cut: that
  /// of its neighbours, away from the cut.
  void choose_sides() {
    find_sites();
    for (std::size_t i = 0; i < known_.size(); ++i)
      for (const int f : sites_[known_[i]].faces)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t s = corner_sites_[3 * static_cast<std::size_t>(f) + k];
          if (sites_[s].tile >= 0) continue;
          sites_[s].tile = below(sites_[s]);
          if (sites_[s].tile < 0 || !left_.are_connected(sites_[known_[i]].tile, sites_[s].tile))
            sites_[s].tile = sites_[known_[i]].tile;
          known_.push_back(s);
        }
    for (Site& site : sites_) {
      if (site.tile < 0) site.tile = below(site);
      if (site.tile < 0) site.tile = faces_[static_cast<std::size_t>(site.faces[0])].tile;
      const int behind = surface_.elements[left_.face(site.tile)];
      site.element = around_.suitable(behind, site.place);
    }
  }

  /// The tile below a site, seen from the largest face at it.
  int below(const Site& site) const {
    const auto largest = *std::max_element(site.faces.begin(), site.faces.end(), [&](int a, int b) {
      return faces_[static_cast<std::size_t>(a)].area < faces_[static_cast<std::size_t>(b)].area;
    });
    const std::array<int, 3>& corners = faces_[static_cast<std::size_t>(largest)].corners;
    const Vec3 middle = (place(corners[0]) + place(corners[1]) + place(corners[2])) / 3;
    return tile_below(site.place + step_inward * (middle - site.place));
  }

  /// Lets vertex v of the result hang on a site's tissue, at a point near it.
  void hang(std::size_t v, const Site& site, const Vec3& x) {
    const Eigen::Vector4d weights = around_.weights(site.element, x);
    result_.embedding.tets[v] = site.element;
    result_.embedding.nodes[v] = mesh_.tets[static_cast<std::size_t>(site.element)];
    for (int i = 0; i < 4; ++i)
      result_.embedding.weights[v][static_cast<std::size_t>(i)] = static_cast<float>(weights[i]);
    const std::size_t face = left_.face(site.tile);
    SkinAnchor& anchor = result_.anchors[v];
    const auto [a, b, c] = left_.corners(site.tile);
    const auto on_face = closest_point_weights(site.foot, a, b, c);
    for (std::size_t k = 0; k < 3; ++k) anchor.weights[k] = static_cast<float>(on_face[k]);
    anchor.region = surface_.regions[face];
    for (std::size_t k = 0; k < 3; ++k)
      anchor.nodes[k] = surface_.nodes[static_cast<std::size_t>(surface_.triangles[face][k])];
  }

  void hang_vertices() {
    for (std::size_t v = 0; v < vertices(); ++v)
      if (const auto site = sites_by_key_.find(cutter_.same_[v]);
          loose_[cutter_.same_[v]] && site != sites_by_key_.end())
        hang(v, sites_[site->second], base_.surface.mesh.nodes[v]);
  }

  /// Adds a vertex at x with the look of a place in a triangle of the base.
  int add_vertex(const Site& site, const Vec3& x, int triangle, const Vec3& weights) {
    TexturedSurface& surface = result_.surface;
    const std::size_t v = surface.mesh.nodes.size();
    surface.mesh.nodes.push_back(x);
    const Triangle& corners = base_.surface.mesh.triangles[static_cast<std::size_t>(triangle)];
    std::array<float, 2> where{0, 0};
    Vec3f colour = Vec3f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto n = static_cast<std::size_t>(corners[k]);
      const auto w = static_cast<float>(weights[static_cast<int>(k)]);
      for (std::size_t i = 0; i < 2 && !surface.places.empty(); ++i) where[i] += w * base_.surface.places[n][i];
      if (!surface.colours.empty()) colour += w * base_.surface.colours[n];
    }
    if (!surface.places.empty()) surface.places.push_back(where);
    if (!surface.colours.empty()) surface.colours.push_back(colour);
    result_.same.push_back(static_cast<std::uint32_t>(v));
    result_.embedding.tets.emplace_back();
    result_.embedding.nodes.emplace_back();
    result_.embedding.weights.emplace_back();
    result_.anchors.emplace_back();
    hang(v, site, x);
    return static_cast<int>(v);
  }

  /// Adds the faces at loose vertices. Parts of one triangle share vertices; those of two share `same`.
  void add_parts() {
    std::map<std::pair<std::size_t, int>, int> known;  // by site and triangle of the base
    std::map<std::size_t, std::uint32_t> first;        // by site
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[f];
      Triangle corners = face.corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t s = corner_sites_[3 * f + k];
        const Site& lead = sites_[corner_sites_[3 * f]];
        if (!left_.are_connected(lead.tile, sites_[s].tile)) {
          corners[k] = add_vertex(beside(lead, sites_[s]), sites_[s].place, face.triangle, weights_at(face, k));
          continue;
        }
        if (static_cast<std::size_t>(corners[k]) < vertices()) continue;
        const auto [vertex, is_new] = known.try_emplace({s, face.triangle}, -1);
        if (is_new) {
          vertex->second = add_vertex(sites_[s], sites_[s].place, face.triangle, weights_at(face, k));
          const auto v = static_cast<std::uint32_t>(vertex->second);
          result_.same[v] = first.try_emplace(s, v).first->second;
        }
        corners[k] = vertex->second;
      }
      result_.surface.mesh.triangles.push_back(corners);
    }
  }

  Vec3 weights_at(const Face& face, std::size_t k) const {
    return face.part < 0 ? Vec3::Unit(static_cast<int>(k))
                         : split_.parts[static_cast<std::size_t>(face.part)].weights[k];
  }

  /// A site on the side of another: where a line along the rim was not found, far from the body at a sharp edge of it,
  /// triangles across the cut come off instead of spanning it.
  Site beside(const Site& lead, const Site& site) const {
    Site moved = site;
    moved.tile = lead.tile;
    moved.element = around_.suitable(lead.element, site.place);
    return moved;
  }

  /// Closes the gap between the skin's new edges and the rim of the wound, where the skin lies above it.
  void add_strips() {
    const double least = least_strip * original_.tolerance();
    std::map<std::size_t, std::array<int, 2>> ends;  // by site: vertices at the skin and at the rim
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[f];
      for (std::size_t k = 0; k < 3 && face.part >= 0; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (!rim_face(face.corners[k], face.corners[next])) continue;
        const std::array sites{corner_sites_[3 * f + k], corner_sites_[3 * f + next]};
        const auto height = [&](std::size_t s) {
          const auto [a, b, c] = left_.corners(sites_[s].tile);
          return (sites_[s].place - sites_[s].foot).dot((b - a).cross(c - a).normalized());
        };
        if (std::max(height(sites[0]), height(sites[1])) < least ||
            !left_.are_connected(sites_[sites[0]].tile, sites_[sites[1]].tile))
          continue;
        std::array<std::array<int, 2>, 2> at;
        for (std::size_t e = 0; e < 2; ++e) {
          const auto [known, is_new] = ends.try_emplace(sites[e]);
          const Site site = sites_[sites[e]];
          const Vec3 weights = weights_at(face, e == 0 ? k : next);
          if (is_new)
            known->second = {add_vertex(site, site.place, face.triangle, weights),
                             add_vertex(site, site.foot, face.triangle, weights)};
          at[e] = known->second;
        }
        result_.surface.mesh.triangles.push_back({at[1][0], at[0][0], at[0][1]});
        result_.surface.mesh.triangles.push_back({at[1][0], at[0][1], at[1][1]});
      }
    }
  }

  const SkinCutter& cutter_;
  const Skin& base_;
  const SurfaceMesh& surface_;
  const TetMesh& mesh_;
  OriginalSkin original_;
  RemainingSkin left_;
  ElementsAround around_;
  SplitSkin split_;
  std::vector<int> tiles_;   // #V: the tile that was below a vertex before the cut too; −1: it is no more
  std::vector<char> loose_;  // #V, by welded vertex
  std::vector<Face> faces_;
  std::vector<std::size_t> joined_;  // corners of faces_, as a forest
  std::map<std::size_t, std::size_t> sites_by_key_;
  std::vector<Site> sites_;
  std::vector<std::size_t> corner_sites_;  // 3 a face
  std::vector<std::size_t> known_;         // sites whose side is known, nearest to the cut first
  Skin result_;
};

std::shared_ptr<const Skin> SkinCutter::cut(const SurfaceMesh& surface, const Topology& topology,
                                            const TetMesh& mesh) const {
  return std::make_shared<const Skin>(Cut(*this, surface, topology, mesh).run());
}

}  // namespace heml
