// Removal of elements: the rest equals a body built without them and keeps its internal state.
#include <doctest/doctest.h>

#include <heml/mesh/edit.hpp>

#include "small_body.hpp"

namespace heml::removal_test {

using namespace heml::test;

namespace {

/// Materials and options of a body of the small mesh.
struct Made {
  std::vector<Material> materials;
  BodyOptions options;
};

std::unique_ptr<ElasticBody<double>> body_of(const TetMesh& mesh, const std::vector<int>& material_of,
                                             const Made& made) {
  return std::make_unique<ElasticBody<double>>(mesh, material_of, made.materials, made.options);
}

/// All results of a body at x, one list for each quantity.
std::vector<std::vector<double>> answers(ElasticBody<double>& body, const std::vector<double>& x) {
  ThreadTeam team(1);
  std::vector<double> change(x.size()), dx(x.size()), of_elements, stiffness;
  for (std::size_t i = 0; i < x.size(); ++i) dx[i] = 1e-3 * std::sin(static_cast<double>(i));
  const std::vector<double> f = forces_of(body, x);
  body.linearise(x.data(), team);
  body.force_differential(dx.data(), change.data(), team);
  std::vector<ElementState<double>> states;
  body.states(x.data(), states);
  for (const auto& s : states) of_elements.insert(of_elements.end(), {s.J, s.stretch, s.von_mises});
  body.each_stiffness([&](const Tet&, const ElementMatrix<double>& K) {
    for (const auto& row : K) stiffness.insert(stiffness.end(), row, row + 12);
  });
  return {f,
          change,
          body.masses(),
          of_elements,
          stiffness,
          {body.energy(x.data(), team)},
          {body.potential(x.data(), team)},
          {body.frequency_bound(x.data(), team)},
          {body.damping_bound(x.data(), team)}};
}

/// Largest difference of two bodies, relative to the largest value of its quantity; 0: the same bits.
double difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    REQUIRE(a[k].size() == b[k].size());
    for (std::size_t i = 0; i < a[k].size(); ++i) {
      const double d = std::abs(a[k][i] - b[k][i]) / std::max(largest(b[k]), 1e-300);
      if (!(d <= worst)) worst = d;  // also true for NaN
    }
  }
  return worst;
}

/// All elements whose number is odd or a multiple of 3, without the last four.
std::vector<int> most_of(const TetMesh& mesh) {
  std::vector<int> kept;
  for (int t = 0; t + 4 < static_cast<int>(mesh.tets.size()); ++t)
    if (t % 2 != 0 || t % 3 == 0) kept.push_back(t);
  return kept;
}

}  // namespace

TEST_CASE("what is left of a body gives the bits of a body made of it alone, in every law") {
  std::mt19937_64 random(5);
  const SmallBody small(random, 0.1, Mat3(Vec3(1.1, 0.95, 1).asDiagonal()));
  const std::vector<int> kept = most_of(small.mesh);
  for (const std::string_view law : law_names(true)) {
    CAPTURE(std::string(law));
    for (const bool nodal : {false, true}) {
      if (nodal && !find_law(law)->has_volume_term) continue;
      Material other = sample_material(law);
      other.density = 1300;
      const Made made{{sample_material(law), other}, {true, nodal}};
      std::vector<int> material_of(small.mesh.tets.size());
      for (std::size_t t = 0; t < material_of.size(); ++t) material_of[t] = t % 5 == 0 ? 1 : 0;
      const auto cut = body_of(small.mesh, material_of, made);
      cut->keep_elements(kept);
      const auto built = body_of(with_elements(small.mesh, kept), with_elements(material_of, kept), made);
      CHECK(answers(*cut, small.x) == answers(*built, small.x));
      cut->set_mesh(small.mesh, material_of);
      CHECK(answers(*cut, small.x) == answers(*body_of(small.mesh, material_of, made), small.x));
    }
  }
}

TEST_CASE("a material may lose all its elements and can still be changed") {
  std::mt19937_64 random(6);
  const SmallBody small(random, 0.05);
  std::vector<int> material_of(small.mesh.tets.size(), 0), kept;
  for (std::size_t t = 0; t < material_of.size(); ++t)
    if (t < 7)
      material_of[t] = 1;
    else
      kept.push_back(static_cast<int>(t));
  const Made made{{sample_material("stvk"), sample_material("ogden")}, {}};
  const auto body = body_of(small.mesh, material_of, made);
  body->keep_elements(kept);
  CHECK(body->elements() == kept.size());
  const auto before = answers(*body, small.x);
  body->set_material(1, sample_material("yeoh"), small.x.data());
  CHECK(answers(*body, small.x) == before);
}

TEST_CASE("fields of elements and fibres go with them") {
  std::mt19937_64 random(7);
  SmallBody small(random, 0.1);
  ElementField stiffness{"stiffness", 1, {}}, direction{"direction", 3, {}};
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) {
    stiffness.values.push_back(uniform(random, 300, 900));
    const Vec3 fibre = random_vector(random, 1) + Vec3(2, 0, 0);
    direction.values.insert(direction.values.end(), {fibre.x(), fibre.y(), fibre.z()});
  }
  small.mesh.fields = {stiffness, direction};
  Material material = sample_material("hgo");
  material.fields = {{0, "stiffness"}};
  material.fibre_field = "direction";
  const Made made{{material}, {true}};
  const std::vector<int> all(small.mesh.tets.size(), 0), kept = most_of(small.mesh);
  const auto cut = body_of(small.mesh, all, made);
  cut->keep_elements(kept);
  const auto built = body_of(with_elements(small.mesh, kept), with_elements(all, kept), made);
  CHECK(answers(*cut, small.x) == answers(*built, small.x));
}

TEST_CASE("viscosity, relaxation and plastic set of what is left go on as if the rest had never been") {
  for (const std::string_view law : law_names()) {
    CAPTURE(std::string(law));
    if (law.starts_with("paper_")) continue;
    Material material = sample_material(law);
    material.viscosity = 3;
    material.relaxation = {{0.4, 0.02}, {0.3, 0.2}};
    if (!find_law(law)->has_fibre) material.plasticity = Plasticity{50, 20};
    if (material_problem(material)) continue;  // relaxation is not supported with this law
    std::mt19937_64 random(8);
    const SmallBody small(random, 0.15, Mat3(Vec3(1.15, 0.9, 1).asDiagonal()));
    const std::vector<int> all(small.mesh.tets.size(), 0), kept = most_of(small.mesh);
    const double tolerance = 1e-11;  // an edit converts the state of elements in fans
    const Made made{{material}, {true}};
    const auto cut = body_of(small.mesh, all, made);
    const auto built = body_of(with_elements(small.mesh, kept), with_elements(all, kept), made);
    const auto live = [&](ElasticBody<double>& body, double share) {
      auto x = small.rest();
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * (small.x[i] - x[i]);
      body.begin_step(0.01);
      body.commit(x.data());
      body.begin_step(0.01);
    };
    for (const double share : {0.5, 1.0, 1.2}) {
      live(*cut, share);
      live(*built, share);
    }
    cut->keep_elements(kept);
    CHECK(difference(answers(*cut, small.x), answers(*built, small.x)) <= tolerance);
    live(*cut, 0.8);
    live(*built, 0.8);
    CHECK(difference(answers(*cut, small.x), answers(*built, small.x)) <= tolerance);
    cut->reset_history(small.x.data());
    built->reset_history(small.x.data());
    CHECK(answers(*cut, small.x) == answers(*built, small.x));
  }
}

}  // namespace heml::removal_test
