#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/selection.hpp>

namespace heml {

void set_nodes(Command& command, const TetMesh& mesh, const std::vector<Vec3>& points) {
  const auto node = [&](std::size_t k) { return nearest_surface_node(mesh, points.at(k)); };
  if (auto* grasp = std::get_if<Grasp>(&command)) grasp->node = node(0);
  if (auto* pin = std::get_if<PinTissue>(&command)) pin->node = node(0);
  if (auto* unpin = std::get_if<Unpin>(&command)) unpin->node = node(0);
  if (auto* suture = std::get_if<SutureTissue>(&command)) suture->nodes = {node(0), node(1)};
}

Schedule::Schedule(const Scene& scene, const TetMesh& mesh) : file_(scene.file), events_(scene.events) {
  for (const auto& [index, points] : scene.points) set_nodes(events_.at(index).command, mesh, points);
  // Cuts add nodes and elements: the world tells whether those are there.
  const bool cuts = std::any_of(events_.begin(), events_.end(),
                                [](const Event& event) { return std::holds_alternative<CutTissue>(event.command); });
  for (const Event& event : events_) {
    if (cuts) break;
    const auto expect = [&](int number, std::size_t count, const std::string& key, const char* kind) {
      if (number >= 0 && static_cast<std::size_t>(number) < count) return;
      throw InputError(file_, fmt::format("events: step {}: {}", event.tick, key), fmt::format("is {}", number),
                       fmt::format("the mesh has {} 0 to {}", kind, count - 1));
    };
    if (const auto* grasp = std::get_if<Grasp>(&event.command))
      expect(grasp->node, mesh.nodes.size(), "grasp.node", "nodes");
    if (const auto* pin = std::get_if<PinTissue>(&event.command))
      expect(pin->node, mesh.nodes.size(), "pin.node", "nodes");
    if (const auto* unpin = std::get_if<Unpin>(&event.command); unpin && unpin->node)
      expect(*unpin->node, mesh.nodes.size(), "release.node", "nodes");
    if (const auto* suture = std::get_if<SutureTissue>(&event.command))
      for (const int node : suture->nodes) expect(node, mesh.nodes.size(), "suture.nodes", "nodes");
    if (const auto* remove = std::get_if<RemoveElements>(&event.command))
      for (std::size_t k = 0; k < remove->which.tets.size(); ++k)
        expect(remove->which.tets[k], mesh.tets.size(), fmt::format("remove.tets[{}]", k), "elements");
  }
}

std::span<const Event> Schedule::due(long tick) {
  const std::size_t first = next_;
  while (next_ < events_.size() && events_[next_].tick <= tick) ++next_;
  return std::span(events_).subspan(first, next_ - first);
}

/// After a cut: whether its sweep has parted anything. A stroke is over where no later cut goes on with it.
void Schedule::watch_stroke(const Event& event, bool parted) {
  const auto* cut = std::get_if<CutTissue>(&event.command);
  if (!cut) return;
  parted_ = (cut->continues_stroke && parted_) || parted;
  const auto next = std::find_if(events_.begin() + (&event - events_.data()) + 1, events_.end(),
                                 [](const Event& later) { return std::holds_alternative<CutTissue>(later.command); });
  const bool continues_stroke = next != events_.end() && std::get<CutTissue>(next->command).continues_stroke;
  if (!parted_ && !continues_stroke)
    warn("{}: events: step {}: the cut parted nothing: its blade passes beside the body as it lies then", file_,
         event.tick);
}

void Schedule::apply(World& world, const std::function<void(const Command&)>& applied) {
  const auto split = [&] {
    std::size_t sum = 0;
    for (const EditReport& edit : world.edits()) sum += edit.split;
    return sum;
  };
  for (const Event& event : due(world.ticks())) {
    const std::size_t before = split();
    if (const Status status = world.apply(event.command); !status.ok())
      throw InputError(file_, fmt::format("events: step {}", event.tick), status.message(), event_line(event));
    watch_stroke(event, split() != before);
    applied(event.command);
  }
}

}  // namespace heml
