#pragma once
// The one list of laws. Adding a law is its header and a line in LawList.
#include <cassert>
#include <heml/materials/material.hpp>
#include <heml/materials/neo_hookean.hpp>
#include <heml/materials/stvk.hpp>
#include <tuple>

namespace heml {

/// Carries a law's template, so that a list can hold it for every scalar and both continuations.
template <template <class, bool> class L>
struct LawTag {
  template <class Real, bool continued>
  using Law = L<Real, continued>;
};

using LawList = std::tuple<LawTag<NeoHookean>, LawTag<StVK>>;

namespace detail {
template <class Real, class L, class Use>
void use_law(const Material& material, const Use& use) {
  static_assert(Law<L, Real>);
  assert(material.parameters.size() == std::size(L::parameters));
  L law;
  static_assert(sizeof(L) == sizeof(Real) * std::size(L::parameters), "a law holds its parameters and nothing else");
  Real* member = reinterpret_cast<Real*>(&law);
  for (std::size_t i = 0; i < material.parameters.size(); ++i) member[i] = static_cast<Real>(material.parameters[i]);
  use(law);
}
}  // namespace detail

/// Calls use(law) with the material's law as a struct of Real, continued or not: the one place where a name becomes a
/// type. The material must be one that material_problem() has nothing against.
template <class Real, class Use>
void with_law(const Material& material, bool continuation, const Use& use) {
  const auto attempt = [&]<class Tag>(Tag) {
    if (material.law != Tag::template Law<Real, false>::name) return false;
    if (continuation)
      detail::use_law<Real, typename Tag::template Law<Real, true>>(material, use);
    else
      detail::use_law<Real, typename Tag::template Law<Real, false>>(material, use);
    return true;
  };
  [[maybe_unused]] const bool found = std::apply([&](auto... tag) { return (attempt(tag) || ...); }, LawList{});
  assert(found);
}

}  // namespace heml
