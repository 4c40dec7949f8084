#pragma once
// Internal state of the elements in fans (viscosity, relaxation), in the layout that their kernels read and write
// (elastic/fan_terms.hpp): once at the last commit, once after the step that is being evaluated. Stiffness, energies,
// edits and snapshots know the state by slot (elastic/viscoelastic_term.hpp); read() and write() convert.
#include <heml/elastic/fan_places.hpp>

namespace heml {

template <class Real>
class FanFlow;
template <class Real>
class PlasticFlow;

/// The state of one part by slot: `each` numbers a slot, G0 T0 Q of branch 0 …, padding included.
template <class Real>
struct FanSlots {
  const ElementGroup<Real>* group;
  std::vector<Real>* values;  ///< null: the part has no state
  std::size_t each;
  const PlasticFlow<Real>* flow = nullptr;  ///< of the elements that flow in fans (fan_flow.hpp)
};

template <class Real>
std::vector<const ElementGroup<Real>*> groups_of(const std::vector<FanSlots<Real>>& slots) {
  std::vector<const ElementGroup<Real>*> groups;
  for (const FanSlots<Real>& part : slots) groups.push_back(part.group);
  return groups;
}

template <class Real>
class FanState {
 public:
  bool is_known() const { return is_known_; }
  void forget() { *this = {}; }

  /// terms, slots: of each part of the layout; lanes: of its kernels.
  void read(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
            const std::vector<FanSlots<Real>>& slots);
  /// Writes what read() reads.
  void write(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
             const std::vector<FanSlots<Real>>& slots) const;

  /// Largest 4/ρ |S| γ, 1/s² (step_bound.hpp), with S the stress that is fixed during the step
  /// (ViscoelasticTerm::state_bound()). flow: of the parts that flow.
  Real bound(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
             const std::vector<FanSlots<Real>>& slots, const FanFlow<Real>& flow) const;

  const Real* now(std::size_t block) const { return now_.data() + start_[block]; }
  Real* next(std::size_t block) { return next_.data() + start_[block]; }
  /// Before kernels write to next().
  void make_next() { next_.resize(now_.size()); }
  /// The next state becomes the present one.
  void advance() { std::swap(now_, next_); }
  /// Frees what the next evaluation writes again.
  void drop_next() { next_ = {}; }

  std::size_t bytes() const;

 private:
  template <class Visit>
  void each_element(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                    const Visit& visit) const;

  bool is_known_ = false;
  std::vector<Real, CacheAligned<Real>> now_, next_;
  std::vector<std::size_t> start_;  ///< of each block in now_
  FanPlaces places_;
};

}  // namespace heml
