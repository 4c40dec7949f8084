#pragma once
// Other ways to compute a session's body, side by side with it: each is a world of its own that gets the same commands
// and makes the same ticks. Nothing of them comes back to the session's world.
//
//    command ──► world ─┬─► companion 1 ─┬─► companion 2 …        apply(): each that it concerns
//    tick:    [ world | companion 1 | companion 2 … ]             on as many cores as there are
#include <heml/base/thread_team.hpp>
#include <heml/session/frame.hpp>
#include <heml/session/variant.hpp>

namespace heml {

class ComparisonRuns {
 public:
  static constexpr std::size_t max = 3;  ///< that can be looked at

  /// As the words say (variant_of()), of the body as it is set up. Throws InputError.
  ComparisonRuns(const WorldSetup& setup, const std::vector<std::string>& words);

  /// What the world has carried out. A companion with a law of its own takes no other; of a method likewise.
  void apply(const Command& command);
  /// One tick of the world and of every companion that has not halted. Returns when all have ended: how much longer
  /// that took than the world's own tick, s, since what is learnt of the clock is to be of the world alone.
  double tick(World& world);
  /// Lets a tick under way end early.
  void interrupt();
  /// Fills Frame::beside and Frame::way of the world's frame, which is filled. ahead: as in fill_frame(), s.
  void fill(const World& world, Frame& frame, double ahead = 0);

 private:
  struct ComparisonRun {
    Variant variant;  ///< without its setup
    std::unique_ptr<World> world;
    std::shared_ptr<const SurfaceMesh> surface_mesh;
  };
  std::vector<ComparisonRun> comparison_runs_;
  ThreadTeam team_;
};

}  // namespace heml
