#include "app/render/make/tissue_texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <heml/math/types.hpp>
#include <numbers>
#include <random>

namespace heml::render {
namespace {

constexpr float step = 0.005f;       // rad between points of a vessel
constexpr float thinnest = 0.0026f;  // rad, half-width at which a vessel ends
constexpr float blush = 0.030f;      // rad, extent of the reddening round a vessel
constexpr int cells = 64;            // per side of the grid over the sphere's bounding cube

struct Point {
  Vec3f place;  // on the unit sphere
  float width;  // rad, half-width
  int vessel;
};

// A grid of points whose cells are wider than any search radius.
class Points {
 public:
  void add(const Point& point) { grid_[cell(point.place)].push_back(point); }

  template <class Action>
  void for_each_near(const Vec3f& place, Action action) const {
    const std::array<int, 3> middle = coordinates(place);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = middle[0] + dx, y = middle[1] + dy, z = middle[2] + dz;
          if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= cells) continue;
          for (const Point& point : grid_[(z * cells + y) * cells + x]) action(point);
        }
  }

 private:
  static std::array<int, 3> coordinates(const Vec3f& place) {
    std::array<int, 3> result;
    for (int k = 0; k < 3; ++k)
      result[k] = std::clamp(static_cast<int>((place[k] * 0.5f + 0.5f) * cells), 0, cells - 1);
    return result;
  }
  static std::size_t cell(const Vec3f& place) {
    const auto [x, y, z] = coordinates(place);
    return static_cast<std::size_t>((z * cells + y) * cells + x);
  }
  std::vector<std::vector<Point>> grid_ = std::vector<std::vector<Point>>(cells * cells * cells);
};

class Growth {
 public:
  Points grow() {
    for (int root = 0; root < 26; ++root) {
      const float z = 1 - 2 * (static_cast<float>(root) + 0.5f) / 26, angle = 2.39996f * static_cast<float>(root);
      const float r = std::sqrt(1 - z * z);
      const Vec3f place(r * std::cos(angle), z, r * std::sin(angle));
      const float first = uniform() * 2 * std::numbers::pi_v<float>;
      const int arms = 3 + static_cast<int>(uniform() * 3);  // a star of vessels, as on a kidney's capsule
      for (int arm = 0; arm < arms; ++arm)
        add(place, first + 2 * std::numbers::pi_v<float> * static_cast<float>(arm) / static_cast<float>(arms),
            0.0058f + 0.003f * uniform(), -1);
    }
    for (std::size_t next = 0; next < buds_.size() && next < 4000; ++next) follow(buds_[next], static_cast<int>(next));
    return std::move(points_);
  }

 private:
  struct Bud {
    Vec3f place, heading;
    float width;
    int parent;
  };

  float uniform() { return static_cast<float>(random_() % 65536) / 65536; }

  static Vec3f turned(const Vec3f& place, const Vec3f& heading, float angle) {
    return (std::cos(angle) * heading + std::sin(angle) * place.cross(heading)).normalized();
  }

  void add(const Vec3f& place, float angle, float width, int parent) {
    buds_.push_back({place, turned(place, place.unitOrthogonal(), angle), width, parent});
  }

  // Grows a vessel that bends at random, branches, thins out, and ends where it would meet another.
  void follow(Bud bud, int vessel) {
    float bend = 0;
    for (int i = 0; bud.width > thinnest; ++i) {
      bend = 0.80f * bend + 0.08f * (uniform() - 0.5f);
      bud.heading = turned(bud.place, bud.heading, bend);
      bud.place = (bud.place + step * bud.heading).normalized();
      bud.heading = (bud.heading - bud.heading.dot(bud.place) * bud.place).normalized();
      if (i > 3 && is_taken(bud, vessel)) return;
      points_.add({bud.place, bud.width, vessel});
      bud.width *= 0.9935f;
      if (i > 4 && uniform() < 0.056f && bud.width > 1.3f * thinnest) {
        const float side = uniform() < 0.5f ? -1.0f : 1.0f;
        buds_.push_back({bud.place, turned(bud.place, bud.heading, side * (0.5f + 0.6f * uniform())),
                         bud.width * (0.62f + 0.2f * uniform()), vessel});
      }
    }
  }

  bool is_taken(const Bud& bud, int vessel) const {
    bool taken = false;
    points_.for_each_near(bud.place, [&](const Point& point) {
      taken |= point.vessel != vessel && point.vessel != bud.parent &&
               (point.place - bud.place).squaredNorm() < 0.016f * 0.016f;
    });
    return taken;
  }

  std::minstd_rand random_{1994};
  std::vector<Bud> buds_;
  Points points_;
};

Vec3f octahedral_direction(float x, float y) {
  Vec3f n(x, y, 1 - std::abs(x) - std::abs(y));
  if (n.z() < 0) n = Vec3f(std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), n.z());
  return n.normalized();
}

float fade(float from, float to, float at) {
  const float t = std::clamp((at - from) / (to - from), 0.0f, 1.0f);
  return 1 - t * t * (3 - 2 * t);
}

// A hash 0..1 of each cell of space.
float lattice(int x, int y, int z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u + static_cast<std::uint32_t>(y) * 0xd8163841u +
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / 16777216.0f;
}

// Gradient of value noise with quintic blending.
Vec3f noise_slope(const Vec3f& p) {
  const Vec3f floor = p.array().floor();
  const Eigen::Array3f f = p - floor;
  const Eigen::Vector3i i = floor.cast<int>();
  const Eigen::Array3f u = f * f * f * (f * (f * 6 - 15) + 10), du = 30 * f * f * (f * (f - 2) + 1);
  Vec3f slope = Vec3f::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i side(corner & 1, (corner >> 1) & 1, corner >> 2);
    const Eigen::Array3f weight = (side == 1).select(u, 1 - u), change = (side == 1).select(du, -du);
    const float value = lattice(i.x() + side.x(), i.y() + side.y(), i.z() + side.z());
    slope += value * Vec3f(change.x() * weight.y() * weight.z(), weight.x() * change.y() * weight.z(),
                           weight.x() * weight.y() * change.z());
  }
  return slope;
}

Vec3f bump_slope(const Vec3f& place) {
  return 0.36f * noise_slope(11 * place) + 0.42f * noise_slope(23 * place + Vec3f(5, 9, 2)) +
         0.40f * noise_slope(47 * place);
}

// Vessel in the upper half of the range, blush in the lower.
float vessel(const Points& points, const Vec3f& place) {
  float core = 0, halo = 0;
  points.for_each_near(place, [&](const Point& point) {
    const float distance = (point.place - place).norm();
    const float strength = std::min(1.0f, 0.35f + point.width / 0.009f);
    core = std::max(core, strength * fade(0.35f * point.width, 1.25f * point.width, distance));
    halo = std::max(halo, strength * fade(0, std::min(blush, 8 * point.width), distance));
  });
  return core > 0 ? 0.5f + 0.5f * core : 0.5f * halo;
}

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))); }

}  // namespace

std::vector<std::uint8_t> tissue_texture(int side) {
  const Points points = Growth().grow();
  std::vector<std::uint8_t> texels;
  texels.reserve(std::size_t{4} * side * side);
  const auto at = [&](int k) { return (2 * static_cast<float>(k) + 1) / static_cast<float>(side) - 1; };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const Vec3f place = octahedral_direction(at(i), at(j));
      const Vec3f slope = Vec3f::Constant(0.5f) + 0.5f * bump_slope(place);
      texels.insert(texels.end(), {byte(slope.x()), byte(slope.y()), byte(slope.z()), byte(vessel(points, place))});
    }
  return texels;
}

}  // namespace heml::render
