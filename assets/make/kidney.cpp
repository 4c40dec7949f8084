#include <algorithm>
#include <cmath>

#include "organ.hpp"

namespace heml::make {
namespace {

/// The bean: an ellipsoid bent round a centre on the medial side, with the sinus hollowed out of its concave flank.
double parenchyma(const Vec3& p) {
  constexpr double bend = 0.046;  // m, radius of the arc that the long axis follows
  const Vec3 unbent(bend - std::hypot(bend - p.x(), p.y()), bend * std::atan2(p.y(), bend - p.x()), p.z());
  const double taper = 1 - 1.6 * unbent.y();  // the upper pole is broader
  const double body =
      ellipsoid(Vec3(unbent.x() * taper, unbent.y(), unbent.z()), Vec3::Zero(), Vec3(0.0270, 0.0600, 0.0205));
  const double sinus = ellipsoid(p, Vec3(0.0340, 0.0, 0.0), Vec3(0.0220, 0.0230, 0.0130));
  return smooth_cut(body, sinus, 0.010);
}

/// Cut square across at its end.
double cut_tube(const Tube& tube, const Vec3& p) {
  return smooth_intersection(tube.distance(p), half_space(p, tube.last().centre, tube.direction()), 0.003);
}

const Tube vein({{{0.0100, 0.0000, 0.0010}, 0.0085},
                 {{0.0260, 0.0010, 0.0020}, 0.0078},
                 {{0.0410, 0.0030, 0.0040}, 0.0076},
                 {{0.0560, 0.0060, 0.0050}, 0.0076},
                 {{0.0700, 0.0080, 0.0040}, 0.0078}});
const Tube artery({{{0.0100, 0.0090, 0.0000}, 0.0066},
                   {{0.0240, 0.0160, -0.0010}, 0.0062},
                   {{0.0400, 0.0250, -0.0040}, 0.0058},
                   {{0.0540, 0.0325, -0.0060}, 0.0056},
                   {{0.0680, 0.0380, -0.0060}, 0.0058}});
const Tube ureter({{{0.0090, -0.0070, 0.0000}, 0.0082},
                   {{0.0230, -0.0130, -0.0010}, 0.0076},
                   {{0.0350, -0.0215, -0.0020}, 0.0060},
                   {{0.0460, -0.0320, -0.0020}, 0.0054},
                   {{0.0540, -0.0450, -0.0010}, 0.0054}});

/// Vessels and ureter, joined where they enter by what fills the sinus.
double vessels(const Vec3& p) {
  const double pelvis = ellipsoid(p, Vec3(0.0130, 0.0010, 0.0), Vec3(0.0110, 0.0190, 0.0100));
  const double tubes = std::min({cut_tube(vein, p), cut_tube(artery, p), cut_tube(ureter, p)});
  return smooth_union(tubes, pelvis, 0.005);
}

}  // namespace

Organ kidney(std::string name, double edge) {
  Organ organ;
  organ.name = std::move(name);
  organ.shape = [](const Vec3& p) { return smooth_union(parenchyma(p), vessels(p), 0.006); };
  organ.region = [](const Vec3& p) { return parenchyma(p) < vessels(p) ? 1 : 2; };
  organ.detail = [](const Vec3& p) {
    const double away = std::clamp((vessels(p) - 0.002) / 0.012, 0.0, 1.0);
    return std::lerp(0.8, 1.0, away);
  };
  organ.low = Vec3(-0.050, -0.075, -0.040);
  organ.high = Vec3(0.100, 0.075, 0.040);
  organ.edge = edge;
  organ.depth = 0.008;
  organ.spacing = 0.020;
  organ.enough = 0.3;
  return organ;
}

}  // namespace heml::make
