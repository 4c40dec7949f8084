// The tools of a scene: those present from the start, and those that its events use.
#include <fmt/format.h>

#include <heml/scenario/command_table.hpp>
#include <heml/scenario/explain.hpp>

namespace heml {
std::vector<ToolFacts> tools_of(const Scene& scene, const WorldSetup& setup) {
  std::vector<ToolFacts> tools;
  for (const Table& table : setup.tables)
    tools.push_back({"table", fmt::format("friction {:.3g}; each node of the surface is checked against its plane",
                                          table.friction)});
  if (setup.self_contact)
    tools.push_back(
        {"self-contact",
         fmt::format("friction {:.3g}; pairs of faces{} that come near each other are searched",
                     setup.self_contact->friction, setup.self_contact->within_bodies ? "" : " of different bodies")});
  if (setup.tearing)
    tools.push_back(
        {"tearing", fmt::format("faces open where elements are stretched beyond {:.3g}", setup.tearing->stretch)});
  for (const ToolInfo& tool : tool_table()) {
    ToolFacts facts{std::string(tool.name), std::string(tool.does)};
    for (const Event& event : scene.events) {
      const CommandInfo& command = info_of(event.command);
      if (command.tool != tool.tool) continue;
      facts.last = static_cast<double>(event.tick) * setup.solver.tick();
      if (!facts.first) facts.first = facts.last;
      facts.times += command.takes_up(event.command) ? 1 : 0;
    }
    if (facts.first) tools.push_back(std::move(facts));
  }
  return tools;
}

}  // namespace heml
