#pragma once
// Which label a point has: the one whose indicator, smoothed over voxels, is largest there. Two labels meet where
// theirs are equal, which is a smooth surface where the voxels' faces are steps.
#include <heml/mesh/labels/label_map.hpp>
#include <heml/mesh/labels/region_field.hpp>

namespace heml {

class LabelField : public RegionField {
 public:
  /// Throws InputError for labels that take more memory than a limit.
  explicit LabelField(const LabelMap& map);

  int labels() const { return static_cast<int>(indicators_.size()); }  ///< outside (0) included
  int label_at(const Vec3& x) const override;
  double difference(int a, int b, const Vec3& x) const override;

  /// Weights that are added to the labels' indicators, so that volumes can be met; outside: 0. Moves the interfaces of
  /// label k by about weight · offset_of_weight() voxels.
  void set_weights(std::vector<double> weights) { weights_ = std::move(weights); }
  const std::vector<double>& weights() const { return weights_; }
  static double offset_of_weight();

 private:
  struct Indicator {
    std::array<int, 3> low{}, size{};  ///< voxels it is stored at; 0 elsewhere
    std::vector<float> values;
    float at(const Vec3& voxel) const;
  };
  double value(int label, const Vec3& voxel) const;
  Vec3 voxel_of(const Vec3& x) const { return to_voxel_ * (x - origin_); }
  static Indicator smoothed(const LabelMap& map, int label, const std::array<int, 3>& low,
                            const std::array<int, 3>& high);

  std::vector<Indicator> indicators_;  ///< that of outside is what the others leave of 1
  std::vector<double> weights_;
  Mat3 to_voxel_;
  Vec3 origin_;
};

}  // namespace heml
