#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/improve/improve.hpp>
#include <heml/mesh/labels/clean_labels.hpp>
#include <heml/mesh/labels/cut_lattice.hpp>
#include <heml/mesh/labels/label_field.hpp>
#include <heml/mesh/labels/merge_scraps.hpp>
#include <heml/mesh/labels/mesh_labels.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

constexpr int max_cutting_passes = 12;
constexpr double count_error = 0.06, volume_error = 0.002;  // below which passes end
constexpr double max_weight = 0.4;  // of two labels against each other twice that: about a voxel
constexpr double tolerated_volume_error = 0.01;
constexpr double growth = 2.4;              // of the number of elements: this power of 1 / cell, about
constexpr double share_of_passes = 0.3;     // of the time, for progress
constexpr double voxel_faces = 1.5;         // area of stairs over that of a surface that they follow, on average
constexpr double tolerance_of_cell = 0.01;  // that improving may move surfaces by, which takes from round volumes

std::vector<double> volumes_by_region(const TetMesh& mesh, std::size_t count) {
  std::vector<double> volumes(count, 0.0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    volumes[static_cast<std::size_t>(mesh.regions[t])] +=
        signed_volume(mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]);
  }
  return volumes;
}

/// Area of each label's surface, m², from the faces of its voxels.
std::vector<double> surface_areas(const LabelMap& map) {
  std::array<double, 3> face;
  for (int d = 0; d < 3; ++d)
    face[static_cast<std::size_t>(d)] = map.axes.col((d + 1) % 3).cross(map.axes.col((d + 2) % 3)).norm() / voxel_faces;
  const std::array<std::size_t, 3> step{map.index(1, 0, 0), map.index(0, 1, 0), map.index(0, 0, 1)};
  std::vector<double> areas(map.values.size(), 0.0);
  for (std::size_t d = 0; d < 3; ++d)  // the outermost voxels lie outside
    for (std::size_t v = 0; v + step[d] < map.voxels.size(); ++v)
      if (const std::uint8_t a = map.voxels[v], b = map.voxels[v + step[d]]; a != b) {
        areas[a] += face[d];
        areas[b] += face[d];
      }
  return areas;
}

class LabelMesher {
 public:
  LabelMesher(const LabelMap& map, const LabelMeshOptions& options)
      : map_(map), options_(options), field_(map), areas_(surface_areas(map)) {
    for (const std::size_t voxels : count_labels(map))
      wanted_.push_back(static_cast<double>(voxels) * map.voxel_volume());
    for (int c = 0; c < 8; ++c) {
      Vec3 corner;
      for (int d = 0; d < 3; ++d) corner[d] = (c >> d & 1) ? map.size[static_cast<std::size_t>(d)] - 0.5 : -0.5;
      box_.extend(Vec3(map.origin + map.axes * corner));
    }
  }

  LabelMeshing run() {
    TetMesh mesh = best_pass();
    merge_scraps(mesh);
    mesh.source = map_.source;
    if (mesh.tets.empty())
      throw InputError(map_.source, "", "its labels are finer than the elements: none is left",
                       "ask for more (--tets)");
    Improvement improved = improve(std::move(mesh), improve_options());
    LabelMeshing result{std::move(improved.mesh), {}, cell_, std::move(improved.below)};
    const std::vector<double> volumes = volumes_by_region(result.mesh, map_.values.size());
    for (std::size_t k = 1; k < volumes.size(); ++k) {
      if (wanted_[k] > 0) result.labels.push_back({map_.values[k], wanted_[k], volumes[k]});
      warn_of_volume(map_.values[k], wanted_[k], volumes[k]);
    }
    for (int& region : result.mesh.regions) region = map_.values[static_cast<std::size_t>(region)];
    return result;
  }

 private:
  /// Cuts lattices, each with the cell and the weights that the one before suggests; the best of them.
  TetMesh best_pass() {
    double cell = std::cbrt(12 * std::accumulate(wanted_.begin() + 1, wanted_.end(), 0.0) / options_.tets);
    double best_error = std::numeric_limits<double>::infinity();
    TetMesh best;
    for (int pass = 0; pass < max_cutting_passes; ++pass) {
      show(share_of_passes * pass / max_cutting_passes, "cutting the lattice");
      TetMesh mesh = cut_lattice(make_lattice(field_, box_.min(), box_.max(), cell, map_.source), field_);
      const double ratio = static_cast<double>(std::max<std::size_t>(mesh.tets.size(), 1)) / options_.tets;
      const double count_off = std::max(0.0, std::abs(ratio - 1) - count_error);
      const double volume_off = adjust_weights(volumes_by_region(mesh, wanted_.size()));
      if (const double error = 10 * count_off + volume_off; error < best_error) {
        best_error = error;
        best = std::move(mesh);
        cell_ = cell;
      }
      if (best_error < volume_error) break;
      if (count_off > 0) cell *= std::clamp(std::pow(ratio, 1 / growth), 0.4, 2.5);
    }
    return best;
  }

  /// Moves the interfaces towards the wanted volumes. Returns the largest relative error of a volume.
  double adjust_weights(const std::vector<double>& volumes) {
    const double voxel = std::cbrt(map_.voxel_volume());
    std::vector<double> weights = field_.weights();
    double worst = 0;
    for (std::size_t k = 1; k < volumes.size(); ++k) {
      if (areas_[k] == 0) continue;
      worst = std::max(worst, std::abs(volumes[k] / wanted_[k] - 1));
      const double offset = (wanted_[k] - volumes[k]) / areas_[k] / voxel;
      weights[k] = std::clamp(weights[k] + offset / LabelField::offset_of_weight(), -max_weight, max_weight);
    }
    field_.set_weights(std::move(weights));
    return worst;
  }

  ImproveOptions improve_options() const {
    ImproveOptions improving;
    improving.min_angle = options_.min_angle;
    improving.surface_tolerance = tolerance_of_cell * cell_;
    improving.progress = [this](double fraction, const char* doing) {
      show(share_of_passes + (1 - share_of_passes) * fraction, doing);
    };
    return improving;
  }

  void warn_of_volume(int value, double wanted, double volume) const {
    if (wanted == 0) return;
    const double error = volume / wanted - 1;
    if (volume == 0)
      warn("{}: label {} is lost: it is finer than the elements ({:.2g} m; --tets gives more)", map_.source, value,
           cell_);
    else if (std::abs(error) > tolerated_volume_error)
      warn("{}: label {}: volume {:+.2g} % of its voxels' (elements of {:.2g} m; --tets gives more)", map_.source,
           value, 100 * error, cell_);
  }

  void show(double fraction, const char* doing) const {
    if (options_.progress) options_.progress(fraction, doing);
  }

  const LabelMap& map_;
  const LabelMeshOptions& options_;
  LabelField field_;
  std::vector<double> areas_, wanted_;  ///< of each label: m², m³
  Eigen::AlignedBox3d box_;
  double cell_ = 0;
};

}  // namespace

LabelMeshing mesh_labels(LabelMap map, const LabelMeshOptions& options) {
  if (options.progress) options.progress(0, "smoothing labels");
  crop(map);
  remove_specks(map);
  return LabelMesher(map, options).run();
}

}  // namespace heml
