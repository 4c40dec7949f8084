#pragma once
// What code that is generic in its scalar asks of it beside arithmetic, so that it runs on a number, on a jet, on a
// counting scalar and on a pack of numbers (math/pack.hpp) alike: a choice that is no branch.
#include <utility>

namespace heml {

/// What a comparison of two of them gives: bool, or a mask of many.
template <class Real>
using Mask = decltype(std::declval<Real>() < std::declval<Real>());

/// condition ? a : b.
template <class Real>
[[gnu::always_inline]] constexpr Real select(bool condition, const Real& a, const Real& b) {
  return condition ? a : b;
}

/// The number type a scalar is made of: of a pack, that of one lane.
template <class Real>
struct LaneOf {
  using type = Real;
};
template <class Real>
using Lane = typename LaneOf<Real>::type;

}  // namespace heml
