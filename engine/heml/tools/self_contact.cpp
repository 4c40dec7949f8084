#include <algorithm>
#include <cmath>
#include <cstdint>
#include <heml/math/bytes.hpp>
#include <heml/math/closest.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/tools/self_contact.hpp>
#include <limits>
#include <tuple>

namespace heml {
namespace {

constexpr double touch_gap = 1e-3;  // of an edge: nearer pairs count as touching, since a step may push them together
constexpr double slack = 0.01;      // of a face or an edge: margin outside it, so that nothing slips between neighbours
constexpr double beside = 0.25;     // of a face or an edge: margin within which overlapping pairs stay candidates
constexpr double min_allowance = 0.15, max_allowance = 1;  // of an edge
constexpr double min_sifted = 0.02, max_sifted = 0.15;     // of an edge
constexpr double min_woken = 1e-4, max_woken = 0.05;       // of an edge
constexpr int brief = 32, lasting = 512;                   // steps between which candidates stay awake
constexpr double search_steps = 16, filter_steps = 8;      // as long as this one: for which candidates are found
constexpr double same_overlap = 1e-6;                      // of an edge: smaller overlaps at rest are round-off
constexpr double facing = 0.1;                             // cosine, minimum between two surfaces that face each other
constexpr double flat = 0.02;                              // sine: edges with a smaller bend are no ridges
constexpr double still_ridge = -0.02, still_out = 0.3;     // the same, and the margin of normals, of pairs that bear
constexpr double parallel = 0.3;         // sine: edges closer to parallel are left to node and face pairs
constexpr double max_penetration = 0.5;  // of an element's height: deeper pairs did not enter through this face

std::size_t at(int n) { return static_cast<std::size_t>(n); }

/// Whether a / √square < threshold, where the threshold is negative.
bool is_below(double a, double threshold, double square) { return a < 0 && a * a > threshold * threshold * square; }

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

/// Whether a pair's weights are those of points within the face or both edges, up to a margin.
bool is_within(const ContactPair& pair, const ContactPoint& point, double by = slack) {
  const auto& w = point.weights;
  if (pair.side == 0) return w[1] <= by && w[2] <= by && w[3] <= by;
  return w[0] >= -by && w[1] >= -by && w[2] <= by && w[3] <= by;
}

std::array<Vec3, 4> between(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b, double t) {
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = a[k] + t * (b[k] - a[k]);
  return x;
}

}  // namespace

SelfContact::SelfContact(const SelfContactSettings& settings, const TetMesh& mesh) : friction_(settings.friction) {
  set_rest(mesh);
  make_edges();
  nodes_now_.resize(nodes_.size());
  faces_now_.resize(faces_.size());
  edges_now_.resize(edges_.size());
  from_.resize(nodes_.size());
  to_.resize(nodes_.size());
}

void SelfContact::set_rest(const TetMesh& mesh) {
  const BoundaryFaces boundary = extract_boundary(mesh);
  for (std::size_t f = 0; f < boundary.triangles.size(); ++f) {
    const Tet& tet = mesh.tets[at(boundary.tets[f])];
    nodes_.insert(nodes_.end(), tet.begin(), tet.end());
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  const auto number = [this](int n) {
    return static_cast<int>(std::lower_bound(nodes_.begin(), nodes_.end(), n) - nodes_.begin());
  };
  for (const int n : nodes_) rest_.push_back(mesh.nodes[at(n)]);
  for (std::size_t f = 0; f < boundary.triangles.size(); ++f) {
    const Triangle& face = boundary.triangles[f];
    faces_.push_back({number(face[0]), number(face[1]), number(face[2])});
    for (const int n : mesh.tets[at(boundary.tets[f])])
      if (std::find(face.begin(), face.end(), n) == face.end()) apex_.push_back(number(n));
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

void SelfContact::make_edges() {
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
  edge_ = length / static_cast<double>(std::max<std::size_t>(1, edges_.size()));
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (start_[n] < start_[n + 1]) give(own_nodes_[at(round_[at(start_[n])])], static_cast<int>(n));
}

void SelfContact::find(const std::vector<ContactPair>& held) {
  contacts_.clear();
  points_.clear();
  ++step_count_;
  const auto is_finite = [](const Positions& places) {
    return std::all_of(places.begin(), places.end(), [](const Vec3& x) { return x.allFinite(); });
  };
  if (!is_finite(from_) || !is_finite(to_)) return;  // the step detects the failure itself
  double moved = std::max(spread(filtered_.reference, from_), spread(filtered_.reference, to_));
  if (!(moved <= filtered_.allowance) || woken_steps_ > lasting) {
    update_candidates();
    moved = spread(from_, to_);
  }
  const double reach = reach_of(moved);
  if (!(reach <= awake_reach_ && spread(woken_.reference, from_) <= woken_.allowance)) wake_candidates(moved);
  ++woken_steps_;
  for (const auto& [distance, nodes, candidate, is_certain] : awake_) {
    ++tested_count_;
    if (distance > reach || !(is_certain || can_meet(candidate))) continue;
    ContactPair pair{nodes, candidate.edges ? side_now(candidate) : 0};
    const auto crossing = crossing_if_met(candidate, pair);
    if (!crossing) continue;
    for (int& n : pair.nodes) n = nodes_[at(n)];
    contacts_.push_back(pair);
    points_.push_back(point_of(pair, *crossing));
  }
  add_held(held);
}

/// Adds pairs of edges that have borne a load and have lost nothing but their bend. A load flattens ridges; if that
/// ended their contact, they would fall in and be pushed out in turn, step by step.
void SelfContact::add_held(const std::vector<ContactPair>& held) {
  const std::size_t found = contacts_.size();
  for (const ContactPair& pair : held) {
    if (pair.side == 0) continue;
    const auto end = contacts_.begin() + static_cast<std::ptrdiff_t>(found);
    const auto place = std::lower_bound(contacts_.begin(), end, pair);
    if (place != end && *place == pair) continue;
    std::array<int, 4> local;
    for (std::size_t k = 0; k < 4; ++k)
      local[k] = static_cast<int>(std::lower_bound(nodes_.begin(), nodes_.end(), pair.nodes[k]) - nodes_.begin());
    const auto edge_of = [this](int a, int b) {
      const auto before = [](const Edge& edge, const std::array<int, 2>& ends) { return edge.ends < ends; };
      return static_cast<int>(std::lower_bound(edges_.begin(), edges_.end(), std::array<int, 2>{a, b}, before) -
                              edges_.begin());
    };
    const Candidate candidate{true, edge_of(local[0], local[1]), edge_of(local[2], local[3])};
    const std::array<Vec3, 4> from{from_[at(local[0])], from_[at(local[1])], from_[at(local[2])],
                                   from_[at(local[3])]};
    const auto crossing = crossing_of(pair.side, from);
    if (!crossing || !crossing->is_within(pair.side, slack) || crossing->gap() > touch_gap * edge_) continue;
    if (bend_now(candidate.first) < still_ridge || bend_now(candidate.second) < still_ridge) continue;
    if (!is_out_of_both(candidate, from, *crossing, still_out)) continue;
    if (crossing->height < 0 && -crossing->gap() >= max_penetration * height_behind(candidate)) continue;
    contacts_.push_back(pair);
    points_.push_back(point_of(pair, *crossing));
  }
  for (std::size_t i = found; i < contacts_.size(); ++i)
    for (std::size_t k = i; k > 0 && contacts_[k] < contacts_[k - 1]; --k) {
      std::swap(contacts_[k], contacts_[k - 1]);
      std::swap(points_[k], points_[k - 1]);
    }
}

/// Sine of an edge's bend at from_, positive where it is convex; the least of both where they differ.
double SelfContact::bend_now(int edge) {
  const auto& [ends, faces] = edges_[at(edge)];
  const FaceNow& face = face_now(faces[0]);
  double least = 1;
  for (const int k : faces_[at(faces[1])]) {
    if (k == ends[0] || k == ends[1]) continue;
    const Vec3 displacement = from_[at(k)] - from_[at(ends[0])];
    least = std::min(least, -face.area.dot(displacement) / std::sqrt(face.square * displacement.squaredNorm()));
  }
  return least;
}

/// Largest displacement of a node from the reference, less the mean displacement, m. Infinite without a reference.
double SelfContact::spread(const Positions& reference, const Positions& x) const {
  if (reference.size() != x.size()) return std::numeric_limits<double>::infinity();
  Vec3 mean = Vec3::Zero();
  for (std::size_t n = 0; n < x.size(); ++n) mean += x[n] - reference[n];
  mean /= static_cast<double>(x.size());
  double max_square = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    max_square = std::max(max_square, (x[n] - reference[n] - mean).squaredNorm());
  return std::sqrt(max_square);
}

/// Filters the broad candidates, or finds them again where this step leaves what they are valid for. The filter's
/// allowance ends where that of the broad phase does, so find() need not check both.
void SelfContact::update_candidates() {
  const double step = spread(from_, to_);
  if (!std::isfinite(step)) {  // of a body about to leave the range of numbers, which meets nothing on its way
    candidates_.clear();
    filtered_ = {};
    awake_reach_ = 0;
    return;
  }
  if (!(spread(searched_.reference, from_) + 1.5 * step <= searched_.allowance)) broad_phase(step);
  filter_candidates(step);
}

/// Distance (m) within which pairs can touch while each node moves by at most `allowance`.
double SelfContact::reach_of(double allowance) const { return 2 * allowance + (touch_gap + 4 * slack) * edge_; }

/// Collects pairs of faces that share a grid cell, each once: in the cell of the lower corner of their boxes'
/// intersection.
void SelfContact::broad_phase(double step) {
  ++broad_phase_count_;
  searched_.reference = from_;
  searched_.allowance =
      std::max(1.5 * step, std::clamp(search_steps * step, min_allowance * edge_, max_allowance * edge_));
  const double reach = reach_of(searched_.allowance);
  broad_candidates_.clear();
  std::vector<Eigen::AlignedBox3d> boxes(faces_.size());
  Eigen::AlignedBox3d all;
  double size = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (const int n : faces_[f]) boxes[f].extend(from_[at(n)]);
    const Vec3 more = Vec3::Constant(reach / 2);
    boxes[f] = Eigen::AlignedBox3d(boxes[f].min() - more, boxes[f].max() + more);
    all.extend(boxes[f]);
    size += boxes[f].sizes().maxCoeff() / static_cast<double>(faces_.size());
  }
  constexpr double max_cells = 1 << 20;  // in each direction
  const double cell = std::max(size, all.sizes().maxCoeff() / max_cells);
  const auto cell_of = [&](const Vec3& x) -> Eigen::Vector3i {
    return ((x - all.min()) / cell).array().floor().cast<int>();
  };
  const auto key_of = [](const Eigen::Vector3i& c) {
    return (static_cast<std::uint64_t>(c[0]) << 42) | (static_cast<std::uint64_t>(c[1]) << 21) |
           static_cast<std::uint64_t>(c[2]);
  };
  std::vector<std::pair<std::uint64_t, int>> entries;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Eigen::Vector3i low = cell_of(boxes[f].min()), high = cell_of(boxes[f].max());
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k) entries.emplace_back(key_of({i, j, k}), static_cast<int>(f));
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t first = 0, last; first < entries.size(); first = last) {
    for (last = first; last < entries.size() && entries[last].first == entries[first].first;) ++last;
    for (std::size_t p = first; p < last; ++p)
      for (std::size_t q = p + 1; q < last; ++q) {
        const auto &one = boxes[at(entries[p].second)], &other = boxes[at(entries[q].second)];
        if (!one.intersects(other) || key_of(cell_of(one.min().cwiseMax(other.min()))) != entries[p].first) continue;
        add_candidates(entries[p].second, entries[q].second, reach);
      }
  }
  std::sort(broad_candidates_.begin(), broad_candidates_.end());
}

void SelfContact::add_candidates(int one, int other, double reach) {
  for (const int n : own_nodes_[at(one)])
    if (n >= 0) add_node_candidates(n, other, reach);
  for (const int n : own_nodes_[at(other)])
    if (n >= 0) add_node_candidates(n, one, reach);
  for (const int e : own_edges_[at(one)])
    for (const int d : own_edges_[at(other)])
      if (e >= 0 && d >= 0) add_edge_candidates(std::min(e, d), std::max(e, d), reach);
}

void SelfContact::add_node_candidates(int node, int face, double reach) {
  const Triangle& corners = faces_[at(face)];
  if (std::find(corners.begin(), corners.end(), node) != corners.end()) return;
  if (squared_distance({false, node, face}) > reach * reach) return;
  // A pair that overlaps at rest is no contact.
  const ContactPair pair{{node, corners[0], corners[1], corners[2]}, 0};
  const auto at_rest = point_of(pair, [this](int n) { return rest_[at(n)]; });
  if (at_rest && at_rest->gap < -same_overlap * edge_ && is_within(pair, *at_rest)) {
    const Vec3 normal = area_vector(rest_[at(corners[0])], rest_[at(corners[1])], rest_[at(corners[2])]).normalized();
    const double depth = normal.dot(rest_[at(corners[0])] - rest_[at(apex_[at(face)])]);
    if (-at_rest->gap < 2 * depth) return;
  }
  broad_candidates_.push_back({false, node, face});
}

void SelfContact::add_edge_candidates(int one, int other, double reach) {
  const auto [a, b] = edges_[at(one)].ends;
  const auto [c, d] = edges_[at(other)].ends;
  if (a == c || a == d || b == c || b == d) return;
  if (squared_distance({true, one, other}) > reach * reach) return;
  const ContactPair pair{{a, b, c, d}, side_of(edges_[at(one)], edges_[at(other)], rest_)};
  const auto at_rest = point_of(pair, [this](int n) { return rest_[at(n)]; });
  if (at_rest && at_rest->gap < -same_overlap * edge_ && is_within(pair, *at_rest)) return;
  broad_candidates_.push_back({true, one, other});
}

/// Of the candidate's two primitives with nodes at from_, m².
double SelfContact::squared_distance(const Candidate& candidate) const {
  const auto x = [this](int n) -> const Vec3& { return from_[at(n)]; };
  if (!candidate.edges) {
    const Triangle& corners = faces_[at(candidate.second)];
    const Vec3 &p = x(candidate.first), &a = x(corners[0]), &b = x(corners[1]), &c = x(corners[2]);
    const auto [u, v, w] = closest_point_weights(p, a, b, c);
    return (u * a + v * b + w * c - p).squaredNorm();
  }
  const auto [a, b] = edges_[at(candidate.first)].ends;
  const auto [c, d] = edges_[at(candidate.second)].ends;
  const Vec3 u = x(b) - x(a), v = x(d) - x(c);
  const auto [s, t] = closest_on_segments(x(a), u, x(c), v);
  return (x(a) + s * u - x(c) - t * v).squaredNorm();
}

/// Selects the near pairs that can touch while nodes move far less than the broad phase allows. Overlapping pairs
/// stay, however deep.
void SelfContact::filter_candidates(double step) {
  ++filter_count_;
  filtered_.reference = from_;
  filtered_.allowance =
      std::min(searched_.allowance - spread(searched_.reference, from_),
               std::max(1.5 * step, std::clamp(filter_steps * step, min_sifted * edge_, max_sifted * edge_)));
  const double reach = reach_of(filtered_.allowance);
  candidates_.clear();
  for (const Candidate& candidate : broad_candidates_) {
    const double distance = std::sqrt(squared_distance(candidate));
    const ContactPair pair{nodes_of(candidate), candidate.edges ? side_now(candidate) : 0};
    const auto point = point_of(pair, [this](int n) { return from_[at(n)]; });
    const bool is_behind = point && point->gap < 0;
    const bool overlaps = is_behind && is_within(pair, *point, beside);
    if (distance <= reach || overlaps) candidates_.push_back({is_behind ? 0 : distance, candidate});
  }
  std::sort(candidates_.begin(), candidates_.end());
  awake_reach_ = 0;
}

/// Selects the candidates within reach of little more than the motion so far, except those that positions near those
/// of now rule out. Positions at a step's start may move by as much as makes this worth its time.
void SelfContact::wake_candidates(double moved) {
  awake_reach_ = reach_of(1.2 * moved);
  double allowance = std::max(woken_.allowance, min_woken * edge_);
  if (woken_steps_ < brief) allowance = std::min(2 * allowance, max_woken * edge_);
  if (woken_steps_ > lasting) allowance = std::max(allowance / 4, min_woken * edge_);
  woken_ = {from_, allowance};
  woken_steps_ = 0;
  // Of starts and ends, from from_.
  const double all_motion = allowance + 1.2 * moved + spread(filtered_.reference, from_);
  awake_.clear();
  for (const auto& [distance, candidate] : candidates_) {
    if (distance > awake_reach_) break;
    const Answer answer = can_meet_within(candidate, allowance);
    const AwakeCandidate awake{distance, nodes_of(candidate), candidate, answer == Answer::yes};
    if (answer != Answer::no && !is_outside_within(awake, all_motion)) awake_.push_back(awake);
  }
  std::sort(awake_.begin(), awake_.end(),
            [](const AwakeCandidate& a, const AwakeCandidate& b) { return a.nodes < b.nodes; });
}

/// What can_meet() says at all positions within `allowance` (m) of from_, each by its mean displacement at most.
auto SelfContact::can_meet_within(const Candidate& candidate, double allowance) -> Answer {
  if (candidate.edges) {
    const Answer one = is_ridge_within(candidate.first, allowance);
    const Answer other = is_ridge_within(candidate.second, allowance);
    if (one == Answer::no || other == Answer::no) return Answer::no;
    return one == Answer::yes && other == Answer::yes ? Answer::yes : Answer::unsure;
  }
  const NodeNow& node = node_now(candidate.first);
  const FaceNow& face = face_now(candidate.second);
  const auto change_of = [&](int f) {  // m², of a face's area vector
    const auto [a, b, c] = faces_[at(f)];
    const double sides = (from_[at(b)] - from_[at(a)]).norm() + (from_[at(c)] - from_[at(a)]).norm();
    return 2 * allowance * (sides + 2 * allowance);
  };
  double change = 0;
  for (int k = start_[at(candidate.first)]; k < start_[at(candidate.first) + 1]; ++k)
    change += change_of(round_[at(k)]);
  const double cosine = node.area.dot(face.area) / std::sqrt(node.square * face.square);
  const double margin =
      2 * (change / std::sqrt(node.square) + change_of(candidate.second) / std::sqrt(face.square));
  if (cosine <= -facing - margin) return Answer::yes;
  return cosine >= -facing + margin ? Answer::no : Answer::unsure;
}

/// What is_ridge_now() says at all positions within `allowance` (m) of from_. A face turns by at most 2 allowance over
/// its least height, a segment by that over its length; a half more is for terms of higher order.
auto SelfContact::is_ridge_within(int edge, double allowance) -> Answer {
  const auto& [ends, faces] = edges_[at(edge)];
  const FaceNow& face = face_now(faces[0]);
  const auto [a, b, c] = faces_[at(faces[0])];
  const double longest = std::max({(from_[at(b)] - from_[at(a)]).norm(), (from_[at(c)] - from_[at(b)]).norm(),
                                   (from_[at(a)] - from_[at(c)]).norm()});
  const double height = std::sqrt(face.square) / longest;
  Answer answer = Answer::yes;
  for (const int k : faces_[at(faces[1])]) {
    if (k == ends[0] || k == ends[1]) continue;
    const Vec3 displacement = from_[at(k)] - from_[at(ends[0])];
    const double length = displacement.norm();
    const double sine = -face.area.dot(displacement) / (std::sqrt(face.square) * length);
    const double margin = 3 * allowance * (1 / height + 1 / length);
    if (!(allowance < 0.1 * std::min(height, length))) return Answer::unsure;
    if (sine <= flat - margin) return Answer::no;
    if (!(sine >= flat + margin)) answer = Answer::unsure;
  }
  return answer;
}

/// Whether the foot of a node is outside its face for all positions within `allowance` (m) of from_.
bool SelfContact::is_outside_within(const AwakeCandidate& awake, double allowance) const {
  if (awake.candidate.edges) return false;
  const auto [a, b, c, d] = awake.nodes;
  const std::array<Vec3, 4> x{from_[at(a)], from_[at(b)], from_[at(c)], from_[at(d)]};
  const auto crossing = crossing_of(0, x);
  if (!crossing) return false;
  const double longest = std::sqrt(std::max({(x[2] - x[1]).squaredNorm(), (x[3] - x[2]).squaredNorm(),
                                             (x[1] - x[3]).squaredNorm()}));
  const double height = std::sqrt(crossing->square) / longest;  // the face's least
  const double away = (x[0] - x[1]).norm() + longest + 2 * allowance;
  // The foot moves against the face's corners by their motion and by the turn of the face times its distance.
  const double margin = 4 * allowance / height * (1 + away / height);
  return allowance < 0.1 * height && !crossing->is_within(0, slack + margin);
}

Vec3 SelfContact::face_normal(int face, const Positions& x) const {
  const auto [a, b, c] = faces_[at(face)];
  return area_vector(x[at(a)], x[at(b)], x[at(c)]).normalized();
}

const SelfContact::FaceNow& SelfContact::face_now(int face) {
  FaceNow& now = faces_now_[at(face)];
  if (now.step == step_count_) return now;
  const auto [a, b, c] = faces_[at(face)];
  const Vec3 area = area_vector(from_[at(a)], from_[at(b)], from_[at(c)]);
  return now = {step_count_, area, area.squaredNorm()};
}

/// Height (m) of the element behind a face; not positive where it is inverted.
double SelfContact::height_now(int face) {
  const auto& [step, area, square] = face_now(face);
  return area.dot(from_[at(faces_[at(face)][0])] - from_[at(apex_[at(face)])]) / std::sqrt(square);
}

const SelfContact::NodeNow& SelfContact::node_now(int node) {
  NodeNow& now = nodes_now_[at(node)];
  if (now.step == step_count_) return now;
  Vec3 sum = Vec3::Zero();
  for (int k = start_[at(node)]; k < start_[at(node) + 1]; ++k) sum += face_now(round_[at(k)]).area;
  return now = {step_count_, sum, sum.squaredNorm()};
}

/// Whether an edge is convex.
bool SelfContact::is_ridge_now(int edge) {
  EdgeNow& now = edges_now_[at(edge)];
  if (now.step == step_count_) return now.is_ridge;
  now = {step_count_, true};
  const auto& [ends, faces] = edges_[at(edge)];
  const FaceNow& face = face_now(faces[0]);
  for (const int k : faces_[at(faces[1])]) {
    if (k == ends[0] || k == ends[1]) continue;
    const Vec3 displacement = from_[at(k)] - from_[at(ends[0])];
    const double square = face.square * displacement.squaredNorm();
    now.is_ridge = now.is_ridge && is_below(face.area.dot(displacement), -flat, square);
  }
  return now.is_ridge;
}

/// Whether a direction lies between the normals of a ridge's faces.
bool SelfContact::is_ridge_towards(int edge, const Vec3& normal, double margin) {
  const auto [one, other] = edges_[at(edge)].faces;
  const FaceNow &first = face_now(one), &second = face_now(other);
  const Vec3 n = first.area / std::sqrt(first.square), m = second.area / std::sqrt(second.square);
  const double c = n.dot(m), p = normal.dot(n), q = normal.dot(m), determinant = 1 - c * c;
  return p - c * q >= -margin * determinant && q - c * p >= -margin * determinant;
}

int SelfContact::side_of(const Edge& one, const Edge& other, const Positions& x) const {
  const Vec3 u = x[at(one.ends[1])] - x[at(one.ends[0])], v = x[at(other.ends[1])] - x[at(other.ends[0])];
  return u.cross(v).dot(face_normal(other.faces[0], x) + face_normal(other.faces[1], x)) > 0 ? 1 : -1;
}

/// As side_of(), at from_.
int SelfContact::side_now(const Candidate& candidate) {
  const Edge &one = edges_[at(candidate.first)], &other = edges_[at(candidate.second)];
  const Vec3 u = from_[at(one.ends[1])] - from_[at(one.ends[0])];
  const Vec3 v = from_[at(other.ends[1])] - from_[at(other.ends[0])];
  const FaceNow &first = face_now(other.faces[0]), &second = face_now(other.faces[1]);
  const Vec3 N = u.cross(v);
  return N.dot(first.area) / std::sqrt(first.square) + N.dot(second.area) / std::sqrt(second.square) > 0 ? 1 : -1;
}

/// The nodes of a candidate's pair, by indices into nodes_.
std::array<int, 4> SelfContact::nodes_of(const Candidate& candidate) const {
  if (!candidate.edges) {
    const auto [a, b, c] = faces_[at(candidate.second)];
    return {candidate.first, a, b, c};
  }
  const auto [a, b] = edges_[at(candidate.first)].ends;
  const auto [c, d] = edges_[at(candidate.second)].ends;
  return {a, b, c, d};
}

/// Whether the surfaces face each other, or both edges are convex: all that positions at the step's start decide, asked
/// first, since most pairs of edges on flat surfaces at rest on each other end here.
bool SelfContact::can_meet(const Candidate& candidate) {
  if (candidate.edges) return is_ridge_now(candidate.first) && is_ridge_now(candidate.second);
  const NodeNow& node = node_now(candidate.first);
  const FaceNow& face = face_now(candidate.second);
  return is_below(node.area.dot(face.area), -facing, node.square * face.square);
}

/// Of a candidate that can meet: its crossing at from_, if it touches there or on the way to to_.
std::optional<PairCrossing> SelfContact::crossing_if_met(const Candidate& candidate, const ContactPair& pair) {
  const auto places = [&pair](const Positions& x) -> std::array<Vec3, 4> {
    const auto [a, b, c, d] = pair.nodes;
    return {x[at(a)], x[at(b)], x[at(c)], x[at(d)]};
  };
  const std::array<Vec3, 4> from = places(from_);
  const auto first = crossing_of(pair.side, from);
  if (!first) return std::nullopt;
  const double near = touch_gap * edge_, height = first->height;
  if (height <= 0 || height * height <= near * near * first->square) {  // touches: most pairs at rest end here
    if (!first->is_within(pair.side, slack)) return std::nullopt;
  } else if (!crosses_later(pair.side, from, places(to_), first->gap())) {
    return std::nullopt;
  }
  if (candidate.edges && !is_out_of_both(candidate, from, *first, slack)) return std::nullopt;
  if (height >= 0 || -first->gap() < max_penetration * height_behind(candidate)) return first;
  return std::nullopt;
}

/// Whether a pair whose gap (m) is open at `from` comes to touch within its face or edges on the way to `to`.
bool SelfContact::crosses_later(int side, const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& to,
                                double gap) const {
  const auto last = crossing_of(side, to);
  if (!last) return false;
  const double then = last->gap();
  if (!(then <= touch_gap * edge_)) return false;
  const auto there = crossing_of(side, between(from, to, then < 0 ? gap / (gap - then) : 1));
  return there && there->is_within(side, slack);
}

/// Least height (m) of the elements behind a candidate's faces; of a node and a face, behind the face.
double SelfContact::height_behind(const Candidate& candidate) {
  if (!candidate.edges) return height_now(candidate.second);
  const Edge &one = edges_[at(candidate.first)], &other = edges_[at(candidate.second)];
  return std::min({height_now(one.faces[0]), height_now(one.faces[1]), height_now(other.faces[0]),
                   height_now(other.faces[1])});
}

/// Whether edges are far enough from parallel, and their normal lies between those of the faces of both.
bool SelfContact::is_out_of_both(const Candidate& candidate, const std::array<Vec3, 4>& from,
                                 const PairCrossing& first, double margin) {
  const Vec3 u = from[1] - from[0], v = from[3] - from[2];
  if (first.square < parallel * parallel * u.squaredNorm() * v.squaredNorm()) return false;
  const Vec3 normal = first.normal / std::sqrt(first.square);
  return is_ridge_towards(candidate.first, -normal, margin) && is_ridge_towards(candidate.second, normal, margin);
}

std::size_t SelfContact::bytes() const {
  return bytes_of(nodes_, rest_, faces_, apex_, edges_, start_, round_, own_nodes_, own_edges_) +
         bytes_of(nodes_now_, faces_now_, edges_now_) +
         bytes_of(from_, to_, searched_.reference, filtered_.reference, broad_candidates_, candidates_) +
         bytes_of(awake_, woken_.reference, contacts_, points_);
}

}  // namespace heml
