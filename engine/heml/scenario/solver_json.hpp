#pragma once
// The `solver` object of a scene between JSON and data.
#include <heml/scenario/json_cursor.hpp>
#include <heml/world/setup.hpp>
#include <span>
#include <string_view>

namespace heml {

/// Of `threads`, and of --threads: more would only wait for each other.
constexpr int max_threads = 256;

/// In the order of Integrator.
std::span<const std::string_view> integrator_names();

inline constexpr std::string_view precision_names[] = {"double", "float"};
inline constexpr std::string_view element_names[] = {"p1", "nodal_pressure", "p2", "p2_pressure"};

/// The integrator a value names. Throws InputError for one that is unknown.
Integrator integrator_from(const JsonCursor& key);

/// Ticks a second, Hz, where a scene gives no rate.
double default_rate(Integrator integrator);

/// Throws InputError naming the key.
SolverSettings solver_from(const JsonCursor& key);

Json solver_json(const SolverSettings& solver);

}  // namespace heml
