#pragma once
// What `heml explain --json` prints: one object, whose keys stay (SI units; times in s but for "milliseconds").
#include <heml/scenario/explain.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/measure_features.hpp>
#include <optional>

namespace heml {

Json explanation_json(const Explanation& explained, const std::optional<Measurement>& measured);

}  // namespace heml
