#include <algorithm>
#include <heml/base/thread_team.hpp>
#include <heml/math/closest.hpp>
#include <heml/mesh/weld.hpp>
#include <heml/session/skin_cutter.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr std::size_t vertices_per_thread = 500;

std::vector<std::uint32_t> welded(const TriangleMesh& mesh) {
  std::vector<Vec3f> places;
  for (const Vec3& x : mesh.nodes) places.push_back(x.cast<float>());
  return weld(places);
}

}  // namespace

TriangleMesh SkinCutter::as_mesh(const std::vector<Vec3f>& nodes, std::vector<Triangle> triangles) {
  TriangleMesh mesh;
  for (const Vec3f& x : nodes) mesh.nodes.push_back(x.cast<double>());
  mesh.triangles = std::move(triangles);
  return mesh;
}

SkinCutter::SkinCutter(std::shared_ptr<const Skin> skin, std::shared_ptr<const SurfaceMesh> whole)
    : skin_(std::move(skin)),
      whole_(std::move(whole)),
      tree_(skin_->surface.mesh),
      body_(as_mesh(whole_->rest, whole_->triangles)),
      same_(welded(skin_->surface.mesh)) {
  find_fans();
  anchor();
}

void SkinCutter::find_fans() {
  const std::vector<Triangle>& triangles = skin_->surface.mesh.triangles;
  first_.assign(same_.size() + 1, 0);
  for (const Triangle& t : triangles)
    for (const int v : t) ++first_[same_[static_cast<std::size_t>(v)] + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  around_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int v : triangles[t]) around_[next[same_[static_cast<std::size_t>(v)]]++] = static_cast<int>(t);
}

/// Finds the nearest place on the body's surface for every vertex.
void SkinCutter::anchor() {
  const std::vector<Vec3>& vertices = skin_->surface.mesh.nodes;
  anchors_.resize(vertices.size());
  faces_.resize(vertices.size());
  std::vector<double> distances(vertices.size());
  ThreadTeam team(0);
  team.parallel_for(vertices.size(), vertices_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const SurfaceTree::Nearest nearest = body_.nearest(vertices[v]);
      const auto face = static_cast<std::size_t>(nearest.triangle);
      faces_[v] = nearest.triangle;
      distances[v] = nearest.distance;
      const auto [a, b, c] = body_.corners(nearest.triangle);
      const auto weights = closest_point_weights(nearest.point, a, b, c);
      for (std::size_t k = 0; k < 3; ++k) anchors_[v].weights[k] = static_cast<float>(weights[k]);
      anchors_[v].region = whole_->regions.empty() ? 0 : whole_->regions[face];
      for (std::size_t k = 0; k < 3; ++k)
        anchors_[v].nodes[k] = whole_->nodes[static_cast<std::size_t>(whole_->triangles[face][k])];
    }
  });
  for (const double distance : distances) reach_ = std::max(reach_, distance);
}

}  // namespace heml
