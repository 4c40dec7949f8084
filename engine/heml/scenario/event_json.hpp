#pragma once
// Events and checkpoints between JSON and data. One entry, in the lists `events` and `checkpoints` of a document or on
// a line of a recording, is one of
//
//   {"step": 12, "grasp": {"node": 3, "radius": 0.01}}      take hold; or "point": [x, y, z], for the surface
//                                                         node nearest to it at rest
//   {"step": 13, "move": [0.1, 0, 0]}                       the tool
//   {"step": 40, "release": true}
//   {"step": 41, "pin": {"node": 3, "radius": 0.01}}        hold where it is; node and point as in grasp
//   {"step": 45, "release": {"node": 3}}                    the pin that holds the node; or "pins": all
//   {"step": 46, "tables": [{"point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0.3}]}   from now on, these
//   {"step": 47, "probe": {"radius": 0.004, "shaft": [0, 0.1, 0], "friction": 0.2, "path": [[0, 0.1, 0], …],
//                          "speed": 0.1}}                 the tip goes on from where it is; "release": "probe"
//   {"step": 48, "suture": {"nodes": [3, 8], "length": 0, "over": 0.5}}    drawn in to a length, m, over s; or
//   "points":
//                                                         [[x, y, z], [x, y, z]]; "release": "sutures"
//   {"step": 50, "material": {"region": 2, "law": ...}}     as an entry of `materials`
//   {"step": 60, "damping": 2}   {"step": 60, "gravity": [0, -9.81, 0]}   {"step": 60, "integrator": "verlet"}
//   {"step": 65, "remove": {"tets": [3, 4]}}               elements by number; or "region": 2; or "box": [[..], [..]]
//   or
//                                                         "sphere": [[x, y, z], r], of centroids at rest
//   {"step": 66, "cut": {"sweep": [[tip, end], [tip, end], …]}}   where the blade is, moment after moment; "goes_on":
//                                                         true: of one stroke with the cut before
//   {"step": 67, "undo": true}                             the last removal or stroke
//   {"step": 70, "reset": true}
//   {"step": 80, "checkpoint": "0123456789abcdef", "nodes": "12ab..."}    state hash; 4 hexadecimal digits a node
//   {"step": 90, "end": true, "checkpoints": 12, "hash": "0123456789abcdef", "halt": "unstable at …"}
//                                                         how far a recording went, how many checkpoints it holds, the
//                                                         state before the events of this step, and why it stopped
//                                                         there
//
// with "at": seconds instead of "step" where that is easier: it means the nearest tick.
#include <heml/scenario/json_cursor.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

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

/// Hands a script to a scene, in ascending order of ticks; entries of one tick keep their order.
void install_script(Script script, Scene& scene);

}  // namespace heml
