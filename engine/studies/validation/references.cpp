#include <cmath>
#include <stdexcept>
#include <studies/validation/references.hpp>

namespace heml::validation {
namespace {

/// ∂W/∂λ_r at stretches λ_r and, `k` times, λ_θ; of a cylinder the third stretch is 1.
double radial_stress(const ThickWall& wall, double radial, double hoop) {
  const int k = wall.directions;
  const double J = radial * std::pow(hoop, k), I1 = radial * radial + k * hoop * hoop + (2 - k);
  return wall.material.shear * std::pow(J, -2.0 / 3) * (radial - I1 / (3 * radial)) +
         wall.material.bulk * (J - 1) * J / radial;
}

double hoop_stress(const ThickWall& wall, double radial, double hoop) {
  const int k = wall.directions;
  const double J = radial * std::pow(hoop, k), I1 = radial * radial + k * hoop * hoop + (2 - k);
  return wall.material.shear * std::pow(J, -2.0 / 3) * (hoop - I1 / (3 * hoop)) +
         wall.material.bulk * (J - 1) * J / hoop;
}

/// λ_r of a radial stress; `near`: where Newton's method begins.
double radial_stretch(const ThickWall& wall, double stress, double hoop, double near) {
  double stretch = near;
  for (int i = 0; i < 8; ++i) {
    const double h = 1e-6, off = radial_stress(wall, stretch, hoop) - stress;
    const double slope = (radial_stress(wall, stretch + h, hoop) - radial_stress(wall, stretch - h, hoop)) / (2 * h);
    const double change = off / slope;
    stretch -= change;
    if (std::abs(change) < 1e-13) break;
  }
  return stretch;
}

}  // namespace

double root(const std::function<double(double)>& f, double low, double high) {
  const bool rises = f(low) < 0;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    ((f(middle) < 0) == rises ? low : high) = middle;
  }
  return (low + high) / 2;
}

RadialState radial_state(const ThickWall& wall, double deformed_outer, int steps) {
  const double k = wall.directions, h = (wall.inner - wall.outer) / steps;
  double R = wall.outer, near = std::pow(wall.outer / deformed_outer, k);
  std::array<double, 2> y{deformed_outer, 0};  // r, P_r
  using Pair = std::array<double, 2>;
  const auto slope = [&](double at, const Pair& s) -> Pair {
    const double hoop = s[0] / at;
    near = radial_stretch(wall, s[1], hoop, near);
    return {near, -k * (s[1] - hoop_stress(wall, near, hoop)) / at};
  };
  const auto plus = [](const Pair& a, double t, const Pair& b) { return Pair{a[0] + t * b[0], a[1] + t * b[1]}; };
  RadialState state{0, 0, deformed_outer, {{R, y[0] - R}}};
  for (int i = 0; i < steps; ++i, R = wall.outer + i * h) {
    const Pair a = slope(R, y), b = slope(R + h / 2, plus(y, h / 2, a)), c = slope(R + h / 2, plus(y, h / 2, b)),
               d = slope(R + h, plus(y, h, c));
    for (std::size_t j = 0; j < 2; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    state.profile.push_back({R + h, y[0] - R - h});
  }
  state.inner = y[0];
  state.pressure = -y[1] / std::pow(y[0] / wall.inner, k);
  return state;
}

RadialState radial_state_under(const ThickWall& wall, double pressure) {
  const auto off = [&](double outer) { return radial_state(wall, outer, 200).pressure - pressure; };
  double high = wall.outer;
  while (off(high) < 0) {
    high += 0.01 * wall.outer;
    if (high > 2 * wall.outer) throw std::domain_error("no radial state bears this pressure");
  }
  const double near = root(off, high - 0.01 * wall.outer, high), width = 1e-8 * wall.outer;
  return radial_state(wall, root([&](double outer) { return radial_state(wall, outer).pressure - pressure; },
                                 near - width, near + width));
}

double incompressible_sphere_pressure(double shear, double inner, double outer, double deformed_inner) {
  const double grown = deformed_inner * deformed_inner * deformed_inner - inner * inner * inner;
  const double a = deformed_inner / inner, b = std::cbrt(outer * outer * outer + grown) / outer;
  const auto term = [](double stretch) { return 2 / stretch + 1 / (2 * std::pow(stretch, 4)); };
  return shear * (term(b) - term(a));
}

double LinearSolid::stress_after(double strain_change, double seconds) {
  strain_ += strain_change;
  double stress = shear_ * strain_;
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const auto [strength, time] = branches_[b];
    const double gone = -std::expm1(-seconds / time);
    stresses_[b] += shear_ * strength * strain_change * time / seconds * gone - stresses_[b] * gone;
    stress += stresses_[b];
  }
  return stress;
}

double creep_strain(double stress, const Rubber& at_last, const Branch& branch, double time) {
  const double part = branch.strength / (1 + branch.strength);
  const double compliance = (1 - part * std::exp(-time / (branch.time * (1 + branch.strength)))) / at_last.shear;
  return stress * (compliance / 3 + 1 / (9 * at_last.bulk));
}

double PlasticShear::stress_after(double strain_change) {
  const double trial = stress_ + shear_ * strain_change, limit = (yield_ + hardening_ * equivalent_) / std::sqrt(3);
  const double flow = std::max(0.0, (std::abs(trial) - limit) / (shear_ + hardening_ / 3));
  const double before = flow > 0 ? limit : 0, after = std::abs(trial) - shear_ * flow;
  work_ += flow * (before + after) / 2;
  equivalent_ += flow / std::sqrt(3);
  stress_ = std::copysign(after, trial);
  return stress_;
}

Elastica elastica_of(double load) {
  constexpr int steps = 1000;
  constexpr double h = 1.0 / steps;
  using State = std::array<double, 4>;  // angle, its slope, along, across
  const auto shoot = [&](double slope_at_clamp, Elastica* shape) {
    const auto rate = [&](const State& s) {
      return State{s[1], -load * std::cos(s[0]), std::cos(s[0]), std::sin(s[0])};
    };
    const auto plus = [](State a, double t, const State& b) {
      for (std::size_t j = 0; j < 4; ++j) a[j] += t * b[j];
      return a;
    };
    State s{0, slope_at_clamp, 0, 0};
    for (int i = 0; i < steps; ++i) {
      const State a = rate(s), b = rate(plus(s, h / 2, a)), c = rate(plus(s, h / 2, b)), d = rate(plus(s, h, c));
      for (std::size_t j = 0; j < 4; ++j) s[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
      if (shape && i % 10 == 9) shape->shape.push_back({s[2], s[3]});
    }
    if (shape) shape->along = s[2], shape->across = s[3];
    return s[1];  // the bending moment of the end, which is free
  };
  // Up to the first root: larger slopes belong to coiled states.
  double high = 0.01;
  while (shoot(high, nullptr) < 0) high += 0.01;
  Elastica result{0, 0, {{0, 0}}};
  shoot(root([&](double slope) { return shoot(slope, nullptr); }, high - 0.01, high), &result);
  return result;
}

}  // namespace heml::validation
