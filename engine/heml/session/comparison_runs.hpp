#pragma once
// Comparison runs: variants of a session's body (variant.hpp) simulated in lockstep with it. Each is a separate world
// that gets the same commands and ticks; none affects the session's world.
//
//    command ──► world ─┬─► run 1 ─┬─► run 2 …        apply(): each run that the command concerns
//    tick:    [ world | run 1 | run 2 … ]             in parallel, on up to all cores
#include <heml/base/thread_team.hpp>
#include <heml/session/frame.hpp>
#include <heml/session/surface_mesh.hpp>
#include <heml/session/variant.hpp>

namespace heml {

class ComparisonRuns {
 public:
  static constexpr std::size_t max = 3;  ///< number of runs

  /// One run of `setup` for each entry of `words`, in the syntax of variant_of(). Throws InputError for an unknown word
  /// or too many entries.
  ComparisonRuns(const WorldSetup& setup, const std::vector<std::string>& words);

  /// Applies a command that the world has carried out. A run with its own law ignores SetMaterial, one with its own
  /// integrator SetIntegrator.
  void apply(const Command& command);
  /// Runs one tick of the world and of every run that has not halted, and waits for all. Returns the wall time (s)
  /// spent waiting for comparison runs, so that cost estimates can exclude it.
  double tick(World& world);
  /// Makes a tick under way end early; may be called from any thread.
  void interrupt();
  /// Fills Frame::comparisons and Frame::variant of the world's frame, which fill_frame() has filled. ahead: s, as
  /// there. skin: of the world's frames; those of the runs get one of their own, cut as they are.
  void fill(const World& world, Frame& frame, double ahead = 0, const SkinAttachment& skin = {});

 private:
  struct ComparisonRun {
    Variant variant;  ///< without its setup
    std::unique_ptr<World> world;
    std::shared_ptr<const SurfaceMesh> surface_mesh;
    std::shared_ptr<const Solid> solid;
    SkinAttachment skin;  // of a world whose frames have one; cut as this run is
  };
  std::vector<ComparisonRun> comparison_runs_;
  ThreadTeam team_;
};

}  // namespace heml
