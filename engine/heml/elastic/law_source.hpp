#pragma once
// The law of one slot, of several in the lanes of a pack, or of a packet: uniform, or with parameters that vary by
// element.
#include <algorithm>
#include <cstring>
#include <heml/elastic/element_group.hpp>
#include <heml/materials/law_packs.hpp>
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
  const std::vector<Real L::*>& members() const { return members_; }

  L at(const ElementGroup<Real>& group, std::size_t s) const {
    L law = law_;
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (members_[k]) law.*members_[k] = group.parameters[k][s];
    return law;
  }

  /// Sets the parameters that vary to those of the slots from s on, one a lane. law: broadcast from uniform_law().
  template <class P, class Law>
  [[gnu::always_inline]] inline void read_varying(const ElementGroup<Real>& group, std::size_t s, Law& law) const {
    constexpr auto parameters = std::make_index_sequence<std::size(L::parameters)>{};
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (members_[k]) read_parameter<P>(members_[k], group.parameters[k].data() + s, law, parameters);
  }

 private:
  template <class P, class Law, std::size_t... i>
  [[gnu::always_inline]] static void read_parameter(Real L::*member, const Real* values, Law& law,
                                                    std::index_sequence<i...>) {
    [[maybe_unused]] const auto read = [&](Real L::*of_number, P Law::*of_pack) {
      if (of_number == member) std::memcpy(&(law.*of_pack).v, values, sizeof(P));
    };
    (read(L::parameters[i].member, Law::parameters[i].member), ...);
  }

  L law_;
  std::vector<Real L::*> members_;
};

/// In place of PacketLaws, for a uniform law that holds more than parameters.
template <class Real, class L>
struct SameLaw {
  const L& law;
  void read(const ElementGroup<Real>&, std::size_t) const {}
  const L& at(std::size_t) const { return law; }
};

/// The laws of the slots of a packet as lists of their parameters, for loops over lanes that are vectorised. Of laws
/// that hold nothing but parameters (law_from()).
template <class Real, class L>
class PacketLaws {
 public:
  static constexpr std::size_t lanes = ElementGroup<Real>::lanes, count = std::size(L::parameters);

  [[gnu::always_inline]] explicit PacketLaws(const LawSource<Real, L>& source) : source_(&source) {
    for (std::size_t i = 0; i < count; ++i)
      std::fill_n(value_[i], lanes, source.uniform_law().*L::parameters[i].member);
  }
  /// Of the slots from s on, until the next call.
  [[gnu::always_inline]] inline void read(const ElementGroup<Real>& group, std::size_t s) {
    for (std::size_t k = 0; k < source_->members().size(); ++k)
      for (std::size_t i = 0; i < count; ++i)
        if (L::parameters[i].member == source_->members()[k]) std::copy_n(&group.parameters[k][s], lanes, value_[i]);
  }
  [[gnu::always_inline]] inline L at(std::size_t lane) const {
    return of_lane(lane, std::make_index_sequence<count>{});
  }

 private:
  template <std::size_t... i>
  [[gnu::always_inline]] inline L of_lane(std::size_t lane, std::index_sequence<i...>) const {
    L law{};
    ((law.*L::parameters[i].member = value_[i][lane]), ...);
    return law;
  }

  const LawSource<Real, L>* source_;
  Real value_[count][lanes];
};

/// The law of the slots in the lanes of a pack P.
template <class P, class L>
class PackedLaw {
 public:
  using Law = typename ReboundLaw<L, P>::Law;
  using Source = LawSource<Lane<P>, L>;

  [[gnu::always_inline]] explicit PackedLaw(const L& uniform) : law_(broadcast<Law, P>(uniform)) {}
  [[gnu::always_inline]] PackedLaw(const Source& source, const ElementGroup<Lane<P>>& group)
      : law_(broadcast<Law, P>(source.uniform_law())), source_(source.uniform() ? nullptr : &source), group_(&group) {}

  /// Of the slots from s on, until the next call.
  [[gnu::always_inline]] inline const Law& at(std::size_t s) {
    if (source_) source_->template read_varying<P>(*group_, s, law_);
    return law_;
  }

 private:
  Law law_;
  const Source* source_ = nullptr;  ///< null: uniform
  const ElementGroup<Lane<P>>* group_ = nullptr;
};

}  // namespace heml
