#pragma once
// What a person or a script can do to a running world: one struct an action. Commands enter at the start of a tick, at
// one door (World::apply), where sessions record them; a replay sends the same commands at the same ticks.
#include <array>
#include <heml/materials/material.hpp>
#include <heml/math/types.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/sweep.hpp>
#include <heml/tools/contact_surface.hpp>
#include <heml/world/setup.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace heml {

/// A body is held by at most so many hands at once. Hand 0 is a person's at the mouse, the last ones are that person's
/// at other devices; those between are second hands of scripts, and clamps that were left in place.
inline constexpr int max_hands = 16, first_device_hand = 14;

/// Whether a person moves a hand: it is drawn as forceps, and letting go ends its grasp.
constexpr bool is_persons_hand(int hand) { return hand == 0 || hand >= first_device_hand; }

/// Takes hold of the surface nodes within `radius` of a node, by a critically damped spring to a tool that starts where
/// the node is now. Replaces what this hand held before. What a hand holds already by this node and radius is handed
/// over as it is, with its tool and tension: so a clamp is left, and taken up again.
struct Grasp {
  int node = 0;       ///< mesh-file order
  double radius = 0;  ///< m, rest shape; 0: that node alone
  int hand = 0;       ///< 0 to max_hands - 1
  std::vector<int> hidden = {};  ///< regions, ascending: the surface is that of the others
};
/// Moves the tool of a grasp.
struct MoveTool {
  Vec3 target = Vec3::Zero();  ///< m
  int hand = 0;
};
/// Lets go.
struct Release {
  std::optional<int> hand = 0;  ///< none: all hands
};
/// Holds the surface nodes within `radius` of a node exactly where they are, beside all that is pinned already.
struct PinTissue {
  int node = 0;       ///< mesh-file order
  double radius = 0;  ///< m, rest shape; 0: that node alone
  std::vector<int> hidden = {};  ///< regions, ascending: the surface is that of the others
  std::vector<int> nodes = {};   ///< mesh-file order: these, inner ones too, in place of a patch about `node`
};
/// Releases the pin that holds a node.
struct Unpin {
  std::optional<int> node;      ///< mesh-file order; none: all pins
  std::vector<int> nodes = {};  ///< mesh-file order: pins let go of these, and hold the rest of theirs
};
/// The tables that there are from now on: these.
struct SetTables {
  std::vector<Table> tables;
};
/// The nodes that are held or moved by the scene from now on: these. Each goes to its place at once. Ramps begin at the
/// start of simulated time.
struct SetBoundary {
  std::vector<Boundary> entries;
};
/// The loads that there are from now on: these, ramped likewise.
struct SetLoads {
  std::vector<Load> entries;
};
/// Sets the probe on its way: from where it is, or, where there is none, from the path's first place.
struct MoveProbe {
  double radius = 0;          ///< m
  Vec3 shaft = Vec3::Zero();  ///< m, from the tip's centre to the other end of a capsule's axis; 0: a ball
  double friction = 0;        ///< Coulomb's coefficient
  std::vector<Vec3> path;     ///< m, places of the tip's centre, one or more
  double speed = 1;           ///< m/s
};
/// Takes the probe away.
struct WithdrawProbe {};
/// Ties two nodes by a stiff link that is drawn in from the distance between them now.
struct SutureTissue {
  std::array<int, 2> nodes{};  ///< mesh-file order
  double length = 0;           ///< m, in the end
  double ramp_time = 0.5;      ///< s, of drawing in
};
/// Takes out all sutures.
struct CutSutures {};
/// Switches the material of a region (none: of the default entry, or the only one). Positions and velocities are kept.
struct SetMaterial {
  std::optional<int> region;
  Material material;
};
/// Contracts or relaxes the muscle of a region (none: of the default entry), whose material must have a fibre. Internal
/// state is kept.
struct SetActiveStress {
  std::optional<int> region;
  double stress = 0;  ///< Ta, Pa
};
/// Makes elements a region with a material of its own. Of a region that has none yet, without `material`: a copy of
/// what its first element is made of.
struct TagRegion {
  RegionTag tag;
  std::optional<Material> material;
};
struct SetDamping {
  double damping = 0;  ///< 1/s
};
struct SetGravity {
  Vec3 gravity = Vec3::Zero();  ///< m/s²
};
struct SetIntegrator {
  Integrator integrator = Integrator::verlet;
};
/// How many iterations each stage of an implicit step may take from now on. Sessions send it where a scene's budget is
/// in milliseconds, by what they measure.
struct SetBudget {
  int iterations = 1;
};
/// How many ticks a simulated second has from now on. The body goes on from where it is. Replaces a given step.
struct SetRate {
  double rate = 1000;  ///< Hz
};
/// What an explicit step costs, for "auto" to choose by. Sessions send what they measure.
struct SetStepCost {
  double nanoseconds = 40;  ///< an element
};
/// Takes elements out of the body, with their mass, their energy and their share of loads. The rest goes on from where
/// it is, as fast as it is, and remembers what it did. Nodes that lose all elements stay where they are.
struct RemoveElements {
  ElementSelection which;  ///< of those that are there, mesh-file order
};
/// Cuts the tissue along what a blade sweeps. Elements are split there and come apart; nothing is lost, nothing moves
/// but by its own tension. A blade that meets nothing does nothing.
struct CutTissue {
  Sweep sweep;                    ///< where the blade is, m, in space as the tissue lies now
  bool continues_stroke = false;  ///< with the last cut: one stroke, and one edit to undo
};
/// An electrode goes along a sweep, whose blades may be points, and one alone: it cuts as a blade does and coagulates
/// the tissue about it, which shrinks at rest (mesh/burn.hpp).
struct CauterizeTissue {
  Sweep sweep;                    ///< where the electrode is, m, in space as the tissue lies now
  Heat heat;
  bool continues_stroke = false;  ///< with the last one: one stroke, and one edit to undo
};
/// Takes back the last removal or stroke: elements and positions are what they were before it, and so is what they
/// remember; what happened since is forgotten, time goes on. A stroke that parted nothing is none. What has been
/// grasped ever since stays grasped. With nothing but edits since, the body goes on as if there had been none, to the
/// bit.
struct Undo {};
/// Takes back the last action of a person, or brings back the last one that was taken back: the whole state, time
/// included, is what it was before the action, or when it was taken back; ticks go on counting. An action is a grasp, a
/// probe's way, a stroke, a removal, a pin, a suture, a setting or a reset (is_action).
struct StepHistory {
  int by = -1;  ///< −1: back, 1: forth
};
/// Preconditions implicit steps from now on with what is made for the body as it is now, after elements were removed.
/// Sessions send it when that has arrived from another thread (World::preconditioner_build); where none has, it is made
/// there and then, to the same bits.
struct AdoptPreconditioner {};
/// Back to the initial state at time 0, with all elements there again; ticks go on counting. Materials, damping and the
/// like stay as they are.
struct Reset {
  bool scene = false;  ///< all else of the scene too: materials, regions, boundary, loads, gravity, method, tables
};

using Command = std::variant<Grasp, MoveTool, Release, PinTissue, Unpin, SetTables, SetBoundary, SetLoads, MoveProbe,
                             WithdrawProbe, SutureTissue, CutSutures, SetMaterial, SetActiveStress, TagRegion,
                             SetDamping, SetGravity, SetIntegrator, SetBudget, SetRate, SetStepCost, RemoveElements,
                             CutTissue, CauterizeTissue, Undo, StepHistory, AdoptPreconditioner, Reset>;

/// Whether a kind of command changes the elements that there are, or takes such a change back.
template <class C>
inline constexpr bool is_edit_command = std::is_same_v<C, RemoveElements> || std::is_same_v<C, CutTissue> ||
                                        std::is_same_v<C, CauterizeTissue> || std::is_same_v<C, Undo>;

inline bool is_edit(const Command& command) {
  return std::visit([]<class C>(const C&) { return is_edit_command<C>; }, command);
}

/// Of a part of a stroke, whether it goes on with the part before; none: it is no part of one.
inline std::optional<bool> continues_stroke(const Command& command) {
  if (const auto* cut = std::get_if<CutTissue>(&command)) return cut->continues_stroke;
  if (const auto* burn = std::get_if<CauterizeTissue>(&command)) return burn->continues_stroke;
  return std::nullopt;
}

/// Whether a command is an action of a person that StepHistory takes back. The rest goes on with an action, or is a
/// choice made by the clock. A person's hand letting go ends its grasp; that another does, which may be a clamp, is an
/// action.
inline bool is_action(const Command& command) {
  if (const auto* release = std::get_if<Release>(&command)) return !release->hand || !is_persons_hand(*release->hand);
  return std::visit(
      []<class C>(const C&) {
        return !(std::is_same_v<C, MoveTool> || std::is_same_v<C, SetBudget> ||
                 std::is_same_v<C, SetStepCost> || std::is_same_v<C, StepHistory> ||
                 std::is_same_v<C, AdoptPreconditioner>);
      },
      command);
}

/// A command and the tick at whose start it takes effect (the first tick is 0).
struct Event {
  long tick = 0;
  Command command;
};

}  // namespace heml
