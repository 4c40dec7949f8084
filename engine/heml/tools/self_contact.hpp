#pragma once
// Self-contact: two bodies of one mesh, the two sides of a cut, a fold. There are two kinds of contact pair:
//
//      node and face                            ridge and ridge
//        ╲      ╱                                    ╲
//         ╲    ╱   ↑ normal                    ───────╲──────
//          ╲  ╱    │ gap                               ╲  ↑ normal, along both's common perpendicular
//     a ────●─────────── b  (c behind)
//
// The gap is signed by the outward side, so it is well defined at 0: the two sides of a fresh cut coincide, may open
// freely, and do not pass each other. A nearby pair is in contact only if
//   (1) the surfaces face each other,
//   (2) the crossing lies within the face or both edges: at the step's start where the pair touches, else at the time
//       of crossing,
//   (3) the penetration is below half the height of the element behind.
// In a body without inverted elements no node lies in an element of its neighbours, so neighbours are no contact. Pairs
// that overlap at rest are ignored. Where bodies bear on each other alone (`within_bodies` false), only pairs of two
// are searched: a tenth of them, where small bodies lie on each other.
//
//   each step      nodes at from, at to ──► has any moved by more than the allowance? ──► wake, filter, or broad phase;
//                  sweep where one step alone moves them further than a filter may allow
//                  candidates awake that the motion since the filter brings within reach ──► contacts: those that
//                  touch between from and to. Allowances are of each node, by its own speed: where a hand lets go of
//                  one end, the rest hardly moves
//   broad phase    faces whose boxes, enlarged by the allowance, intersect ──► broad candidates, in the order of nodes
//   sweep          faces whose boxes from start to end, with the element behind, intersect ──► candidates valid for
//                  this start: a falling body reaches far ahead, but not to its sides
//   filter         broad candidates ──► candidates, the nearest first: valid for a small part of the motion that the
//                  broad phase allows
//   wake           candidates ──► awake candidates, in the order of pairs: within reach of little more than the
//                  motion since the filter, and not certain to fail (1) or (2) until nodes have moved further than they
//                  move at rest. On flat surfaces most edges are no ridges, and most crossings lie far outside.
// Built only where a scene has "self_contact".
#include <Eigen/Geometry>
#include <compare>
#include <heml/tools/contact_pair.hpp>
#include <heml/tools/contact_travel.hpp>
#include <heml/tools/settings.hpp>

namespace heml {

class SelfContact {
 public:
  /// mesh: at rest, with the present elements only, internal numbers.
  SelfContact(const SelfContactSettings& settings, const TetMesh& mesh);

  double friction() const { return friction_; }
  /// m, by which two edges may have crossed before they bend enough to be ridges. Steps do not push them apart from
  /// there: that would flatten them, so that they cross anew, and shake bodies at rest on each other.
  double hidden_depth() const { return ContactSkin::flat * edge_; }

  /// Pairs that touch or cross while nodes move in straight lines from from(node) to to(node), m. Ascending; valid
  /// until the next call. Empty where a position is not finite. held: pairs that bore a load in the last step,
  /// ascending; edges among them stay in contact until their bend is clearly gone, faces until the node is clearly
  /// outside.
  template <class From, class To>
  const std::vector<ContactPair>& contacts_between(const From& from, const To& to,
                                                   const std::vector<ContactPair>& held = {}) {
    skin_.begin_step(from);
    for (std::size_t i = 0; i < to_.size(); ++i) to_[i] = to(skin_.nodes()[i]);
    find(held);
    return contacts_;
  }
  /// Of each of these pairs, its point while the nodes are at from(node).
  const std::vector<ContactPoint>& contact_points() const { return points_; }

  long broad_phase_count() const { return broad_phase_count_; }  ///< broad phases run so far
  long filter_count() const { return filter_count_; }            ///< filters run so far
  long sweep_count() const { return sweep_count_; }              ///< sweeps run so far
  long tested_count() const { return tested_count_; }            ///< candidates tested so far
  std::size_t bytes() const;

 private:
  using Positions = ContactSkin::Positions;
  using Answer = ContactSkin::Answer;
  /// A node and a face, or two edges, as skin_ numbers them.
  struct Candidate {
    bool edges;
    int first, second;
    auto operator<=>(const Candidate&) const = default;
  };
  struct NearCandidate {
    double distance;  ///< m, when the filter ran; 0 where one was behind the other
    Candidate candidate;
    auto operator<=>(const NearCandidate&) const = default;
  };
  struct AwakeCandidate {
    double distance;
    std::array<int, 4> nodes;  ///< as in ContactPair, as skin_ numbers them
    Candidate candidate;
    bool can_meet;  ///< for certain, as can_meet() tells
  };
  /// Reference positions, and how far nodes may move from them before the candidates must be found again.
  struct CandidateSet {
    Positions reference;  ///< m; empty: none yet
    ContactTravel allowance;
  };
  /// Of a long step: where its nodes are on their way, in the frame of their mean motion.
  struct Sweep {
    Positions from;                          ///< m; empty: none yet
    std::vector<Eigen::AlignedBox3d> boxes;  ///< #nodes, m
    std::vector<AwakeCandidate> candidates;  ///< that can meet from there, in the order of pairs
  };
  static constexpr double touch_gap = 1e-3;  // of an edge: nearer pairs touch, since a step may push them together
  static constexpr double slack = 0.01;      // of a face or an edge: margin, so that nothing slips between neighbours
  static constexpr int lasting = 512;        // steps for which candidates stay awake

  void find(const std::vector<ContactPair>& held);
  void find_contacts();
  std::optional<double> travel_awake();
  void test(const std::vector<AwakeCandidate>& candidates, double reach);
  void add_held(const std::vector<ContactPair>& held);
  std::array<int, 4> nodes_of(const Candidate& candidate) const;
  int side_of(const Candidate& candidate);
  bool can_meet(const Candidate& candidate);
  std::optional<PairCrossing> crossing_if_met(const Candidate& candidate, const ContactPair& pair);
  bool crosses_later(int side, const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& to, double gap) const;
  double height_behind(const Candidate& candidate);
  bool is_out_of_both(const Candidate& candidate, const std::array<Vec3, 4>& from, const PairCrossing& first,
                      double margin);

  // self_contact_search.cpp
  ContactTravel travelled(const Positions& reference) const { return travel_between(skin_, reference, skin_.x()); }
  ContactTravel allowance(const ContactTravel& step, double steps, double least, double most) const;
  double reach_of(double travel) const;
  bool is_long(const ContactTravel& step) const;
  void update_candidates(const ContactTravel& step);
  void broad_phase(const ContactTravel& step);
  void sweep();
  bool is_swept() const;
  void filter_candidates(const ContactTravel& step);
  void wake_candidates(const ContactTravel& moved);
  double squared_distance(const Candidate& candidate) const;
  template <class BoxOfNode>
  std::vector<Eigen::AlignedBox3d> face_boxes(const BoxOfNode& box_of) const;
  template <class IsNear>
  void collect(const std::vector<std::pair<int, int>>& faces, std::vector<Candidate>& candidates,
               const IsNear& is_near) const;
  bool overlaps_at_rest(const Candidate& candidate) const;
  Answer can_meet_within(const Candidate& candidate, double allowance);
  bool is_outside_within(const AwakeCandidate& awake, double allowance) const;

  double friction_;
  bool within_bodies_;
  ContactSkin skin_;  ///< at the step's start
  std::vector<int> body_of_face_;
  double edge_;       ///< m, mean length at rest
  Positions to_;      ///< m, at its end
  CandidateSet searched_, filtered_;
  Sweep swept_;
  CandidateSet woken_;                       ///< of awake_, for positions at a step's start
  double still_ = 0;                         ///< m, least allowance of woken_
  ContactTravel awake_travel_;               ///< since the filter, for which awake_ serves; none: must be made
  int woken_steps_ = 0;                      ///< since awake_ was made
  std::vector<Candidate> broad_candidates_;  ///< valid within searched_
  std::vector<NearCandidate> candidates_;    ///< the subset valid within filtered_, ascending
  std::vector<AwakeCandidate> awake_;        ///< and of these, valid within awake_travel_, in the order of pairs
  std::vector<ContactPair> contacts_;
  std::vector<ContactPoint> points_;  ///< of contacts_
  long broad_phase_count_ = 0, filter_count_ = 0, sweep_count_ = 0, tested_count_ = 0;
};

}  // namespace heml
