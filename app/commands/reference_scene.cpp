// The reference page of scenes and recordings, from the tables that they are read by.
#include <fmt/format.h>

#include <app/commands/markdown.hpp>
#include <app/commands/reference.hpp>
#include <heml/scenario/event_json.hpp>
#include <heml/scenario/scene_reference.hpp>
#include <set>

namespace heml {
namespace {

constexpr const char* introduction =
    R"(# Scene format

Written by `heml reference` from the tables that scenes are read by. A scene is a JSON file (`.json`). A recording is a scene with what was done
in it, in JSON Lines (`.jsonl`); both forms are read everywhere. All values are SI; angles are in degrees, rotations right-handed. Paths are
relative to the scene's file. A key twice or a key that is not listed here is an error, which names the nearest known key.

Contents: [example](#example), [keys](#keys), [how a scene is run](#how-a-scene-is-run), [events](#events), [recordings](#recordings).
Laws and presets: [laws](../../engine/docs/laws.md). Commands: [commands](commands.md).

## Example

```json
{
  "schema_version": 1,
  "name": "beam",
  "mesh": { "box": { "size": [0.1, 0.02, 0.02], "cells": [10, 2, 2] } },
  "materials": [ { "law": "neo_hookean", "young": 1e4, "poisson": 0.45, "density": 1000, "viscosity": 0.5 } ],
  "boundary": [ { "box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": true } ],
  "loads": [ { "box": [[0.0999, -1, -1], [1, 1, 1]], "traction": [0, -20, 0], "over": 0.1 } ],
  "tables": [ { "point": [0, -0.05, 0], "normal": [0, 1, 0], "friction": 0.3 } ],
  "gravity": [0, -9.81, 0],
  "solver": { "integrator": "verlet", "duration": 0.3, "damping": 2 },
  "outputs": { "times": [0.15], "vtu": true, "history": true,
               "markers": [ { "name": "tip", "box": [[0.0999, -1, -1], [1, 1, 1]] } ] },
  "view": { "azimuth": 30, "elevation": 15, "field": "stretch" },
  "events": [ { "at": 0.1, "grasp": { "point": [0.1, 0.02, 0.02], "radius": 0.01 } },
              { "at": 0.12, "move": [0.1, 0.03, 0.02] },
              { "at": 0.2, "release": true } ]
}
```

## Keys

The default is what holds where a key is not given.

)";

constexpr const char* how_it_is_run =
    R"(## How a scene is run

- **Selections** (`nodes`, `box`, `sphere`) are made at rest, after the mesh is scaled, rotated and moved. A selection of nothing is an error.
- **Mass** is lumped: a quarter of density × volume of each tetrahedron on each of its nodes.
- **Tolerance**: the Euclidean norm of the residual over free components, divided by the larger of the norms of external nodal forces and of
  reactions; absolute, 1e-12 N, where both vanish.
- **`static`**: boundary motions, loads and gravity grow together from 0 to 1 in increments that the solver chooses. `over` and `duration` do
  not matter. There is no `tearing` and no `plasticity`, which depend on the way taken.
- **`nodal_pressure`** takes laws with a separate volume term, all with the same `volume_term`; `p2_pressure` any of each.
- **Implicit steps that do not converge** are halved, then replaced by explicit substeps, then end with their best iterate, counted in
  `report.json` (`explicit_rescues`, `unconverged_steps`). A given `step` is obeyed: the run ends there with exit code 4, as `static` does.
- **The end of a law's range** (ln J at J ≤ 0, overflow) ends the run at the last valid state with exit code 4, unless `continuation` is on.

)";

constexpr const char* about_events =
    R"(## Events

An entry of `events` has a time and one action. Entries of one tick happen in the order in which they stand. An event that the world refuses
ends the run with exit code 3.

Times of events, and of files of `outputs`, are those since the start: `history` and `reset` take the state back, but not that time. `over` of
`boundary` and `loads` counts from the event; an entry that stands there as before, on all its nodes or on some, goes on with its ramp. A `reset`
begins all ramps anew.

)";

constexpr const char* about_recordings =
    R"(## Recordings

`heml run --record FILE` writes a line for each thing as it happens: the scene with `recorded`, then events, checkpoints and the end, each with
its `step`. A crash loses the line that was being written and no other; such a recording has no end, and `replay --verify` asks for
`--partial`. Whatever a clock has chosen (`budget`, `step_cost`, `factor`) is recorded as an event, so a replay needs no clock.

```
{"schema_version": 1, "mesh": {...}, ..., "recorded": {"nodes": 99, "tets": 200, "mesh": "0123456789abcdef", "format": 2, ...}}
{"step": 0, "checkpoint": "0123456789abcdef", "nodes": "12ab..."}
{"step": 12, "grasp": {"node": 3, "radius": 0.01}}
{"step": 90, "end": true, "checkpoints": 1, "hash": "0123456789abcdef"}
```

In a single JSON document checkpoints and the end may stand in the list `checkpoints`. `replay --verify` compares every checkpoint and the
hashes of its nodes, the end's hash, the number of checkpoints, and the message of a halt. In JSON Lines the end is the last line.

)";

/// The section about an object that is the value of a key; nullptr where there is none.
const ObjectInfo* object_of(const ObjectInfo& parent, std::string_view name) {
  const std::string path = fmt::format("{}{}{}", parent.path, parent.path.empty() ? "" : ".", name);
  for (const ObjectInfo& object : scene_objects)
    if (object.path == path || object.path == path + "[]") return &object;
  for (const ObjectInfo& object : scene_objects)
    if (object.path.ends_with(fmt::format(".{}", name))) return &object;
  return nullptr;
}

std::string value_text(const ObjectInfo& parent, const KeyInfo& key) {
  std::string text = form_text(key.form);
  const ObjectInfo* object = object_of(parent, key.name);
  const std::size_t word = text.find("object");
  if (!object || word == text.npos) return text;
  const std::size_t length = text.substr(word).starts_with("objects") ? 7 : 6;
  return text.replace(word, length, fmt::format("[{}](#{})", text.substr(word, length), anchor(object->path)));
}

template <class Value, class Usual>
std::string key_table(std::span<const KeyInfo> keys, const Value& value, const Usual& usual) {
  MarkdownTable table({"key", "value", "unit", "default", "meaning"});
  for (const KeyInfo& key : keys)
    table.add({fmt::format("`{}`", key.name), value(key), std::string(key.unit), usual(key), std::string(key.meaning)});
  return table.text();
}

std::string objects_text() {
  std::string text;
  for (const ObjectInfo& object : scene_objects)
    text += fmt::format("### {}\n\n{}\n\n", object.path.empty() ? "scene" : object.path, object.meaning) +
            key_table(
                object.keys, [&](const KeyInfo& key) { return value_text(object, key); },
                [&](const KeyInfo& key) { return usual_text(object, key); });
  return text;
}

std::string plain_table(std::span<const KeyInfo> keys) {
  return key_table(
      keys, [](const KeyInfo& key) { return form_text(key.form); },
      [](const KeyInfo& key) { return std::string(key.usual); });
}

std::string events_text() {
  MarkdownTable events({"event", "value", "unit", "does"});
  for (const CommandInfo& command : command_table())
    events.add({fmt::format("`{{\"{}\": {}}}`", command.key, command.example), form_text(command.form),
                std::string(command.unit),
                fmt::format("{}{}", command.meaning, command.is_edit ? " (an edit of the mesh)" : "")});
  std::string text = about_events + plain_table(script_time_keys) + events.text();
  std::set<const KeyInfo*> told;  // commands may share a table
  for (const CommandInfo& command : command_table()) {
    if (command.keys.empty() || !told.insert(command.keys.data()).second) continue;
    std::string names;
    for (const CommandInfo& other : command_table())
      if (other.keys.data() == command.keys.data()) names += (names.empty() ? "" : ", ") + std::string(other.key);
    text += fmt::format("### event: {}\n\n", names) + key_table(
                                                          command.keys,
                                                          [](const KeyInfo& key) { return form_text(key.form); },
                                                          [&](const KeyInfo& key) { return usual_text(command, key); });
  }
  return text;
}

}  // namespace

std::string scene_page() {
  std::string text = introduction + objects_text() + how_it_is_run + events_text() + about_recordings;
  text += "A checkpoint:\n\n" + plain_table(checkpoint_keys) + "The end:\n\n" + plain_table(end_keys);
  text.pop_back();  // no empty line at the end
  return text;
}

}  // namespace heml
