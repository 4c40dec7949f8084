#pragma once
// Materials between JSON and data: entries of `materials`, the `material` event, the file of `heml probe`.
#include <heml/scenario/json_cursor.hpp>
#include <heml/world/setup.hpp>

namespace heml {

/// Throws InputError naming the key: unknown law or key, missing parameter, value out of range. Where a field of the
/// mesh stands for a number, 1 does until load_setup().
RegionMaterial material_from(const JsonCursor& entry);

/// Whether anything in it comes from fields of the mesh.
bool uses_fields(const Material& material);

Json material_json(const RegionMaterial& material);

}  // namespace heml
