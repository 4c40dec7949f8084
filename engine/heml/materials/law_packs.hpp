#pragma once
// Conversion of a law of numbers to one of packs (math/pack.hpp), with the same parameters in every lane.
#include <heml/math/pack.hpp>
#include <iterator>
#include <utility>

namespace heml {

/// The type of law L with the scalar P.
template <class L, class P>
struct ReboundLaw;
template <template <class, bool> class L, class Real, bool continued, class P>
struct ReboundLaw<L<Real, continued>, P> {
  using Law = L<P, continued>;
};
template <template <class, bool, bool> class L, class Real, bool continued, bool other, class P>
struct ReboundLaw<L<Real, continued, other>, P> {
  using Law = L<P, continued, other>;
};

template <class To, class From, std::size_t... i>
[[gnu::always_inline]] inline void copy_parameters(const From& from, To& to, std::index_sequence<i...>) {
  ((to.*To::parameters[i].member = from.*From::parameters[i].member), ...);
}

/// The law with its parameters copied to every lane.
template <class PackLaw, class P, class L>
[[gnu::always_inline]] inline PackLaw broadcast(const L& law) {
  if constexpr (requires { law.template broadcast<P>(); }) {
    return law.template broadcast<P>();
  } else {
    PackLaw packs;
    copy_parameters(law, packs, std::make_index_sequence<std::size(L::parameters)>{});
    return packs;
  }
}

}  // namespace heml
