// Cases of forces and stiffness, without motion.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <heml/mesh/generate.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/naive.hpp>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

using Vector = std::vector<double>;

double largest(const Vector& values) {
  double result = 0;
  for (const double v : values)
    if (!(std::abs(v) <= result)) result = std::abs(v);
  return result;
}

double largest_apart(const Vector& a, const Vector& b) {
  Vector apart = a;
  for (std::size_t i = 0; i < a.size(); ++i) apart[i] -= b[i];
  return largest(apart);
}

/// A small irregular body at rest, 60 tetrahedra.
TetMesh irregular_block() {
  TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), {3, 2, 2});
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    for (int i = 0; i < 3; ++i) mesh.nodes[n][i] += 0.004 * noise(1, 3 * n + static_cast<std::size_t>(i));
  return mesh;
}

/// Positions F X, each coordinate then moved at random by up to `reach`, m.
Vector moved(const TetMesh& mesh, const Mat3& F, double reach, std::uint64_t seed) {
  Vector x;
  for (const Vec3& X : mesh.nodes)
    for (int i = 0; i < 3; ++i) x.push_back((F * X)[i] + reach * noise(seed, x.size()));
  return x;
}

/// Forces and stiffness of a body in the precision of the trial, with its fault. Energy is in double.
class Body {
 public:
  Body(const Trial& trial, TetMesh mesh, Material material, bool continuation)
      : trial_(trial),
        mesh_(std::move(mesh)),
        material_(std::move(material)),
        double_(mesh_, std::vector<int>(mesh_.tets.size(), 0), {material_}, {continuation, false}),
        float_(mesh_, std::vector<int>(mesh_.tets.size(), 0), {material_}, {continuation, false}) {}

  const TetMesh& mesh() const { return mesh_; }
  const Material& material() const { return material_; }

  /// Positions rounded to the precision of the trial.
  Vector held(const Vector& x) const {
    if (!trial_.variant.single) return x;
    const std::vector<float> single(x.begin(), x.end());
    return {single.begin(), single.end()};
  }
  Vector forces(const Vector& x) {
    Vector f(x.size());
    if (trial_.variant.single) {
      const std::vector<float> at(x.begin(), x.end());
      std::vector<float> force(x.size());
      float_.forces(at.data(), force.data(), team_);
      f.assign(force.begin(), force.end());
    } else {
      double_.forces(x.data(), f.data(), team_);
    }
    if (trial_.force_fault) trial_.force_fault(mesh_, material_, x, f);
    return f;
  }
  Vector exact_forces(const Vector& x) {
    Vector f(x.size());
    double_.forces(x.data(), f.data(), team_);
    if (trial_.force_fault) trial_.force_fault(mesh_, material_, x, f);
    return f;
  }
  Vector force_differential(const Vector& x, const Vector& dx) {
    Vector change(x.size());
    if (!trial_.variant.single) {
      double_.linearise(x.data(), team_);
      double_.force_differential(dx.data(), change.data(), team_);
      return change;
    }
    const std::vector<float> at(x.begin(), x.end()), along(dx.begin(), dx.end());
    std::vector<float> out(x.size());
    float_.linearise(at.data(), team_);
    float_.force_differential(along.data(), out.data(), team_);
    return {out.begin(), out.end()};
  }
  double energy(const Vector& x) { return double_.energy(x.data(), team_); }
  int inverted(const Vector& x) const {
    std::vector<ElementState<double>> states;
    double_.states(x.data(), states);
    return static_cast<int>(std::count_if(states.begin(), states.end(), [](const auto& s) { return s.J <= 0; }));
  }

 private:
  const Trial& trial_;
  TetMesh mesh_;
  Material material_;
  ElasticBody<double> double_;
  ElasticBody<float> float_;
  ThreadTeam team_{1};
};

/// Largest difference of forces and −∂U/∂x by fourth-order differences, relative to the largest component.
double gradient_error(Body& body, const Vector& x, double h = 2e-7) {
  const Vector f = body.forces(x);
  Vector slope(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto U = [&](double by) {
      Vector at = x;
      at[i] += by;
      return body.energy(at);
    };
    slope[i] = -(8 * (U(h) - U(-h)) - (U(2 * h) - U(-2 * h))) / (12 * h);
  }
  return largest_apart(f, slope) / largest(slope);
}

/// Largest difference of −K dx and fourth-order differences of forces along dx, relative to the largest component.
double stiffness_error(Body& body, const Vector& x, double h = 1e-7) {
  Vector dx(x.size());
  for (std::size_t i = 0; i < dx.size(); ++i) dx[i] = noise(7, i);
  dx = body.held(dx);
  const auto along = [&](double by) {
    Vector at = x;
    for (std::size_t i = 0; i < x.size(); ++i) at[i] += by * dx[i];
    return body.exact_forces(at);
  };
  const Vector a = along(h), b = along(-h), c = along(2 * h), d = along(-2 * h),
               change = body.force_differential(x, dx);
  Vector slope(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) slope[i] = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
  return largest_apart(change, slope) / largest(slope);
}

/// The larger error of a state in the law's range and of one with inverted elements, where the law is continued.
template <class Error>
Outcome in_range_and_inverted(const Trial& trial, double reach_inverted, const Error& error) {
  Outcome outcome;
  for (const bool continued : {false, true}) {
    Body body(trial, irregular_block(), bench_material(trial.variant.law), continued);
    const Vector x = body.held(moved(body.mesh(), Mat3::Identity(), continued ? reach_inverted : 0.0024, 2));
    const int inside_out = body.inverted(x);
    outcome.value = std::max(outcome.value, error(body, x));
    if ((inside_out > 0) != continued) outcome.broken = fmt::format("{} elements are inside out", inside_out);
    if (continued) outcome.note = fmt::format("{} of {} elements inside out", inside_out, body.mesh().tets.size());
  }
  return outcome;
}

}  // namespace

Outcome force_is_energy_gradient(const Trial& trial) {
  return in_range_and_inverted(trial, 0.024, [](Body& body, const Vector& x) { return gradient_error(body, x); });
}

Outcome stiffness_is_force_gradient(const Trial& trial) {
  return in_range_and_inverted(trial, 0.018, [](Body& body, const Vector& x) { return stiffness_error(body, x); });
}

Outcome tension_form_is_gradient_form(const Trial& trial) {
  Body body(trial, irregular_block(), bench_material(trial.variant.law), false);
  Mat3 F;
  F << 1.2, 0.15, 0, -0.1, 0.9, 0.1, 0.05, 0, 1.05;
  const Vector x = body.held(moved(body.mesh(), F, 0.002, 3));
  Vector reference(x.size());
  NaiveForces(body.mesh(), body.material())(x.data(), reference.data());
  return {largest_apart(body.forces(x), reference) / largest(reference)};
}

Outcome rigid_motion_far_away(const Trial& trial) {
  // A world, not a body alone: who asks for float gets double here, for float has steps of 1 mm at 10 km.
  constexpr double young = 1e4, length = 0.1;
  WorldSetup setup = trial.setup("04_ten_km_away");
  setup.gravity.setZero();
  const Vec3 centre = setup.mesh.nodes.front();
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, -2, 2) / 3).toRotationMatrix();
  setup.initial_positions.clear();
  for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(R * (X - centre) + centre);
  Vector forces(3 * setup.mesh.nodes.size());
  trial.world(std::move(setup))->write_vectors(NodeVector::force, forces);
  return {largest(forces) / (young * length * length)};
}

Outcome sums_of_forces(const Trial& trial) {
  Body body(trial, irregular_block(), bench_material(trial.variant.law), true);
  const Vector x = body.held(moved(body.mesh(), Mat3::Identity(), 0.009, 4)), f = body.forces(x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double forces = 0, moments = 0;
  for (std::size_t n = 0; n < f.size() / 3; ++n) {
    const Vec3 force(f[3 * n], f[3 * n + 1], f[3 * n + 2]), at(x[3 * n], x[3 * n + 1], x[3 * n + 2]);
    sum += force;
    moment += at.cross(force);
    forces += force.norm();
    moments += at.norm() * force.norm();
  }
  return {std::max(sum.norm() / forces, moment.norm() / moments)};
}

Outcome exponential_far_out(const Trial& trial) {
  // Q = 200: e^Q exceeds the range of float, and any tissue.
  Material material = bench_material(trial.variant.law);
  const double gamma = 20;
  const LawInfo& law = *find_law(trial.variant.law);
  for (std::size_t k = 0; k < law.parameters.size(); ++k)
    if (law.parameters[k].kind == ParameterKind::exponent) material.parameters[k] = gamma;
  if (law.has_fibre) material.fibre = Vec3::UnitX();
  double stretch = 1;  // stretch of an incompressible bar with Q(stretch) = 200
  const auto Q = [&](double t) {
    const double I1 = t * t + 2 / t;
    if (law.name == "guccione") return gamma * (std::pow(t * t - 1, 2) + 2 * std::pow(1 / t - 1, 2)) / 4;
    return law.has_fibre ? gamma * std::pow(t * t - 1, 2) : gamma * (I1 - 3);
  };
  while (Q(stretch) < 200) stretch += 1e-4;
  const Vec3 stretches(stretch, 1 / std::sqrt(stretch), 1 / std::sqrt(stretch));
  Body body(trial, irregular_block(), material, true);
  const Vector x = body.held(moved(body.mesh(), stretches.asDiagonal(), 1e-4, 5));
  return {gradient_error(body, x), 0, 0, {}, {}, fmt::format("stretched to {:.2f}", stretch)};
}

Outcome equal_stretches(const Trial& trial) {
  Outcome outcome;
  TetMesh mesh = irregular_block();
  for (const Vec3& stretches : {Vec3(1, 1, 1), Vec3(1.3, 1.3, 1.3), Vec3(1.4, 0.8, 0.8), Vec3(1.2, 1.2, 0.7)})
    for (const double reach : {0.0, 1e-10, 1e-6}) {
      Body body(trial, mesh, bench_material(trial.variant.law), false);
      const Vector x = body.held(moved(mesh, stretches.asDiagonal(), reach, 6));
      outcome.value = std::max(outcome.value, stiffness_error(body, x, 2e-6));
    }
  return outcome;
}

}  // namespace heml::stability
