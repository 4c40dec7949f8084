#include <algorithm>
#include <cmath>
#include <heml/math/bytes.hpp>
#include <heml/tools/self_contact.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double still_ridge = -0.02, still_out = 0.3;  // bend (sine) and margin of normals of edges that bear
constexpr double still_within = 0.1;                    // of a face that bears: how far the crossing may be outside
constexpr double parallel = 0.3;         // sine: edges closer to parallel are left to node and face pairs
constexpr double max_penetration = 0.5;  // of an element's height: deeper pairs did not enter through this face

std::size_t at(int n) { return static_cast<std::size_t>(n); }

std::array<Vec3, 4> between(const std::array<Vec3, 4>& a, const std::array<Vec3, 4>& b, double t) {
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = a[k] + t * (b[k] - a[k]);
  return x;
}

}  // namespace

SelfContact::SelfContact(const SelfContactSettings& settings, const TetMesh& mesh)
    : friction_(settings.friction),
      within_bodies_(settings.within_bodies),
      skin_(mesh),
      edge_(skin_.mean_edge()),
      to_(skin_.nodes().size()) {
  for (const Triangle& face : skin_.faces()) body_of_face_.push_back(skin_.body_of(face[0]));
}

void SelfContact::find(const std::vector<ContactPair>& held) {
  contacts_.clear();
  points_.clear();
  const auto is_finite = [](const Positions& places) {
    return std::all_of(places.begin(), places.end(), [](const Vec3& x) { return x.allFinite(); });
  };
  if (to_.empty() || !is_finite(skin_.x()) || !is_finite(to_)) return;  // the step detects the failure itself
  find_contacts();
  add_held(held);
}

/// Finds the contacts among the candidates that serve this step.
void SelfContact::find_contacts() {
  if (const auto moved = travel_awake()) return test(awake_, reach_of(*moved));
  ContactTravel moved = travelled(filtered_.reference);
  moved.extend(travel_between(skin_, filtered_.reference, to_));
  if (!moved.is_within(filtered_.allowance) || woken_steps_ > lasting) {
    moved = travel_between(skin_, skin_.x(), to_);
    if (is_long(moved)) {
      if (!is_swept()) sweep();
      return test(swept_.candidates, 0);
    }
    update_candidates(moved);
  }
  wake_candidates(moved);
  test(awake_, reach_of(moved.largest()));
}

/// How far nodes have moved since the filter, m, where the awake candidates serve this step.
std::optional<double> SelfContact::travel_awake() {
  if (++woken_steps_ > lasting) return std::nullopt;
  const auto before = travel_within(skin_, filtered_.reference, skin_.x(), awake_travel_);
  if (!before) return std::nullopt;
  const auto after = travel_within(skin_, filtered_.reference, to_, awake_travel_);
  if (!after || !travel_within(skin_, woken_.reference, skin_.x(), woken_.allowance)) return std::nullopt;
  return std::max(*before, *after);
}

void SelfContact::test(const std::vector<AwakeCandidate>& candidates, double reach) {
  for (const auto& [distance, nodes, candidate, is_certain] : candidates) {
    ++tested_count_;
    if (distance > reach || !(is_certain || can_meet(candidate))) continue;
    ContactPair pair{nodes, side_of(candidate)};
    const auto crossing = crossing_if_met(candidate, pair);
    if (!crossing) continue;
    for (int& n : pair.nodes) n = skin_.nodes()[at(n)];
    contacts_.push_back(pair);
    points_.push_back(point_of(pair, *crossing));
  }
}

/// Adds pairs that have borne a load and have lost nothing but the bend of their edges, or lie just beside their face.
/// A load flattens ridges and shifts nodes; if that ended their contact, they would fall in and be pushed out in turn,
/// step by step.
void SelfContact::add_held(const std::vector<ContactPair>& held) {
  const std::size_t found = contacts_.size();
  for (const ContactPair& pair : held) {
    const auto end = contacts_.begin() + static_cast<std::ptrdiff_t>(found);
    const auto place = std::lower_bound(contacts_.begin(), end, pair);
    if (place != end && *place == pair) continue;
    std::array<int, 4> local;
    for (std::size_t k = 0; k < 4; ++k) local[k] = skin_.index_of(pair.nodes[k]);
    const std::array<Vec3, 4> from{skin_.x()[at(local[0])], skin_.x()[at(local[1])], skin_.x()[at(local[2])],
                                   skin_.x()[at(local[3])]};
    const auto crossing = crossing_of(pair.side, from);
    if (!crossing || crossing->gap() > touch_gap * edge_) continue;
    if (pair.side == 0) {
      if (!crossing->is_within(0, still_within)) continue;
      contacts_.push_back(pair);
      points_.push_back(point_of(pair, *crossing));
      continue;
    }
    const Candidate candidate{true, skin_.edge_between(local[0], local[1]), skin_.edge_between(local[2], local[3])};
    if (!crossing->is_within(pair.side, slack)) continue;
    if (skin_.bend(candidate.first) < still_ridge || skin_.bend(candidate.second) < still_ridge) continue;
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

/// The nodes of a candidate's pair, by indices into nodes_.
std::array<int, 4> SelfContact::nodes_of(const Candidate& candidate) const {
  if (!candidate.edges) {
    const auto [a, b, c] = skin_.faces()[at(candidate.second)];
    return {candidate.first, a, b, c};
  }
  const auto [a, b] = skin_.edges()[at(candidate.first)].ends;
  const auto [c, d] = skin_.edges()[at(candidate.second)].ends;
  return {a, b, c, d};
}

/// Of a pair of edges, as ContactPair::side, at the step's start; else 0.
int SelfContact::side_of(const Candidate& candidate) {
  return candidate.edges ? skin_.side(candidate.first, candidate.second) : 0;
}

/// Whether the surfaces face each other, or both edges are convex: all that positions at the step's start decide, asked
/// first, since most pairs of edges on flat surfaces at rest on each other end here.
bool SelfContact::can_meet(const Candidate& candidate) {
  if (candidate.edges) return skin_.is_ridge(candidate.first) && skin_.is_ridge(candidate.second);
  return skin_.is_facing(candidate.first, candidate.second);
}

/// Of a candidate that can meet: its crossing at skin_.x(), if it touches there or on the way to to_.
std::optional<PairCrossing> SelfContact::crossing_if_met(const Candidate& candidate, const ContactPair& pair) {
  const auto places = [&pair](const Positions& x) -> std::array<Vec3, 4> {
    const auto [a, b, c, d] = pair.nodes;
    return {x[at(a)], x[at(b)], x[at(c)], x[at(d)]};
  };
  const std::array<Vec3, 4> from = places(skin_.x());
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
  if (!candidate.edges) return skin_.height_behind(candidate.second);
  double least = std::numeric_limits<double>::infinity();
  for (const int edge : {candidate.first, candidate.second})
    for (const int face : skin_.edges()[at(edge)].faces) least = std::min(least, skin_.height_behind(face));
  return least;
}

/// Whether edges are far enough from parallel, and their normal lies between those of the faces of both.
bool SelfContact::is_out_of_both(const Candidate& candidate, const std::array<Vec3, 4>& from, const PairCrossing& first,
                                 double margin) {
  const Vec3 u = from[1] - from[0], v = from[3] - from[2];
  if (first.square < parallel * parallel * u.squaredNorm() * v.squaredNorm()) return false;
  const Vec3 normal = first.normal / std::sqrt(first.square);
  return skin_.is_ridge_towards(candidate.first, -normal, margin) &&
         skin_.is_ridge_towards(candidate.second, normal, margin);
}

std::size_t SelfContact::bytes() const {
  return skin_.bytes() +
         bytes_of(body_of_face_, to_, searched_.reference, filtered_.reference, broad_candidates_, candidates_) +
         bytes_of(awake_, woken_.reference, swept_.from, swept_.boxes, swept_.candidates, contacts_, points_) +
         bytes_of(searched_.allowance.of_node, filtered_.allowance.of_node, woken_.allowance.of_node,
                  awake_travel_.of_node);
}

}  // namespace heml
