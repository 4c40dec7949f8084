#pragma once
// From a material to its law as a struct.
#include <cassert>
#include <heml/materials/law_list.hpp>
#include <heml/materials/material.hpp>

namespace heml {

/// A law's struct from its parameters' values (contract order; lists one after the other).
template <class L, class Real>
L law_from(std::span<const double> values) {
  if constexpr (requires { L::from(values); }) {
    return L::from(values);
  } else {
    static_assert(sizeof(L) == sizeof(Real) * std::size(L::parameters), "a law holds its parameters and nothing else");
    assert(values.size() == std::size(L::parameters));
    L law;
    Real* member = reinterpret_cast<Real*>(&law);
    for (std::size_t i = 0; i < values.size(); ++i) member[i] = static_cast<Real>(values[i]);
    return law;
  }
}

/// Calls use(law) with the material's law as a struct of Real, continued or not: where a name becomes a type. Laws of
/// which `wanted(index in LawList)` is false are not even instantiated. Returns whether the law was found.
/// The material must be one that material_problem() has nothing against.
template <class Real, class Wanted, class Use>
bool with_law_among(const Wanted&, const Material& material, bool continuation, const Use& use) {
  const auto attempt = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) {
    if constexpr (Wanted{}(k)) {
      using Tag = std::tuple_element_t<k, LawList>;
      using Plain = typename Tag::template Law<Real, false>;
      using Continued = typename Tag::template Law<Real, true>;
      static_assert(Law<Plain, Real> && Law<Continued, Real>);
      if (material.law != Plain::name) return false;
      if (continuation)
        use(law_from<Continued, Real>(material.parameters));
      else
        use(law_from<Plain, Real>(material.parameters));
      return true;
    }
    return false;
  };
  return [&]<std::size_t... k>(std::index_sequence<k...>) {
    return (attempt(std::integral_constant<std::size_t, k>{}) || ...);
  }
  (std::make_index_sequence<std::tuple_size_v<LawList>>{});
}

/// The same among all laws, one of which it must be (mass_spring is not a law of an element).
template <class Real, class Use>
void with_law(const Material& material, bool continuation, const Use& use) {
  const auto all = [](std::size_t) { return true; };
  [[maybe_unused]] const bool found = with_law_among<Real>(all, material, continuation, use);
  assert(found);
}

}  // namespace heml
