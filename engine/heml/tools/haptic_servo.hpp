#pragma once
// Force feedback between the engine's ticks. A device is served at 1 kHz, while a step of the body may take ten
// milliseconds; so the servo evaluates a local linear model, fitted to the engine's last states:
//
//    engine   ●───────────────●───────────────●        R_k, x_k: force on the tissue and position of the tool
//    servo    ·············································  R(x) ≈ R_k + B (x − x_k)
//
// B (N/m) follows from consecutive states by Broyden's update (Mathematics of Computation 19, 1965). The model uses its
// symmetric part, with eigenvalues clamped between 0 and the stiffness that the device is stable with. The jump of
// force at a new state is blended over the time between states. A late or wrong model can feed energy to the user, felt
// as buzzing; a passivity observer adds damping that dissipates the excess (Hannaford & Ryu: Time-domain passivity
// control of haptic interfaces, IEEE Transactions on Robotics and Automation 18, 2002).
//
// Depends on no world, thread or clock.
#include <heml/math/types.hpp>

namespace heml {

struct HapticLimits {
  double max_stiffness = 1000;  ///< N/m, of the model, bounded by the device's stability
  double force = 4;             ///< N, maximum the device can give; larger forces are clamped
  double damping = 20;          ///< N s/m, maximum that is added
};

/// State of the tool in the engine at one time.
struct ToolContact {
  double time = 0;            ///< s
  Vec3 tool = Vec3::Zero();   ///< m
  Vec3 force = Vec3::Zero();  ///< N, of the tool on the tissue; the user feels the opposite
};

class HapticServo {
 public:
  explicit HapticServo(const HapticLimits& limits = {}) : limits_(limits) {}

  /// Updates the model with a state of the engine newer than the last.
  void update(const ToolContact& state);
  /// Removes the model: no force until the next update().
  void release();

  /// Returns the force (N) on the handle at x (m). seconds: since the previous call, during which its force was
  /// constant.
  Vec3 serve(const Vec3& x, double seconds);

  double energy() const { return energy_; }             ///< J, put in by the user so far; negative: the servo is active
  double added_damping() const { return damping_; }     ///< N s/m, at the last call
  const Mat3& stiffness() const { return stiffness_; }  ///< N/m, of the model

 private:
  Vec3 modelled(const Vec3& x) const;
  void limit_energy(const Vec3& displacement, double seconds);

  HapticLimits limits_;
  bool touching_ = false, has_served_ = false;
  ToolContact last_;
  double between_ = 0;              ///< s, between the last two states
  double since_ = 0;                ///< s, of serving since the last state
  Vec3 correction_ = Vec3::Zero();  ///< N, the previous model's force at the last state's position minus the true one
  Mat3 broyden_ = Mat3::Zero();     ///< B
  Mat3 stiffness_ = Mat3::Zero();   ///< clamped symmetric part of B
  Vec3 handle_ = Vec3::Zero(), last_force_ = Vec3::Zero();  ///< m and N, at the last call
  double energy_ = 0, damping_ = 0;
};

}  // namespace heml
