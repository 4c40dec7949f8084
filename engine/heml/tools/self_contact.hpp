#pragma once
// Where tissue meets tissue: two bodies of one mesh, the two sides of a cut, a fold. Surfaces meet in two ways:
//
//      node and face                            ridge and ridge
//        ╲      ╱                                    ╲
//         ╲    ╱   ↑ normal                    ───────╲──────
//          ╲  ╱    │ gap                               ╲  ↑ normal, along both's common perpendicular
//     a ────●─────────── b  (c behind)
//
// A gap is signed by which side is outside, not a distance. So it says at 0 what to do: two sides of a fresh cut lie
// exactly on each other, may open freely, and do not pass each other again. What else lies near is told from contact by
// this: the two surfaces face each other; what was crossed lies inside the face, or along both ridges, at the moment of
// crossing; and what is inside is so by less than half the element behind. In a body that is not inside out no node
// lies in an element that is not its own, so neighbours are no contact. What overlaps at rest is let be.
//
//   each step   nodes at from, at to ──► have any moved by more than was allowed for? ──► search, or sift
//               close pairs ──► those that meet between from and to
//   search      faces in a grid of cells, in the order of cells ──► near pairs, in the order of nodes
//   sift        near pairs ──► close pairs: nodes may go a small part of the way that a search allows for
//
// Without a scene's "self_contact" none of this is made.
#include <compare>
#include <heml/tools/contact_surface.hpp>
#include <heml/tools/settings.hpp>
#include <tuple>

namespace heml {

/// Two bits of surface, inner numbers: a node and a face's corners, or an edge's ends and another's.
struct ContactPair {
  std::array<int, 4> nodes;
  int side = 0;  ///< of edges, 1 or −1: times (b − a)×(d − c) it points out of what the second belongs to; 0: a face
};

inline bool operator<(const ContactPair& a, const ContactPair& b) {
  return std::tie(a.nodes, a.side) < std::tie(b.nodes, b.side);
}
inline bool operator==(const ContactPair& a, const ContactPair& b) { return a.nodes == b.nodes && a.side == b.side; }

/// The way from the second to the first, with its nodes at x, m: of the face's plane and of the edges' lines, however
/// far they go on. No direction where a face is a line, or edges are parallel: none then.
std::optional<ContactPoint> point_of(const ContactPair& pair, const std::array<Vec3, 4>& x);

template <class At>
std::optional<ContactPoint> point_of(const ContactPair& pair, const At& at) {
  const auto [a, b, c, d] = pair.nodes;
  return point_of(pair, std::array<Vec3, 4>{at(a), at(b), at(c), at(d)});
}

class SelfContact {
 public:
  /// mesh: at rest, the elements that are there, inner numbers.
  SelfContact(const SelfContactSettings& settings, const TetMesh& mesh);

  double friction() const { return friction_; }

  /// Pairs that touch, or cross, while nodes go straight from one place to another, m: from(node), to(node). Ascending.
  template <class From, class To>
  const std::vector<ContactPair>& contacts_between(const From& from, const To& to) {
    from_.clear(), to_.clear();
    for (const int n : nodes_) from_.emplace_back(from(n)), to_.emplace_back(to(n));
    find();
    return met_;
  }

  long broad_phase_count() const { return broad_phase_count_; }  ///< so far
  std::size_t bytes() const;

 private:
  struct Edge {
    std::array<int, 2> ends, faces;
  };
  /// A node and a face, or two edges.
  struct Candidate {
    bool edges;
    int first, second;
    auto operator<=>(const Candidate&) const = default;
  };
  using Places = std::vector<Vec3>;
  // All numbers below are the skin's own.
  void set_rest(const TetMesh& mesh);
  void make_edges();
  void find();
  /// Places for which it is known which pairs can meet.
  struct CandidateSet {
    Places seen;           ///< empty: none yet
    double allowance = 0;  ///< m, that nodes may be from there
  };
  bool covers(const CandidateSet& set) const;
  double spread(const CandidateSet& set, const Places& x) const;
  double reach_of(double allowance) const;
  void broad_phase();
  void filter_candidates();
  double squared_distance(const Candidate& candidate) const;
  bool overlaps(const Candidate& candidate) const;
  void add_candidates(int one, int other, double reach);
  void add_node_candidates(int node, int face, double reach);
  void add_edge_candidates(int one, int other, double reach);
  int side_of(const Edge& one, const Edge& other, const Places& x) const;
  ContactPair pair_of(const Candidate& candidate) const;
  bool meets(const Candidate& candidate, const ContactPair& pair) const;
  Vec3 face_normal(int face, const Places& x) const;
  Vec3 node_normal(int node) const;
  double height(int face) const;
  bool faces_node(int node, const Vec3& normal) const;
  bool is_ridge_towards(const Edge& edge, const Vec3& normal) const;

  double friction_;
  double edge_ = 0;         ///< m, mean of the surface at rest
  std::vector<int> nodes_;  ///< inner numbers, ascending: of the surface, and those opposite to faces in their elements
  Places rest_;
  std::vector<Triangle> faces_;
  std::vector<int> apex_;                        ///< of each face, the fourth node of its element
  std::vector<Edge> edges_;                      ///< with two faces each
  std::vector<int> start_, round_;               ///< faces round each node: round_[start_[n] .. start_[n + 1])
  std::vector<Triangle> own_nodes_, own_edges_;  ///< of each face: nodes, edges that no face before it has; −1
  Places from_, to_;
  CandidateSet searched_, filtered_;
  std::vector<Candidate> near_, close_;  ///< pairs that can meet: of searched_; of these, of filtered_
  std::vector<ContactPair> met_;
  long broad_phase_count_ = 0;
};

}  // namespace heml
