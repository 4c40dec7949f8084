#pragma once
// Numbers of a scene that its equilibrium depends on, by path: "materials[0].young", "loads[1].force[2]", "gravity[1]",
// "mesh.scale".
#include <heml/scenario/json_text.hpp>
#include <string>

namespace heml {

/// The number at a path; 1 for a mesh.scale that is not given. Throws InputError.
double number_at(const Json& scene, const std::string& path);

/// Sets a number that number_at() finds.
void set_number(Json& scene, const std::string& path, double value);

/// Where a path names `young` or `poisson` of a material that has `lambda` and `mu`, or the reverse, gives the material
/// the moduli of the path. Throws InputError.
void name_moduli(Json& scene, const std::string& path);

}  // namespace heml
