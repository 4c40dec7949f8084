#pragma once
// The law of one slot: the same for all, or with parameters of the element's own.
#include <heml/elastic/element_group.hpp>
#include <heml/materials/laws.hpp>

namespace heml {

template <class Real, class L>
class LawSource {
 public:
  /// fields: which parameters of L the group's rows are, in their order; −1: not one of L.
  LawSource(L law, std::vector<int> fields) : law_(std::move(law)), fields_(std::move(fields)) {}

  bool uniform() const { return fields_.empty(); }
  const L& uniform_law() const { return law_; }

  L at(const ElementGroup<Real>& group, std::size_t s) const {
    L law = law_;
    for (std::size_t k = 0; k < fields_.size(); ++k)
      if (fields_[k] >= 0) set(law, static_cast<std::size_t>(fields_[k]), group.parameters[k][s]);
    return law;
  }

 private:
  static void set(L& law, std::size_t parameter, Real value) {
    if constexpr (requires { L::from({}); })
      law.kappa = value;  // lists are the same for all elements
    else
      reinterpret_cast<Real*>(&law)[parameter] = value;
  }

  L law_;
  std::vector<int> fields_;
};

}  // namespace heml
