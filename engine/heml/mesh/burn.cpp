#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/burn.hpp>
#include <limits>

namespace heml {
namespace {

/// The path of an electrode: what it sweeps, and its edges, which are there where it is a point.
class Path {
 public:
  explicit Path(const Sweep& sweep) : surface_(oriented(sweep)) {
    const auto& blades = sweep.blades;
    for (std::size_t k = 0; k < blades.size(); ++k) {
      add(blades[k][0], blades[k][1]);
      for (std::size_t end = 0; k > 0 && end < 2; ++end) add(blades[k - 1][end], blades[k][end]);
    }
  }

  const Eigen::AlignedBox3d& box() const { return box_; }

  double distance(const Vec3& x) const {
    double nearest = surface_.empty() ? std::numeric_limits<double>::infinity() : surface_.nearest(x).distance;
    for (const auto& [from, to] : edges_) {
      const Vec3 along = to - from;
      const double t = closest_on_segments(from, along, x, Vec3::Zero()).first;
      nearest = std::min(nearest, (from + t * along - x).norm());
    }
    return nearest;
  }

 private:
  void add(const Vec3& from, const Vec3& to) {
    edges_.push_back({from, to});
    box_.extend(from).extend(to);
  }

  SweptSurface surface_;
  std::vector<std::array<Vec3, 2>> edges_;
  Eigen::AlignedBox3d box_;
};

}  // namespace

double burn_level(double distance, double radius) {
  const double t = std::clamp(2 * distance / radius - 1, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

std::vector<Burn> burns_after(const Heat& heat, const Sweep& sweep, const TetMesh& mesh, const std::vector<Vec3>& x,
                              const Topology& topology) {
  std::vector<Burn> burns = mesh.burns;
  burns.resize(mesh.tets.size());
  const Path path(sweep);
  for (const int element : topology.elements) {
    const auto t = static_cast<std::size_t>(element);
    const auto at = [&](std::size_t corner) { return x[static_cast<std::size_t>(mesh.tets[t][corner])]; };
    Eigen::AlignedBox3d box(at(0));
    for (std::size_t c = 1; c < 4; ++c) box.extend(at(c));
    if (!(box.exteriorDistance(path.box()) < heat.radius)) continue;
    double nearest = path.distance((at(0) + at(1) + at(2) + at(3)) / 4);
    for (std::size_t c = 0; c < 4; ++c) nearest = std::min(nearest, path.distance(at(c)));
    for (const auto& [a, b] : tet_edges) nearest = std::min(nearest, path.distance((at(a) + at(b)) / 2));
    const double level = burn_level(nearest, heat.radius);
    burns[t].level = std::max(burns[t].level, level);
    burns[t].shrink = std::max(burns[t].shrink, heat.shrink * level);
  }
  return burns;
}

bool are_contracting(const std::vector<Burn>& burns) {
  return std::any_of(burns.begin(), burns.end(), [](const Burn& burn) { return burn.scale > 1 - burn.shrink; });
}

void contract(std::vector<Burn>& burns, double by) {
  for (Burn& burn : burns)
    if (const double end = 1 - burn.shrink; burn.scale > end) burn.scale = std::max(end, burn.scale - by);
}

}  // namespace heml
