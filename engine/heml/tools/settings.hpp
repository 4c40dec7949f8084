#pragma once
// What a scene asks for of tissue as a whole.

namespace heml {

/// Tissue meets tissue (self_contact.hpp).
struct SelfContactSettings {
  double friction = 0;  ///< Coulomb's coefficient
};

/// Tissue tears (tearing.hpp).
struct TearingSettings {
  double stretch = 2;  ///< largest principal stretch that elements bear
};

}  // namespace heml
