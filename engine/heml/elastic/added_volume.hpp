#pragma once
// Volume terms beside a law in the kernels of fans and of points, on packs.
#include <heml/materials/volume.hpp>
#include <heml/materials/volume_term.hpp>

namespace heml {

/// wJ of a volume term with κ = 1; `valid` loses the lanes in which it is not defined.
template <class P>
[[gnu::always_inline]] inline P added_volume_derivative(VolumeTerm volume, bool is_continued, P J, Mask<P>& valid) {
  const auto of = [&](const auto& law) {
    const Invariants<P> at{P(3), P(3), J};
    valid = valid && law.valid(at);
    return law.first_derivatives(at).wJ;
  };
  if (volume == VolumeTerm::quadratic) return J - P(1);
  if (volume == VolumeTerm::logarithmic)
    return is_continued ? of(VolumeLaw<P, true, false>{P(1)}) : of(VolumeLaw<P, false, false>{P(1)});
  return is_continued ? of(VolumeLaw<P, true, true>{P(1)}) : of(VolumeLaw<P, false, true>{P(1)});
}

}  // namespace heml
