#pragma once
// Interface of hyperelastic laws: the energy W per unit rest volume and its derivatives by the invariants of C = FᵀF.
// Concepts distinguish two kinds of law:
//
//   edges ──► C = FᵀF ──► I1, I2, (I4, I5) ─┐
//                                           ├─► InvariantLaw ──► W(I1, I2, J, I4, I5), first, second derivatives
//   triple product ──► J (signed) ──────────┤
//                                           └─► PrincipalLaw ──► Σ h(c̄_i) + ψ(J), c̄_i: eigenvalues of J^(−2/3) C
//
// I1, I2, I4 and I5 are functions of squared edge lengths alone (paper, Appendix). J is the signed det F: squared
// lengths do not distinguish an element from its mirror image. elastic/tension.hpp computes tensions from the
// derivatives.
#include <array>
#include <concepts>
#include <heml/math/scalar.hpp>
#include <iterator>
#include <span>
#include <string_view>

namespace heml {

/// Invariants of C = FᵀF and the signed volume ratio: I1 = tr C, I2 = ½(tr²C − tr C²), J = det F, I4 = a0·C a0 and
/// I5 = a0·C² a0, where the unit vector a0 is the fibre direction at rest.
template <class Real>
struct Invariants {
  Real I1, I2, J, I4 = Real(1), I5 = Real(1);
};

/// First derivatives of W, Pa.
template <class Real>
struct FirstDerivatives {
  Real w1, w2, wJ, w4 = Real(0), w5 = Real(0);
};

/// Second derivatives of W, Pa.
template <class Real>
struct SecondDerivatives {
  Real w11, w12, w22, w1J, w2J, wJJ, w14 = Real(0), w24 = Real(0), w4J = Real(0), w44 = Real(0);
  Real w15 = Real(0), w25 = Real(0), w5J = Real(0), w45 = Real(0), w55 = Real(0);
};

/// Range of a parameter; all must be finite.
enum class ParameterRange { any, positive, not_negative, not_zero };

enum class ParameterKind {
  plain,
  list,      ///< any number of values; all lists of a law have the same length
  exponent,  ///< factor in the exponent of an exponential, which overflows at large stretches
  limit      ///< limit of stretch, beyond which W is undefined
};

/// A parameter of a law as scene files and the panel present it.
struct ParameterInfo {
  std::string_view name;     ///< key in a scene file
  std::string_view symbol;   ///< as shown in the panel
  std::string_view unit;     ///< "Pa", "" for a ratio
  std::string_view meaning;  ///< one line
  ParameterRange range = ParameterRange::any;
  double initial_value =
      1;  ///< initial value when a material changes to this law (match_moduli.hpp then scales moduli)
  ParameterKind kind = ParameterKind::plain;

  constexpr bool is_list() const { return kind == ParameterKind::list; }
};

/// A parameter of the law L of Real and the member that stores it; null for a list (see L::from in ogden.hpp).
template <class L, class Real>
struct Parameter {
  Real L::*member;
  ParameterInfo info;
};

/// Elastic constants of the law linearised at rest, Pa.
struct SmallStrainModuli {
  double shear, bulk;
};

/// Time of one force evaluation, ns per tetrahedron, measured by `heml bench kernel --quick` on one core of an AMD EPYC
/// with AVX2 (irregular cube 9). Without AVX2 twice as much.
struct ForceCost {
  double in_double, in_float;
};

/// What both kinds of law have in common. A law is a struct of its parameters; `parameters` is their table. valid()
/// tells whether W is defined at a state; where it is not, results of other functions are unspecified.
template <class L>
concept AnyLaw = requires {
  {std::size(L::parameters)};
  { L::has_volume_term } -> std::convertible_to<bool>;  ///< has a member kappa; with kappa = 0, W is isochoric
  { L::always_valid } -> std::convertible_to<bool>;
  { L::uses_I2 } -> std::convertible_to<bool>;  ///< false: no derivative depends on I2, and w2 = 0
  { L::uses_J } -> std::convertible_to<bool>;   ///< false: W does not depend on J, and wJ = 0
  { L::uses_I4 } -> std::convertible_to<bool>;  ///< false: no fibre
};

/// Whether a law depends on I5: it says so by a true `uses_I5`, and then uses I2, J and I4 too.
template <class L>
concept FibreShearLaw = requires { requires L::uses_I5 && L::uses_I2 && L::uses_J && L::uses_I4; };

template <class L, class Real>
concept InvariantLaw = AnyLaw<L> && requires(const L law, Invariants<Real> at) {
  { law.valid(at) } -> std::same_as<Mask<Real>>;
  { law.energy(at) } -> std::same_as<Real>;
  { law.first_derivatives(at) } -> std::same_as<FirstDerivatives<Real>>;
  { law.second_derivatives(at) } -> std::same_as<SecondDerivatives<Real>>;
};

/// h(c̄) and its first two derivatives at an eigenvalue c̄ of J^(−2/3) C, Pa.
template <class Real>
struct PrincipalDerivatives {
  Real h, h1, h2;
};

/// ψ(J) and its first two derivatives, Pa.
template <class Real>
struct VolumeDerivatives {
  Real w, w1, w2;
};

/// A law of principal stretches: W = Σ_i h(c̄_i) + ψ(J). Its stress is in materials/principal.hpp.
template <class L, class Real>
concept PrincipalLaw = AnyLaw<L> && requires(const L law, Real c) {
  { law.principal(c) } -> std::same_as<PrincipalDerivatives<Real>>;
  { law.divided_difference(c, c) } -> std::same_as<Real>;  ///< (h1(a) − h1(b)) / (a − b), with its limit
  { law.volume(c) } -> std::same_as<VolumeDerivatives<Real>>;
};

template <class L, class Real>
concept Law = InvariantLaw<L, Real> || PrincipalLaw<L, Real>;

/// Description that every law of LawList has, for users, tests and the cost model.
template <class L>
concept DescribedLaw = requires(double modulus) {
  { L::name } -> std::convertible_to<std::string_view>;
  { L::title } -> std::convertible_to<std::string_view>;
  { L::formula } -> std::convertible_to<std::string_view>;
  { L::source } -> std::convertible_to<std::string_view>;
  { L::is_stress_free } -> std::convertible_to<bool>;  ///< at rest
  { L::cost } -> std::convertible_to<ForceCost>;
  { L::sample } -> std::convertible_to<SmallStrainModuli>;    ///< moduli of its sample_material()
  {std::span<const double>(L::of_moduli(modulus, modulus))};  ///< parameters of a soft tissue with these moduli at rest
};

}  // namespace heml
