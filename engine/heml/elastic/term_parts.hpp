#pragma once
// Laws as terms. The loops of every law are a lot of code: the list of laws is compiled in parts, each every `parts`-th
// law of it, so that a build can work on several at once (term_part_0.cpp ...).
#include <heml/elastic/group_term.hpp>

namespace heml {

/// A material's law as a term of its own, its isochoric part where asked (laws with a volume term only).
template <class Real>
std::unique_ptr<GroupTerm<Real>> make_law_term(const Material& material, bool continuation, bool isochoric);

/// A volume term other than the laws' own, as a term beside them.
template <class Real>
std::unique_ptr<GroupTerm<Real>> make_volume_term(const Material& material, bool continuation);

inline constexpr std::size_t term_parts = 5;

/// make_law_term() for the laws of one part; nothing for others.
template <class Real, std::size_t part>
std::unique_ptr<GroupTerm<Real>> make_law_term_of_part(const Material& material, bool continuation, bool isochoric);

}  // namespace heml
