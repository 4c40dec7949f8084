#pragma once
// Operations beyond arithmetic of code that is generic in its scalar (number, jet, counting scalar, pack): selection
// without a branch.
#include <utility>

namespace heml {

/// Type of a comparison of two scalars: bool, or a mask with one entry per lane (math/pack.hpp).
template <class Real>
using Mask = decltype(std::declval<Real>() < std::declval<Real>());

/// condition ? a : b.
template <class Real>
[[gnu::always_inline]] constexpr Real select(bool condition, const Real& a, const Real& b) {
  return condition ? a : b;
}

/// The number type of one lane of a pack; for other scalars the scalar itself.
template <class Real>
struct LaneOf {
  using type = Real;
};
template <class Real>
using Lane = typename LaneOf<Real>::type;

}  // namespace heml
