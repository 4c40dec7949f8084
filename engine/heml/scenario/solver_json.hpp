#pragma once
// The `solver` object of a scene between JSON and data.
#include <heml/scenario/json_cursor.hpp>
#include <heml/world/setup.hpp>

namespace heml {

/// Of `threads`, and of --threads: more would only wait for each other.
constexpr int max_threads = 256;

/// The integrator a value names. Throws InputError for one that is unknown or not part of this build.
Integrator integrator_from(const JsonCursor& key);

/// Throws InputError naming the key.
SolverSettings solver_from(const JsonCursor& key);

Json solver_json(const SolverSettings& solver);

}  // namespace heml
