#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <heml/tools/contact_potential.hpp>

#include "engine/tools/small_tets.hpp"
#include "support.hpp"

namespace heml::contact_potential_test {

using namespace heml::test;

namespace {

constexpr double bound = 1e-4;  // m

Vector positions(const std::vector<Vec3>& places) {
  Vector x(3 * static_cast<Eigen::Index>(places.size()));
  for (std::size_t n = 0; n < places.size(); ++n) x.segment<3>(3 * static_cast<Eigen::Index>(n)) = places[n];
  return x;
}

Vector forces(ContactPotential& potential, const Vector& x) {
  Vector f = Vector::Zero(x.size());
  potential.add_forces(x, f);
  return f;
}

Vector product(ContactPotential& potential, const Vector& x, const Vector& dx) {
  Vector out = Vector::Zero(x.size());
  potential.linearise(x);
  potential.add_product(dx, out);
  return out;
}

/// How far the forces are from −∂U/∂x by fourth-order differences, relative to their norm.
double gradient_error(ContactPotential& potential, const Vector& x, double by = 1e-5) {
  const Vector f = forces(potential, x);
  REQUIRE(f.norm() > 0);
  double worst = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto U = [&](double k) {
      Vector moved = x;
      moved[i] += k * by;
      return potential.value(moved);
    };
    const double slope = (8 * (U(1) - U(-1)) - (U(2) - U(-2))) / (12 * by);
    worst = std::max(worst, std::abs(f[i] + slope));
  }
  return worst / f.norm();
}

/// How far K dx is from differences of the forces, relative to its norm.
double stiffness_error(ContactPotential& potential, const Vector& x, const Vector& dx, double by = 1e-5) {
  const Vector K_dx = product(potential, x, dx);
  const auto f = [&](double k) { return forces(potential, x + k * by * dx); };
  const Vector change = (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * by);
  return (K_dx + change).norm() / K_dx.norm();
}

Vector random_direction(std::mt19937_64& random, Eigen::Index size) {
  Vector dx(size);
  for (Eigen::Index i = 0; i < size; ++i) dx[i] = uniform(random, -1, 1);
  return dx.normalized();
}

/// Makes the stiffness of friction at x the slope of its forces, as it is once Newton's method has converged.
void settle(ContactPotential& potential, const Vector& x) {
  potential.linearise(x);
  potential.step_taken(1);
}

/// A node of stiffness k, N/m, at a table on z = 0 with friction.
struct NodeOnTable {
  Contacts contacts;
  ContactPotential potential{contacts, bound};

  NodeOnTable(double k, double friction) {
    contacts.boundary.nodes = {0};
    contacts.tables = {{Vec3::Zero(), Vec3::UnitZ(), friction}};
    potential.set_stiffness({k});
  }
};

/// With all that is indefinite.
Eigen::MatrixXd matrix_of_products(ContactPotential& potential, const Vector& x) {
  potential.linearise(x);
  Eigen::MatrixXd K(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) K.col(i) = product(potential, x, Vector::Unit(x.size(), i));
  return K;
}

Eigen::MatrixXd matrix_of_blocks(ContactPotential& potential, const Vector& x) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(x.size(), x.size());
  potential.linearise(x);
  potential.each_block([&](int a, int b, const Mat3& block) {
    K.block<3, 3>(3 * a, 3 * b) += block;
    if (a != b) K.block<3, 3>(3 * b, 3 * a) += block.transpose();
  });
  return K;
}

/// The sum of the rank-one terms where the stiffness was evaluated last.
Eigen::MatrixXd matrix_of_terms(const ContactPotential& potential, Eigen::Index size) {
  std::vector<RankOneTerm> terms;
  potential.add_rank_one_terms(terms);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (const RankOneTerm& term : terms) {
    Vector g = Vector::Zero(size);
    for (std::size_t k = 0; k < static_cast<std::size_t>(term.count); ++k) g.segment<3>(3 * term.nodes[k]) = term.g[k];
    sum += term.sign * g * g.transpose();
  }
  return sum;
}

void put_probe(Contacts& contacts, const Vec3& tip, double friction = 0) {
  contacts.probe.emplace(0.5, Vec3(0, 0.2, 1), friction);
  contacts.probe->go({tip}, 0, 0);
}

/// Three nodes of a face and one beside them, over a table.
Contacts contacts_of_face() {
  Contacts contacts;
  contacts.boundary.nodes = {0, 1, 2, 3};
  contacts.boundary.faces = {{0, 2, 1}};
  return contacts;
}

const std::vector<Vec3> face_places = {{-1, -0.8, 0.01}, {1.1, -0.9, 0.02}, {0.1, 1.3, -0.02}, {3, 3, -0.03}};

}  // namespace

TEST_CASE("a node inside a table has the energy and the force of a spring, one outside none") {
  Contacts contacts = contacts_of_face();
  contacts.tables = {{Vec3::Zero(), Vec3::UnitZ(), 0}};
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({100, 200, 300, 400});
  const Vector x = positions(face_places);
  potential.begin(x, 0);
  CHECK(potential.value(x) == doctest::Approx(300 * 0.02 * 0.02 / 2 + 400 * 0.03 * 0.03 / 2));
  Vector expected = Vector::Zero(12);
  expected[8] = 300 * 0.02;
  expected[11] = 400 * 0.03;
  CHECK((forces(potential, x) - expected).norm() < 1e-12);
}

TEST_CASE("forces of a table, a probe and a thread are the slope of their energy, and the stiffness theirs") {
  std::mt19937_64 random(21);
  Contacts contacts = contacts_of_face();
  const Vector x = positions(face_places);
  SUBCASE("table") { contacts.tables = {{Vec3(0, 0, 0.05), Vec3(2, -1, 2) / 3, 0}}; }
  SUBCASE("thread") { contacts.sutures = {{{0, 3}, 4.5, 4.5, 0, 0}}; }
  SUBCASE("table with friction, that sticks") { contacts.tables = {{Vec3(0, 0, 0.05), Vec3(2, -1, 2) / 3, 0.7}}; }
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({100, 200, 300, 400});
  potential.begin(x, 0);
  for (int k = 0; k < 5; ++k) {
    const Vector at = x + 0.01 * random_direction(random, x.size());
    CHECK(gradient_error(potential, at) < 1e-8);
    CHECK(stiffness_error(potential, at, random_direction(random, x.size())) < 1e-8);
  }
}

TEST_CASE("the force of a probe is the slope of its energy, and its stiffness that of its force") {
  std::mt19937_64 random(22);
  Contacts contacts = contacts_of_face();
  put_probe(contacts, Vec3(0.1, 0.05, 0.45));
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({100, 200, 300, 400});
  const Vector x = positions(face_places);
  potential.begin(x, 0);
  for (int k = 0; k < 5; ++k) CHECK(gradient_error(potential, x + 0.01 * random_direction(random, x.size())) < 1e-8);
  // Moved along the face's normal the nearest point does not turn about the probe, and nothing is left out.
  const auto corner = [&](int n) -> Vec3 { return x.segment<3>(3 * n); };
  const Vec3 n = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  Vector along = Vector::Zero(12);
  for (int k = 0; k < 3; ++k) along.segment<3>(3 * k) = n;
  CHECK(stiffness_error(potential, x, along) < 1e-8);
  // Half of the corners' mean stiffness, for each of the faces round a node.
  CHECK(along.dot(product(potential, x, along)) == doctest::Approx(0.5 * 200));
  for (int k = 0; k < 5; ++k) CHECK(stiffness_error(potential, x, random_direction(random, 12)) < 1e-6);
  potential.linearise(x, true);
  CHECK(matrix_of_terms(potential, 12).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > -1e-10);
}

TEST_CASE("blocks of the stiffness are its products, and pairs beside elements are told") {
  Contacts contacts = contacts_of_face();
  contacts.tables = {{Vec3(0, 0, 0.05), Vec3::UnitZ(), 0.3}};
  put_probe(contacts, Vec3(0.1, 0.05, 0.45), 0.4);
  const Vector x = positions(face_places);
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({100, 200, 300, 400});
  potential.begin(x, 0);
  const Eigen::MatrixXd K = matrix_of_products(potential, x);
  CHECK(K.norm() > 100);
  CHECK((K - matrix_of_blocks(potential, x)).norm() < 1e-12 * K.norm());
  Contacts sewn = contacts_of_face();
  sewn.sutures = {{{0, 3}, 4.5, 4.5, 0, 0}};
  ContactPotential thread(sewn, bound);
  thread.set_stiffness({100, 200, 300, 400});
  thread.begin(x, 0);
  const Eigen::MatrixXd T = matrix_of_products(thread, x);
  CHECK(T.block<3, 3>(0, 9).norm() > 0.1 * T.norm());
  CHECK((matrix_of_blocks(thread, x) - T).norm() < 1e-12 * T.norm());
  std::vector<std::array<int, 2>> pairs;
  potential.add_coupled_pairs(pairs);
  CHECK(pairs.empty());
  thread.add_coupled_pairs(pairs);
  REQUIRE(pairs.size() == 1);
  CHECK(std::min(pairs[0][0], pairs[0][1]) == 0);
  CHECK(std::max(pairs[0][0], pairs[0][1]) == 3);
}

TEST_CASE("rank-one terms add up to the products, of tables, probes and threads") {
  Contacts contacts = contacts_of_face();
  contacts.tables = {{Vec3(0, 0, 0.05), Vec3::UnitZ(), 0.3}};
  contacts.sutures = {{{0, 3}, 4.5, 4.5, 0, 0}};
  put_probe(contacts, Vec3(0.1, 0.05, 0.45), 0.4);
  const Vector x = positions(face_places);
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({100, 200, 300, 400});
  potential.begin(x, 0);
  potential.update_lagged(x);
  const Vector slid = x + 1e-3 * Vector::Ones(x.size());
  const Eigen::MatrixXd K = matrix_of_products(potential, slid);
  CHECK(K.norm() > 100);
  CHECK((matrix_of_terms(potential, x.size()) - K).norm() < 1e-8 * K.norm());
}

TEST_CASE("friction holds as a spring up to Coulomb's bound and slips there, with the slope of one smooth energy") {
  std::mt19937_64 random(23);
  const double k = 1000, friction = 0.4, deep = 5e-5;  // less than the bound, so that nothing becomes stiffer
  NodeOnTable on(k, friction);
  ContactPotential& potential = on.potential;
  const Vector x = positions({Vec3(0, 0, -deep)});
  potential.begin(x, 0);
  CHECK(potential.update_lagged(x));  // now the weight is known
  CHECK_FALSE(potential.update_lagged(x));
  const double most = friction * k * deep, slips_at = most / k;
  for (const double part : {0.2, 0.9, 1.1, 5.0, 300.0}) {
    CAPTURE(part);
    const double angle = uniform(random, 0, 6);
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    const Vector at = positions({Vec3(0, 0, -deep) + part * slips_at * along});
    const Vec3 f = forces(potential, at);
    CHECK((f - Vec3(0, 0, k * deep) + std::min(1.0, part) * most * along).norm() < 1e-12);
    CHECK(gradient_error(potential, at, slips_at / 100) < 1e-8);
    settle(potential, at);
    CHECK(stiffness_error(potential, at, random_direction(random, 3), slips_at / 100) < 1e-6);
  }
}

TEST_CASE("a light contact slips as far as a tenth of the accepted penetration away, not at once") {
  std::mt19937_64 random(24);
  const double k = 1000, friction = 0.4, deep = 1e-3 * bound, slips_at = 0.1 * bound, most = friction * k * deep;
  NodeOnTable on(k, friction);
  ContactPotential& potential = on.potential;
  const auto at = [&](double along) { return positions({Vec3(along, 0, -deep)}); };
  potential.begin(at(0), 0);
  while (potential.update_lagged(at(0))) {
  }
  for (const double part : {0.3, 0.9, 1.1, 40.0}) {
    CAPTURE(part);
    CHECK(forces(potential, at(part * slips_at)).x() == doctest::Approx(-std::min(1.0, part) * most));
    CHECK(gradient_error(potential, at(part * slips_at), deep / 10) < 1e-6);
    settle(potential, at(part * slips_at));
    CHECK(stiffness_error(potential, at(part * slips_at), random_direction(random, 3), deep / 10) < 1e-6);
  }
  potential.accept(at(0.5 * slips_at));
  potential.begin(at(0.5 * slips_at), 0);
  CHECK(forces(potential, at(0.5 * slips_at)).x() == doctest::Approx(-0.5 * most));
}

TEST_CASE("Newton's steps find where a point that slides comes to stick, and where it goes on") {
  const double k = 1000, friction = 0.4, deep = 5e-5, most = friction * k * deep, slips_at = most / k;
  const double soft = k / 1000;                          // of a spring at the node, along
  for (const double pull : {0.1, 0.5, 0.9, 1.5, 4.0}) {  // of Coulomb's bound, towards larger x
    CAPTURE(pull);
    NodeOnTable on(k, friction);
    ContactPotential& potential = on.potential;
    const auto at = [&](double along) { return positions({Vec3(along, 0, -deep)}); };
    potential.begin(at(0), 0);
    while (potential.update_lagged(at(0))) {
    }
    const auto rest_force = [&](double x) { return forces(potential, at(x)).x() + pull * most - soft * x; };
    double x = 400 * slips_at;
    int steps = 0;
    while (std::abs(rest_force(x)) > 1e-9 * most && steps < 60) {
      potential.linearise(at(x));
      x += rest_force(x) / (product(potential, at(x), Vector::Unit(3, 0)).x() + soft);
      potential.step_taken(1);
      ++steps;
    }
    CHECK(steps <= 6);
    CHECK(x == doctest::Approx(pull < 1 ? pull * most / (k + soft) : (pull - 1) * most / soft));
  }
}

TEST_CASE("friction is bounded by the forces of a solve, not by a penalty that was raised after it") {
  const double k = 100, friction = 0.4, deep = 10 * bound;
  NodeOnTable on(k, friction);
  ContactPotential& potential = on.potential;
  const auto at = [&](double along) { return positions({Vec3(along, 0, -deep)}); };
  potential.begin(at(0), 0);
  REQUIRE(potential.update_lagged(at(0)));
  CHECK(forces(potential, at(0)).z() > 10 * k * deep);  // it was raised
  CHECK(forces(potential, at(1)).x() == doctest::Approx(-friction * k * deep));
}

TEST_CASE("what has slipped stays, what has stuck is pulled back in the next step") {
  const double k = 1000, friction = 0.4, deep = 5e-5, slips_at = friction * deep;
  NodeOnTable on(k, friction);
  ContactPotential& potential = on.potential;
  const auto at = [&](double along) { return positions({Vec3(along, 0, -deep)}); };
  potential.begin(at(0), 0);
  while (potential.update_lagged(at(0))) {
  }
  potential.accept(at(0.5 * slips_at));
  CHECK(on.contacts.report_of(0).force.x() == doctest::Approx(-0.5 * friction * k * deep));
  potential.begin(at(0.5 * slips_at), 0);
  CHECK(forces(potential, at(0.5 * slips_at)).x() == doctest::Approx(-0.5 * friction * k * deep));
  potential.accept(at(7 * slips_at));
  potential.begin(at(7 * slips_at), 0);
  CHECK(forces(potential, at(7 * slips_at)).x() == doctest::Approx(-friction * k * deep));
  CHECK(std::abs(forces(potential, at(6 * slips_at)).x()) < 1e-12);  // its spring ends one slips_at behind
}

TEST_CASE("a table becomes stiffer until what lies on it is no deeper than the bound") {
  const double k = 100, weight = 50;
  Contacts contacts;
  contacts.boundary.nodes = {0};
  contacts.tables = {{Vec3::Zero(), Vec3::UnitZ(), 0}};
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({k});
  Vector x = positions({Vec3::Zero()});
  potential.begin(x, 0);
  int solves = 0;
  do {
    x = positions({Vec3(0, 0, -1e-6)});  // inside, so that there is a stiffness
    const double now = product(potential, x, Vector::Unit(3, 2)).z();
    x[2] = -weight / now;
    CHECK(forces(potential, x).z() == doctest::Approx(weight));
    ++solves;
  } while (potential.update_lagged(x));
  CHECK(solves > 1);
  CHECK(-x[2] <= bound);
  CHECK(-x[2] > bound / 64);
  potential.accept(x);
  const ContactReport report = contacts.report_of(0);
  CHECK(report.force.z() == doctest::Approx(weight));
  CHECK(report.max_penetration == doctest::Approx(-x[2]));
  CHECK(report.energy == doctest::Approx(weight * -x[2] / 2));
  CHECK(report.contact_count == 1);
}

TEST_CASE("tissue that has gone through a probe is noticed, and tissue that only comes near is not") {
  Contacts contacts = contacts_of_face();
  put_probe(contacts, Vec3(0.1, 0.05, 0.6));
  ContactPotential potential(contacts, bound);
  potential.set_stiffness({100, 200, 300, 400});
  const Vector x = positions(face_places);
  potential.begin(x, 0);
  const auto raised = [&](double by) {
    Vector moved = x;
    for (int n = 0; n < 4; ++n) moved[3 * n + 2] += by;
    return moved;
  };
  CHECK_FALSE(potential.crosses_probe(raised(0.3)));
  CHECK(potential.crosses_probe(raised(0.7)));
  CHECK_FALSE(potential.crosses_probe(raised(-5)));
}

TEST_CASE("tissue that met tissue on the way is pushed back with the slope of its energy, in balance") {
  std::mt19937_64 random(24);
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0},       {1, 0, 0},   {0, 1, 0},      {0.2, 0.2, -1},
                {0.2, 0.3, 0.1}, {1, 0.3, 1}, {-0.5, 0.9, 1}, {0, -0.6, 1}};
  mesh.tets = {{0, 2, 1, 3}, {4, 5, 6, 7}};
  for (Tet& tet : mesh.tets) {
    const auto node = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(tet[a])]; };
    if (signed_volume(node(0), node(1), node(2), node(3)) < 0) std::swap(tet[0], tet[1]);
  }
  mesh.regions = {0, 0};
  Contacts contacts;
  contacts.tissue.emplace(SelfContactSettings{}, mesh);
  ContactPotential potential(contacts, bound);
  potential.set_stiffness(std::vector<double>(8, 100));
  const Vector apart = positions(mesh.nodes);
  Vector crossed = apart;
  for (int n = 4; n < 8; ++n) crossed[3 * n + 2] -= 0.2;
  potential.begin(apart, 0);
  CHECK(potential.value(crossed) == 0);     // no pair has met yet
  CHECK(potential.update_lagged(crossed));  // now node 4 and the face of 0, 1, 2 have
  const double k = potential.value(crossed) * 2 / (0.1 * 0.1);
  CHECK(k == doctest::Approx(0.5 * 100));  // no stiffer: nothing has resisted yet
  const Vector f = forces(potential, crossed);
  CHECK((f.segment<3>(12) - Vec3(0, 0, k * 0.1)).norm() < 1e-10 * k);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (int n = 0; n < 8; ++n) {
    sum += f.segment<3>(3 * n);
    moment += Vec3(crossed.segment<3>(3 * n)).cross(Vec3(f.segment<3>(3 * n)));
  }
  CHECK(sum.norm() < 1e-12 * f.norm());
  CHECK(moment.norm() < 1e-12 * f.norm());
  CHECK(gradient_error(potential, crossed + 0.01 * random_direction(random, 24)) < 1e-8);
  const auto least_eigenvalue = [&] {
    return matrix_of_terms(potential, 24).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
  };
  potential.linearise(crossed);
  CHECK(least_eigenvalue() > -1e-10 * k);  // the pair is new
  potential.linearise(crossed);
  CHECK(least_eigenvalue() < -0.01 * k);
  potential.linearise(crossed, true);
  CHECK(least_eigenvalue() > -1e-10 * k);
  const Eigen::MatrixXd K = matrix_of_products(potential, crossed);
  CHECK(K.norm() > k);
  CHECK((matrix_of_terms(potential, K.rows()) - K).norm() < 1e-8 * K.norm());
  CHECK(potential.update_lagged(crossed));  // what resists and gives way so far becomes stiffer
  CHECK(potential.value(crossed) * 2 / (0.1 * 0.1) == doctest::Approx(32 * k));
  potential.disable_self_contact();
  potential.reset();
  potential.begin(apart, 0);
  CHECK_FALSE(potential.update_lagged(crossed));
  CHECK(potential.value(crossed) == 0);
}

TEST_CASE("pairs of tissue that meet later are added to those that have met, each once") {
  TetMesh mesh;
  constexpr int copies = 6;
  for (int k = 0; k < copies; ++k) {
    const Vec3 place(10 * k, 0, 0);
    add_tet(mesh, {place, place + Vec3(0, 1, 0), place + Vec3(1, 0, 0), place + Vec3(0.2, 0.2, -1)});
    add_tet(mesh, {place + Vec3(0.2, 0.3, 0.1), place + Vec3(1, 0.3, 1), place + Vec3(-0.5, 0.9, 1),
                   place + Vec3(0, -0.6, 1)});
  }
  Contacts contacts;
  contacts.tissue.emplace(SelfContactSettings{}, mesh);
  ContactPotential potential(contacts, bound);
  potential.set_stiffness(std::vector<double>(mesh.nodes.size(), 100));
  Vector x = positions(mesh.nodes);
  const auto cross = [&](int k) {
    for (int n = 8 * k + 4; n < 8 * k + 8; ++n) x[3 * n + 2] -= 0.2;
  };
  potential.begin(x, 0);
  cross(3);
  CHECK(potential.update_lagged(x));
  for (const int k : {0, 1, 2, 4, 5}) cross(k);
  CHECK(potential.update_lagged(x));
  potential.accept(x);
  CHECK(contacts.reports.at(0).contact_count == copies);
}

}  // namespace heml::contact_potential_test
