#include <app/panel/motion_section.hpp>
#include <array>

namespace heml::panel {
namespace {

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

}  // namespace

void MotionSection::write_into(Scene& scene) const {
  scene.gravity = strength_ * direction_;
  scene.solver.damping = damping_;
  scene.solver.integrator = integrator_;
}

MotionSection::MotionSection(const Vec3& gravity, const SolverSettings& solver)
    : damping_(solver.damping), integrator_(solver.integrator) {
  sync(SetGravity{gravity});
}

void MotionSection::sync(const SetGravity& command) {
  strength_ = command.gravity.norm();
  if (strength_ > 0) direction_ = command.gravity / strength_;
}

void MotionSection::draw(Rows& rows, PanelActions& out) {
  draw_gravity(rows, out);
  if (rows.slider({"Damping", "Mass-proportional damping, 1/s. 0: none."}, damping_, {0, 20, "%.2f 1/s", false}))
    out.commands.emplace_back(SetDamping{damping_});
  draw_integrator(rows, out);
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
  names[6] = "as in the scene";
  const std::span<const std::string> offered(names.data(), chosen == 6 ? 7 : 6);
  if (rows.choice({"Direction", "Direction of gravity."}, chosen, offered)) {
    direction_ = directions()[chosen].vector;
    changed = true;
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
  integrator_ = integrators[static_cast<std::size_t>(chosen)];
  out.commands.emplace_back(SetIntegrator{integrator_});
}

}  // namespace heml::panel
