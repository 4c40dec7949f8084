#pragma once
// The parts of the module, each in the file of its name.
#include <nanobind/nanobind.h>

#include <app/python/live_world.hpp>

namespace heml::python {

void bind_scene(nanobind::module_& module);
void bind_snapshot(nanobind::module_& module);
void bind_world(nanobind::module_& module);
void bind_solve(nanobind::module_& module);
void bind_batch(nanobind::module_& module);
void bind_render(nanobind::module_& module);

/// A heml.Scene, or a path or a dict, which becomes one. Throws InputError.
Scene scene_from(nanobind::handle given);

/// How long the engine computes before handlers of signals may run.
constexpr std::chrono::milliseconds signal_interval{50};

nanobind::object report_object(World& world, const SolveFacts& facts);

/// A vector of every node, (V, 3), in `out` or a new array.
nanobind::object node_vectors(const World& world, NodeVector which, nanobind::object out);

}  // namespace heml::python
