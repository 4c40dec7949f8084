// Which pairs are near: broad phase, filter, and those awake (self_contact.hpp).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <heml/math/closest.hpp>
#include <heml/tools/self_contact.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double beside = 0.25;  // of a face or an edge: margin within which overlapping pairs stay candidates
constexpr double min_allowance = 0.15, max_allowance = 1;   // of an edge
constexpr double min_filtered = 0.02, max_filtered = 0.15;  // of an edge
constexpr double min_woken = 1e-4, max_woken = 0.05;        // of an edge
constexpr long tests_per_candidate = 4;                     // after which to find candidates anew is cheap
constexpr int brief = 32;                                   // steps: candidates awake for less are given more room
constexpr double search_steps = 16, filter_steps = 8;       // as long as this one: for which candidates are found
constexpr double same_overlap = 1e-6;                       // of an edge: smaller overlaps at rest are round-off

std::size_t at(int n) { return static_cast<std::size_t>(n); }

/// Whether a pair's weights are those of points within the face or both edges, up to a margin.
bool is_within(const ContactPair& pair, const ContactPoint& point, double by) {
  const auto& w = point.weights;
  if (pair.side == 0) return w[1] <= by && w[2] <= by && w[3] <= by;
  return w[0] >= -by && w[1] >= -by && w[2] <= by && w[3] <= by;
}

}  // namespace

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

/// Whether candidates were found for a step much longer than this one, and have been tested so often that to find them
/// anew costs little beside that: after an impact, say.
bool SelfContact::is_too_wide() {
  if (tests_ < tests_per_candidate * static_cast<long>(broad_candidates_.size())) return false;
  tests_ = 0;
  const double step = spread(skin_.x(), to_);
  return step > 0 && is_far_below(step, filtered_);
}

bool SelfContact::is_far_below(double step, const CandidateSet& set) const {
  return step < set.step / 4 && set.allowance > min_allowance * edge_;
}

/// Filters the broad candidates, or finds them again where this step leaves what they are valid for. The filter's
/// allowance ends where that of the broad phase does, so find() need not check both.
void SelfContact::update_candidates() {
  const double step = spread(skin_.x(), to_);
  if (!std::isfinite(step)) {  // of a body about to leave the range of numbers, which meets nothing on its way
    candidates_.clear();
    filtered_ = {};
    awake_reach_ = 0;
    return;
  }
  if (!(spread(searched_.reference, skin_.x()) + 1.5 * step <= searched_.allowance) || is_far_below(step, searched_))
    broad_phase(step);
  filter_candidates(step);
}

/// Distance (m) within which pairs can touch while each node moves by at most `allowance`.
double SelfContact::reach_of(double allowance) const { return 2 * allowance + (touch_gap + 4 * slack) * edge_; }

/// Collects pairs of faces that share a grid cell, each once: in the cell of the lower corner of their boxes'
/// intersection.
void SelfContact::broad_phase(double step) {
  ++broad_phase_count_;
  searched_.reference = skin_.x();
  searched_.step = step;
  searched_.allowance =
      std::max(1.5 * step, std::clamp(search_steps * step, min_allowance * edge_, max_allowance * edge_));
  const double reach = reach_of(searched_.allowance);
  broad_candidates_.clear();
  std::vector<Eigen::AlignedBox3d> boxes(skin_.faces().size());
  Eigen::AlignedBox3d all;
  double size = 0;
  for (std::size_t f = 0; f < skin_.faces().size(); ++f) {
    for (const int n : skin_.faces()[f]) boxes[f].extend(skin_.x()[at(n)]);
    const Vec3 more = Vec3::Constant(reach / 2);
    boxes[f] = Eigen::AlignedBox3d(boxes[f].min() - more, boxes[f].max() + more);
    all.extend(boxes[f]);
    size += boxes[f].sizes().maxCoeff() / static_cast<double>(skin_.faces().size());
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
  for (std::size_t f = 0; f < skin_.faces().size(); ++f) {
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
  for (const int n : skin_.own_nodes(one))
    if (n >= 0) add_node_candidates(n, other, reach);
  for (const int n : skin_.own_nodes(other))
    if (n >= 0) add_node_candidates(n, one, reach);
  for (const int e : skin_.own_edges(one))
    for (const int d : skin_.own_edges(other))
      if (e >= 0 && d >= 0) add_edge_candidates(std::min(e, d), std::max(e, d), reach);
}

void SelfContact::add_node_candidates(int node, int face, double reach) {
  const Triangle& corners = skin_.faces()[at(face)];
  if (std::find(corners.begin(), corners.end(), node) != corners.end()) return;
  if (squared_distance({false, node, face}) > reach * reach) return;
  // A pair that overlaps at rest is no contact.
  const ContactPair pair{{node, corners[0], corners[1], corners[2]}, 0};
  const auto at_rest = point_of(pair, [this](int n) { return skin_.rest()[at(n)]; });
  if (at_rest && at_rest->gap < -same_overlap * edge_ && is_within(pair, *at_rest, slack)) {
    const double depth = skin_.rest_normal(face).dot(skin_.rest()[at(corners[0])] - skin_.rest()[at(skin_.apex(face))]);
    if (-at_rest->gap < 2 * depth) return;
  }
  broad_candidates_.push_back({false, node, face});
}

void SelfContact::add_edge_candidates(int one, int other, double reach) {
  const auto [a, b] = skin_.edges()[at(one)].ends;
  const auto [c, d] = skin_.edges()[at(other)].ends;
  if (a == c || a == d || b == c || b == d) return;
  if (squared_distance({true, one, other}) > reach * reach) return;
  const ContactPair pair{{a, b, c, d}, skin_.side_at_rest(one, other)};
  const auto at_rest = point_of(pair, [this](int n) { return skin_.rest()[at(n)]; });
  if (at_rest && at_rest->gap < -same_overlap * edge_ && is_within(pair, *at_rest, slack)) return;
  broad_candidates_.push_back({true, one, other});
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
void SelfContact::filter_candidates(double step) {
  ++filter_count_;
  filtered_.reference = skin_.x();
  filtered_.step = step;
  tests_ = 0;
  filtered_.allowance =
      std::min(searched_.allowance - spread(searched_.reference, skin_.x()),
               std::max(1.5 * step, std::clamp(filter_steps * step, min_filtered * edge_, max_filtered * edge_)));
  const double reach = reach_of(filtered_.allowance);
  candidates_.clear();
  for (const Candidate& candidate : broad_candidates_) {
    const double distance = std::sqrt(squared_distance(candidate));
    const ContactPair pair{nodes_of(candidate), side_of(candidate)};
    const auto point = point_of(pair, [this](int n) { return skin_.x()[at(n)]; });
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
  woken_ = {skin_.x(), allowance};
  woken_steps_ = 0;
  // Of starts and ends, from the start.
  const double all_motion = allowance + 1.2 * moved + spread(filtered_.reference, skin_.x());
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

/// What can_meet() says at all positions within `allowance` (m) of the start, each by its mean displacement at most.
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
