#pragma once
// The volume terms that a law may have. Plain data only: files compiled for other instruction sets include this header.

namespace heml {

/// Volume term ψ(J) of a law that has a separate one; κ is the bulk modulus at rest. `quadratic` is the default.
enum class VolumeTerm {
  quadratic,    ///< κ/2 (J−1)²
  logarithmic,  ///< κ/2 (ln J)²
  simo_taylor   ///< κ/4 (J² − 1 − 2 ln J)
};

}  // namespace heml
