// Bounds of single elements with a weight for each corner: K ≤ b M Z, Z = 1/w (step_weights.hpp).
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <heml/elastic/active_term.hpp>
#include <numeric>

#include "small_body.hpp"

namespace heml::element_bounds_test {

using namespace heml::test;

namespace {

/// Tetrahedra without common nodes, of many shapes, deformed; a weight from 0.1 to 10 for each node.
struct Separate {
  static constexpr int count = 24;  // three packets
  TetMesh mesh;
  std::vector<double> x, weights;

  explicit Separate(std::mt19937_64& random, double strain) {
    const Mat3 F = strain > 0.2 ? random_gradient(random, 0.5, 1.8) : Mat3::Identity();
    for (int t = 0; t < count; ++t) {
      const double flat = std::pow(10.0, uniform(random, -1, 0));
      Vec3 X[4];
      do
        for (Vec3& corner : X) corner = 0.01 * random_vector(random, 1).cwiseProduct(Vec3(1, 1, flat));
      while (signed_volume(X[0], X[1], X[2], X[3]) < 1e-8 * flat);
      const int first = 4 * t;
      mesh.tets.push_back({first, first + 1, first + 2, first + 3});
      mesh.regions.push_back(0);
      const Mat3 own =
          F +
          strain *
              (Mat3() << random_vector(random, 0.3), random_vector(random, 0.3), random_vector(random, 0.3)).finished();
      for (const Vec3& corner : X) {
        mesh.nodes.push_back(corner);
        const Vec3 at = own * corner;
        x.insert(x.end(), {at.x(), at.y(), at.z()});
        weights.push_back(std::pow(10.0, uniform(random, -1, 1)));
      }
    }
  }
};

/// λ_max(Z⁻¹ M⁻¹ K) of each element, K by differences of the term's forces.
std::vector<double> exact(const Separate& bodies, const ElementGroup<double>& group, const GroupTerm<double>& term) {
  constexpr double h = 1e-8;
  std::vector<Eigen::Matrix<double, 12, 12>> K(Separate::count);
  const auto forces = [&](int component, double by) {
    std::vector<double> x = bodies.x, f(12 * (group.first_corner / 4 + group.packets() * group.lanes));
    for (int t = 0; t < Separate::count; ++t) x[static_cast<std::size_t>(12 * t + component)] += by;
    term.forces(group, x.data(), 0, group.packets(), f.data(), false);
    return f;
  };
  for (int i = 0; i < 12; ++i) {
    const auto up = forces(i, h), down = forces(i, -h);
    for (std::size_t s = 0; s < group.size(); ++s)
      for (int j = 0; j < 12; ++j) {
        const std::size_t k = 3 * (group.first_corner + 4 * s) + static_cast<std::size_t>(j);
        K[s](j, i) = (down[k] - up[k]) / (2 * h);
      }
  }
  std::vector<double> largest;
  for (std::size_t s = 0; s < group.size(); ++s) {
    const auto t = static_cast<std::size_t>(group.element[s]);
    Eigen::Matrix<double, 12, 1> root;
    for (int i = 0; i < 12; ++i) root[i] = std::sqrt(bodies.weights[4 * t + static_cast<std::size_t>(i / 3)]);
    const double mass = group.density * group.volume[s] / 4;
    const Eigen::Matrix<double, 12, 12> weighted =
        root.asDiagonal() * ((K[s] + K[s].transpose()) / 2) * root.asDiagonal();
    largest.push_back(
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>>(weighted / mass).eigenvalues().maxCoeff());
  }
  return largest;
}

/// The loosest bound, over the exact value; fails the test where a bound is too low.
double check(const Separate& bodies, const ElementGroup<double>& group, const GroupTerm<double>& term) {
  std::vector<double> bounds(group.packets() * group.lanes);
  term.frequency_bounds(group, bodies.weights.data(), bodies.x.data(), 0, group.packets(), bounds.data(), false);
  double loosest = 0;
  const auto of_slot = exact(bodies, group, term);
  for (std::size_t s = 0; s < group.size(); ++s) {
    CAPTURE(s);
    CHECK(bounds[s] >= of_slot[s] * (1 - 1e-6));
    if (of_slot[s] > 0) loosest = std::max(loosest, bounds[s] / of_slot[s]);
  }
  return loosest;
}

}  // namespace

TEST_CASE("element bounds: with any weights no element of any law is stiffer, in any state") {
  std::mt19937_64 random(31);
  std::vector<int> elements(Separate::count);
  std::iota(elements.begin(), elements.end(), 0);
  for (const std::string_view law : law_names())
    for (const VolumeTerm volume : {VolumeTerm::quadratic, VolumeTerm::logarithmic, VolumeTerm::simo_taylor}) {
      if (volume != VolumeTerm::quadratic && !find_law(law)->has_volume_term) continue;
      for (const double strain : {0.0, 0.02, 0.1, 1.0, 1.0}) {
        if (strain == 0 && find_law(law)->has_fibre) continue;  // stiffness jumps where the fibre is taut
        CAPTURE(law);
        CAPTURE(volume);
        CAPTURE(strain);
        const Separate bodies(random, strain);
        Material material = sample_material(law);
        material.volume_term = volume;
        const auto group = make_group<double>(bodies.mesh, elements, material);
        for (const auto& term : make_terms<double>(material, true, false)) {
          const double loosest = check(bodies, group, *term);
          if (strain == 0) CHECK(loosest < 5);  // Ogden 4, others at most 3
        }
      }
    }
}

TEST_CASE("element bounds: with any weights active stress is no stiffer") {
  std::mt19937_64 random(32);
  std::vector<int> elements(Separate::count);
  std::iota(elements.begin(), elements.end(), 0);
  Material material = sample_material("neo_hookean");
  material.fibre = random_vector(random, 1).normalized();
  for (int k = 0; k < 3; ++k) {
    const Separate bodies(random, 1);
    const auto group = make_group<double>(bodies.mesh, elements, material);
    CHECK(check(bodies, group, ActiveTerm<double>(5e3)) < 1 + 1e-6);
  }
}

}  // namespace heml::element_bounds_test
