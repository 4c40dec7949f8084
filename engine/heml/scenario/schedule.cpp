#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/command_table.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/selection.hpp>

namespace heml {

void set_nodes(Command& command, const TetMesh& mesh, const std::vector<Vec3>& points) {
  std::size_t next = 0;
  for (const MeshReference& reference : info_of(command).references(command))
    if (reference.kind == MeshReference::Kind::node) *reference.number = nearest_surface_node(mesh, points.at(next++));
}

Schedule::Schedule(const Scene& scene, const TetMesh& mesh) : file_(scene.file), events_(scene.events) {
  for (const auto& [index, points] : scene.points) set_nodes(events_.at(index).command, mesh, points);
  // Cuts add nodes and elements: the world tells whether those are there.
  const bool cuts = std::any_of(events_.begin(), events_.end(),
                                [](const Event& event) { return continues_stroke(event.command).has_value(); });
  if (cuts) return;
  for (Event& event : events_)
    for (const MeshReference& reference : info_of(event.command).references(event.command)) {
      const bool is_node = reference.kind == MeshReference::Kind::node;
      const std::size_t count = is_node ? mesh.nodes.size() : mesh.tets.size();
      const int number = *reference.number;
      if (number >= 0 && static_cast<std::size_t>(number) < count) continue;
      throw InputError(file_, fmt::format("events: step {}: {}", event.tick, reference.key),
                       fmt::format("is {}", number),
                       fmt::format("the mesh has {} 0 to {}", is_node ? "nodes" : "elements", count - 1));
    }
}

std::span<const Event> Schedule::due(long tick) {
  const std::size_t first = next_;
  while (next_ < events_.size() && events_[next_].tick <= tick) ++next_;
  return std::span(events_).subspan(first, next_ - first);
}

void Schedule::rewind(long tick) {
  next_ = 0;
  due(tick - 1);
}

/// After a part of a stroke: whether it has parted or burnt anything. A stroke is over where no later part goes on with
/// it.
void Schedule::watch_stroke(const Event& event, bool met) {
  const auto continues = continues_stroke(event.command);
  if (!continues) return;
  met_ = (*continues && met_) || met;
  const auto next = std::find_if(events_.begin() + (&event - events_.data()) + 1, events_.end(),
                                 [](const Event& later) { return continues_stroke(later.command).has_value(); });
  if (met_ || (next != events_.end() && *continues_stroke(next->command))) return;
  if (std::holds_alternative<CutTissue>(event.command))
    warn(
        "{}: events: step {}: the cut parted nothing: its blade passes beside the body as it lies then, or is too "
        "short to part an element",
        file_, event.tick);
  else
    warn("{}: events: step {}: the electrode burnt nothing: no tissue that it could still burn is within its radius",
         file_, event.tick);
}

void Schedule::apply(World& world, const std::function<void(const Command&)>& applied) {
  const auto met = [&] {
    std::size_t sum = world.edits().size();
    for (const EditReport& edit : world.edits()) sum += edit.split + edit.burnt;
    return sum;
  };
  for (const Event& event : due(world.ticks())) {
    const std::size_t before = met();
    if (const Status status = world.apply(event.command); !status.ok())
      throw InputError(file_, fmt::format("events: step {}", event.tick), status.message(), event_line(event));
    watch_stroke(event, met() != before);
    applied(event.command);
  }
}

}  // namespace heml
