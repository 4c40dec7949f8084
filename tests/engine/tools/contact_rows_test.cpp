#include <doctest/doctest.h>

#include <heml/tools/contact_rows.hpp>

namespace heml::contact_rows_test {
namespace {

constexpr RoundLimit exact{200, 1e-12};

ContactPoint on_edge(double first, double second) {
  return {{0, 1, 1, 1}, {first, second, 0, 0}, 2, 0, Vec3::UnitZ()};
}

/// Two nodes of 1 kg that fall.
struct Nodes {
  std::vector<double> inverse_mass{1, 1}, v{0.5, 0, -1, 0.5, 0, -1};
  ContactRows<double> rows;

  Nodes() { rows.clear(2); }
  auto& add(double first, double second) {
    const ContactPoint point = on_edge(first, second);
    return rows.add(point, inverse_mass_of(point, inverse_mass), inverse_mass);
  }
  double energy() const {
    double sum = 0;
    for (const double u : v) sum += u * u / 2;
    return sum;
  }
};

}  // namespace

TEST_CASE("what a point got before its neighbour bore the load is taken back") {
  Nodes nodes;
  nodes.add(1, 0);
  nodes.add(0.5, 0.5);
  nodes.rows.solve(exact, exact, nodes.v.data());
  // Both nodes rest on the middle; an impulse at the first would throw it up.
  CHECK(nodes.rows.rows()[0].normal_impulse == doctest::Approx(0).epsilon(1e-9));
  CHECK(nodes.rows.rows()[1].normal_impulse == doctest::Approx(2));
  CHECK(std::abs(nodes.v[2]) < 1e-9);
  CHECK(std::abs(nodes.v[5]) < 1e-9);
}

TEST_CASE("friction of a row is bounded by its own coefficient and stops what it can") {
  for (const double friction : {0.2, 0.9}) {
    Nodes nodes;
    nodes.add(0.5, 0.5).friction = friction;
    nodes.rows.solve(exact, exact, nodes.v.data());
    CHECK(nodes.v[0] == doctest::Approx(std::max(0.0, 0.5 - friction)).epsilon(1e-9));
    CHECK(nodes.v[3] == doctest::Approx(nodes.v[0]));
  }
}

TEST_CASE("impulses of the last step are a start unless they would add energy") {
  for (const double last : {2.0, 50.0}) {
    Nodes nodes;
    auto& row = nodes.add(0.5, 0.5);
    start_with({last, Vec3::Zero()}, row);
    row.is_known = true;
    const double energy = nodes.energy();
    nodes.rows.start(nodes.v.data());
    CHECK(nodes.energy() <= energy);
    CHECK(nodes.rows.rows()[0].normal_impulse == (last < 4 ? last : 0));
    nodes.rows.solve({1, 1e-3}, exact, nodes.v.data());
    CHECK(nodes.rows.rows()[0].normal_impulse == doctest::Approx(2));
    CHECK(nodes.rows.rounds() <= 2);
  }
}

TEST_CASE("a point that turns keeps its impulse along the new normal, and momentum follows") {
  Nodes nodes;
  nodes.add(0.5, 0.5);
  nodes.rows.solve(exact, exact, nodes.v.data());
  ContactPoint turned = on_edge(0.25, 0.75);
  turned.normal = Vec3::UnitY();
  nodes.rows.turn(0, turned, inverse_mass_of(turned, nodes.inverse_mass), nodes.inverse_mass, nodes.v.data());
  CHECK(nodes.v[2] == doctest::Approx(-1));
  CHECK(nodes.v[1] == doctest::Approx(0.5));
  CHECK(nodes.v[4] == doctest::Approx(1.5));
}

}  // namespace heml::contact_rows_test
