#pragma once
// How far the nodes of a skin move, or may move: of each node about the mean of its body, and of bodies against each
// other. Bodies that fall on each other or are drawn along move far but hardly within themselves; and where a hand lets
// go of one end, the rest of a body hardly moves.
//
//   two nodes of one body      come nearer by at most  a + b                    a, b: of_node
//   nodes of two bodies                                a + b + 2 of_bodies
#include <heml/tools/contact_skin.hpp>
#include <optional>

namespace heml {

struct ContactTravel {
  std::vector<double> of_node;  ///< m, #nodes of the skin
  double of_bodies = 0;         ///< m, half of what the means of two bodies move against each other at most

  double largest() const;                           ///< m, of nodes and bodies together
  bool is_within(const ContactTravel& most) const;  ///< of every node; false where one of them is of no node
  void extend(const ContactTravel& other);          ///< to the larger of both, everywhere
  void add(const ContactTravel& other, double factor = 1);
  void reduce(const ContactTravel& most);  ///< to the smaller of both, everywhere
  /// m, half of what two primitives may move against each other at most: a node and a face, or two edges.
  double of_pair(const ContactSkin& skin, const std::array<int, 4>& nodes, bool edges) const;
  /// m, by how much each of the nodes moves at most, all seen from one place.
  double of_each(const ContactSkin& skin, const std::array<int, 4>& nodes) const;
};

/// Between two positions (m, #nodes); of no node where there are none at first.
ContactTravel travel_between(const ContactSkin& skin, const ContactSkin::Positions& from,
                             const ContactSkin::Positions& to);

/// Its largest() if it is_within(most), in a fraction of the time.
std::optional<double> travel_within(const ContactSkin& skin, const ContactSkin::Positions& from,
                                    const ContactSkin::Positions& to, const ContactTravel& most);

/// The largest value at a node and those of its faces.
std::vector<double> with_neighbours(const ContactSkin& skin, const std::vector<double>& of_node);

}  // namespace heml
