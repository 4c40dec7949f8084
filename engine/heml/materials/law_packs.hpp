#pragma once
// A law of numbers as one of packs of numbers: the same parameters in every lane.
#include <heml/math/pack.hpp>

namespace heml {

/// The same law of another scalar.
template <class L, class P>
struct Rebound;
template <template <class, bool> class L, class Real, bool continued, class P>
struct Rebound<L<Real, continued>, P> {
  using Law = L<P, continued>;
};
template <template <class, bool, bool> class L, class Real, bool continued, bool other, class P>
struct Rebound<L<Real, continued, other>, P> {
  using Law = L<P, continued, other>;
};

/// A law's struct of packs from that of numbers.
template <class PackLaw, class P, class L>
[[gnu::always_inline]] inline PackLaw broadcast(const L& law) {
  if constexpr (requires { law.template broadcast<P>(); }) {
    return law.template broadcast<P>();
  } else {
    static_assert(sizeof(PackLaw) / sizeof(P) == sizeof(L) / sizeof(Lane<P>));
    PackLaw packs;
    P* to = reinterpret_cast<P*>(&packs);
    const Lane<P>* from = reinterpret_cast<const Lane<P>*>(&law);
    for (std::size_t i = 0; i < sizeof(L) / sizeof(Lane<P>); ++i) to[i] = from[i];
    return packs;
  }
}

}  // namespace heml
