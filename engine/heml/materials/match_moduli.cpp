#include <heml/materials/match_moduli.hpp>
#include <heml/materials/parameter_slots.hpp>

namespace heml {
namespace {

constexpr double spring_length = 0.01;  // m

SmallStrainModuli moduli_of(const Material& material, const LawInfo& law) {
  if (law.is_continuum) return small_strain_moduli(material);
  const LameParameters lame = lame_parameters(material.parameters.front() / spring_length, 0.25);
  return {lame.mu, lame.lambda + 2 * lame.mu / 3};
}

}  // namespace

Material match_moduli(const Material& material, const LawInfo& from, const LawInfo& to) {
  const SmallStrainModuli wanted = moduli_of(material, from);
  Material result = material;
  result.law = to.name;
  result.parameters.clear();
  result.fields.clear();
  for (const ParameterInfo& info : to.parameters) result.parameters.push_back(info.initial_value);
  if (!to.is_continuum) result.active_stress = 0;
  if (!to.has_fibre && result.active_stress == 0) {
    result.fibre = Vec3::Zero();
    if (!to.is_continuum) result.fibre_field.clear();  // else it stays, since nobody could give it again
  } else if (to.has_fibre && result.fibre_field.empty() && result.fibre.isZero()) {
    result.fibre = Vec3::UnitX();
  }
  if (!to.has_volume_term) {
    result.volume_term = VolumeTerm::quadratic;
    result.relaxation.clear();
    result.plasticity.reset();
  }
  if (to.has_fibre) result.plasticity.reset();
  if (!to.is_continuum) {
    const LameParameters lame{wanted.bulk - 2 * wanted.shear / 3, wanted.shear};
    result.parameters = {engineering_constants(lame).young * spring_length};
    result.viscosity = result.bulk_viscosity = 0;
    return result;
  }
  // Both moduli are linear in the parameters with unit Pa. The shear modulus does not depend on the volume parameter,
  // which enters the bulk modulus with factor 1.
  const std::size_t volume = *volume_parameter(result, to);
  const std::vector<ParameterSlot> slots = parameter_slots(result, to);
  const double factor = wanted.shear / small_strain_moduli(result).shear;
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (i != volume && slots[i].info->unit == "Pa") result.parameters[i] *= factor;
  result.parameters[volume] += wanted.bulk - small_strain_moduli(result).bulk;
  return result;
}

}  // namespace heml
