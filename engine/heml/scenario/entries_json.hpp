#pragma once
// Entries of `boundary`, `loads`, `tables`, `self_contact`, `tearing` and `outputs.markers`, and the selections in them
// and in events, between JSON and data.
#include <heml/scenario/key.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// Throw InputError naming the key.
BoundaryEntry boundary_from(const Key& key);
LoadEntry load_from(const Key& key);
MarkerEntry marker_from(const Key& key);

std::vector<Table> tables_from(const Key& key);
/// true, {"friction": 0.3}, or false: none.
std::optional<SelfContactSettings> self_contact_from(const Key& key);
/// {"stretch": 1.8}.
TearingSettings tearing_from(const Key& key);

Json boundary_json(const BoundaryEntry& entry);
Json load_json(const LoadEntry& entry);
Json marker_json(const MarkerEntry& entry);
Json tables_json(const std::vector<Table>& tables);
Json tearing_json(const TearingSettings& settings);
Json self_contact_json(const SelfContactSettings& settings);

/// {"tets": [3, 4]}, {"region": 2}, {"box": [[..], [..]]} or {"sphere": [[x, y, z], r]}. Throws likewise.
ElementSelection elements_from(const Key& key);
Json elements_json(const ElementSelection& which);

}  // namespace heml
