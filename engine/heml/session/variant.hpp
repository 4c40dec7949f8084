#pragma once
// The same body computed another way, to be looked at beside it.
#include <heml/world/setup.hpp>
#include <string>
#include <vector>

namespace heml {

/// What a variant changes of a setup.
struct Variant {
  std::string name;  ///< as given: words joined by +, e.g. "ogden+tr_bdf2"
  bool has_law = false, has_integrator = false;
  WorldSetup setup;
};

/// The words there are: laws (with the moduli at rest that the setup has, match_moduli()), integrators that move,
/// "float" and "double", "p1" and "nodal_pressure".
std::vector<std::string> variant_words();

/// In which way a setup is computed, in such words: its laws and its integrator.
std::string variant_name(const WorldSetup& setup);

/// The setup as words joined by + say. Throws InputError for another word, and for what such a body cannot be.
Variant variant_of(WorldSetup setup, const std::string& words);

}  // namespace heml
