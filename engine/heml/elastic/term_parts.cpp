#include <cassert>
#include <heml/elastic/energy_term.hpp>
#include <heml/elastic/law_term.hpp>
#include <heml/elastic/term_parts.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/parameter_slots.hpp>

namespace heml {
namespace {

template <class Real, bool continued, bool simo_taylor>
std::unique_ptr<GroupTerm<Real>> volume_term(const Material& material) {
  using L = VolumeLaw<Real, continued, simo_taylor>;
  const std::size_t kappa = *volume_parameter(material, *find_law(material.law));
  std::vector<Real L::*> members;
  for (const FieldParameter& field : material.fields) members.push_back(field.parameter == kappa ? &L::kappa : nullptr);
  const L law{static_cast<Real>(material.parameters[kappa])};
  return std::make_unique<LawTerm<Real, L>>(LawSource<Real, L>(law, std::move(members)));
}

}  // namespace

template <class Real>
std::unique_ptr<GroupTerm<Real>> make_law_term(const Material& material, bool continuation, bool isochoric) {
  if (find_energy_law(material.law)) return make_energy_term<Real>(material);
  std::unique_ptr<GroupTerm<Real>> term;
  [&]<std::size_t... part>(std::index_sequence<part...>) {
    void(((term = make_law_term_of_part<Real, part>(material, continuation, isochoric), term != nullptr) || ...));
  }
  (std::make_index_sequence<term_parts>{});
  assert(term);
  return term;
}

template <class Real>
std::unique_ptr<GroupTerm<Real>> make_volume_term(const Material& material, bool continuation) {
  const bool simo_taylor = material.volume_term == VolumeTerm::simo_taylor;
  if (continuation)
    return simo_taylor ? volume_term<Real, true, true>(material) : volume_term<Real, true, false>(material);
  return simo_taylor ? volume_term<Real, false, true>(material) : volume_term<Real, false, false>(material);
}

template std::unique_ptr<GroupTerm<float>> make_law_term(const Material&, bool, bool);
template std::unique_ptr<GroupTerm<double>> make_law_term(const Material&, bool, bool);
template std::unique_ptr<GroupTerm<float>> make_volume_term(const Material&, bool);
template std::unique_ptr<GroupTerm<double>> make_volume_term(const Material&, bool);

}  // namespace heml
