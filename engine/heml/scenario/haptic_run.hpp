#pragma once
// Offline haptic run: the force on a device whose handle follows a recorded trajectory. The engine ticks at the scene's
// rate, each tick's state reaches the device when the tick is over, and in between a servo (tools/haptic_servo.hpp)
// computes forces at 1 kHz. No clock is read: the same trajectory gives the same forces.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/tools/haptic_servo.hpp>
#include <vector>

namespace heml {

/// Positions of the handle over time.
struct HandleTrajectory {
  std::vector<double> times;    ///< s, ascending
  std::vector<Vec3> positions;  ///< m
  Vec3 at(double time) const;   ///< interpolated linearly, constant before and after
};

/// Reads a CSV with header `time,x,y,z` (s, m). Throws InputError naming the line.
HandleTrajectory read_handle_csv(const std::filesystem::path& path);

/// One cycle of the servo.
struct HapticSample {
  double time = 0;             ///< s
  Vec3 handle = Vec3::Zero();  ///< m
  Vec3 force = Vec3::Zero();   ///< N, on the handle
  double energy = 0;           ///< J, put in by the user so far
  double damping = 0;          ///< N s/m, added by the servo
};

/// Runs the scene with its grasp following the handle. The scene's events apply, except MoveTool. Ends with the
/// trajectory or the scene, whichever is first, or where the world halts (HapticRun::halt, samples up to there). Throws
/// InputError for a static scene or a refused command.
struct HapticRun {
  std::vector<HapticSample> samples;
  std::optional<StopReason> halt;
};
HapticRun run_with_handle(const Scene& scene, const HandleTrajectory& handle, const HapticLimits& limits = {});

}  // namespace heml
