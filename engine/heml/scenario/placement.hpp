#pragma once
// Placement of a scene's mesh: scale, rotation, translation.
#include <heml/math/rotation.hpp>
#include <heml/scenario/scene.hpp>
#include <numbers>

namespace heml {

/// x -> rotate(scale x − origin) + origin + translate, m; directions are only rotated. Without a rotation none is
/// computed, so that positions keep their bits.
class Placement {
 public:
  explicit Placement(const MeshSpec& mesh)
      : scale_(mesh.scale), turns_(mesh.rotate_degrees != 0), origin_(mesh.rotate_origin), translate_(mesh.translate) {
    if (turns_) rotation_ = rotation_matrix(mesh.rotate_axis, mesh.rotate_degrees * std::numbers::pi / 180);
  }

  Vec3 operator()(const Vec3& x) const {
    const Vec3 scaled = scale_ * x;
    const Vec3 turned = turns_ ? Vec3(rotation_ * (scaled - origin_) + origin_) : scaled;
    return turned + translate_;
  }

  Vec3 direction(const Vec3& d) const { return turns_ ? Vec3(rotation_ * d) : d; }

 private:
  double scale_;
  bool turns_;
  Mat3 rotation_ = Mat3::Identity();
  Vec3 origin_, translate_;
};

}  // namespace heml
