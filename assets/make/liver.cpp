#include <algorithm>
#include <cmath>

#include "organ.hpp"

namespace heml::make {
namespace {

/// x to the body's left, y superior, z anterior. The dome of the right lobe, thinning to the left lobe, cut
/// flat and hollow underneath, with the notch of the falciform ligament in the lower front edge.
double parenchyma(const Vec3& p) {
  const double right = ellipsoid(p, Vec3(-0.030, 0.000, 0.000), Vec3(0.078, 0.068, 0.062));
  const double left = ellipsoid(p, Vec3(0.060, 0.022, 0.014), Vec3(0.066, 0.034, 0.040));
  const double dome = smooth_union(right, left, 0.030);
  // The visceral face looks down, back and to the left.
  const Vec3 down = Vec3(0.30, -0.86, -0.42).normalized();
  const double flat = smooth_intersection(dome, half_space(p, Vec3(-0.020, -0.012, -0.010), down), 0.016);
  const double stomach = ellipsoid(p, Vec3(0.055, -0.040, -0.022), Vec3(0.060, 0.040, 0.045));
  const double notch = ellipsoid(p, Vec3(0.014, -0.016, 0.052), Vec3(0.007, 0.026, 0.030));
  return smooth_cut(smooth_cut(flat, stomach, 0.014), notch, 0.008);
}

const Tube vena_cava({{{-0.006, 0.000, -0.036}, 0.0120},
                      {{-0.004, 0.036, -0.036}, 0.0120},
                      {{-0.002, 0.078, -0.034}, 0.0125}});

double vessels(const Vec3& p) {
  const Station end = vena_cava.last();
  return smooth_intersection(vena_cava.distance(p), half_space(p, end.centre, vena_cava.direction()), 0.003);
}

}  // namespace

Organ liver() {
  Organ organ;
  organ.name = "liver";
  organ.shape = [](const Vec3& p) { return smooth_union(parenchyma(p), vessels(p), 0.010); };
  organ.region = [](const Vec3& p) { return parenchyma(p) < vessels(p) ? 1 : 2; };
  organ.detail = [](const Vec3& p) { return p.x() > 0.05 ? 0.85 : 1.0; };  // the left lobe is thin
  organ.low = Vec3(-0.130, -0.100, -0.090);
  organ.high = Vec3(0.150, 0.110, 0.090);
  organ.edge = 0.0095;
  organ.depth = 0.010;
  organ.spacing = 0.016;
  organ.enough = 0.3;
  return organ;
}

}  // namespace heml::make
