#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/improve/improve.hpp>
#include <heml/mesh/labels/cut_lattice.hpp>
#include <heml/mesh/labels/merge_scraps.hpp>
#include <heml/mesh/mend/remesh.hpp>
#include <heml/mesh/mend/winding_number.hpp>

namespace heml {
namespace {

constexpr double max_tets = 12000, min_tets = 4000;  // of finest cells alone; inside they are coarser
constexpr double tets_of_cell = 12;
constexpr double max_cells = 1.5e6;    // of the box
constexpr double remesh_growth = 2.4;  // of the number of elements: this power of 1 / cell, about
constexpr int max_passes = 4;
constexpr double remesh_tolerance_of_cell = 0.01;

class Remesher {
 public:
  Remesher(const TriangleMesh& surface, std::optional<double> max_volume) : winding_(surface), max_volume_(max_volume) {
    for (const Triangle& t : surface.triangles)
      for (const int n : t) box_.extend(surface.nodes[n]);
  }

  TetMesh run() {
    TetMesh mesh = best_lattice();
    mesh.source = surface().source;
    merge_scraps(mesh);
    if (mesh.tets.empty()) refuse();
    ImproveOptions improving;
    improving.surface_tolerance = remesh_tolerance_of_cell * cell_;
    mesh = improve(std::move(mesh), improving).mesh;
    mesh.regions.assign(mesh.tets.size(), 0);
    warn("{}: meshed anew with {} elements about {:.3g} long at the surface, which lies within {:.2g} of the file's",
         surface().source, mesh.tets.size(), cell_, distance_of(mesh));
    return mesh;
  }

 private:
  const TriangleMesh& surface() const { return winding_.tree().surface(); }

  [[noreturn]] void refuse() const {
    throw InputError(surface().source, "", "the surface winds round no volume", "a surface round a body");
  }

  TetMesh best_lattice() {
    cell_ = first_cell();
    TetMesh mesh;
    for (int pass = 0; pass < max_passes; ++pass) {
      mesh = cut_lattice(make_lattice(winding_, box_.min(), box_.max(), cell_, surface().source), winding_);
      const double ratio = static_cast<double>(mesh.tets.size()) / max_tets;
      if (max_volume_ || ratio <= 1.25) break;
      cell_ *= std::pow(ratio, 1 / remesh_growth);
    }
    return mesh;
  }

  double first_cell() const {
    double volume = sampled_volume(24);
    if (volume == 0) volume = sampled_volume(96);
    if (volume == 0) refuse();
    const auto cell_for = [&](double tets) { return std::cbrt(tets_of_cell * volume / tets); };
    double cell = std::clamp(mean_edge(), cell_for(max_tets), cell_for(min_tets));
    if (max_volume_) cell = std::min(cell, std::cbrt(tets_of_cell * *max_volume_));
    return std::max(cell, std::cbrt(box_.volume() / max_cells));
  }

  /// From the points of a grid, `count` along each axis, that the surface winds round.
  double sampled_volume(int count) const {
    int inside = 0;
    for (int z = 0; z < count; ++z)
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
          inside +=
              winding_.label_at(box_.min() + (Vec3(x, y, z) + Vec3::Constant(0.5)).cwiseProduct(box_.sizes()) / count);
    return box_.volume() * inside / std::pow(count, 3);
  }

  double mean_edge() const {
    double sum = 0;
    for (const Triangle& t : surface().triangles)
      for (std::size_t i = 0; i < 3; ++i) sum += (surface().nodes[t[i]] - surface().nodes[t[(i + 1) % 3]]).norm();
    return sum / (3.0 * static_cast<double>(surface().triangles.size()));
  }

  /// Of the new surface's nodes from the old one.
  double distance_of(const TetMesh& mesh) const {
    std::vector<char> seen(mesh.nodes.size(), 0);
    double farthest = 0;
    for (const Triangle& t : constrained_surface(mesh).triangles)
      for (const int n : t)
        if (!std::exchange(seen[n], 1)) farthest = std::max(farthest, winding_.tree().nearest(mesh.nodes[n]).distance);
    return farthest;
  }

  WindingNumber winding_;
  std::optional<double> max_volume_;
  Eigen::AlignedBox3d box_;
  double cell_ = 0;
};

}  // namespace

TetMesh remesh(const TriangleMesh& surface, std::optional<double> max_volume) {
  return Remesher(surface, max_volume).run();
}

}  // namespace heml
