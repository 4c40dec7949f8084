#pragma once
// The panel's section "Motion": gravity, damping and the integrator.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class MotionSection {
 public:
  MotionSection(const Vec3& gravity, const SolverSettings& solver);

  void draw(Rows& rows, PanelActions& out);

  void write_into(Scene& scene) const;  ///< the shown settings

  // Update the shown settings after a command from elsewhere (a script).
  void sync(const SetGravity& command);
  void sync(const SetDamping& command) { damping_ = command.damping; }
  void sync(const SetIntegrator& command) { integrator_ = command.integrator; }
  void sync(const SetRate& command);
  void sync(const SetBudget& command) { budget_ = command.iterations; }

  Integrator integrator() const { return integrator_; }
  Vec3 gravity() const { return strength_ * direction_; }  ///< m/s²
  bool has_arrow() const { return has_arrow_ && is_typed_; }  ///< gravity in the image, to be dragged
  int budget() const { return budget_; }  ///< iterations of an implicit stage; 0: to its tolerance

 private:
  void draw_gravity(Rows& rows, PanelActions& out);
  void draw_integrator(Rows& rows, PanelActions& out);
  void draw_rate(Rows& rows, PanelActions& out);
  void draw_budget(Rows& rows, PanelActions& out);
  /// Adds a command to the actions and shows its setting.
  template <class C>
  void send(const C& command, PanelActions& out) {
    sync(command);
    out.commands.emplace_back(command);
  }

  bool has_arrow_ = false;
  bool is_typed_ = false;      // by its components
  Vec3 typed_ = Vec3::Zero();  // m/s², gravity as its components are shown
  double strength_ = 0;              ///< of gravity, m/s²
  Vec3 direction_ = Vec3(0, -1, 0);  ///< of gravity, unit; kept while the strength is 0
  double damping_;                   ///< 1/s
  Integrator integrator_;
  double rate_;      ///< Hz
  bool step_given_;  ///< by the scene, and not replaced by a rate since
  int budget_ = 0;   ///< iterations; 0: none, or in milliseconds
};

}  // namespace heml::panel
