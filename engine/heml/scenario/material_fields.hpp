#pragma once
// What the materials of a scene read from fields of the mesh.
#include <heml/world/setup.hpp>
#include <string>

namespace heml {

/// Checks every field that a material of the setup reads: it is there, and every value used is finite and right for the
/// law. Makes directions of fibres unit vectors, adds the fields that are made from others (young_poisson.hpp), forgets
/// those that nothing reads, and gives each parameter that is a field its mean, weighted by volume.
/// file: of the scene, for messages. Throws InputError naming key path, field and element.
void resolve_fields(const std::string& file, WorldSetup& setup);

}  // namespace heml
