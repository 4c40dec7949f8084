#pragma once
// What each term_part_N.cpp instantiates.
#include <heml/elastic/law_term.hpp>
#include <heml/elastic/term_parts.hpp>
#include <heml/materials/parameter_slots.hpp>

namespace heml {

/// The law's members that the material's fields set, in the order of the fields; null for an omitted volume term.
template <class Real, class L>
std::vector<Real L::*> members_with_fields(const Material& material, bool isochoric) {
  const LawInfo& info = *find_law(material.law);
  const std::vector<ParameterSlot> slots = parameter_slots(material, info);
  const std::optional<std::size_t> volume = isochoric ? volume_parameter(material, info) : std::nullopt;
  std::vector<Real L::*> members;
  for (const FieldParameter& field : material.fields) {
    const auto parameter = static_cast<std::size_t>(slots[field.parameter].info - info.parameters.data());
    members.push_back(field.parameter == volume ? nullptr : L::parameters[parameter].member);
  }
  return members;
}

template <class Real, std::size_t part>
std::unique_ptr<GroupTerm<Real>> make_law_term_of_part(const Material& material, bool continuation, bool isochoric) {
  std::unique_ptr<GroupTerm<Real>> term;
  visit_law(law_index(material.law), continuation, [&]<class Tag, bool continued>(Tag, std::bool_constant<continued>) {
    if constexpr (law_index(Tag::name) % term_parts == part) {
      using L = typename Tag::template Law<Real, continued>;
      L law = law_from<L, Real>(material.parameters);
      if constexpr (L::has_volume_term)
        if (isochoric) law.kappa = 0;
      term = std::make_unique<LawTerm<Real, L>>(
          LawSource<Real, L>(std::move(law), members_with_fields<Real, L>(material, isochoric)));
    }
  });
  return term;
}

/// Instantiates one part for both scalars.
#define HEML_TERM_PART(part)                                                                                  \
  template std::unique_ptr<GroupTerm<float>> make_law_term_of_part<float, part>(const Material&, bool, bool); \
  template std::unique_ptr<GroupTerm<double>> make_law_term_of_part<double, part>(const Material&, bool, bool)

}  // namespace heml
