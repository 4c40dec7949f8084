#pragma once
// The events of a scene, handed out tick by tick.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <span>
#include <string>
#include <vector>

namespace heml {

/// Of a command about nodes that was given by places: the nodes of the surface nearest to them.
void set_nodes(Command& command, const TetMesh& mesh, const std::vector<Vec3>& points);

class Schedule {
 public:
  /// Resolves commands given by places to the surface nodes nearest at rest. mesh: as the world has it.
  /// Throws InputError for a node or an element the mesh does not have.
  Schedule(const Scene& scene, const TetMesh& mesh);

  /// The events up to a tick that were not handed out before. Valid while the schedule lives.
  std::span<const Event> due(long tick);

  /// Whether an event of a tick, or of a later one, was handed out.
  bool has_begun(long tick) const { return next_ > 0 && events_[next_ - 1].tick >= tick; }
  /// Hands out the events of a tick and of those after it again: for a world that went back to a snapshot.
  void rewind(long tick);

  /// Those handed out so far.
  std::span<const Event> past() const { return std::span(events_).first(next_); }

  /// Applies the events due at the world's coming tick, and tells of each that was. Warns of a stroke that has parted
  /// nothing. Throws InputError when the world refuses an event: what came before it stands.
  void apply(
      World& world, const std::function<void(const Command&)>& applied = [](const Command&) {});

 private:
  void watch_stroke(const Event& event, bool met);

  std::string file_;
  std::vector<Event> events_;  ///< ascending in tick
  std::size_t next_ = 0;
  bool met_ = false;  ///< whether the stroke under way has parted or burnt anything
};

}  // namespace heml
