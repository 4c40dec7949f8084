#pragma once
// Factories of law terms. The loops of all laws are much code, so the list of laws is compiled in `term_parts` files
// (term_part_0.cpp ...), law i in file i mod term_parts, which build in parallel.
#include <heml/elastic/group_term.hpp>

namespace heml {

/// The term of a material's law. isochoric: without its volume term (for laws that have one).
template <class Real>
std::unique_ptr<GroupTerm<Real>> make_law_term(const Material& material, bool continuation, bool isochoric);

/// The volume term that replaces the one of the law.
template <class Real>
std::unique_ptr<GroupTerm<Real>> make_volume_term(const Material& material, bool continuation);

inline constexpr std::size_t term_parts = 5;

/// make_law_term() for the laws of one part; null for others.
template <class Real, std::size_t part>
std::unique_ptr<GroupTerm<Real>> make_law_term_of_part(const Material& material, bool continuation, bool isochoric);

}  // namespace heml
