#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <heml/materials/point.hpp>
#include <optional>
#include <studies/stability/measures.hpp>
#include <studies/stability/penalty.hpp>

namespace heml::stability {
namespace {

constexpr double damping = 30, duration = 2, young = 1e4, poisson = 0.45;
constexpr double shear = young / (2 + 2 * poisson), bulk = young / (3 - 6 * poisson);

struct Method {
  std::string name, law;
  bool continued = false;
  double strength = 0;                                                    ///< of the penalty, relative to λ + 2μ
  double stiffness() const { return strength * (bulk + 4 * shear / 3); }  ///< k, Pa
};

/// V (m³) and J of a tetrahedron, and the gradients of J by its corners, 1/m.
struct VolumeSlope {
  double V, J;
  Vec3 g[4];
};

VolumeSlope volume_slope(const TetMesh& mesh, const Tet& tet, const std::vector<double>& x) {
  const auto at = [&](std::size_t c) { return Vec3(&x[3 * static_cast<std::size_t>(tet[c])]); };
  const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
  const double V = signed_volume(X(0), X(1), X(2), X(3));
  const Vec3 a = at(1) - at(0), b = at(2) - at(0), c = at(3) - at(0);
  VolumeSlope result{V, a.dot(b.cross(c)) / (6 * V), {}};
  result.g[1] = b.cross(c) / (6 * V);
  result.g[2] = c.cross(a) / (6 * V);
  result.g[3] = a.cross(b) / (6 * V);
  result.g[0] = -(result.g[1] + result.g[2] + result.g[3]);
  return result;
}

/// A body by one of the methods, integrated in damped explicit steps.
class SteppedBody {
 public:
  SteppedBody(const Method& method, const WorldSetup& setup)
      : method_(method),
        mesh_(setup.mesh),
        body_(mesh_, std::vector<int>(mesh_.tets.size(), 0), {material_of(method.law, shear, bulk)},
              {method.continued, false}),
        mass_(body_.masses()),
        x_(flat(setup.initial_positions)),
        v_(x_.size()),
        f_(x_.size()),
        free_(mesh_.nodes.size(), 1) {
    for (const int n : setup.boundary[0].nodes) free_[static_cast<std::size_t>(n)] = 0;
    for (std::size_t i = 0; i < x_.size(); ++i)  // coincident nodes leave forces without a direction
      if (free_[i / 3]) x_[i] += 1e-6 * noise(13, i);
  }

  /// Upper bound of ω², 1/s²: that of the body plus that of the penalty, which includes the second derivatives of J.
  double bound(const std::vector<double>& x) {
    double penalty = 0;
    for (const Tet& tet : mesh_.tets) {
      const VolumeSlope s = volume_slope(mesh_, tet, x);
      double steep = 0;
      for (const Vec3& g : s.g) steep += g.squaredNorm();
      penalty = std::max(penalty, 4 * method_.stiffness() / 1000 * steep * (1 + std::abs(1 - s.J)));
    }
    return body_.frequency_bound(x.data(), team_) + penalty;
  }

  void run() {
    for (double t = 0; t < duration;) {
      forces();
      const double h = 0.5 / std::sqrt(bound(x_));
      if (!(h > 1e-9)) return;
      for (std::size_t i = 0; i < x_.size(); ++i)
        if (free_[i / 3]) {
          v_[i] = (v_[i] + h * f_[i] / mass_[i / 3]) / (1 + damping * h);
          x_[i] += h * v_[i];
        }
      t += h;
    }
  }

  void measure(PenaltyRow& row) const {
    row.elements = static_cast<int>(mesh_.tets.size());
    for (const Tet& tet : mesh_.tets) row.inverted += !(volume_slope(mesh_, tet, x_).J > 0);
    double sum = 0;
    const std::vector<double> rest = flat(mesh_.nodes);
    for (std::size_t i = 0; i < x_.size(); ++i) sum += std::pow(x_[i] - rest[i], 2);
    row.away = std::sqrt(sum / static_cast<double>(mesh_.nodes.size())) / diagonal(mesh_);
  }

 private:
  void forces() {
    body_.forces(x_.data(), f_.data(), team_);
    if (method_.strength == 0) return;
    for (const Tet& tet : mesh_.tets) {
      const VolumeSlope s = volume_slope(mesh_, tet, x_);
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < 3; ++i)
          f_[3 * static_cast<std::size_t>(tet[c]) + i] +=
              method_.stiffness() * s.V * (1 - s.J) * s.g[c][static_cast<int>(i)];
    }
  }

  const Method& method_;
  TetMesh mesh_;
  ElasticBody<double> body_;
  ThreadTeam team_{1};
  std::vector<double> mass_, x_, v_, f_;
  std::vector<char> free_;
};

/// Stress added by the penalty to a bar at stretch 1.3 (sides at 0.9), relative to that of the law.
double changed_stress(const Method& method) {
  const Mat3 F = Vec3(1.3, 0.9, 0.9).asDiagonal();
  const auto point = make_material_point(material_of(method.law, shear, bulk), method.continued);
  const Mat3 added = method.stiffness() * (F.determinant() - 1) * F.determinant() * F.inverse().transpose();
  return added.norm() / point->first_piola(F).norm();
}

PenaltyRow row_of(const Method& method, const std::string& start, const WorldSetup& setup) {
  PenaltyRow row;
  row.start = start.substr(3);
  row.method = method.name;
  const std::vector<double> rest = flat(setup.mesh.nodes);
  Method without = method;
  without.strength = 0;
  row.max_step = std::sqrt(SteppedBody(without, setup).bound(rest) / SteppedBody(method, setup).bound(rest));
  row.changed_stress = changed_stress(method);
  SteppedBody body(method, setup);
  body.run();
  body.measure(row);
  return row;
}

PenaltyRow recovered(const std::string& start, const WorldSetup& setup) {
  const auto world = make_world(setup);
  run_until(*world, duration);
  PenaltyRow row{start.substr(3),
                 "Neo-Hookean, engine's recovery",
                 inverted(*world),
                 static_cast<int>(setup.mesh.tets.size()),
                 away_from_rest(*world),
                 1,
                 0};
  return row;
}

}  // namespace

std::vector<PenaltyRow> compare_with_penalty(bool quick) {
  const Method methods[] = {{"StVK alone", "stvk"},
                            {"StVK + penalty 0.1", "stvk", false, 0.1},
                            {"StVK + penalty 1", "stvk", false, 1},
                            {"StVK + penalty 10", "stvk", false, 10},
                            {"StVK continued", "stvk", true},
                            {"Neo-Hookean continued", "neo_hookean", true}};
  std::vector<PenaltyRow> rows;
  for (const std::string start : {"13_point", "13_line", "13_plane", "13_scatter", "15_mirrored", "12_shaken"}) {
    if (quick && start != "13_plane" && start != "12_shaken") continue;
    Trial trial;
    trial.variant = {"neo_hookean", Integrator::backward_euler, false};
    WorldSetup setup = trial.setup(start);
    setup.solver.recovery = true;
    set_young_poisson(setup, young, poisson);
    for (const Method& method : methods) rows.push_back(row_of(method, start, setup));
    rows.push_back(recovered(start, setup));
  }
  return rows;
}

}  // namespace heml::stability
