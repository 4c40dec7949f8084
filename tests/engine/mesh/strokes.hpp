#pragma once
// Cubes that are cut, and random strokes through them.
#include <algorithm>
#include <cmath>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/generate.hpp>
#include <map>
#include <numeric>
#include <random>
#include <string>

namespace heml::test {

/// A body to which cuts are applied.
struct CutBody {
  TetMesh mesh;
  std::vector<Vec3> x;
  Topology topology;

  explicit CutBody(TetMesh given) : mesh(std::move(given)), x(mesh.nodes), topology(full_topology(mesh)) {}

  /// Applies a cut; returns the message of make_cut(), "" on success.
  std::string cut(const Sweep& sweep, Cut& made, const Stroke& stroke = {}) {
    if (const Status status = make_cut(sweep, mesh, x, topology, snap, stroke, made); !status.ok())
      return status.message();
    topology = apply_edit(topology, made.edit, static_cast<int>(mesh.tets.size()));
    append(made.edit, mesh);
    append(made.edit, x);
    return "";
  }
  std::string cut(const Sweep& sweep) {
    Cut made;
    return cut(sweep, made);
  }

  std::vector<Tet> tets() const { return with_elements(mesh.tets, topology.elements); }

  double volume(const Tet& t) const {
    const auto at = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
    return signed_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3]));
  }
  double volume() const {
    double sum = 0;
    for (const Tet& t : tets()) sum += volume(t);
    return sum;
  }

  /// Number of face-connected parts.
  int components() const {
    const std::vector<Tet> all = tets();
    std::vector<int> root(all.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int k) {
      while (root[static_cast<std::size_t>(k)] != k) k = root[static_cast<std::size_t>(k)];
      return k;
    };
    std::map<std::array<int, 3>, int> seen;
    int count = static_cast<int>(all.size());
    for (std::size_t t = 0; t < all.size(); ++t)
      for (const auto& f : tet_faces) {
        std::array<int, 3> nodes;
        for (std::size_t k = 0; k < 3; ++k) nodes[k] = all[t][static_cast<std::size_t>(f[k])];
        std::sort(nodes.begin(), nodes.end());
        const auto [other, fresh] = seen.emplace(nodes, static_cast<int>(t));
        if (fresh) continue;
        const int a = find(static_cast<int>(t)), b = find(other->second);
        if (a == b) continue;
        root[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        --count;
      }
    return count;
  }

  double snap = 0;
};

/// A cube of 1 m, with inner nodes displaced by up to an eighth of a cell.
inline CutBody cube(int cells, unsigned seed = 1) {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {cells, cells, cells});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.125 / cells, 0.125 / cells);
  for (Vec3& X : mesh.nodes) {
    const Vec3 move(jitter(random), jitter(random), jitter(random));
    if ((X.array() > 1e-9).all() && (X.array() < 1 - 1e-9).all()) X += move;
  }
  CutBody body(std::move(mesh));
  body.snap = snapping_distance(body.mesh);
  return body;
}

/// A smooth stroke through the centre of a cube, at random: a blade longer than the cube, bent path.
inline Sweep random_stroke(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  const Vec3 centre = Vec3(0.5, 0.5, 0.5) + 0.15 * vector(), along = vector().normalized(),
             normal = along.cross(vector()).normalized(), blade = along.cross(normal);
  const double bend = 0.08 * any(random), phase = any(random);
  Sweep sweep;
  for (int k = 0; k <= 100; ++k) {
    const Vec3 at = centre + (0.026 * k - 1.3) * along + bend * std::sin(0.04 * k + phase) * normal;
    const Vec3 edge = 2 * (blade + 0.1 * std::sin(0.03 * k + phase) * normal);
    sweep.blades.push_back({at - edge, at + edge});
  }
  return sweep;
}

/// Applies a stroke in parts, with the body displaced before each part by move(rest position, time). Returns the area.
template <class Move>
double cut_in_parts(CutBody& body, const Sweep& stroke, int parts, const Move& move) {
  double area = 0;
  Stroke state;
  for (int k = 0; k < parts; ++k) {
    for (std::size_t n = 0; n < body.x.size(); ++n)
      body.x[n] = move(body.mesh.nodes[n], static_cast<double>(k) / parts);
    const auto begin = stroke.blades.begin() + 100 / parts * k;
    const Sweep sweep{{begin, begin + 100 / parts + 1}};
    Cut made;
    if (body.cut(sweep, made, state) == "") {
      area += made.area;
      state = made.stroke;
    }
    if (state.front.in_tissue())
      state.front.pass(sweep);
    else
      state.front = BladeFront(sweep.blades.back(), body.mesh, body.x, body.topology);
  }
  return area;
}

inline Vec3 still(const Vec3& X, double) { return X; }

/// Sways by 4 % of the cube and shears, two times to and fro during a stroke.
inline Vec3 sway(const Vec3& X, double time) {
  return X + 0.04 * std::sin(12 * time) * Vec3(1, 0.5, -0.7) + 0.03 * std::sin(9 * time) * Vec3(X.y(), X.z(), X.x());
}

}  // namespace heml::test
