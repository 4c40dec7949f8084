#pragma once
// Conversion of a material to the struct of its law.
#include <cassert>
#include <heml/materials/law_list.hpp>
#include <heml/materials/material.hpp>

namespace heml {

/// The law with these parameter values, in the order of LawInfo::parameters (lists one after the other).
template <class L, class Real>
L law_from(std::span<const double> values) {
  if constexpr (requires { L::from(values); }) {
    return L::from(values);
  } else {
    static_assert(sizeof(L) == sizeof(Real) * std::size(L::parameters), "a law holds its parameters and nothing else");
    assert(values.size() == std::size(L::parameters));
    L law{};
    for (std::size_t i = 0; i < values.size(); ++i) law.*L::parameters[i].member = static_cast<Real>(values[i]);
    return law;
  }
}

/// Calls use(law) with the material's law as a struct of Real, continued or not. Requires that material_problem()
/// returns nothing and that the law is a continuum (LawInfo::is_continuum).
template <class Real, class Use>
void with_law(const Material& material, bool continuation, const Use& use) {
  const std::size_t index = law_index(material.law);
  assert(index < law_count);
  visit_law(index, continuation, [&]<class Tag, bool continued>(Tag, std::bool_constant<continued>) {
    using L = typename Tag::template Law<Real, continued>;
    static_assert(Law<L, Real> && DescribedLaw<L>);
    use(law_from<L, Real>(material.parameters));
  });
}

}  // namespace heml
