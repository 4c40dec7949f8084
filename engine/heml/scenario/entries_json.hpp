#pragma once
// Entries of `regions`, `boundary`, `loads`, `tables`, `self_contact`, `tearing` and `outputs.markers`, and the
// selections in them and in events, between JSON and data.
#include <heml/scenario/json_cursor.hpp>
#include <heml/scenario/key_table.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// Throw InputError naming the key.
BoundaryEntry boundary_from(const JsonCursor& key);
LoadEntry load_from(const JsonCursor& key);
MarkerEntry marker_from(const JsonCursor& key);
/// keys: of the entry, those of `regions[]` and more.
RegionTag region_tag_from(const JsonCursor& key, std::span<const KeyInfo> keys);

std::vector<Table> tables_from(const JsonCursor& key);
/// true, {"friction": 0.3}, or false: none.
std::optional<SelfContactSettings> self_contact_from(const JsonCursor& key);
/// {"stretch": 1.8}.
TearingSettings tearing_from(const JsonCursor& key);

Json boundary_json(const BoundaryEntry& entry);
Json load_json(const LoadEntry& entry);
Json region_tag_json(const RegionTag& tag);
Json marker_json(const MarkerEntry& entry);
Json tables_json(const std::vector<Table>& tables);
Json tearing_json(const TearingSettings& settings);
Json self_contact_json(const SelfContactSettings& settings);

/// A list of numbers from 0, one or more, as it stands. what: "node" or "element", for messages.
std::vector<int> numbers_from(const JsonCursor& key, const char* what);

/// A list of regions, ascending, each once.
std::vector<int> regions_from(const JsonCursor& key);

/// {"tets": [3, 4]}, {"region": 2}, {"box": [[..], [..]]} or {"sphere": [[x, y, z], r]}. Throws likewise.
ElementSelection elements_from(const JsonCursor& key);
Json elements_json(const ElementSelection& which);

}  // namespace heml
