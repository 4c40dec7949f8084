#pragma once
// Material parameters and fibre directions from fields of the mesh.
#include <heml/world/setup.hpp>
#include <string>

namespace heml {

/// Checks every field that a material of the setup uses: it exists, and every value used is finite and valid for the
/// law. Normalises fibre directions, adds λ and μ fields computed from others (young_poisson.hpp), removes unused
/// fields, and sets each parameter that is a field to its mean weighted by volume.
/// file: of the scene, for messages. Throws InputError naming key path, field and element.
void resolve_fields(const std::string& file, WorldSetup& setup);

}  // namespace heml
