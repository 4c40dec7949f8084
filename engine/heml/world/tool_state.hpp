#pragma once
// What acts on a body besides boundary conditions and loads: one state a kind, and a list of all that are there. A kind
// that is added to ToolState does not compile until everything that reads the list (drawing, readings, reports) says
// what it does with it.
#include <array>
#include <heml/math/types.hpp>
#include <heml/tools/contact_surface.hpp>
#include <optional>
#include <variant>
#include <vector>

namespace heml {

struct GraspState {
  int hand = 0;                ///< that holds
  long serial = 0;             ///< of all grasps of the world so far; the latest has the highest
  int node = -1;               ///< grasped node, mesh-file order
  double radius = 0;           ///< m, of the patch at rest
  Vec3 target = Vec3::Zero();  ///< m, where the tool is
  Vec3 grip = Vec3::Zero();    ///< m, where the grasped patch is (mass-weighted mean)
  Vec3 force = Vec3::Zero();   ///< N, of the tool on the tissue
};

struct PinState {
  int node = -1;              ///< its centre, mesh-file order
  std::vector<int> nodes;     ///< all that it constrains, mesh-file order
  Vec3 place = Vec3::Zero();  ///< m, of the centre
  Vec3 force = Vec3::Zero();  ///< N, of the pin on the tissue
};

/// What a contact surface does to the tissue. Forces of explicit methods are means over the last tick.
struct ContactState {
  Vec3 force = Vec3::Zero();   ///< N, on the tissue
  double work = 0;             ///< J, on the tissue, force times displacement: friction takes energy away
  double energy = 0;           ///< J, stored in the contact of implicit methods
  double max_penetration = 0;  ///< m, that tissue is inside
  int contact_count = 0;       ///< points of tissue in contact
};

struct TableState : ContactState {
  Table table;
};

struct ProbeState : ContactState {
  Vec3 tip = Vec3::Zero(), end = Vec3::Zero();  ///< m, of its axis
  double radius = 0;                            ///< m
};

struct SutureState {
  std::array<int, 2> nodes{};                            ///< mesh-file order
  std::array<Vec3, 2> ends{Vec3::Zero(), Vec3::Zero()};  ///< m
  Vec3 force = Vec3::Zero();                             ///< N, on its first node: along the thread
};

/// Contact of tissue with tissue.
struct SelfContactState {
  double force = 0;            ///< N, sum of the normal forces of all pairs; mean over the last tick if explicit
  double work = 0;             ///< J, of friction
  double energy = 0;           ///< J, stored in the contact of implicit methods
  double max_penetration = 0;  ///< m
  int contact_count = 0;       ///< pairs of a node and a face, or of two edges
};

using ToolState = std::variant<GraspState, PinState, TableState, ProbeState, SutureState, SelfContactState>;

/// Calls one of several functions by the kind of a tool: std::visit(ByKind{[](const PinState&) {}, …}, tool).
template <class... Functions>
struct ByKind : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
ByKind(Functions...) -> ByKind<Functions...>;

/// All of one kind, in their order.
template <class State>
std::vector<State> tools_of(const std::vector<ToolState>& tools) {
  std::vector<State> found;
  for (const ToolState& tool : tools)
    if (const State* state = std::get_if<State>(&tool)) found.push_back(*state);
  return found;
}

/// The first of one kind; null: there is none. Valid as long as the list.
template <class State>
const State* find_tool(const std::vector<ToolState>& tools) {
  for (const ToolState& tool : tools)
    if (const State* state = std::get_if<State>(&tool)) return state;
  return nullptr;
}

/// What a hand holds; null: nothing. Valid as long as the list.
inline const GraspState* find_grasp(const std::vector<ToolState>& tools, int hand) {
  for (const ToolState& tool : tools)
    if (const GraspState* grasp = std::get_if<GraspState>(&tool); grasp && grasp->hand == hand) return grasp;
  return nullptr;
}

/// Sum of the forces of all tools of one kind, N.
template <class State>
Vec3 force_of(const std::vector<ToolState>& tools) {
  Vec3 sum = Vec3::Zero();
  for (const ToolState& tool : tools)
    if (const State* state = std::get_if<State>(&tool)) sum += state->force;
  return sum;
}

}  // namespace heml
