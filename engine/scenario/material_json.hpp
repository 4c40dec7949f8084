#pragma once
// Materials between JSON and data: entries of `materials`, the `material` event, the file of `heml probe`.
#include <heml/scenario/key.hpp>
#include <heml/world/setup.hpp>

namespace heml {

/// Throws InputError naming the key: unknown law or key, missing parameter, value out of range.
RegionMaterial material_from(const Key& entry);

Json material_json(const RegionMaterial& material);

}  // namespace heml
