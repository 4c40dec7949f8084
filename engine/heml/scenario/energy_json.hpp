#pragma once
// Laws by expression in JSON: {"law": "energy", "expression": "C1*(I1b-3) + ...", "parameters": {"C1": 1500, ...}}.
#include <heml/scenario/json_cursor.hpp>
#include <heml/world/setup.hpp>

namespace heml {

/// Reads law and parameters of an entry whose law is "energy". Throws InputError with the column in the expression.
void read_energy(const JsonCursor& entry, Material& material);

/// Warns of stress at rest and of a shear modulus at rest that is not positive.
void warn_energy(const JsonCursor& entry, const Material& material);

/// Why the world cannot run a material by expression with these settings; empty if it can, or is of another law.
std::string energy_setup_problem(const Material& material, bool continuation);

/// The keys `law`, `expression` and `parameters`.
Json energy_json(const Material& material);

}  // namespace heml
