// Which pairs are near: broad phase, filter, and those awake (self_contact.hpp).
#include <algorithm>
#include <cmath>
#include <heml/math/box_pairs.hpp>
#include <heml/math/closest.hpp>
#include <heml/tools/self_contact.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double beside = 0.25;  // of a face or an edge: margin within which overlapping pairs stay candidates
constexpr double min_allowance = 0.15, max_allowance = 1;   // of an edge
constexpr double min_filtered = 0.02, max_filtered = 0.15;  // of an edge
constexpr double beside_way = 0.15;                         // of an edge: how far nodes may end beside their way
constexpr double min_woken = 1e-4, max_woken = 0.05;        // of an edge
constexpr int brief = 32;                                   // steps: candidates awake for less are given more room
constexpr double search_steps = 16, filter_steps = 8;       // as long as this one: for which candidates are found
constexpr double wake_steps = 4;                            // and stay awake
constexpr double struck = 0.25;                             // of what the fastest node may move: each may
constexpr double same_overlap = 1e-6;                       // of an edge: smaller overlaps at rest are round-off

std::size_t at(int n) { return static_cast<std::size_t>(n); }

/// Whether a pair's weights are those of points within the face or both edges, up to a margin.
bool is_within(const ContactPair& pair, const ContactPoint& point, double by) {
  const auto& w = point.weights;
  if (pair.side == 0) return w[1] <= by && w[2] <= by && w[3] <= by;
  return w[0] >= -by && w[1] >= -by && w[2] <= by && w[3] <= by;
}

Vec3 mean_displacement(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < from.size(); ++n) sum += to[n] - from[n];
  return sum / static_cast<double>(from.size());
}

Eigen::AlignedBox3d around(const Eigen::AlignedBox3d& box, double margin) {
  const Vec3 more = Vec3::Constant(margin);
  return {box.min() - more, box.max() + more};
}

Eigen::AlignedBox3d box_between(const Vec3& a, const Vec3& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }

template <class Candidates>
void sort_by_pairs(Candidates& candidates) {
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.nodes < b.nodes; });
}

}  // namespace

/// For some steps like this one; least, most: of an edge. What is slow may be struck by what is fast.
auto SelfContact::allowance(const ContactTravel& step, double steps, double least, double most) const -> ContactTravel {
  const auto allowed = [&](double one_step, double at_least) {
    return std::max(1.5 * one_step, std::clamp(steps * one_step, at_least, most * edge_));
  };
  ContactTravel result;
  const double fastest = *std::max_element(step.of_node.begin(), step.of_node.end());
  const double floor = std::clamp(struck * steps * fastest, least * edge_, most * edge_);
  for (const double one_step : step.of_node) result.of_node.push_back(allowed(one_step, floor));
  if (skin_.bodies().size() > 1) result.of_bodies = allowed(step.of_bodies, struck * least * edge_);
  return result;
}

/// Whether a step is so long that the filter would hold for it alone.
bool SelfContact::is_long(const ContactTravel& step) const {
  return 1.5 * step.largest() > max_filtered * edge_ && std::isfinite(step.largest());
}

/// Filters the broad candidates, or finds them again where this step leaves what they are valid for. The filter's
/// allowance ends where that of the broad phase does, so find() need not check both.
void SelfContact::update_candidates(const ContactTravel& step) {
  if (!std::isfinite(step.largest())) {  // of a body about to leave the range of numbers: it meets nothing on its way
    candidates_.clear();
    filtered_ = {};
    awake_travel_ = {};
    return;
  }
  ContactTravel ahead = travelled(searched_.reference);
  if (!ahead.of_node.empty()) ahead.add(step, 1.5);
  if (!ahead.is_within(searched_.allowance)) broad_phase(step);
  filter_candidates(step);
}

/// Distance (m) within which pairs can touch that may move against each other by twice `travel`.
double SelfContact::reach_of(double travel) const { return 2 * travel + (touch_gap + 4 * slack) * edge_; }

void SelfContact::broad_phase(const ContactTravel& step) {
  ++broad_phase_count_;
  searched_ = {skin_.x(), allowance(step, search_steps, min_allowance, max_allowance)};
  const auto box_of = [this](int n) {
    return around(Eigen::AlignedBox3d(skin_.x()[at(n)]), reach_of(searched_.allowance.of_node[at(n)]) / 2);
  };
  const std::vector<Eigen::AlignedBox3d> of_faces = face_boxes(box_of);
  std::vector<Eigen::AlignedBox3d> of_edges;
  for (const auto& edge : skin_.edges()) of_edges.push_back(box_of(edge.ends[0]).merged(box_of(edge.ends[1])));
  const double of_bodies = searched_.allowance.of_bodies;
  const auto faces = intersecting_pairs(of_faces, body_of_face_, of_bodies, within_bodies_);
  collect(faces, broad_candidates_, [&](const Candidate& candidate) {
    const auto& [edges, first, second] = candidate;
    // Of most pairs of faces whose boxes intersect few nodes and edges do.
    const Eigen::AlignedBox3d one = edges ? of_edges[at(first)] : box_of(first);
    if (!are_near(one, edges ? of_edges[at(second)] : of_faces[at(second)], of_bodies)) return false;
    const double reach = reach_of(searched_.allowance.of_pair(skin_, nodes_of(candidate), edges));
    return squared_distance(candidate) <= reach * reach;
  });
}

/// Collects the pairs of a step so long that the filter would hold for it alone: those that can meet, of nodes and
/// elements behind faces whose boxes, from start to end, intersect. They are all while the start is the same and each
/// node ends in its box.
void SelfContact::sweep() {
  ++sweep_count_;
  const Vec3 mean = mean_displacement(skin_.x(), to_);
  swept_.from = skin_.x();
  swept_.boxes.clear();
  for (std::size_t n = 0; n < to_.size(); ++n)
    swept_.boxes.push_back(around(box_between(skin_.x()[n], to_[n] - mean), beside_way * edge_));
  const auto box_of = [this](int node) { return around(swept_.boxes[at(node)], reach_of(0) / 2); };
  std::vector<Eigen::AlignedBox3d> boxes = face_boxes(box_of);
  for (std::size_t f = 0; f < boxes.size(); ++f) boxes[f].extend(box_of(skin_.apex(static_cast<int>(f))));
  const auto is_near = [&](int edge, int other) {  // to the elements behind the other
    const auto& [a, b] = skin_.edges()[at(edge)].ends;
    const auto& [one, two] = skin_.edges()[at(other)].faces;
    return box_of(a).merged(box_of(b)).intersects(boxes[at(one)].merged(boxes[at(two)]));
  };
  std::vector<Candidate> found;
  collect(intersecting_pairs(boxes, body_of_face_, 0, within_bodies_), found, [&](const Candidate& candidate) {
    const auto& [edges, first, second] = candidate;
    if (!can_meet(candidate)) return false;
    return edges ? is_near(first, second) && is_near(second, first) : box_of(first).intersects(boxes[at(second)]);
  });
  swept_.candidates.clear();
  for (const Candidate& candidate : found) swept_.candidates.push_back({0, nodes_of(candidate), candidate, true});
  sort_by_pairs(swept_.candidates);
}

bool SelfContact::is_swept() const {
  if (swept_.from != skin_.x()) return false;
  const Vec3 mean = mean_displacement(skin_.x(), to_);
  for (std::size_t n = 0; n < to_.size(); ++n)
    if (!swept_.boxes[n].contains(to_[n] - mean)) return false;
  return true;
}

template <class BoxOfNode>
std::vector<Eigen::AlignedBox3d> SelfContact::face_boxes(const BoxOfNode& box_of) const {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& [a, b, c] : skin_.faces()) boxes.push_back(box_of(a).merged(box_of(b)).merged(box_of(c)));
  return boxes;
}

/// Finds candidates among pairs of faces, in the order of candidates.
template <class IsNear>
void SelfContact::collect(const std::vector<std::pair<int, int>>& faces, std::vector<Candidate>& candidates,
                          const IsNear& is_near) const {
  candidates.clear();
  const auto add = [&](const Candidate& candidate) {
    if (is_near(candidate) && !overlaps_at_rest(candidate)) candidates.push_back(candidate);
  };
  const auto add_node = [&](int node, int face) {
    const Triangle& corners = skin_.faces()[at(face)];
    if (node >= 0 && std::find(corners.begin(), corners.end(), node) == corners.end()) add({false, node, face});
  };
  const auto add_edges = [&](int one, int other) {
    if (one < 0 || other < 0) return;
    const auto [a, b] = skin_.edges()[at(one)].ends;
    const auto [c, d] = skin_.edges()[at(other)].ends;
    if (a != c && a != d && b != c && b != d) add({true, std::min(one, other), std::max(one, other)});
  };
  for (const auto& [one, other] : faces) {
    for (const int n : skin_.own_nodes(one)) add_node(n, other);
    for (const int n : skin_.own_nodes(other)) add_node(n, one);
    for (const int e : skin_.own_edges(one))
      for (const int d : skin_.own_edges(other)) add_edges(e, d);
  }
  std::sort(candidates.begin(), candidates.end());
}

/// Such a pair is no contact. Edges that turn their backs on each other lie behind each other however far apart they
/// are, so what overlaps is no deeper than the elements behind.
bool SelfContact::overlaps_at_rest(const Candidate& candidate) const {
  const int side = candidate.edges ? skin_.side_at_rest(candidate.first, candidate.second) : 0;
  const ContactPair pair{nodes_of(candidate), side};
  const auto at_rest = point_of(pair, [this](int n) { return skin_.rest()[at(n)]; });
  if (!at_rest || at_rest->gap >= -same_overlap * edge_ || !is_within(pair, *at_rest, slack)) return false;
  const auto height_behind = [this](int face) {
    const Vec3& corner = skin_.rest()[at(skin_.faces()[at(face)][0])];
    return skin_.rest_normal(face).dot(corner - skin_.rest()[at(skin_.apex(face))]);
  };
  double least = height_behind(candidate.edges ? skin_.edges()[at(candidate.first)].faces[0] : candidate.second);
  if (candidate.edges)
    for (const int edge : {candidate.first, candidate.second})
      for (const int face : skin_.edges()[at(edge)].faces) least = std::min(least, height_behind(face));
  return -at_rest->gap < 2 * least;
}

/// Of the candidate's two primitives with nodes at the start, m².
double SelfContact::squared_distance(const Candidate& candidate) const {
  const auto x = [this](int n) -> const Vec3& { return skin_.x()[at(n)]; };
  if (!candidate.edges) {
    const Triangle& corners = skin_.faces()[at(candidate.second)];
    const Vec3 &p = x(candidate.first), &a = x(corners[0]), &b = x(corners[1]), &c = x(corners[2]);
    const auto [u, v, w] = closest_point_weights(p, a, b, c);
    return (u * a + v * b + w * c - p).squaredNorm();
  }
  const auto [a, b] = skin_.edges()[at(candidate.first)].ends;
  const auto [c, d] = skin_.edges()[at(candidate.second)].ends;
  const Vec3 u = x(b) - x(a), v = x(d) - x(c);
  const auto [s, t] = closest_on_segments(x(a), u, x(c), v);
  return (x(a) + s * u - x(c) - t * v).squaredNorm();
}

/// Selects the near pairs that can touch while nodes move far less than the broad phase allows. Overlapping pairs
/// stay, however deep.
void SelfContact::filter_candidates(const ContactTravel& step) {
  ++filter_count_;
  ContactTravel left = searched_.allowance;
  left.add(travelled(searched_.reference), -1);
  filtered_ = {skin_.x(), allowance(step, filter_steps, min_filtered, max_filtered)};
  filtered_.allowance.reduce(left);
  candidates_.clear();
  for (const Candidate& candidate : broad_candidates_) {
    const double distance = std::sqrt(squared_distance(candidate));
    const ContactPair pair{nodes_of(candidate), side_of(candidate)};
    const auto point = point_of(pair, [this](int n) { return skin_.x()[at(n)]; });
    const bool is_behind = point && point->gap < 0;
    const bool overlaps = is_behind && is_within(pair, *point, beside);
    const double reach = reach_of(filtered_.allowance.of_pair(skin_, pair.nodes, candidate.edges));
    if (distance <= reach || overlaps) candidates_.push_back({is_behind ? 0 : distance, candidate});
  }
  std::sort(candidates_.begin(), candidates_.end());
  awake_travel_ = {};
}

/// Selects the candidates within reach of little more than the motion so far, except those that positions near those
/// of now rule out. Positions at a step's start may move by as much as makes this worth its time.
void SelfContact::wake_candidates(const ContactTravel& moved) {
  // A step as those since the last time. Where the next one would end says less: contact will hold it back.
  ContactTravel step{std::vector<double>(moved.of_node.size(), 0), 0};
  if (!woken_.reference.empty()) step.add(travelled(woken_.reference), 1.0 / std::max(1, woken_steps_));
  still_ = std::max(still_, min_woken * edge_);
  if (woken_steps_ < brief) still_ = std::min(2 * still_, max_woken * edge_);
  if (woken_steps_ > lasting) still_ = std::max(still_ / 4, min_woken * edge_);
  woken_steps_ = 0;
  awake_travel_ = moved;
  awake_travel_.add(moved, 0.2);
  awake_travel_.add(step, wake_steps);
  const double least = std::max(struck * moved.largest(), still_);
  for (double& one : awake_travel_.of_node) one = std::max(one, least);
  awake_travel_.of_bodies = std::max(awake_travel_.of_bodies, still_);
  if (!filtered_.reference.empty()) awake_travel_.reduce(filtered_.allowance);
  woken_ = {skin_.x(), allowance(step, wake_steps, still_ / edge_, max_allowance)};
  woken_.allowance.of_bodies = std::max(woken_.allowance.of_bodies, still_);
  ContactTravel all = travelled(filtered_.reference);  // of starts and ends, from the start
  if (!all.of_node.empty()) all.add(awake_travel_), all.add(woken_.allowance);
  const ContactTravel of_surface{with_neighbours(skin_, woken_.allowance.of_node),
                                 0};  // bodies apart ask nothing of it
  const double farthest = reach_of(awake_travel_.largest());
  awake_.clear();
  for (const auto& [distance, candidate] : candidates_) {
    if (distance > farthest) break;
    const std::array<int, 4> nodes = nodes_of(candidate);
    if (distance > reach_of(awake_travel_.of_pair(skin_, nodes, candidate.edges))) continue;
    const Answer answer = can_meet_within(candidate, of_surface.of_each(skin_, nodes));
    const AwakeCandidate awake{distance, nodes, candidate, answer == Answer::yes};
    if (answer != Answer::no && !is_outside_within(awake, all.of_each(skin_, nodes))) awake_.push_back(awake);
  }
  sort_by_pairs(awake_);
}

/// What can_meet() says at all positions within `allowance` (m) of the start, about the mean of each body: it asks how
/// the surface of each lies, not how far they are apart.
auto SelfContact::can_meet_within(const Candidate& candidate, double allowance) -> Answer {
  if (!candidate.edges) return skin_.is_facing_within(candidate.first, candidate.second, allowance);
  const Answer one = skin_.is_ridge_within(candidate.first, allowance);
  const Answer other = skin_.is_ridge_within(candidate.second, allowance);
  if (one == Answer::no || other == Answer::no) return Answer::no;
  return one == Answer::yes && other == Answer::yes ? Answer::yes : Answer::unsure;
}

/// Whether the foot of a node is outside its face for all positions within `allowance` (m) of the start.
bool SelfContact::is_outside_within(const AwakeCandidate& awake, double allowance) const {
  if (awake.candidate.edges) return false;
  const auto [a, b, c, d] = awake.nodes;
  const std::array<Vec3, 4> x{skin_.x()[at(a)], skin_.x()[at(b)], skin_.x()[at(c)], skin_.x()[at(d)]};
  const auto crossing = crossing_of(0, x);
  if (!crossing) return false;
  const double longest =
      std::sqrt(std::max({(x[2] - x[1]).squaredNorm(), (x[3] - x[2]).squaredNorm(), (x[1] - x[3]).squaredNorm()}));
  const double height = std::sqrt(crossing->square) / longest;  // the face's least
  const double away = (x[0] - x[1]).norm() + longest + 2 * allowance;
  // The foot moves against the face's corners by their motion and by the turn of the face times its distance.
  const double margin = 4 * allowance / height * (1 + away / height);
  return allowance < 0.1 * height && !crossing->is_within(0, slack + margin);
}

}  // namespace heml
