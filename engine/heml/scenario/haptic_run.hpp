#pragma once
// A scene touched by a hand that was recorded: what a haptic device would feel. The engine ticks as the scene says,
// each tick's state reaches the hand when the tick is over, and between them a servo (tools/haptic_servo.hpp) answers a
// thousand times a second. No clock: the same hand feels the same forces again.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/tools/haptic_servo.hpp>
#include <vector>

namespace heml {

/// Places of a hand.
struct HandleTrajectory {
  std::vector<double> times;    ///< s, ascending
  std::vector<Vec3> positions;  ///< m
  Vec3 at(double time) const;   ///< linear between them, still before and after
};

/// Reads a CSV: header `time,x,y,z`, s and m. Throws InputError naming the line.
HandleTrajectory read_handle_csv(const std::filesystem::path& path);

/// One turn of the servo.
struct HapticSample {
  double time = 0;             ///< s
  Vec3 handle = Vec3::Zero();  ///< m
  Vec3 force = Vec3::Zero();   ///< N, on the hand
  double energy = 0;           ///< J, the hand has put in
  double damping = 0;          ///< N s/m, added
};

/// The scene's grasp goes where the hand goes. Its events play, without their moves of the tool. Ends with the hand or
/// the scene, whichever is first. Throws InputError; where the world halts, with what was felt up to there in `felt`.
struct HapticRun {
  std::vector<HapticSample> samples;
  std::optional<StopReason> halt;
};
HapticRun run_with_handle(const Scene& scene, const HandleTrajectory& handle, const HapticLimits& limits = {});

}  // namespace heml
