// The tools of a scene: those present from the start, and those that its events use.
#include <fmt/format.h>

#include <heml/scenario/explain.hpp>

namespace heml {
namespace {

template <class... Kinds>
bool is_one_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

bool begins_a_stroke(const Command& command) {
  const auto* cut = std::get_if<CutTissue>(&command);
  return cut && !cut->continues_stroke;
}

/// The commands that use a tool, those of them that start its use, and its effect on the engine.
struct ToolKind {
  const char* name;
  bool (*is_used_by)(const Command&);
  bool (*is_taken_up_by)(const Command&);
  const char* does;
};
constexpr ToolKind kinds[] = {
    {"grasp", is_one_of<Grasp, MoveTool, Release>, is_one_of<Grasp>,
     "a spring at each node in reach; explicit steps look at their limit every other step meanwhile"},
    {"probe", is_one_of<MoveProbe, WithdrawProbe>, is_one_of<MoveProbe>,
     "meets faces of the surface; explicit steps look at their limit every other step meanwhile"},
    {"pin", is_one_of<PinTissue, Unpin>, is_one_of<PinTissue>, "nodes constrained where they are"},
    {"suture", is_one_of<SutureTissue, CutSutures>, is_one_of<SutureTissue>, "a stiff link that is drawn in"},
    {"tables", is_one_of<SetTables>, is_one_of<SetTables>, "other planes from then on"},
    {"cut", is_one_of<CutTissue>, begins_a_stroke, "elements are split, and the layout of the body is rebuilt"},
    {"removal", is_one_of<RemoveElements>, is_one_of<RemoveElements>, "loops ask which elements are there"},
    {"undo", is_one_of<Undo>, is_one_of<Undo>, "the body as it was before the last cut or removal"},
};

}  // namespace

std::vector<ToolFacts> tools_of(const Scene& scene, const WorldSetup& setup) {
  std::vector<ToolFacts> tools;
  for (const Table& table : setup.tables)
    tools.push_back({"table", fmt::format("friction {:.3g}; each node of the surface is checked against its plane",
                                          table.friction)});
  if (setup.self_contact)
    tools.push_back(
        {"self-contact", fmt::format("friction {:.3g}; pairs of faces that come near each other are searched",
                                     setup.self_contact->friction)});
  if (setup.tearing)
    tools.push_back(
        {"tearing", fmt::format("faces open where elements are stretched beyond {:.3g}", setup.tearing->stretch)});
  for (const ToolKind& kind : kinds) {
    ToolFacts facts{kind.name, kind.does};
    for (const Event& event : scene.events) {
      if (!kind.is_used_by(event.command)) continue;
      facts.last = static_cast<double>(event.tick) * setup.solver.tick();
      if (!facts.first) facts.first = facts.last;
      facts.times += kind.is_taken_up_by(event.command) ? 1 : 0;
    }
    if (facts.first) tools.push_back(std::move(facts));
  }
  return tools;
}

}  // namespace heml
