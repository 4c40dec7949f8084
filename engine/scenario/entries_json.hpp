#pragma once
// Entries of `boundary` and `loads`, and the selections in them, between JSON and data.
#include <heml/scenario/key.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// Throw InputError naming the key.
BoundaryEntry boundary_from(const Key& key);
LoadEntry load_from(const Key& key);

Json boundary_json(const BoundaryEntry& entry);
Json load_json(const LoadEntry& entry);

}  // namespace heml
