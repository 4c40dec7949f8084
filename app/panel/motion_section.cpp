#include <fmt/format.h>

#include <app/panel/motion_section.hpp>
#include <array>
#include <cmath>
#include <heml/scenario/suitable_method.hpp>

namespace heml::panel {
namespace {

constexpr double max_gravity = 1000;  // m/s², of a component that is typed

struct Direction {
  const char* name;
  Vec3 vector;
};
const std::array<Direction, 6>& directions() {
  static const std::array<Direction, 6> all{{{"down (−y)", {0, -1, 0}},
                                             {"up (+y)", {0, 1, 0}},
                                             {"left (−x)", {-1, 0, 0}},
                                             {"right (+x)", {1, 0, 0}},
                                             {"back (−z)", {0, 0, -1}},
                                             {"front (+z)", {0, 0, 1}}}};
  return all;
}

/// "1000 Hz, 1 ms".
std::string name_of_rate(double rate) { return fmt::format("{:.4g} Hz, {:.3g} ms", rate, 1e3 / rate); }

}  // namespace

void MotionSection::write_into(Scene& scene) const {
  scene.gravity = strength_ * direction_;
  scene.solver.damping = damping_;
  scene.solver.integrator = integrator_;
  if (!step_given_) {
    scene.solver.step.reset();
    scene.solver.rate = rate_;
  }
  if (budget_ > 0) {
    if (!scene.solver.budget) scene.solver.budget.emplace();
    if (scene.solver.budget->milliseconds == 0) scene.solver.budget->iterations = budget_;
  }
}

MotionSection::MotionSection(const Vec3& gravity, const SolverSettings& solver)
    : damping_(solver.damping),
      integrator_(solver.integrator),
      rate_(1 / solver.tick()),
      step_given_(solver.step.has_value()),
      budget_(solver.budget ? solver.budget->iterations : 0) {
  sync(SetGravity{gravity});
}

void MotionSection::sync(const SetGravity& command) {
  typed_ = command.gravity;
  strength_ = command.gravity.norm();
  if (strength_ > 0) direction_ = command.gravity / strength_;
}

void MotionSection::sync(const SetRate& command) {
  rate_ = command.rate;
  step_given_ = false;
}

void MotionSection::draw(Rows& rows, PanelActions& out) {
  draw_gravity(rows, out);
  if (rows.slider({"Damping", "Mass-proportional damping, 1/s. 0: none."}, damping_, {0, 20, "%.2f 1/s", false}))
    out.commands.emplace_back(SetDamping{damping_});
  draw_integrator(rows, out);
  draw_rate(rows, out);
  if (is_implicit(integrator_)) draw_budget(rows, out);
}

void MotionSection::draw_gravity(Rows& rows, PanelActions& out) {
  bool changed = rows.slider({"Gravity", "Gravitational acceleration, m/s²; 9.81 on Earth."}, strength_,
                             {0, 20, "%.2f m/s²", false});
  std::array<std::string, 7> names;
  int chosen = 6;
  for (int i = 0; i < 6; ++i) {
    names[i] = directions()[i].name;
    if ((directions()[i].vector - direction_).norm() < 1e-9) chosen = i;
  }
  names[6] = "x, y, z";
  if (is_typed_) chosen = 6;
  if (rows.choice({"Direction", "Direction of gravity; x, y, z: typed below."}, chosen, names)) {
    is_typed_ = chosen == 6;
    if (!is_typed_) {
      direction_ = directions()[chosen].vector;
      changed = true;
    }
  }
  if (changed) typed_ = strength_ * direction_;
  if (chosen == 6 && rows.vector({"Gravity x, y, z", "The same by its components, m/s²."}, typed_,
                                 {-max_gravity, max_gravity, "%.4g"})) {
    sync(SetGravity{typed_});
    changed = true;
  }
  bool shown = has_arrow();
  if (chosen == 6 && rows.check({"Arrow in the image", "Shows gravity as an arrow. Drag its tip to set direction and "
                                                       "size; Shift keeps to an axis, Esc gives it back."},
                                shown)) {
    has_arrow_ = shown;
    is_typed_ = true;
  }
  if (changed) out.commands.emplace_back(SetGravity{strength_ * direction_});
}

void MotionSection::draw_integrator(Rows& rows, PanelActions& out) {
  std::vector<std::string> titles;
  std::vector<Integrator> integrators;
  int chosen = -1;
  for (const Integrator integrator : moving_integrators()) {
    if (integrator == integrator_) chosen = static_cast<int>(titles.size());
    titles.emplace_back(info_of(integrator).title);
    integrators.push_back(integrator);
  }
  if (!rows.choice({"Integrator", "Time integrator. Of the two explicit ones Verlet is the more accurate."}, chosen,
                   titles))
    return;
  const Integrator before = integrator_;
  send(SetIntegrator{integrators[static_cast<std::size_t>(chosen)]}, out);
  if (is_implicit(before) != is_implicit(integrator_)) send(SetRate{usual_rate(integrator_)}, out);
}

void MotionSection::draw_rate(Rows& rows, PanelActions& out) {
  constexpr std::array<double, 11> rates{4000, 2000, 1000, 500, 250, 120, 60, 30, 20, 15, 10};
  std::vector<std::string> names;
  int chosen = -1;
  for (const double rate : rates) {
    if (std::abs(rate - rate_) < 1e-6 * rate) chosen = static_cast<int>(names.size());
    names.push_back(name_of_rate(rate));
  }
  if (chosen < 0) {
    chosen = static_cast<int>(names.size());
    names.push_back(name_of_rate(rate_));
  }
  if (rows.choice({"Rate",
                   "Ticks of a simulated second, Hz, and the length of one. Explicit methods divide a tick into stable "
                   "steps; implicit ones "
                   "take a step a tick: fewer cost less and damp more."},
                  chosen, names) &&
      chosen < static_cast<int>(rates.size()))
    send(SetRate{rates[static_cast<std::size_t>(chosen)]}, out);
}

void MotionSection::draw_budget(Rows& rows, PanelActions& out) {
  constexpr std::array<int, 6> iterations{1, 2, 3, 4, 8, 16};
  std::vector<std::string> names;
  int chosen = -1;
  for (const int one : iterations) {
    if (one == budget_) chosen = static_cast<int>(names.size());
    names.push_back(fmt::format("{} iteration{}", one, one == 1 ? "" : "s"));
  }
  if (chosen < 0) {
    chosen = static_cast<int>(names.size());
    names.push_back(budget_ > 0 ? fmt::format("{} iterations", budget_) : std::string("to tolerance"));
  }
  if (rows.choice({"Budget",
                   "Iterations of an implicit step. Fewer keep the pace and leave more of the forces unbalanced; the "
                   "step never gains energy for it."},
                  chosen, names) &&
      chosen < static_cast<int>(iterations.size()))
    send(SetBudget{iterations[static_cast<std::size_t>(chosen)]}, out);
}

}  // namespace heml::panel
