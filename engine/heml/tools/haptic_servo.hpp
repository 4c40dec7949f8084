#pragma once
// What a hand feels between the engine's ticks. A hand is served a thousand times a second, a body may take ten
// milliseconds a step; so the servo keeps a model of what the tool meets, made of the engine's last states, and answers
// from that:
//
//    engine   ●───────────────●───────────────●        R_k, x_k: force on the tissue and place of the tool
//    servo    ·············································  R(x) ≈ R_k + B (x − x_k)
//
// B (N/m) is learnt from one state to the next by Broyden's update (Mathematics of Computation 19, 1965), of which the
// symmetric part with stiffnesses from 0 to what the device can hold is used; a new state's step of force is spread
// over the time to the next. A model that is late or wrong can feed a hand energy, which the hand feels as buzzing: the
// energy given out is watched, and damping takes back what was given beyond what came in (Hannaford & Ryu: Time-domain
// passivity control of haptic interfaces, IEEE Transactions on Robotics and Automation 18, 2002).
//
// Knows no world, no thread and no clock.
#include <heml/math/types.hpp>

namespace heml {

struct HapticLimits {
  double max_stiffness = 1000;  ///< N/m, of the model: no more than the device is stable with
  double force = 4;             ///< N, that the device can give; more is cut off
  double damping = 20;          ///< N s/m, most that is added
};

/// The engine's word on the tool, of one moment.
struct ToolContact {
  double time = 0;            ///< s
  Vec3 tool = Vec3::Zero();   ///< m
  Vec3 force = Vec3::Zero();  ///< N, of the tool on the tissue: the hand feels the opposite
};

class HapticServo {
 public:
  explicit HapticServo(const HapticLimits& limits = {}) : limits_(limits) {}

  /// A state of the engine that is newer than the last.
  void update(const ToolContact& state);
  /// The tool has let go: no force until the next state.
  void release();

  /// The force on a hand that is at x (m), N; held until the next call, `seconds` later.
  Vec3 serve(const Vec3& x, double seconds);

  double energy() const { return energy_; }             ///< J, that the hand has put in so far; less than 0: too little
  double added_damping() const { return damping_; }     ///< N s/m, at the last call
  const Mat3& stiffness() const { return stiffness_; }  ///< N/m, of the model

 private:
  Vec3 modelled(const Vec3& x) const;
  void limit_energy(const Vec3& displacement, double seconds);

  HapticLimits limits_;
  bool touching_ = false, has_served_ = false;
  ToolContact last_;
  double between_ = 0;              ///< s, of the last two states
  double since_ = 0;                ///< s of serving since the last state
  Vec3 correction_ = Vec3::Zero();  ///< N, what the model before said of the last state's place, less what is so
  Mat3 broyden_ = Mat3::Zero();     ///< B
  Mat3 stiffness_ = Mat3::Zero();   ///< of it what is used
  Vec3 handle_ = Vec3::Zero(), last_force_ = Vec3::Zero();  ///< m, N at the last call
  double energy_ = 0, damping_ = 0;
};

}  // namespace heml
