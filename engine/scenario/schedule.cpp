#include <fmt/format.h>
#include <heml/base/error.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/selection.hpp>

namespace heml {

Schedule::Schedule(const Scene& scene, const TetMesh& mesh) : file_(scene.file), events_(scene.events) {
  for (const auto& [index, point] : scene.grasp_points)
    std::get<Grasp>(events_.at(index).command).node = nearest_surface_node(mesh, point);
  for (const Event& event : events_)
    if (const Grasp* grasp = std::get_if<Grasp>(&event.command))
      if (grasp->node < 0 || static_cast<std::size_t>(grasp->node) >= mesh.nodes.size())
        throw InputError(file_, fmt::format("events: step {}: grasp.node", event.tick),
                         fmt::format("is {}", grasp->node),
                         fmt::format("the mesh has nodes 0 to {}", mesh.nodes.size() - 1));
}

std::span<const Event> Schedule::due(long tick) {
  const std::size_t first = next_;
  while (next_ < events_.size() && events_[next_].tick <= tick) ++next_;
  return std::span(events_).subspan(first, next_ - first);
}

void Schedule::apply(World& world) {
  for (const Event& event : due(world.ticks()))
    if (const auto problem = world.apply(event.command))
      throw InputError(file_, fmt::format("events: step {}", event.tick), *problem, event_line(event));
}

}  // namespace heml
