#pragma once
// Reads and writes materials as JSON: entries of `materials`, the `material` event, the file of `heml probe`.
#include <heml/scenario/json_cursor.hpp>
#include <heml/world/setup.hpp>

namespace heml {

/// Throws InputError naming the key: unknown law or key, missing parameter, value out of range. A parameter that is a
/// field of the mesh has the value 1 until load_setup().
RegionMaterial material_from(const JsonCursor& entry);

/// The same where there is no mesh, as `heml probe` takes it: throws for fields too.
Material lone_material_from(const JsonCursor& entry);

/// Whether an entry of a law accepts a key of the table of `materials[]` (scene_keys.hpp).
bool takes_key(const LawInfo& law, std::string_view name);

/// Whether a parameter or the fibre direction is a field of the mesh.
bool uses_fields(const Material& material);

Json material_json(const RegionMaterial& material);

}  // namespace heml
