#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/tools/contact_impulses.hpp>
#include <heml/tools/contact_motion.hpp>

#include "engine/tools/small_tets.hpp"

namespace heml::contact_impulses_test {

using namespace heml::test;

namespace {

constexpr double h = 0.01;  // s

/// Free nodes that one step is made of, each with a mass.
struct Nodes {
  std::vector<double> before, x, v, inverse_mass;

  void add(const Vec3& place, const Vec3& velocity, double mass) {
    before.insert(before.end(), place.begin(), place.end());
    v.insert(v.end(), velocity.begin(), velocity.end());
    inverse_mass.push_back(mass > 0 ? 1 / mass : 0);
    x.resize(before.size());
    for (std::size_t i = x.size() - 3; i < x.size(); ++i) x[i] = before[i] + (mass > 0 ? h * v[i] : 0);
  }
  int count() const { return static_cast<int>(inverse_mass.size()); }
  Vec3 place(int n) const { return Eigen::Map<const Vec3>(x.data() + 3 * n); }
  Vec3 velocity(int n) const { return Eigen::Map<const Vec3>(v.data() + 3 * n); }
  double mass(int n) const { return 1 / inverse_mass[static_cast<std::size_t>(n)]; }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < count(); ++n)
      if (inverse_mass[static_cast<std::size_t>(n)] > 0) sum += mass(n) * velocity(n);
    return sum;
  }
  double energy() const {
    double sum = 0;
    for (int n = 0; n < count(); ++n)
      if (inverse_mass[static_cast<std::size_t>(n)] > 0) sum += mass(n) / 2 * velocity(n).squaredNorm();
    return sum;
  }
  ContactBoundary boundary() const {
    ContactBoundary all;
    for (int n = 0; n < count(); ++n) all.nodes.push_back(n);
    return all;
  }
};

/// Both halves, with no force on the way.
void step(Contacts& contacts, Nodes& nodes, ContactImpulses<double>& impulses, double time = 0) {
  impulses.begin_tick();
  impulses.first_half_step(contacts, time, time + h, 1, nodes.inverse_mass, nodes.before.data(), nodes.x.data(),
                           nodes.v.data());
}

void end(Contacts& contacts, Nodes& nodes, ContactImpulses<double>& impulses) {
  impulses.second_half_step(contacts, nodes.inverse_mass, nodes.x.data(), nodes.v.data());
}

Vec3 random_unit(std::mt19937_64& random) { return random_rotation(random).col(0); }

/// A face that a ball of radius 1 at `center` pushes into.
struct PressedFace {
  Nodes nodes;
  Contacts contacts;
  PressedFace(const std::array<double, 3>& masses, const Vec3& velocity) {
    const std::array<Vec3, 3> x = {Vec3(-2, -1, -1), Vec3(2, -1, -1), Vec3(0, 3, -1)};
    for (std::size_t k = 0; k < 3; ++k) nodes.add(x[k] - h * velocity / 2, velocity, masses[k]);
    contacts.probe.emplace(1, Vec3::Zero(), 0);
    contacts.probe->go({Vec3::Zero()}, 0, 0);
    contacts.boundary = nodes.boundary();
    contacts.boundary.faces = {{0, 2, 1}};
  }
};

}  // namespace

TEST_CASE("a node that would go below a table ends its step on it, and has no velocity into it then") {
  std::mt19937_64 random(11);
  for (int k = 0; k < 100; ++k) {
    const Vec3 n = random_unit(random), origin = random_vector(random, 1);
    const double mass = uniform(random, 0.1, 5), height = uniform(random, 0, 0.01), speed = uniform(random, 1.01, 3);
    Contacts contacts;
    contacts.tables = {{origin, n, 0}};
    Nodes nodes;
    const Vec3 along = n.cross(random_unit(random));
    nodes.add(origin + height * n + along, -speed * n + along, mass);
    contacts.boundary = nodes.boundary();
    const Vec3 first = nodes.momentum();
    ContactImpulses<double> impulses;
    step(contacts, nodes, impulses);
    CHECK(std::abs(n.dot(nodes.place(0) - origin)) < 1e-15);
    CHECK((nodes.velocity(0) - (along - height / h * n)).norm() < 1e-12);
    end(contacts, nodes, impulses);
    CHECK((nodes.velocity(0) - along).norm() < 1e-12);
    const ContactReport report = contacts.report_of(0);
    CHECK((report.force * h - (nodes.momentum() - first)).norm() < 1e-12);
    CHECK((report.force * h - mass * speed * n).norm() < 1e-12);
    CHECK(report.contact_count == 1);
    CHECK(report.max_penetration < 1e-15);
  }
}

TEST_CASE("a node that does not reach a table, or leaves it, keeps every bit") {
  Contacts contacts;
  contacts.tables = {{Vec3::Zero(), Vec3::UnitY(), 0.5}};
  Nodes nodes;
  nodes.add(Vec3(0, 0.011, 0), Vec3(1, -1, 0), 1);
  nodes.add(Vec3(0, 0, 0), Vec3(1, 0.1, 0), 1);
  nodes.add(Vec3(0, -0.1, 0), Vec3(1, -3, 0), 0);  // held below
  contacts.boundary = nodes.boundary();
  const Nodes first = nodes;
  ContactImpulses<double> impulses;
  step(contacts, nodes, impulses);
  end(contacts, nodes, impulses);
  CHECK(nodes.x == first.x);
  CHECK(nodes.v == first.v);
  CHECK(contacts.report_of(0).force.norm() == 0);
}

TEST_CASE("what lies inside a table from the start comes out over the recovery time, not at once") {
  Contacts contacts;
  contacts.tables = {{Vec3::Zero(), Vec3::UnitY(), 0}};
  Nodes nodes;
  nodes.add(Vec3(0, -0.02, 0), Vec3::Zero(), 2);
  contacts.boundary = nodes.boundary();
  ContactImpulses<double> impulses;
  impulses.begin_tick();
  const double quarter = 0.0025;  // s: a quarter of the 10 ms it takes
  impulses.first_half_step(contacts, 0, quarter, 1, nodes.inverse_mass, nodes.before.data(), nodes.x.data(),
                           nodes.v.data());
  CHECK(nodes.x[1] == doctest::Approx(-0.015));
}

TEST_CASE("friction takes Coulomb's coefficient times the normal impulse of what slides, or all of it") {
  std::mt19937_64 random(12);
  int sticks = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 n = random_unit(random), along = n.cross(random_unit(random)).normalized();
    const double friction = uniform(random, 0, 1.5), normal = uniform(random, 0, 2), sliding = uniform(random, 0, 2);
    Contacts contacts;
    contacts.tables = {{Vec3::Zero(), n, friction}};
    Nodes nodes;
    nodes.add(Vec3::Zero(), sliding * along - normal * n, uniform(random, 0.1, 5));
    contacts.boundary = nodes.boundary();
    const double energy = nodes.energy(), mass = nodes.mass(0);
    ContactImpulses<double> impulses;
    step(contacts, nodes, impulses);
    end(contacts, nodes, impulses);
    const double left = std::max(0.0, sliding - friction * normal);
    CHECK((nodes.velocity(0) - left * along).norm() < 1e-12);
    const Vec3 impulse = h * contacts.report_of(0).force, across = impulse - n.dot(impulse) * n;
    CHECK(across.norm() <= friction * n.dot(impulse) * (1 + 1e-9));
    CHECK((impulse - mass * (normal * n + (left - sliding) * along)).norm() < 1e-12 * mass);
    CHECK(nodes.energy() <= energy);
    sticks += left == 0 ? 1 : 0;
  }
  CHECK(sticks > 20);
  CHECK(sticks < 180);
}

TEST_CASE("a ball pushes the corners of a face by their masses and no further in than its surface") {
  const std::array<double, 3> masses = {0.5, 2, 1};
  const Vec3 velocity(0, 0, 4);  // its plane goes from z = −1.02 to −0.98, and the ball is z > −1 there
  PressedFace face(masses, velocity);
  const Vec3 first = face.nodes.momentum();
  ContactImpulses<double> impulses;
  step(face.contacts, face.nodes, impulses);
  // The foot of the ball's centre on the face: (−2, −1) w₀ + (2, −1) w₁ + (0, 3) w₂ = 0.
  const std::array<double, 3> weights = {0.375, 0.375, 0.25};
  double light = 0;
  for (std::size_t k = 0; k < 3; ++k) light += weights[k] * weights[k] / masses[k];
  const double impulse = 0.02 / h / light;
  // The face turns, so the point is met more than once; the first impulse is nearly all.
  for (int n = 0; n < 3; ++n) {
    const auto k = static_cast<std::size_t>(n);
    CHECK(face.nodes.velocity(n).z() == doctest::Approx(4 - weights[k] * impulse / masses[k]).epsilon(0.02));
  }
  double foot = 0;  // where the plane is below the centre: nearly the nearest point
  for (int n = 0; n < 3; ++n) foot += weights[static_cast<std::size_t>(n)] * face.nodes.place(n).z();
  CHECK(foot < -1 + 1e-3);
  CHECK(foot > -1 - 1e-3);
  end(face.contacts, face.nodes, impulses);
  const ContactReport report = face.contacts.report_of(0);
  CHECK(report.max_penetration <= 2e-6);
  CHECK(report.force.z() < 0);
  CHECK((report.force * h - (face.nodes.momentum() - first)).norm() < 1e-12);
}

TEST_CASE("a probe that goes through tissue in one step pushes it along") {
  Contacts contacts;
  contacts.probe.emplace(0.1, Vec3::Zero(), 0);
  contacts.probe->go({Vec3(0, 0, 0.5), Vec3(0, 0, -5)}, 150, 0);  // 1.5 m, 15 radii, in the step
  Nodes nodes;
  for (const Vec3& X : {Vec3(-2, -1, 0), Vec3(2, -1, 0), Vec3(0, 3, 0)}) nodes.add(X, Vec3::Zero(), 1);
  contacts.boundary = nodes.boundary();
  contacts.boundary.faces = {{0, 2, 1}};
  ContactImpulses<double> impulses;
  step(contacts, nodes, impulses);
  const Vec3 foot = 0.375 * nodes.place(0) + 0.375 * nodes.place(1) + 0.25 * nodes.place(2);
  CHECK(foot.z() < -1);  // the tip is there now
}

TEST_CASE("a thread stops its ends at its length, and what one gets the other loses") {
  Contacts contacts;
  contacts.sutures = {{{0, 1}, 0.5, 0.5, 0, 0}};
  Nodes nodes;
  nodes.add(Vec3(0, 0, 0), Vec3(-3, 0, 1), 1);
  nodes.add(Vec3(0.49, 0, 0), Vec3(2, 0, 0), 3);
  contacts.boundary = nodes.boundary();
  const Vec3 first = nodes.momentum();
  const double energy = nodes.energy();
  ContactImpulses<double> impulses;
  step(contacts, nodes, impulses);
  CHECK((nodes.place(1) - nodes.place(0)).norm() == doctest::Approx(0.5).epsilon(1e-6));
  end(contacts, nodes, impulses);
  CHECK((nodes.momentum() - first).norm() < 1e-12);
  CHECK(nodes.energy() < energy);
  const Vec3 direction = (nodes.place(1) - nodes.place(0)).normalized();
  CHECK(direction.dot(nodes.velocity(1) - nodes.velocity(0)) < 1e-2);  // no longer
}

TEST_CASE("nodes stopped by a table in single precision are below it by round-off alone") {
  Contacts contacts;
  contacts.tables = {{Vec3(0, 0.25, 0), Vec3::UnitY(), 0}};
  contacts.boundary.nodes = {0};
  std::vector<float> before = {0.f, 0.251f, 0.f}, v = {0.f, -1.f, 0.f}, x = {0.f, 0.241f, 0.f};
  const std::vector<float> inverse_mass = {2};
  ContactImpulses<float> impulses;
  impulses.begin_tick();
  impulses.first_half_step(contacts, 0, h, 1, inverse_mass, before.data(), x.data(), v.data());
  CHECK(std::abs(x[1] - 0.25f) <= 1e-7f);
}

namespace {

/// A tetrahedron on another that is held, and a node by itself that falls onto a table far below them, for 300 steps.
/// Returns the most rounds over self-contact pairs in a step, from the tenth on.
int rounds_at_rest(bool has_table) {
  constexpr double dt = 1e-3, g = 9.81;
  TetMesh mesh;
  add_tet(mesh, {Vec3(-3, -3, 0), Vec3(3, -3, 0), Vec3(0, 3, 0), Vec3(0, 0, -2)});
  add_tet(mesh, {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  Contacts contacts;
  contacts.tissue.emplace(SelfContactSettings{0.5}, mesh);
  std::vector<double> before, v(27, 0.0), inverse_mass(9, 1.0);
  for (const Vec3& X : mesh.nodes) before.insert(before.end(), X.begin(), X.end());
  before.insert(before.end(), {0, 0, -5});
  if (has_table) contacts.tables = {{Vec3(0, 0, -5), Vec3::UnitZ(), 0.5}};
  contacts.boundary.nodes = {8};
  for (std::size_t n = 0; n < 4; ++n) inverse_mass[n] = 0;
  const std::vector<double> start = before;
  const Vec3 pull(0.3 * g, 0, -g);  // below the angle of friction
  ContactImpulses<double> impulses;
  int rounds = 0;
  const auto accelerate = [&] {  // as a rigid body that does not turn: all its nodes get the mean velocity
    Vec3 mean = Vec3::Zero();
    for (int n = 4; n < 8; ++n) mean += at(v.data(), n) / 4;
    for (int n = 4; n < 8; ++n) Eigen::Map<Vec3>(v.data() + 3 * n) = mean + dt / 2 * pull;
    v[26] -= dt / 2 * g;
  };
  for (int step = 0; step < 300; ++step) {
    accelerate();
    std::vector<double> x = before;
    for (std::size_t i = 12; i < 27; ++i) x[i] += dt * v[i];
    impulses.begin_tick();
    impulses.first_half_step(contacts, dt * step, dt * (step + 1), 1, inverse_mass, before.data(), x.data(), v.data());
    accelerate();
    impulses.second_half_step(contacts, inverse_mass, x.data(), v.data());
    before = x;
    if (step > 10) rounds = std::max(rounds, contacts.reports.back().rounds);
  }
  CHECK(contacts.reports.back().residual < 0.01);
  CHECK(contacts.tissue->broad_phase_count() == 1);
  for (std::size_t i = 12; i < 21; ++i) CHECK(std::abs(before[i] - start[i]) < 1e-6);  // of the corners that touch
  CHECK(impulses.memory().pairs.size() >= 3);
  if (has_table) CHECK(before[26] == doctest::Approx(-5));
  return rounds;
}

}  // namespace

TEST_CASE("a tetrahedron that rests on another takes a few rounds a step, searches once and does not sink or slide") {
  const int rounds = rounds_at_rest(false);
  CHECK(rounds > 0);
  CHECK(rounds <= 4);
}

TEST_CASE("self-contact is not solved again for a table that touches none of its nodes") {
  CHECK(rounds_at_rest(true) == rounds_at_rest(false));
}

}  // namespace heml::contact_impulses_test
