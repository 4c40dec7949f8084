#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <heml/tools/contact_travel.hpp>

namespace heml {
namespace {

std::size_t at(int n) { return static_cast<std::size_t>(n); }

bool is_one_body(const ContactSkin& skin, const std::array<int, 4>& nodes) {
  return skin.body_of(nodes[0]) == skin.body_of(nodes[3]);
}

/// Of the nodes of a body, m.
Vec3 mean_displacement(const std::vector<int>& body, const ContactSkin::Positions& from,
                       const ContactSkin::Positions& to) {
  Vec3 sum = Vec3::Zero();
  for (const int n : body) sum += to[at(n)] - from[at(n)];
  return sum / static_cast<double>(body.size());
}

/// The means of bodies against each other: half the way between the farthest corners of a box round them.
double half_apart(const Eigen::AlignedBox3d& means) { return means.diagonal().norm() / 2; }

}  // namespace

double ContactTravel::largest() const {
  double most = 0;
  for (const double one : of_node) most = std::max(most, one);
  return most + of_bodies;
}

bool ContactTravel::is_within(const ContactTravel& most) const {
  if (of_node.empty() || of_node.size() != most.of_node.size() || !(of_bodies <= most.of_bodies)) return false;
  for (std::size_t n = 0; n < of_node.size(); ++n)
    if (!(of_node[n] <= most.of_node[n])) return false;
  return true;
}

void ContactTravel::extend(const ContactTravel& other) {
  for (std::size_t n = 0; n < of_node.size(); ++n) of_node[n] = std::max(of_node[n], other.of_node[n]);
  of_bodies = std::max(of_bodies, other.of_bodies);
}

void ContactTravel::add(const ContactTravel& other, double factor) {
  for (std::size_t n = 0; n < of_node.size(); ++n) of_node[n] += factor * other.of_node[n];
  of_bodies += factor * other.of_bodies;
}

void ContactTravel::reduce(const ContactTravel& most) {
  for (std::size_t n = 0; n < of_node.size(); ++n) of_node[n] = std::min(of_node[n], most.of_node[n]);
  of_bodies = std::min(of_bodies, most.of_bodies);
}

double ContactTravel::of_pair(const ContactSkin& skin, const std::array<int, 4>& nodes, bool edges) const {
  const auto of = [&](std::size_t k) { return of_node[at(nodes[k])]; };
  const double first = edges ? std::max(of(0), of(1)) : of(0);
  const double second = edges ? std::max(of(2), of(3)) : std::max({of(1), of(2), of(3)});
  return (first + second) / 2 + (is_one_body(skin, nodes) ? 0 : of_bodies);
}

double ContactTravel::of_each(const ContactSkin& skin, const std::array<int, 4>& nodes) const {
  double most = 0;
  for (const int n : nodes) most = std::max(most, of_node[at(n)]);
  return most + (is_one_body(skin, nodes) ? 0 : of_bodies);
}

ContactTravel travel_between(const ContactSkin& skin, const ContactSkin::Positions& from,
                             const ContactSkin::Positions& to) {
  if (from.size() != to.size()) return {};
  ContactTravel result{std::vector<double>(from.size()), 0};
  Eigen::AlignedBox3d means;
  for (const std::vector<int>& body : skin.bodies()) {
    const Vec3 mean = mean_displacement(body, from, to);
    for (const int n : body) result.of_node[at(n)] = (to[at(n)] - from[at(n)] - mean).norm();
    means.extend(mean);
  }
  if (skin.bodies().size() > 1) result.of_bodies = half_apart(means);
  return result;
}

std::optional<double> travel_within(const ContactSkin& skin, const ContactSkin::Positions& from,
                                    const ContactSkin::Positions& to, const ContactTravel& most) {
  if (from.size() != to.size() || from.size() != most.of_node.size() || from.empty()) return std::nullopt;
  double largest = 0;
  Eigen::AlignedBox3d means;
  for (const std::vector<int>& body : skin.bodies()) {
    const Vec3 mean = mean_displacement(body, from, to);
    for (const int n : body) {
      const double square = (to[at(n)] - from[at(n)] - mean).squaredNorm();
      if (!(square <= most.of_node[at(n)] * most.of_node[at(n)])) return std::nullopt;
      largest = std::max(largest, square);
    }
    means.extend(mean);
  }
  const double apart = skin.bodies().size() > 1 ? half_apart(means) : 0;
  if (!(apart <= most.of_bodies)) return std::nullopt;
  return std::sqrt(largest) + apart;
}

std::vector<double> with_neighbours(const ContactSkin& skin, const std::vector<double>& of_node) {
  std::vector<double> result = of_node;
  for (const auto& [a, b, c] : skin.faces()) {
    const double most = std::max({of_node[at(a)], of_node[at(b)], of_node[at(c)]});
    for (const int n : {a, b, c}) result[at(n)] = std::max(result[at(n)], most);
  }
  return result;
}

}  // namespace heml
