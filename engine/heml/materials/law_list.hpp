#pragma once
// The list of laws, and the mapping from a name to a type. How to add a law: engine/docs/adding.md.
#include <heml/materials/arruda_boyce.hpp>
#include <heml/materials/gent.hpp>
#include <heml/materials/guccione.hpp>
#include <heml/materials/hgo.hpp>
#include <heml/materials/mooney_rivlin.hpp>
#include <heml/materials/neo_hookean.hpp>
#include <heml/materials/ogden.hpp>
#include <heml/materials/paper_laws.hpp>
#include <heml/materials/stable_neo_hookean.hpp>
#include <heml/materials/stvk.hpp>
#include <heml/materials/veronda_westmann.hpp>
#include <heml/materials/yeoh.hpp>
#include <string_view>
#include <tuple>
#include <utility>

namespace heml {

/// Wraps a law's template, so that a tuple can list it.
template <template <class, bool> class L>
struct LawTag {
  template <class Real, bool continued>
  using Law = L<Real, continued>;
  static constexpr std::string_view name = L<double, false>::name;
};

/// All laws W(F), in display order.
using LawList =
    std::tuple<LawTag<NeoHookean>, LawTag<StVK>, LawTag<NeoHookeanIso>, LawTag<MooneyRivlin>, LawTag<FungDemiray>,
               LawTag<Ogden>, LawTag<Hgo>, LawTag<Guccione>, LawTag<Yeoh>, LawTag<Gent>, LawTag<ArrudaBoyce>,
               LawTag<VerondaWestmann>, LawTag<StableNeoHookean>, LawTag<PaperNeoHookean>, LawTag<PaperMooneyRivlin>,
               LawTag<PaperFungDemiray>>;

inline constexpr std::size_t law_count = std::tuple_size_v<LawList>;

/// Index of a name in LawList; law_count if it is not there.
constexpr std::size_t law_index(std::string_view name) {
  return [&]<std::size_t... k>(std::index_sequence<k...>) {
    std::size_t found = law_count;
    ((found == law_count && std::tuple_element_t<k, LawList>::name == name ? void(found = k) : void()), ...);
    return found;
  }
  (std::make_index_sequence<law_count>{});
}

/// Calls use(tag, std::bool_constant<continued>) for the law of that index in LawList; no call if there is none. By
/// index, since code for another instruction set (elastic/fan_avx512.hpp) must share no function with other files, not
/// even string comparison.
template <class Use>
void visit_law(std::size_t law, bool continued, const Use& use) {
  const auto call = [&](auto tag) { continued ? use(tag, std::true_type{}) : use(tag, std::false_type{}); };
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    ((k == law ? call(std::tuple_element_t<k, LawList>{}) : void()), ...);
  }
  (std::make_index_sequence<law_count>{});
}

}  // namespace heml
