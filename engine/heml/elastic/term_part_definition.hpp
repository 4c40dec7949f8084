#pragma once
// What each term_part_N.cpp instantiates.
#include <heml/elastic/law_term.hpp>
#include <heml/elastic/term_parts.hpp>
#include <heml/materials/parameter_slots.hpp>

namespace heml {

/// Whether a law of LawList belongs to a part.
template <std::size_t part>
struct InPart {
  constexpr bool operator()(std::size_t law) const { return law % term_parts == part; }
};

template <class Real, std::size_t part>
std::unique_ptr<GroupTerm<Real>> make_law_term_of_part(const Material& material, bool continuation, bool isochoric) {
  std::unique_ptr<GroupTerm<Real>> term;
  std::vector<int> fields;
  const std::size_t kappa = isochoric ? *volume_slot(material, *find_law(material.law)) : 0;
  for (const FieldParameter& field : material.fields) {
    const bool lost = isochoric && field.parameter == kappa;
    fields.push_back(lost ? -1 : static_cast<int>(field.parameter));
  }
  with_law_among<Real>(InPart<part>{}, material, continuation, [&]<class L>(L law) {
    if constexpr (L::has_volume_term)
      if (isochoric) law.kappa = 0;
    term = std::make_unique<LawTerm<Real, L>>(LawSource<Real, L>(law, std::move(fields)));
  });
  return term;
}

/// Defines one part for both scalars.
#define HEML_TERM_PART(part)                                                                                  \
  template std::unique_ptr<GroupTerm<float>> make_law_term_of_part<float, part>(const Material&, bool, bool); \
  template std::unique_ptr<GroupTerm<double>> make_law_term_of_part<double, part>(const Material&, bool, bool)

}  // namespace heml
