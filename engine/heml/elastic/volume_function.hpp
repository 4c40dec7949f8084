#pragma once
// The volume term ψ(J) of unit bulk modulus, for terms that evaluate it at a mean volume ratio.
#include <heml/materials/material.hpp>
#include <heml/materials/volume.hpp>

namespace heml {

template <class Real>
VolumeDerivatives<Real> unit_volume_term(VolumeTerm term, bool continuation, Real J) {
  if (term == VolumeTerm::quadratic) return {(J - 1) * (J - 1) / 2, J - 1, 1};
  const auto of = [J](const auto& law) {
    return VolumeDerivatives<Real>{law.energy({3, 3, J}), law.first_derivatives({3, 3, J}).wJ,
                                   law.second_derivatives({3, 3, J}).wJJ};
  };
  if (term == VolumeTerm::simo_taylor)
    return continuation ? of(VolumeLaw<Real, true, true>{1}) : of(VolumeLaw<Real, false, true>{1});
  return continuation ? of(VolumeLaw<Real, true, false>{1}) : of(VolumeLaw<Real, false, false>{1});
}

/// Whether ψ is defined at J.
template <class Real>
bool volume_term_defined(VolumeTerm term, bool continuation, Real J) {
  return continuation || term == VolumeTerm::quadratic || J > min_volume_ratio<Real>;
}

}  // namespace heml
