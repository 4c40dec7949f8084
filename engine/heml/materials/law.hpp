#pragma once
// What a hyperelastic law is to the rest of the program: an energy W per unit rest volume and its derivatives, by the
// invariants of C = FᵀF. Two kinds of law, told apart by concepts:
//
//   edges ──► C = FᵀF ──► I1, I2, (I4) ─┐
//                                       ├─► InvariantLaw ──► W(I1, I2, J, I4), its slopes and curvatures
//   triple product ──► J (signed) ──────┤
//                                       └─► PrincipalLaw ──► Σ h(c̄_i) + volume term, c̄_i: eigenvalues of J^(−2/3) C
//
// I1, I2 and I4 are functions of squared edge lengths alone (paper, Appendix); J is the signed det F, since squared
// lengths do not see a mirror image. How slopes become tensions of links is in elastic/tension.hpp.
#include <array>
#include <concepts>
#include <heml/math/scalar.hpp>
#include <iterator>
#include <span>
#include <string_view>

namespace heml {

/// Invariants of C = FᵀF and the signed volume ratio. I1 = tr C, I2 = ½(tr²C − tr C²), J = det F, I4 = a0·C a0 with the
/// fibre's unit direction a0 at rest.
template <class Real>
struct Invariants {
  Real I1, I2, J, I4 = Real(1);
};

/// First derivatives of W, Pa.
template <class Real>
struct FirstDerivatives {
  Real w1, w2, wJ, w4 = Real(0);
};

/// Second derivatives of W, Pa.
template <class Real>
struct SecondDerivatives {
  Real w11, w12, w22, w1J, w2J, wJJ, w14 = Real(0), w24 = Real(0), w4J = Real(0), w44 = Real(0);
};

/// Values a parameter may have, beside being finite.
enum class ParameterRange { any, positive, not_negative, not_zero };

enum class ParameterKind {
  plain,
  list,      ///< any number of values; all lists of a law have the same length
  exponent,  ///< the exponential of a law grows with it, and overflows at large stretches
  limit      ///< of stretch: the law ends there
};

/// One number a law takes from the user: what the scene file calls it, and what the panel says of it.
struct ParameterInfo {
  std::string_view name;     ///< key in a scene file
  std::string_view symbol;   ///< as shown in the panel
  std::string_view unit;     ///< "Pa", "" for a ratio
  std::string_view meaning;  ///< one line
  ParameterRange range = ParameterRange::any;
  double start = 1;  ///< when a material changes to this law, its moduli being scaled afterwards
  ParameterKind kind = ParameterKind::plain;

  constexpr bool is_list() const { return kind == ParameterKind::list; }
};

/// A parameter of the law L of Real, and the member that holds it; a list has none (see L::from in ogden.hpp).
template <class L, class Real>
struct Parameter {
  Real L::*member;
  ParameterInfo info;
};

/// Elastic constants at rest, Pa: what a law is for small strains.
struct SmallStrainModuli {
  double shear, bulk;
};

/// What one evaluation of the forces costs, ns a tetrahedron: as `heml bench kernel --quick` found it on one core of an
/// AMD EPYC with AVX2 (irregular cube 9). Without AVX2 twice as much.
struct ForceCost {
  double in_double, in_float;
};

/// What every law says of its calculus. A law is a struct of its parameters, of which `parameters` is the table.
/// `valid` says whether W is defined at a state; other calls may return anything where it is not.
template <class L>
concept AnyLaw = requires {
  {std::size(L::parameters)};
  { L::has_volume_term } -> std::convertible_to<bool>;  ///< has a member kappa; kappa = 0 leaves the isochoric part
  { L::always_valid } -> std::convertible_to<bool>;
  { L::uses_I2 } -> std::convertible_to<bool>;  ///< false: slopes never need I2, and w2 = 0
  { L::uses_J } -> std::convertible_to<bool>;   ///< false: W does not depend on J: wJ = 0
  { L::uses_I4 } -> std::convertible_to<bool>;  ///< false: no fibre
};

template <class L, class Real>
concept InvariantLaw = AnyLaw<L> && requires(const L law, Invariants<Real> at) {
  { law.valid(at) } -> std::same_as<Mask<Real>>;
  { law.energy(at) } -> std::same_as<Real>;
  { law.first_derivatives(at) } -> std::same_as<FirstDerivatives<Real>>;
  { law.second_derivatives(at) } -> std::same_as<SecondDerivatives<Real>>;
};

/// h and its first two derivatives at one eigenvalue c̄ of J^(−2/3) C, Pa.
template <class Real>
struct PrincipalDerivatives {
  Real h, h1, h2;
};

/// ψ and its first two derivatives, Pa.
template <class Real>
struct VolumeDerivatives {
  Real w, w1, w2;
};

/// A law of principal stretches: W = Σ_i h(c̄_i) + ψ(J). See materials/principal.hpp for its calculus.
template <class L, class Real>
concept PrincipalLaw = AnyLaw<L> && requires(const L law, Real c) {
  { law.principal(c) } -> std::same_as<PrincipalDerivatives<Real>>;
  { law.divided_difference(c, c) } -> std::same_as<Real>;  ///< (h1(a) − h1(b)) / (a − b), with its limit
  { law.volume(c) } -> std::same_as<VolumeDerivatives<Real>>;
};

template <class L, class Real>
concept Law = InvariantLaw<L, Real> || PrincipalLaw<L, Real>;

/// What a law of LawList says to people, tests and the cost model.
template <class L>
concept DescribedLaw = requires(double modulus) {
  { L::name } -> std::convertible_to<std::string_view>;
  { L::title } -> std::convertible_to<std::string_view>;
  { L::formula } -> std::convertible_to<std::string_view>;
  { L::source } -> std::convertible_to<std::string_view>;
  { L::is_stress_free } -> std::convertible_to<bool>;  ///< at rest
  { L::cost } -> std::convertible_to<ForceCost>;
  {
    L::sample
    } -> std::convertible_to<SmallStrainModuli>;  ///< moduli of the material that tests and benches have of it
  {std::span<const double>(L::of_moduli(modulus, modulus))};  ///< parameters of a soft tissue with these moduli at rest
};

}  // namespace heml
