#pragma once
// Events, checkpoints and the end of a recording between JSON and data. One entry, in the lists `events` and
// `checkpoints` of a document or on a line of a recording, is one of
//
//   {"step": 12, "grasp": {"node": 3, "radius": 0.01}}      an event: a command by its key (command_table.hpp)
//   {"step": 80, "checkpoint": "0123456789abcdef", "nodes": "12ab..."}
//   {"step": 90, "end": true, "checkpoints": 12, "hash": "0123456789abcdef", "halt": "unstable at ...",
//    "halted": true}
//
// with "at": seconds instead of "step" where that is easier: it means the nearest tick.
#include <heml/scenario/scene.hpp>
#include <heml/scenario/scene_keys.hpp>

namespace heml {

inline constexpr KeyInfo script_time_keys[] = {
    {"step", form::whole(0, 1e12), "", "one of `step`, `at`", "tick at whose start it happens, from 0"},
    {"at", form::non_negative, "s", "one of `step`, `at`", "simulated time; means the nearest tick"},
};
inline constexpr KeyInfo checkpoint_keys[] = {
    {"checkpoint", scene_keys::hash, "", required, "hash of the state before the events of this step"},
    {"nodes", form::other("4 hexadecimal digits a node"), "", scene_keys::none,
     "hashes of the nodes, by which `replay --verify` names the first that differs"},
};
inline constexpr KeyInfo end_keys[] = {
    {"end", form::other("`true`"), "", required, "how far the recording went: to this step"},
    {"checkpoints", form::whole(0, 1e12), "", "not told", "how many the recording holds"},
    {"hash", scene_keys::hash, "", "not told", "hash of the state before the events of this step"},
    {"halt", form::text, "", scene_keys::none, "why the world stopped within this step"},
    {"halted", form::flag, "", "not told", "whether it did: then `halt` says why"},
};
static_assert(is_complete(script_time_keys) && is_complete(checkpoint_keys) && is_complete(end_keys));

/// What entries of a script amount to, before sorting.
struct Script {
  struct Entry {
    Event event;
    std::vector<Vec3> points;  ///< of a command about nodes that are given by their places
  };
  std::vector<Entry> entries;
  std::vector<Checkpoint> checkpoints;
  std::optional<RecordedEnd> end;
};

/// Adds one entry. tick_length: s. Throws InputError naming the key.
void read_script_entry(const JsonCursor& key, double tick_length, Script& script);

/// An event as an entry of `events`. points: places that stand in for its nodes, as in Scene::points.
Json event_json(const Event& event, const std::vector<Vec3>& points = {});

/// Hands a script to a scene, in ascending order of ticks; entries of one tick keep their order.
void install_script(Script script, Scene& scene);

}  // namespace heml
