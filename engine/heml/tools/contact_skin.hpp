#pragma once
// The surface of a mesh as self-contact sees it: nodes, faces and edges, at rest and at a step's start, and what
// several pairs of a step ask of it there, evaluated for the first that asks. Nodes, faces and edges are told by their
// indices here.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

class ContactSkin {
 public:
  using Positions = std::vector<Vec3>;  ///< #nodes, m
  struct Edge {
    std::array<int, 2> ends, faces;  ///< ends ascending
  };
  /// Whether something holds for all positions near those of now.
  enum class Answer { no, unsure, yes };
  static constexpr double flat = 0.02;  ///< sine: edges with a smaller bend are no ridges

  /// mesh: at rest, with the present elements only, internal numbers.
  explicit ContactSkin(const TetMesh& mesh);

  /// Internal numbers, ascending: of the surface, and those opposite its faces.
  const std::vector<int>& nodes() const { return nodes_; }
  const std::vector<Triangle>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }  ///< ascending
  const Positions& rest() const { return rest_; }
  double mean_edge() const { return mean_edge_; }                             ///< m, at rest
  int apex(int face) const { return apex_[static_cast<std::size_t>(face)]; }  ///< the fourth node of its element
  /// Of a face: nodes, and edges, that no earlier face has; unused: −1.
  const Triangle& own_nodes(int face) const { return own_nodes_[static_cast<std::size_t>(face)]; }
  const Triangle& own_edges(int face) const { return own_edges_[static_cast<std::size_t>(face)]; }
  /// The body that a node is of, from 0: what shares no node with the rest of the mesh; how many there are; and the
  /// nodes of each, ascending.
  int body_of(int node) const { return body_[static_cast<std::size_t>(node)]; }
  const std::vector<std::vector<int>>& bodies() const { return bodies_; }
  int index_of(int node) const;          ///< node: internal number, of nodes()
  int edge_between(int a, int b) const;  ///< a < b: ends of an edge
  Vec3 rest_normal(int face) const;
  /// 1 or −1 for two edges, as ContactPair::side.
  int side_at_rest(int first, int second) const;

  /// A step starts with a node (internal number) at from(node), m.
  template <class From>
  void begin_step(const From& from) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) x_[i] = from(nodes_[i]);
    ++step_;
  }
  const Positions& x() const { return x_; }  ///< at the start
  int side(int first, int second);           ///< as side_at_rest(), at the start
  double height_behind(int face);            ///< m, of the element; not positive where it is inverted
  bool is_ridge(int edge);                   ///< whether it is convex
  double bend(int edge);
  bool is_ridge_towards(int edge, const Vec3& normal, double margin);
  bool is_facing(int node, int face);
  Answer is_ridge_within(int edge, double allowance);
  Answer is_facing_within(int node, int face, double allowance);

  std::size_t bytes() const;

 private:
  struct NodeNow {
    long step = 0;  ///< evaluated in, as in step_
    Vec3 area;      ///< m², sum of the area vectors of its faces
    double square;  ///< m⁴, of it
  };
  struct FaceNow {
    long step = 0;
    Vec3 area;      ///< m², twice the face's, along its normal
    double square;  ///< m⁴, of it
  };
  struct EdgeNow {
    long step = 0;
    bool is_ridge;
  };
  void set_rest(const TetMesh& mesh);
  void find_bodies(const TetMesh& mesh);
  void make_edges();
  const NodeNow& node_now(int node);
  const FaceNow& face_now(int face);

  double mean_edge_ = 0;
  std::vector<int> nodes_, body_;
  std::vector<std::vector<int>> bodies_;
  Positions rest_, x_;
  std::vector<Triangle> faces_;
  std::vector<int> apex_;
  std::vector<Edge> edges_;
  std::vector<int> start_, round_;  ///< faces round each node: round_[start_[n] .. start_[n + 1])
  std::vector<Triangle> own_nodes_, own_edges_;
  long step_ = 0;  ///< calls of begin_step()
  std::vector<NodeNow> nodes_now_;
  std::vector<FaceNow> faces_now_;
  std::vector<EdgeNow> edges_now_;
};

}  // namespace heml
