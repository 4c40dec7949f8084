#include <algorithm>
#include <cmath>
#include <heml/math/bytes.hpp>
#include <heml/mesh/connected_parts.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/tools/contact_skin.hpp>
#include <tuple>

namespace heml {
namespace {

constexpr double facing = 0.1;  // cosine, minimum between two surfaces that face each other

std::size_t at(int n) { return static_cast<std::size_t>(n); }

/// Whether a / √square < threshold, where the threshold is negative.
bool is_below(double a, double threshold, double square) { return a < 0 && a * a > threshold * threshold * square; }

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

}  // namespace

ContactSkin::ContactSkin(const TetMesh& mesh) {
  set_rest(mesh);
  find_bodies(mesh);
  make_edges();
  nodes_now_.resize(nodes_.size());
  faces_now_.resize(faces_.size());
  edges_now_.resize(edges_.size());
  x_.resize(nodes_.size());
}

void ContactSkin::set_rest(const TetMesh& mesh) {
  const BoundaryFaces boundary = extract_boundary(mesh);
  for (std::size_t f = 0; f < boundary.triangles.size(); ++f) {
    const Tet& tet = mesh.tets[at(boundary.tets[f])];
    nodes_.insert(nodes_.end(), tet.begin(), tet.end());
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  for (const int n : nodes_) rest_.push_back(mesh.nodes[at(n)]);
  for (std::size_t f = 0; f < boundary.triangles.size(); ++f) {
    const Triangle& face = boundary.triangles[f];
    faces_.push_back({index_of(face[0]), index_of(face[1]), index_of(face[2])});
    for (const int n : mesh.tets[at(boundary.tets[f])])
      if (std::find(face.begin(), face.end(), n) == face.end()) apex_.push_back(index_of(n));
  }
  start_.assign(nodes_.size() + 1, 0);
  for (const Triangle& face : faces_)
    for (const int n : face) ++start_[at(n) + 1];
  for (std::size_t n = 0; n < nodes_.size(); ++n) start_[n + 1] += start_[n];
  round_.resize(3 * faces_.size());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const int n : faces_[f]) round_[at(next[at(n)]++)] = static_cast<int>(f);
}

void ContactSkin::find_bodies(const TetMesh& mesh) {
  const std::vector<int> part = connected_parts(mesh, {});
  std::vector<int> number(mesh.nodes.size(), -1);  // of the body whose part has that name
  for (const int n : nodes_) {
    int& body = number[at(part[at(n)])];
    if (body < 0) {
      body = static_cast<int>(bodies_.size());
      bodies_.emplace_back();
    }
    bodies_[at(body)].push_back(static_cast<int>(body_.size()));
    body_.push_back(body);
  }
}

void ContactSkin::make_edges() {
  std::vector<std::tuple<int, int, int>> sides;  // lower end, upper end, face
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces_[f][k], b = faces_[f][(k + 1) % 3];
      sides.emplace_back(std::min(a, b), std::max(a, b), static_cast<int>(f));
    }
  std::sort(sides.begin(), sides.end());
  own_nodes_.assign(faces_.size(), {-1, -1, -1});
  own_edges_ = own_nodes_;
  const auto give = [](Triangle& list, int item) { *std::find(list.begin(), list.end(), -1) = item; };
  double length = 0;
  for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {  // a closed surface has each edge an even number of times
    const auto [a, b, one] = sides[k];
    const auto [c, d, other] = sides[k + 1];
    give(own_edges_[at(one)], static_cast<int>(edges_.size()));
    edges_.push_back({{a, b}, {one, other}});
    length += (rest_[at(b)] - rest_[at(a)]).norm();
  }
  mean_edge_ = length / static_cast<double>(std::max<std::size_t>(1, edges_.size()));
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (start_[n] < start_[n + 1]) give(own_nodes_[at(round_[at(start_[n])])], static_cast<int>(n));
}

int ContactSkin::edge_between(int a, int b) const {
  const auto before = [](const Edge& edge, const std::array<int, 2>& ends) { return edge.ends < ends; };
  return static_cast<int>(std::lower_bound(edges_.begin(), edges_.end(), std::array<int, 2>{a, b}, before) -
                          edges_.begin());
}

int ContactSkin::index_of(int node) const {
  return static_cast<int>(std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
}

Vec3 ContactSkin::rest_normal(int face) const {
  const auto [a, b, c] = faces_[at(face)];
  return area_vector(rest_[at(a)], rest_[at(b)], rest_[at(c)]).normalized();
}

const ContactSkin::FaceNow& ContactSkin::face_now(int face) {
  FaceNow& now = faces_now_[at(face)];
  if (now.step == step_) return now;
  const auto [a, b, c] = faces_[at(face)];
  const Vec3 area = area_vector(x_[at(a)], x_[at(b)], x_[at(c)]);
  return now = {step_, area, area.squaredNorm()};
}

const ContactSkin::NodeNow& ContactSkin::node_now(int node) {
  NodeNow& now = nodes_now_[at(node)];
  if (now.step == step_) return now;
  Vec3 sum = Vec3::Zero();
  for (int k = start_[at(node)]; k < start_[at(node) + 1]; ++k) sum += face_now(round_[at(k)]).area;
  return now = {step_, sum, sum.squaredNorm()};
}

/// Height (m) of the element behind a face; not positive where it is inverted.
double ContactSkin::height_behind(int face) {
  const auto& [step, area, square] = face_now(face);
  return area.dot(x_[at(faces_[at(face)][0])] - x_[at(apex_[at(face)])]) / std::sqrt(square);
}

/// Whether an edge is convex.
bool ContactSkin::is_ridge(int edge) {
  EdgeNow& now = edges_now_[at(edge)];
  if (now.step == step_) return now.is_ridge;
  now = {step_, true};
  const auto& [ends, faces] = edges_[at(edge)];
  const FaceNow& face = face_now(faces[0]);
  for (const int k : faces_[at(faces[1])]) {
    if (k == ends[0] || k == ends[1]) continue;
    const Vec3 displacement = x_[at(k)] - x_[at(ends[0])];
    const double square = face.square * displacement.squaredNorm();
    now.is_ridge = now.is_ridge && is_below(face.area.dot(displacement), -flat, square);
  }
  return now.is_ridge;
}

/// What is_ridge() says at all positions within `allowance` (m) of the start. A face turns by at most 2 allowance over
/// its least height, a segment by that over its length; a half more is for terms of higher order.
auto ContactSkin::is_ridge_within(int edge, double allowance) -> Answer {
  const auto& [ends, faces] = edges_[at(edge)];
  const FaceNow& face = face_now(faces[0]);
  const auto [a, b, c] = faces_[at(faces[0])];
  const double longest =
      std::max({(x_[at(b)] - x_[at(a)]).norm(), (x_[at(c)] - x_[at(b)]).norm(), (x_[at(a)] - x_[at(c)]).norm()});
  const double height = std::sqrt(face.square) / longest;
  Answer answer = Answer::yes;
  for (const int k : faces_[at(faces[1])]) {
    if (k == ends[0] || k == ends[1]) continue;
    const Vec3 displacement = x_[at(k)] - x_[at(ends[0])];
    const double length = displacement.norm();
    const double sine = -face.area.dot(displacement) / (std::sqrt(face.square) * length);
    const double margin = 3 * allowance * (1 / height + 1 / length);
    if (!(allowance < 0.1 * std::min(height, length))) return Answer::unsure;
    if (sine <= flat - margin) return Answer::no;
    if (!(sine >= flat + margin)) answer = Answer::unsure;
  }
  return answer;
}

/// Sine of an edge's bend at the start, positive where it is convex; the least of both where they differ.
double ContactSkin::bend(int edge) {
  const auto& [ends, faces] = edges_[at(edge)];
  const FaceNow& face = face_now(faces[0]);
  double least = 1;
  for (const int k : faces_[at(faces[1])]) {
    if (k == ends[0] || k == ends[1]) continue;
    const Vec3 displacement = x_[at(k)] - x_[at(ends[0])];
    least = std::min(least, -face.area.dot(displacement) / std::sqrt(face.square * displacement.squaredNorm()));
  }
  return least;
}

/// Whether a direction lies between the normals of a ridge's faces.
bool ContactSkin::is_ridge_towards(int edge, const Vec3& normal, double margin) {
  const auto [one, other] = edges_[at(edge)].faces;
  const FaceNow &first = face_now(one), &second = face_now(other);
  const Vec3 n = first.area / std::sqrt(first.square), m = second.area / std::sqrt(second.square);
  const double c = n.dot(m), p = normal.dot(n), q = normal.dot(m), determinant = 1 - c * c;
  return p - c * q >= -margin * determinant && q - c * p >= -margin * determinant;
}

/// Whether the surface round a node faces a face.
bool ContactSkin::is_facing(int node, int face) {
  const NodeNow& one = node_now(node);
  const FaceNow& other = face_now(face);
  return is_below(one.area.dot(other.area), -facing, one.square * other.square);
}

/// What is_facing() says at all positions within `allowance` (m) of the start, each by its mean displacement at most.
auto ContactSkin::is_facing_within(int node, int face, double allowance) -> Answer {
  const NodeNow& one = node_now(node);
  const FaceNow& other = face_now(face);
  const auto change_of = [&](int f) {  // m², of a face's area vector
    const auto [a, b, c] = faces_[at(f)];
    const double sides = (x_[at(b)] - x_[at(a)]).norm() + (x_[at(c)] - x_[at(a)]).norm();
    return 2 * allowance * (sides + 2 * allowance);
  };
  double change = 0;
  for (int k = start_[at(node)]; k < start_[at(node) + 1]; ++k) change += change_of(round_[at(k)]);
  const double cosine = one.area.dot(other.area) / std::sqrt(one.square * other.square);
  const double margin = 2 * (change / std::sqrt(one.square) + change_of(face) / std::sqrt(other.square));
  if (cosine <= -facing - margin) return Answer::yes;
  return cosine >= -facing + margin ? Answer::no : Answer::unsure;
}

int ContactSkin::side_at_rest(int first, int second) const {
  const Edge &one = edges_[at(first)], &other = edges_[at(second)];
  const Vec3 u = rest_[at(one.ends[1])] - rest_[at(one.ends[0])];
  const Vec3 v = rest_[at(other.ends[1])] - rest_[at(other.ends[0])];
  return u.cross(v).dot(rest_normal(other.faces[0]) + rest_normal(other.faces[1])) > 0 ? 1 : -1;
}

/// As side_at_rest(), at the start.
int ContactSkin::side(int first, int second) {
  const Edge &one = edges_[at(first)], &other = edges_[at(second)];
  const Vec3 u = x_[at(one.ends[1])] - x_[at(one.ends[0])], v = x_[at(other.ends[1])] - x_[at(other.ends[0])];
  const FaceNow &left = face_now(other.faces[0]), &right = face_now(other.faces[1]);
  const Vec3 N = u.cross(v);
  return N.dot(left.area) / std::sqrt(left.square) + N.dot(right.area) / std::sqrt(right.square) > 0 ? 1 : -1;
}

std::size_t ContactSkin::bytes() const {
  return bytes_of(nodes_, body_, bodies_, rest_, faces_, apex_, edges_, start_, round_, own_nodes_, own_edges_) +
         bytes_of(nodes_now_, faces_now_, edges_now_, x_);
}

}  // namespace heml
