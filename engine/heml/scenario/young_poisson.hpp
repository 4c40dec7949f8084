#pragma once
// Parameters that may be fields of the mesh, and conversion of Young's modulus and Poisson's ratio to λ and μ.
//
// Laws have λ and μ as parameters. Where `young` or `poisson` is a field, load_setup() adds two computed fields to the
// mesh, whose names encode the source: `lambda {"young": {"field": "E"}, "poisson": 0.45}`. From the names a material
// is written into a recording as it was read.
#include <heml/materials/material.hpp>
#include <heml/scenario/json_cursor.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace heml {

/// A number, or a field of the mesh file, `{"field": name}`.
struct Quantity {
  double value = 1;   ///< placeholder where there is a field
  std::string field;  ///< empty: none
};
Quantity quantity_from(const JsonCursor& key);  ///< throws InputError naming the key
Json quantity_json(const Quantity& quantity);

struct YoungPoisson {
  Quantity young, poisson;  ///< Pa; dimensionless
};

/// Why a value is invalid; empty: it is valid.
std::string young_problem(double young);
std::string poisson_problem(double poisson);

/// Reads `young` and `poisson` of an entry of `materials`. Throws InputError naming the key.
YoungPoisson young_poisson_from(const JsonCursor& entry);

/// Name of the computed field of `lambda` or `mu`, and the pair encoded in such a name (empty for another name).
std::string lame_field(std::string_view parameter, const YoungPoisson& pair);
std::optional<YoungPoisson> young_poisson_behind(std::string_view field);

}  // namespace heml
