#pragma once
// A material as a scene gives it: law, parameters, density, viscosity, relaxation and plasticity. The engine converts
// it to a law's struct when a body is built or its law is switched (laws.hpp, with_law).
#include <heml/materials/law.hpp>
#include <heml/materials/volume_term.hpp>
#include <heml/math/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heml {

std::span<const std::string_view> volume_term_names();  ///< as in scene files, in the order of the enum

/// One Prony branch of quasi-linear viscoelasticity: G(t)/G∞ = 1 + Σ γ exp(−t/τ), on the isochoric part.
struct PronyTerm {
  double gamma;  ///< strength relative to the elastic law, which is the long-term response
  double tau;    ///< relaxation time, s

  bool operator==(const PronyTerm&) const = default;
};

/// J2 plasticity with linear isotropic hardening, on the isochoric part.
struct Plasticity {
  double yield = 0;      ///< Pa, von Mises Kirchhoff stress at which flow begins
  double hardening = 0;  ///< Pa per unit of equivalent plastic strain

  bool operator==(const Plasticity&) const = default;
};

/// A parameter whose values per element come from a field of the mesh file.
struct FieldParameter {
  std::size_t parameter;  ///< index into Material::parameters, whose entry is then the mean
  std::string field;      ///< name in the mesh file

  bool operator==(const FieldParameter&) const = default;
};

struct Material {
  std::string law = "stvk";        ///< one of laws()
  std::vector<double> parameters;  ///< SI, in the order of LawInfo::parameters; lists one after the other
  double density = 1000.0;         ///< kg/m³

  Vec3 fibre = Vec3::Zero();                ///< unit vector at rest, for laws with a fibre and active stress
  std::string fibre_field = {};             ///< field of the mesh file with a fibre per element; empty: none
  std::vector<FieldParameter> fields = {};  ///< parameters with a value per element

  double active_stress = 0;  ///< Ta of contracting muscle, Pa: S = Ta a0 ⊗ a0 beside the stress of the law
  VolumeTerm volume_term = VolumeTerm::quadratic;
  double viscosity = 0;                    ///< η, Pa s: σ = 2 η ε̇ + ζ tr(ε̇) I at small strain
  double bulk_viscosity = 0;               ///< ζ, Pa s
  std::vector<PronyTerm> relaxation = {};  ///< empty: none
  std::optional<Plasticity> plasticity = {};

  bool operator==(const Material&) const = default;
  bool gives_fibre() const { return !fibre_field.empty() || !fibre.isZero(0); }
  bool has_internal_state() const { return viscosity > 0 || bulk_viscosity > 0 || !relaxation.empty() || plasticity; }
};

/// Description of a law, independent of the scalar type.
struct LawInfo {
  std::string_view name;                      ///< "stvk"
  std::string_view title;                     ///< "Saint Venant–Kirchhoff"
  std::string_view formula;                   ///< energy per unit rest volume, for display
  std::string_view source;                    ///< publication
  std::span<const ParameterInfo> parameters;  ///< of Material::parameters
  bool takes_young_poisson;                   ///< a scene may give `young`, `poisson` instead of `lambda`, `mu`
  bool has_volume_term;                       ///< W = isochoric part + volume term with its κ
  bool has_fibre;                             ///< needs Material::fibre or fibre_field
  bool is_principal;                          ///< W of principal stretches
  bool is_stress_free;                        ///< at rest
  bool is_continuum;                          ///< W(F) of an element; false: forces along mesh edges (mass_spring)
  ForceCost cost;
  SmallStrainModuli sample;                                  ///< moduli of sample_material()
  std::vector<double> (*of_moduli)(SmallStrainModuli rest);  ///< parameters of a soft tissue with these moduli
};

/// All laws, in display order.
std::span<const LawInfo> laws();

/// The law of that name; nullptr if there is none.
const LawInfo* find_law(std::string_view name);

/// A soft material of a law for tests, benchmarks and studies: shear modulus around 1 kPa unless moduli at rest are
/// given (Pa), defined for stretches of 0.5 to 1.6, fibres along x.
Material sample_material(const LawInfo& law);
Material sample_material(const LawInfo& law, SmallStrainModuli rest);

/// The first problem of a material as (key, problem), e.g. ("mu", "must be greater than 0 Pa, is -3"); nothing if it is
/// valid.
std::optional<std::pair<std::string, std::string>> material_problem(const Material& material);

/// Moduli at rest; across the fibre for a law with fibres, 0 for a law that is no continuum. Requires parameters that
/// material_problem() accepts.
SmallStrainModuli small_strain_moduli(const Material& material);

/// Lamé parameters from engineering constants: λ = Eν/((1+ν)(1−2ν)), μ = E/(2(1+ν)).
struct LameParameters {
  double lambda, mu;  ///< Pa
};
LameParameters lame_parameters(double young, double poisson);

/// Engineering constants from Lamé parameters: E = μ(3λ+2μ)/(λ+μ), ν = λ/(2(λ+μ)).
struct EngineeringConstants {
  double young;    ///< Pa
  double poisson;  ///< -
};
EngineeringConstants engineering_constants(const LameParameters& lame);

}  // namespace heml
