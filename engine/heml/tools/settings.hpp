#pragma once
// Settings of a scene that concern all tissue.

namespace heml {

/// Self-contact (self_contact.hpp).
struct SelfContactSettings {
  double friction = 0;        ///< Coulomb's coefficient
  bool within_bodies = true;  ///< false: bodies bear on each other alone, none on itself
};

/// Tearing (tearing.hpp).
struct TearingSettings {
  double stretch = 2;  ///< limit of an element's largest principal stretch
};

}  // namespace heml
