#pragma once
// Numbers of a material that may differ from element to element, and the pair that makes λ and μ.
//
// A law knows λ and μ alone. Where `young` or `poisson` is a field, load_setup() adds two fields to the mesh, computed
// from the file's, and their names say how: `lambda {"young": {"field": "E"}, "poisson": 0.45}`. So a material needs
// nothing more to be written into a recording as it was read.
#include <heml/materials/material.hpp>
#include <heml/scenario/json_cursor.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace heml {

/// A number, or `{"field": name}`: a field of the mesh file.
struct Quantity {
  double value = 1;   ///< stands in until the mesh is known, where there is a field
  std::string field;  ///< empty: none
};
Quantity quantity_from(const JsonCursor& key);  ///< throws InputError naming the key
Json quantity_json(const Quantity& quantity);

struct YoungPoisson {
  Quantity young, poisson;  ///< Pa; a ratio
};

/// What is wrong with a value; empty: nothing.
std::string young_problem(double young);
std::string poisson_problem(double poisson);

/// `young` and `poisson` of an entry of `materials`. Throws InputError naming the key.
YoungPoisson young_poisson_from(const JsonCursor& entry);

/// Name of the field of `lambda` or `mu` made from the pair, and the pair behind such a name.
std::string lame_field(std::string_view parameter, const YoungPoisson& pair);
std::optional<YoungPoisson> young_poisson_behind(std::string_view field);

}  // namespace heml
