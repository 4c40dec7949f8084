#pragma once
// A material as people write it: the name of a law, its parameters, a density, and what acts like elasticity beside it.
// The engine turns it into a law's struct once, when a body is built or the law is switched (laws.hpp, with_law).
#include <heml/materials/law.hpp>
#include <heml/math/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heml {

/// The term of a law with a separate volume term that keeps volume, κ its bulk modulus at rest. `quadratic` is the
/// contract's.
enum class VolumeTerm {
  quadratic,    ///< κ/2 (J−1)²
  logarithmic,  ///< κ/2 (ln J)²
  simo_taylor   ///< κ/4 (J² − 1 − 2 ln J)
};
std::span<const std::string_view> volume_term_names();  ///< in the order of the enum, as scene files spell them

/// One relaxing branch of quasi-linear viscoelasticity: G(t)/G∞ = 1 + Σ γ exp(−t/τ), on the isochoric part.
struct PronyTerm {
  double gamma;  ///< strength relative to the elastic law, which is the long-term one
  double tau;    ///< s

  bool operator==(const PronyTerm&) const = default;
};

/// J2 plasticity with linear isotropic hardening, on the isochoric part.
struct Plasticity {
  double yield = 0;      ///< Pa, von Mises Kirchhoff stress at which flow begins
  double hardening = 0;  ///< Pa per unit of equivalent plastic strain

  bool operator==(const Plasticity&) const = default;
};

/// Parameters that differ from element to element come from a field of the mesh file.
struct FieldParameter {
  std::size_t parameter;  ///< index into Material::parameters, which then holds the mean
  std::string field;      ///< name in the mesh file

  bool operator==(const FieldParameter&) const = default;
};

struct Material {
  std::string law = "stvk";        ///< one of laws()
  std::vector<double> parameters;  ///< SI, in the order of LawInfo::parameters; lists one after the other
  double density = 1000.0;         ///< kg/m³

  Vec3 fibre = Vec3::Zero();                ///< unit, rest shape: laws with a fibre
  std::string fibre_field = {};             ///< per element instead, from the mesh file; empty: none
  std::vector<FieldParameter> fields = {};  ///< per element instead, from the mesh file

  VolumeTerm volume_term = VolumeTerm::quadratic;
  double viscosity = 0;                    ///< η, Pa s: σ = 2 η ε̇ + ζ tr(ε̇) I at small strain
  double bulk_viscosity = 0;               ///< ζ, Pa s
  std::vector<PronyTerm> relaxation = {};  ///< empty: none
  std::optional<Plasticity> plasticity = {};

  bool operator==(const Material&) const = default;
  bool has_internal_state() const { return viscosity > 0 || bulk_viscosity > 0 || !relaxation.empty() || plasticity; }
};

/// What the program knows of a law before it runs it.
struct LawInfo {
  std::string_view name;                      ///< "stvk"
  std::string_view title;                     ///< "Saint Venant–Kirchhoff"
  std::string_view formula;                   ///< energy per unit rest volume, for people
  std::string_view source;                    ///< publication
  std::span<const ParameterInfo> parameters;  ///< what Material::parameters holds
  bool takes_young_poisson;                   ///< `young`, `poisson` may stand for `lambda`, `mu` in a scene
  bool has_volume_term;                       ///< W = isochoric part + volume term with its κ
  bool has_fibre;                             ///< needs Material::fibre or fibre_field
  bool is_principal;                          ///< W of principal stretches
  bool is_stress_free;                        ///< at rest
  bool is_continuum;                          ///< W(F) of an element; false: forces along mesh edges (mass_spring)
  ForceCost cost;
  SmallStrainModuli sample;                                  ///< moduli of sample_material()
  std::vector<double> (*of_moduli)(SmallStrainModuli rest);  ///< parameters of a soft tissue with these moduli
};

/// Every law this build can run, in the order the panel lists them.
std::span<const LawInfo> laws();

/// The law of that name; nullptr when there is none.
const LawInfo* find_law(std::string_view name);

/// A soft material of a law, around 1 kPa unless other moduli at rest are given (Pa), defined for stretches of 0.5 to
/// 1.6, fibres along x: what tests, benches and studies are made of.
Material sample_material(const LawInfo& law);
Material sample_material(const LawInfo& law, SmallStrainModuli rest);

/// What is wrong with the parameters or the density: (key, problem), e.g. ("mu", "must be greater than 0, is -3").
/// Empty when nothing is.
std::optional<std::pair<std::string, std::string>> material_problem(const Material& material);

/// Of a fibre law across the fibre; zero where the law is no continuum. The material must be one that
/// material_problem() has nothing against.
SmallStrainModuli small_strain_moduli(const Material& material);

/// Lamé parameters from engineering constants: λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)).
struct LameParameters {
  double lambda, mu;  ///< Pa
};
LameParameters lame_parameters(double young, double poisson);

/// And back: E = μ(3λ+2μ)/(λ+μ), ν = λ/(2(λ+μ)).
struct EngineeringConstants {
  double young;    ///< Pa
  double poisson;  ///< -
};
EngineeringConstants engineering_constants(const LameParameters& lame);

}  // namespace heml
