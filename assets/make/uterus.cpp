#include <algorithm>
#include <cmath>

#include "organ.hpp"

namespace heml::make {
namespace {

constexpr double internal_os = -0.002;  // m, height where the cervix begins

/// The organ leans forward: what follows is drawn upright and evaluated here.
Vec3 upright(const Vec3& p) { return {p.x(), p.y(), p.z() - 2.5 * (p.y() + 0.03) * (p.y() + 0.03)}; }

/// The right half mirrored onto the left.
Vec3 folded(const Vec3& p) { return {std::abs(p.x()), p.y(), p.z()}; }

const Tube neck(
    {{{0, 0.0080, 0}, 0.0150}, {{0, -0.0050, 0}, 0.0125}, {{0, -0.0180, 0}, 0.0130}, {{0, -0.0300, 0}, 0.0125}});
const Tube horn({{{0.0140, 0.0340, 0}, 0.0090},
                 {{0.0270, 0.0400, 0}, 0.0058},
                 {{0.0390, 0.0420, -0.0020}, 0.0046},
                 {{0.0510, 0.0390, -0.0060}, 0.0048},
                 {{0.0590, 0.0310, -0.0100}, 0.0058}});
const Tube canal({{{0, -0.0400, 0}, 0.0030},
                  {{0, -0.0300, 0}, 0.0030},
                  {{0, -0.0180, 0}, 0.0038},
                  {{0, -0.0040, 0}, 0.0026},
                  {{0, 0.0100, 0}, 0.0045}});
const Tube chamber({{{0, 0.0020, 0}, 0.0040}, {{0.0030, 0.0180, 0}, 0.0060}, {{0.0110, 0.0330, 0}, 0.0060}});

double body(const Vec3& q) {
  const double taper = 1 - 7 * (q.y() - 0.021);  // broad at the fundus, narrow at the neck
  const double pear = ellipsoid({q.x() * taper, q.y(), q.z()}, {0, 0.0210, 0}, {0.0245, 0.0300, 0.0190});
  const double cervix = smooth_intersection(neck.distance(q), half_space(q, {0, -0.0300, 0}, {0, -1, 0}), 0.006);
  return smooth_union(pear, cervix, 0.018);
}

double tubes(const Vec3& q) {
  return smooth_intersection(horn.distance(folded(q)), half_space(folded(q), horn.last().centre, horn.direction()),
                             0.003);
}

/// A flat triangle between the internal os and the two horns, and the canal below it.
double cavity(const Vec3& q) {
  const Vec3 flat(q.x(), q.y(), 1.5 * q.z());
  const double triangle =
      smooth_union(chamber.distance(folded(flat)), ellipsoid(flat, {0, 0.0260, 0}, {0.0080, 0.0130, 0.0060}), 0.004);
  return smooth_union(triangle, canal.distance(q), 0.004);
}

}  // namespace

Organ uterus() {
  Organ organ;
  organ.name = "uterus";
  organ.shape = [](const Vec3& p) {
    const Vec3 q = upright(p);
    return smooth_cut(smooth_union(body(q), tubes(q), 0.008), cavity(q), 0.003);
  };
  organ.region = [](const Vec3& p) {
    const Vec3 q = upright(p);
    if (tubes(q) + 0.002 < body(q)) return 3;
    return q.y() < internal_os ? 2 : 1;
  };
  organ.detail = [](const Vec3& p) {
    const Vec3 q = upright(p);
    return std::lerp(0.9, 1.0, std::clamp((std::min(tubes(q), std::abs(cavity(q))) - 0.001) / 0.006, 0.0, 1.0));
  };
  organ.low = Vec3(-0.070, -0.036, -0.040);
  organ.high = Vec3(0.070, 0.060, 0.050);
  organ.edge = 0.00214;
  organ.depth = 0.004;
  organ.spacing = 0.0085;
  organ.enough = 0.3;
  return organ;
}

}  // namespace heml::make
