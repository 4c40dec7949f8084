#pragma once
// The law of one slot: uniform, or with parameters that vary by element.
#include <heml/elastic/element_group.hpp>
#include <heml/materials/laws.hpp>

namespace heml {

template <class Real, class L>
class LawSource {
 public:
  /// members: the parameter of L that each row of ElementGroup::parameters sets, null for a row that L does not use;
  /// empty if the law is uniform.
  LawSource(L law, std::vector<Real L::*> members) : law_(std::move(law)), members_(std::move(members)) {}

  bool uniform() const { return members_.empty(); }
  const L& uniform_law() const { return law_; }

  L at(const ElementGroup<Real>& group, std::size_t s) const {
    L law = law_;
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (members_[k]) law.*members_[k] = group.parameters[k][s];
    return law;
  }

 private:
  L law_;
  std::vector<Real L::*> members_;
};

}  // namespace heml
