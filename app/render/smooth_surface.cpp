#include "app/render/smooth_surface.hpp"

#include <map>
#include <numbers>
#include <numeric>

namespace heml::render {
namespace {

constexpr float rim_corner = 0.5f;  // cosine of the turn from which a rim has a corner

Vec3f unit_or_zero(const Vec3f& v) {
  const float length = v.norm();
  return length > 0 && std::isfinite(length) ? Vec3f(v / length) : Vec3f(Vec3f::Zero());
}

// Vlachos 2001, section 3.3: the normal at the middle of an edge, reflected so that it captures inflections.
Vec3f middle_normal(const Vec3f& p, const Vec3f& q, const Vec3f& n, const Vec3f& m) {
  const Vec3f d = q - p;
  const float squared = d.squaredNorm();
  if (!(squared > 0)) return n;
  return unit_or_zero(n + m - (2 * d.dot(n + m) / squared) * d);
}

// Control point of the edge p→q near p, section 3.2: a third of the way, projected onto the tangent plane at p.
Vec3f control(const Vec3f& p, const Vec3f& q, const Vec3f& n) { return (2 * p + q - (q - p).dot(n) * n) / 3; }

}  // namespace

SmoothSurface::SmoothSurface(const SurfaceMesh& surface_mesh, int segments, std::span<const char> exposed)
    : topology_(surface_topology(surface_mesh, crease_angle, exposed)), segments_(segments) {
  for (int c = 0; c < static_cast<int>(topology_.corner_nodes.size()); ++c) blends_.push_back({{c, c, c}, {1, 0, 0}});
  number_edges();
  number_triangles();
  find_rim(exposed);
  controls_.resize(topology_.edges.size());
  update(surface_mesh.rest);
}

int SmoothSurface::suitable_segments(std::size_t triangles) {
  if (triangles <= 700) return 4;
  if (triangles <= 1800) return 3;
  return triangles <= 5000 ? 2 : 1;
}

/// Rim edges belong to one exposed face and one of the skin.
void SmoothSurface::find_rim(std::span<const char> exposed) {
  std::vector<std::array<int, 2>> faces(exposed.empty() ? 0 : topology_.edges.size());  // of skin, exposed
  for (std::size_t t = 0; t < exposed.size(); ++t)
    for (const int e : topology_.triangle_edges[t]) ++faces[e][exposed[t] ? 1 : 0];
  std::map<int, std::vector<int>> neighbours;  // of a node along the rim
  for (std::size_t e = 0; e < faces.size(); ++e) {
    if (faces[e] != std::array{1, 1}) continue;
    const SurfaceEdge& edge = topology_.edges[e];
    rim_.push_back({static_cast<int>(e), -1, -1});
    neighbours[edge.from].push_back(edge.to);
    neighbours[edge.to].push_back(edge.from);
  }
  const auto beyond = [&](int node, int from) {
    const std::vector<int>& next = neighbours[node];
    return next.size() != 2 ? -1 : next[0] == from ? next[1] : next[0];
  };
  for (RimEdge& rim : rim_) {
    const SurfaceEdge& edge = topology_.edges[rim.edge];
    rim.before = beyond(edge.from, edge.to);
    rim.after = beyond(edge.to, edge.from);
  }
}

std::vector<std::uint32_t> SmoothSurface::joined_vertices() const {
  std::vector<std::uint32_t> joined(blends_.size());
  std::iota(joined.begin(), joined.end(), 0);
  std::map<int, std::uint32_t> first_corner;  // of a node
  for (std::size_t c = 0; c < topology_.corner_nodes.size(); ++c)
    joined[c] = first_corner.try_emplace(topology_.corner_nodes[c], static_cast<std::uint32_t>(c)).first->second;
  for (const auto& firsts : edge_first_)
    for (const std::uint32_t first : firsts)
      for (int step = 1; step < segments_; ++step) joined[first + step - 1] = firsts[0] + step - 1;
  return joined;
}

void SmoothSurface::number_edges() {
  for (const SurfaceEdge& edge : topology_.edges) {
    std::vector<std::uint32_t> firsts;
    for (const SurfaceEdge::Side& side : edge.sides) {
      firsts.push_back(static_cast<std::uint32_t>(blends_.size()));
      for (int step = 1; step < segments_; ++step) {
        const float t = static_cast<float>(step) / static_cast<float>(segments_);
        blends_.push_back({{side.from, side.to, side.to}, {1 - t, t, 0}});
      }
    }
    std::uint32_t previous = edge.sides[0].from;
    for (int step = 1; step <= segments_; ++step) {
      const std::uint32_t next = step < segments_ ? firsts[0] + step - 1 : edge.sides[0].to;
      lines_.insert(lines_.end(), {previous, next});
      previous = next;
    }
    edge_first_.push_back(std::move(firsts));
  }
}

// Vertex `step` of 0..segments along side k of a triangle, from its vertex k to its vertex k+1.
std::uint32_t SmoothSurface::edge_vertex(int triangle, int side, int step) const {
  const Triangle& corners = topology_.triangles[triangle];
  const int a = corners[side], b = corners[(side + 1) % 3];
  if (step == 0) return a;
  if (step == segments_) return b;
  const int e = topology_.triangle_edges[triangle][side];
  const SurfaceEdge& edge = topology_.edges[e];
  const bool forward = topology_.corner_nodes[a] == edge.from;
  const SurfaceEdge::Side wanted = forward ? SurfaceEdge::Side{a, b} : SurfaceEdge::Side{b, a};
  std::size_t s = 0;
  while (!(edge.sides[s] == wanted)) ++s;
  return edge_first_[e][s] + (forward ? step : segments_ - step) - 1;
}

void SmoothSurface::number_triangles() {
  interior_first_ = static_cast<std::uint32_t>(blends_.size());
  const int n = segments_;
  for (int t = 0; t < static_cast<int>(topology_.triangles.size()); ++t) {
    const auto first = static_cast<std::uint32_t>(blends_.size());
    for (int j = 1; j < n; ++j)
      for (int i = 1; i + j < n; ++i)
        blends_.push_back({topology_.triangles[t],
                           {static_cast<float>(n - i - j) / n, static_cast<float>(i) / n, static_cast<float>(j) / n}});
    // (i, j): i steps towards vertex 1, j towards vertex 2; row j of the interior starts after the rows below it.
    const auto vertex = [&](int i, int j) -> std::uint32_t {
      if (j == 0) return edge_vertex(t, 0, i);
      if (i + j == n) return edge_vertex(t, 1, j);
      if (i == 0) return edge_vertex(t, 2, n - j);
      return first + (j - 1) * (n - 1) - (j - 1) * j / 2 + (i - 1);
    };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        triangles_.insert(triangles_.end(), {vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j + 1 < n)
          triangles_.insert(triangles_.end(), {vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  }
}

void SmoothSurface::update(std::span<const Vec3f> nodes) {
  positions_.resize(blends_.size());
  normals_.resize(blends_.size());
  for (std::size_t c = 0; c < topology_.corner_nodes.size(); ++c) positions_[c] = nodes[topology_.corner_nodes[c]];
  update_corner_normals();
  if (segments_ == 1) return;
  update_edges(nodes);
  update_interiors(nodes);
}

// Weights of Max, "Weights for computing vertex normals from facet normals", 1999: exact for nodes on a sphere.
void SmoothSurface::update_corner_normals() {
  for (std::size_t c = 0; c < topology_.corner_nodes.size(); ++c) normals_[c].setZero();
  for (const auto& [a, b, c] : topology_.triangles) {
    const Vec3f ab = positions_[b] - positions_[a], bc = positions_[c] - positions_[b],
                ca = positions_[a] - positions_[c];
    const float ab2 = ab.squaredNorm(), bc2 = bc.squaredNorm(), ca2 = ca.squaredNorm();
    if (!(ab2 > 0 && bc2 > 0 && ca2 > 0)) continue;
    const Vec3f area = ab.cross(bc);
    normals_[a] += area / (ab2 * ca2);
    normals_[b] += area / (bc2 * ab2);
    normals_[c] += area / (ca2 * bc2);
  }
  for (std::size_t c = 0; c < topology_.corner_nodes.size(); ++c) normals_[c] = unit_or_zero(normals_[c]);
}

void SmoothSurface::update_rim(std::span<const Vec3f> nodes) {
  const auto inner = [&](int other, const Vec3f& p, const Vec3f& q) -> Vec3f {  // control point next to p
    const Vec3f straight = p + (q - p) / 3;
    if (other < 0) return straight;
    const Vec3f back = p - nodes[other], ahead = q - p;
    if (back.dot(ahead) < rim_corner * back.norm() * ahead.norm()) return straight;
    return p + ahead.norm() / 3 * unit_or_zero(q - nodes[other]);
  };
  for (const RimEdge& rim : rim_) {
    const Vec3f &p = nodes[topology_.edges[rim.edge].from], &q = nodes[topology_.edges[rim.edge].to];
    controls_[rim.edge] = {inner(rim.before, p, q), inner(rim.after, q, p)};
  }
}

void SmoothSurface::update_edges(std::span<const Vec3f> nodes) {
  for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
    const SurfaceEdge& edge = topology_.edges[e];
    const Vec3f &p = nodes[edge.from], &q = nodes[edge.to];
    Vec3f near_p = Vec3f::Zero(), near_q = Vec3f::Zero();
    for (const auto& side : edge.sides) {  // all sheets of a sharp edge share the mean of their curves
      near_p += control(p, q, normals_[side.from]);
      near_q += control(q, p, normals_[side.to]);
    }
    const auto count = static_cast<float>(edge.sides.size());
    controls_[e] = {near_p / count, near_q / count};
  }
  update_rim(nodes);
  for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
    const SurfaceEdge& edge = topology_.edges[e];
    const Vec3f &p = nodes[edge.from], &q = nodes[edge.to];
    for (std::size_t s = 0; s < edge.sides.size(); ++s) {
      const Vec3f &n = normals_[edge.sides[s].from], &m = normals_[edge.sides[s].to];
      const Vec3f middle = middle_normal(p, q, n, m);
      for (int step = 1; step < segments_; ++step) {
        const float t = static_cast<float>(step) / static_cast<float>(segments_), u = 1 - t;
        const std::uint32_t vertex = edge_first_[e][s] + step - 1;
        positions_[vertex] =
            u * u * u * p + 3 * u * u * t * controls_[e][0] + 3 * u * t * t * controls_[e][1] + t * t * t * q;
        normals_[vertex] = unit_or_zero(u * u * n + u * t * middle + t * t * m);
      }
    }
  }
}

void SmoothSurface::update_interiors(std::span<const Vec3f> nodes) {
  std::uint32_t vertex = interior_first_;
  if (segments_ < 3) return;
  for (std::size_t f = 0; f < topology_.triangles.size(); ++f) {
    const Triangle& corners = topology_.triangles[f];
    std::array<Vec3f, 3> p, n, middle;
    std::array<std::array<Vec3f, 2>, 3> b;  // b[k]: control points of side k, near vertex k and near vertex k+1
    Vec3f sum = Vec3f::Zero();
    for (int k = 0; k < 3; ++k) {
      p[k] = nodes[topology_.corner_nodes[corners[k]]];
      n[k] = normals_[corners[k]];
      const int e = topology_.triangle_edges[f][k];
      b[k] = controls_[e];
      if (topology_.corner_nodes[corners[k]] != topology_.edges[e].from) std::swap(b[k][0], b[k][1]);
      sum += b[k][0] + b[k][1];
    }
    for (int k = 0; k < 3; ++k) middle[k] = middle_normal(p[k], p[(k + 1) % 3], n[k], n[(k + 1) % 3]);
    const Vec3f centre = sum / 4 - (p[0] + p[1] + p[2]) / 6;  // b111 = E + (E − V)/2
    const int count = (segments_ - 1) * (segments_ - 2) / 2;
    for (int i = 0; i < count; ++i, ++vertex) {
      const auto [u, v, w] = blends_[vertex].weights;  // of vertices 0, 1, 2
      positions_[vertex] = u * u * u * p[0] + v * v * v * p[1] + w * w * w * p[2] +
                           3 * (u * u * v * b[0][0] + u * v * v * b[0][1] + v * v * w * b[1][0] + v * w * w * b[1][1] +
                                w * w * u * b[2][0] + w * u * u * b[2][1]) +
                           6 * u * v * w * centre;
      normals_[vertex] = unit_or_zero(u * u * n[0] + v * v * n[1] + w * w * n[2] + u * v * middle[0] +
                                      v * w * middle[1] + w * u * middle[2]);
    }
  }
}

}  // namespace heml::render
