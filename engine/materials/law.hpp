#pragma once
// What a hyperelastic law is to the rest of the program: an energy W(I1, I2, J) per unit rest volume and its
// derivatives.
//
//   edges ──► C = FᵀF ──► I1, I2 ─┐
//                                 ├─► law ──► W, its slopes (forces), its curvatures (stiffness, stable step)
//   triple product ──► J (signed)─┘
//
// I1 and I2 are functions of squared edge lengths alone (paper, Appendix); J is the signed det F, since squared lengths
// do not see a mirror image. How slopes become tensions of links is in elastic/.
#include <concepts>
#include <span>
#include <string_view>

namespace heml {

/// Invariants of C = FᵀF and the signed volume ratio. I1 = tr C, I2 = ½(tr²C − tr C²), J = det F.
template <class Real>
struct Invariants {
  Real I1, I2, J;
};

/// First derivatives of W, Pa.
template <class Real>
struct Slopes {
  Real w1, w2, wJ;
};

/// Second derivatives of W, Pa.
template <class Real>
struct Curvatures {
  Real w11, w12, w22, w1J, w2J, wJJ;
};

/// One number a law takes from the user: what the scene file calls it, and what the panel says of it.
struct ParameterInfo {
  std::string_view name;     ///< key in a scene file
  std::string_view symbol;   ///< as shown in the panel
  std::string_view unit;     ///< "Pa", "" for a ratio
  std::string_view meaning;  ///< one line
};

/// A law is a struct of its parameters (#P members of type Real, in the order of `parameters`) that answers these
/// calls. `valid` says whether W is defined at a state; the others may return anything where it is not.
template <class L, class Real>
concept Law = requires(const L law, Invariants<Real> at) {
  { L::name } -> std::convertible_to<std::string_view>;
  {std::span<const ParameterInfo>(L::parameters)};
  { L::uses_I2 } -> std::convertible_to<bool>;  ///< false: slopes never need I2, and w2 = 0
  { L::uses_J } -> std::convertible_to<bool>;   ///< false: W does not depend on J: wJ = 0
  { law.valid(at) } -> std::same_as<bool>;
  { law.energy(at) } -> std::same_as<Real>;
  { law.slopes(at) } -> std::same_as<Slopes<Real>>;
  { law.curvatures(at) } -> std::same_as<Curvatures<Real>>;
};

}  // namespace heml
