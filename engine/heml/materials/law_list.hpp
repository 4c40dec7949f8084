#pragma once
// The one list of laws. Adding a law is its header and a line in LawList.
#include <heml/materials/as_printed.hpp>
#include <heml/materials/gent.hpp>
#include <heml/materials/hgo.hpp>
#include <heml/materials/mooney_rivlin.hpp>
#include <heml/materials/neo_hookean.hpp>
#include <heml/materials/ogden.hpp>
#include <heml/materials/stable_neo_hookean.hpp>
#include <heml/materials/stvk.hpp>
#include <heml/materials/veronda_westmann.hpp>
#include <heml/materials/yeoh.hpp>
#include <tuple>

namespace heml {

/// Carries a law's template, so that a list can hold it for every scalar and both continuations.
template <template <class, bool> class L>
struct LawTag {
  template <class Real, bool continued>
  using Law = L<Real, continued>;
};

/// In the order people see them.
using LawList =
    std::tuple<LawTag<NeoHookean>, LawTag<StVK>, LawTag<NeoHookeanIso>, LawTag<MooneyRivlin>, LawTag<FungDemiray>,
               LawTag<Ogden>, LawTag<Hgo>, LawTag<Yeoh>, LawTag<Gent>, LawTag<VerondaWestmann>,
               LawTag<StableNeoHookean>, LawTag<PaperNeoHookean>, LawTag<PaperMooneyRivlin>, LawTag<PaperFungDemiray>>;

}  // namespace heml
