#pragma once
// Variants: the same body with another law, integrator, precision or element, for comparison runs.
#include <heml/world/setup.hpp>
#include <string>
#include <vector>

namespace heml {

/// A changed setup, and what was changed.
struct Variant {
  std::string name;  ///< as given: words joined by +, e.g. "ogden+tr_bdf2"
  bool has_law = false, has_integrator = false;
  WorldSetup setup;
};

/// Known words: names of laws, of integrators except statics, "float" and "double", "p1" and "nodal_pressure".
std::vector<std::string> variant_words();

/// Names a setup's laws and integrator, e.g. "stvk, verlet".
std::string variant_name(const WorldSetup& setup);

/// Changes a setup by words joined by +. A new law keeps the small-strain moduli (match_moduli()). Throws InputError
/// for an unknown word, and for an integrator where the setup is static.
Variant variant_of(WorldSetup setup, const std::string& words);

}  // namespace heml
