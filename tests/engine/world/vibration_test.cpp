// Natural frequencies of a slender cantilever: of its stiffness and lumped masses at rest, of beam theory, and of the
// swing that a run shows.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/elastic/body.hpp>
#include <numbers>

#include "support.hpp"
#include "world_support.hpp"

namespace heml::vibration_test {

using namespace heml::test;

namespace {

constexpr double length = 0.2, depth = 0.02, width = 0.03;  // m; depth is along y, where it bends first
constexpr double young = 1e4, density = 1000;
// A clamp also holds the section back from thinning, which beam theory does not know: at 0.3 the extrapolated
// frequencies are 0.4 to 0.9 % higher.
constexpr double poisson = 0;
const double wave_speed = std::sqrt(young / density);

/// A beam along x, held at x = 0, so many cells through its depth.
WorldSetup beam(int cells) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(length, depth, width), {8 * cells, cells, 3 * cells / 2});
  setup.materials = {{std::nullopt, soft("neo_hookean", young, poisson)}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.solver.threads = 1;
  return setup;
}

struct Mode {
  double omega;           ///< 1/s
  Eigen::VectorXd shape;  ///< 3 #V, of unit modal mass
  Vec3 push;              ///< participation: Σ m φ, which says whether it is bending along y or z, or axial
};

/// The lowest modes of K φ = ω² M φ, by iteration of a subspace on K⁻¹M (Bathe & Wilson 1973).
std::vector<Mode> lowest_modes(const WorldSetup& setup, int wanted) {
  const TetMesh& mesh = setup.mesh;
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {setup.materials[0].material}, {});
  std::vector<bool> is_free(mesh.nodes.size(), true);
  for (const int n : setup.boundary[0].nodes) is_free[static_cast<std::size_t>(n)] = false;
  const FreeNodes free(is_free);
  BlockMatrix stiffness(free, mesh.tets);
  ThreadTeam team(1);
  body.linearise(mesh.nodes[0].data(), team);
  body.each_stiffness([&](const Tet& nodes, const ElementMatrix<double>& K) {
    stiffness.add_element(nodes, [&](int i, int j) { return K[i][j]; });
  });
  const auto masses = body.masses();
  Eigen::VectorXd M(3 * static_cast<Eigen::Index>(free.node.size()));
  for (std::size_t k = 0; k < free.node.size(); ++k)
    M.segment<3>(3 * static_cast<int>(k)).setConstant(masses[static_cast<std::size_t>(free.node[k])]);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(stiffness.lower());
  REQUIRE(factor.info() == Eigen::Success);

  std::mt19937_64 random(9);
  Eigen::MatrixXd basis(M.size(), wanted + 6);
  for (double& entry : basis.reshaped()) entry = uniform(random, -1, 1);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(basis.cols()), before;
  do {
    before = squares;
    const Eigen::MatrixXd load = M.asDiagonal() * basis, next = factor.solve(load);
    const Eigen::MatrixXd K = next.transpose() * load, mass = next.transpose() * M.asDiagonal() * next;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small((K + K.transpose()) / 2, mass);
    squares = small.eigenvalues();
    basis = next * small.eigenvectors();
  } while ((squares - before).head(wanted).cwiseAbs().maxCoeff() > 1e-9 * squares[0]);

  std::vector<Mode> modes;
  for (int m = 0; m < wanted; ++m) {
    Mode mode{std::sqrt(squares[m]), Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.nodes.size())),
              Vec3::Zero()};
    for (std::size_t k = 0; k < free.node.size(); ++k) {
      const Vec3 there = basis.col(m).segment<3>(3 * static_cast<int>(k));
      mode.shape.segment<3>(3 * free.node[k]) = there;
      mode.push += M[3 * static_cast<int>(k)] * there;
    }
    modes.push_back(mode);
  }
  return modes;
}

/// The first modes of those kinds: bending along y twice, axial.
std::array<Mode, 3> named_modes(const WorldSetup& setup) {
  std::vector<Mode> bending, axial;
  const double whole = std::sqrt(density * length * depth * width);  // of a rigid motion along an axis
  for (const Mode& mode : lowest_modes(setup, 8)) {
    if (std::abs(mode.push.y()) > 0.2 * whole) bending.push_back(mode);
    if (std::abs(mode.push.x()) > 0.5 * whole) axial.push_back(mode);
  }
  REQUIRE(bending.size() >= 2);
  REQUIRE(axial.size() >= 1);
  return {bending[0], bending[1], axial[0]};
}

/// Bending of a Timoshenko cantilever, 1/s: the n-th root of Huang's frequency equation (1961), Cowper's shear
/// coefficient (1966).
double timoshenko(int n) {
  const double area = depth * width, I = width * depth * depth * depth / 12;
  const double shear = young / (2 * (1 + poisson)), k = 10 * (1 + poisson) / (12 + 11 * poisson);
  const double r2 = I / (area * length * length), s2 = young * I / (k * area * shear * length * length);
  const auto equation = [&](double omega) {
    const double b2 = density * area * std::pow(length, 4) * omega * omega / (young * I), b = std::sqrt(b2);
    const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4 / b2);
    const double alpha = std::sqrt((root - (r2 + s2)) / 2), beta = std::sqrt((root + (r2 + s2)) / 2);
    return 2 + (b2 * (r2 - s2) * (r2 - s2) + 2) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * (r2 + s2) / std::sqrt(1 - b2 * r2 * s2) * std::sinh(b * alpha) * std::sin(b * beta);
  };
  const double increment = 0.01 * wave_speed / length;
  for (double low = increment;; low += increment)
    if (equation(low) * equation(low + increment) < 0 && --n == 0) {
      double high = low + increment;
      while (high - low > 1e-12 * high) {
        const double middle = (low + high) / 2;
        (equation(low) * equation(middle) <= 0 ? high : low) = middle;
      }
      return low;
    }
}

}  // namespace

TEST_CASE("vibration: Timoshenko's frequencies are Euler's and Bernoulli's less a few percent") {
  const double euler = std::sqrt(young * depth * depth / (12 * density)) / (length * length);
  CHECK(timoshenko(1) / (3.51602 * euler) == doctest::Approx(0.99).epsilon(0.01));
  CHECK(timoshenko(2) / (22.0345 * euler) == doctest::Approx(0.93).epsilon(0.03));
}

TEST_CASE("vibration: natural frequencies of a beam converge to those of theory") {
  const std::array<double, 3> theory{timoshenko(1), timoshenko(2), std::numbers::pi / 2 * wave_speed / length};
  const std::string names[] = {"first bending", "second bending", "axial"};
  const auto coarse = named_modes(beam(4)), fine = named_modes(beam(6));
  for (std::size_t m = 0; m < 3; ++m) {
    // Errors fall with the square of the cell.
    const double extrapolated = (36 * fine[m].omega - 16 * coarse[m].omega) / 20;
    MESSAGE(names[m] << ": " << coarse[m].omega << ", " << fine[m].omega << ", extrapolated " << extrapolated
                     << ", theory " << theory[m] << " 1/s");
    CHECK(std::abs(fine[m].omega - theory[m]) < 0.55 * std::abs(coarse[m].omega - theory[m]));
    CHECK(extrapolated == doctest::Approx(theory[m]).epsilon(0.005));
  }
}

TEST_CASE("vibration: a run swings at the frequencies of its own stiffness") {
  WorldSetup setup = beam(2);
  for (const Mode& mode : named_modes(setup)) {
    const double amplitude = 1e-4 * length / mode.shape.cwiseAbs().maxCoeff();
    setup.initial_positions.clear();
    for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
      setup.initial_positions.push_back(setup.mesh.nodes[n] +
                                        amplitude * mode.shape.segment<3>(3 * static_cast<int>(n)));
    setup.solver.step = 5e-4;
    const auto world = make_world(setup);
    const auto masses =
        ElasticBody<double>(setup.mesh, std::vector<int>(setup.mesh.tets.size(), 0), {setup.materials[0].material}, {})
            .masses();
    const auto swing = [&] {
      double sum = 0;
      const auto x = world->positions();
      for (std::size_t n = 0; n < x.size(); ++n)
        sum += masses[n] * mode.shape.segment<3>(3 * static_cast<int>(n)).dot(x[n] - setup.mesh.nodes[n]);
      return sum;
    };
    // From the first crossing of rest to the fifth: two periods.
    std::vector<double> crossings;
    for (double before = swing(); crossings.size() < 5;) {
      world->tick();
      if (world->halt()) FAIL(world->halt()->message);
      const double now = swing();
      if (before * now <= 0) crossings.push_back(world->time() - *setup.solver.step * now / (now - before));
      before = now;
    }
    const double omega = 4 * std::numbers::pi / (crossings[4] - crossings[0]);
    MESSAGE("ω = " << omega << " 1/s in the run, " << mode.omega << " of the stiffness");
    CHECK(omega == doctest::Approx(mode.omega).epsilon(1e-3));
  }
}

}  // namespace heml::vibration_test
