// Growth of the cost of an implicit step with the mesh: a cube of 10 cm, 10 kPa, fixed at one side, falls by backward
// Euler in steps of 1/60 s. One line per mesh: regular ones, and ones whose inner nodes are displaced at random.
//
//   ninja -C build/release bench_implicit_growth
//   build/release/tests/bench_implicit_growth [LARGEST=1000000] [POISSON=0.3] [NEWTON ITERATIONS PER STEP=until
//     the tolerance is met] [THREADS=1]
//
// A naive evaluation of the same forces (F = Ds Dm⁻¹, P = F S, double, one thread, the mesh's own order of nodes) is
// timed after each step: on a shared machine the ratio of both times is reproducible, the times themselves are not.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <heml/elastic/body.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/world/world.hpp>

#include "support.hpp"

using namespace heml;
using namespace heml::test;

namespace {

constexpr double side = 0.1, young = 1e4, density = 1000, step = 1.0 / 60;
constexpr int first_steps = 3, timed_steps = 5;

double milliseconds() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double megabytes_at_most() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Forces of Neo-Hookean tetrahedra in the textbook form.
class NaiveForces {
 public:
  NaiveForces(const TetMesh& mesh, const LameParameters& lame) : mesh_(mesh), lame_(lame) {
    for (const Tet& tet : mesh.tets) {
      inverse_.push_back(edges(mesh.nodes, tet).inverse());
      volume_.push_back(1 / (6 * inverse_.back().determinant()));
    }
  }
  void operator()(const std::vector<Vec3>& x, std::vector<Vec3>& f) const {
    f.assign(x.size(), Vec3::Zero());
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const Tet& tet = mesh_.tets[t];
      const Mat3 F = edges(x, tet) * inverse_[t];
      const Mat3 C_inverse = (F.transpose() * F).inverse();
      const Mat3 S = lame_.mu * (Mat3::Identity() - C_inverse) + lame_.lambda * std::log(F.determinant()) * C_inverse;
      const Mat3 H = -volume_[t] * F * S * inverse_[t].transpose();
      for (int c = 0; c < 3; ++c) {
        f[static_cast<std::size_t>(tet[static_cast<std::size_t>(c + 1)])] += H.col(c);
        f[static_cast<std::size_t>(tet[0])] -= H.col(c);
      }
    }
  }

 private:
  static Mat3 edges(const std::vector<Vec3>& x, const Tet& tet) {
    const auto at = [&](std::size_t c) -> const Vec3& { return x[static_cast<std::size_t>(tet[c])]; };
    Mat3 Ds;
    Ds << at(1) - at(0), at(2) - at(0), at(3) - at(0);
    return Ds;
  }
  const TetMesh& mesh_;
  LameParameters lame_;
  std::vector<Mat3> inverse_;
  std::vector<double> volume_;
};

TetMesh cube(int cells, bool shaken) {
  TetMesh mesh = make_box(Vec3(side, side, side), {cells, cells, cells});
  std::mt19937_64 random(1);
  for (Vec3& X : mesh.nodes)
    if (shaken && X.minCoeff() > 1e-6 && X.maxCoeff() < side - 1e-6) X += random_vector(random, 0.2 * side / cells);
  return mesh;
}

/// Whether the naive forces equal the engine's to round-off.
bool naive_agrees(const LameParameters& lame) {
  const TetMesh mesh = cube(4, true);
  const std::vector<int> material_of(mesh.tets.size(), 0);
  ElasticBody<double> body(mesh, material_of, {{"neo_hookean", {lame.lambda, lame.mu}, density}}, {});
  ThreadTeam team(1);
  std::mt19937_64 random(2);
  std::vector<Vec3> x = mesh.nodes, f, naive;
  for (Vec3& at : x) at += random_vector(random, 0.05 * side / 4);
  f.resize(x.size());
  body.forces(x[0].data(), f[0].data(), team);
  NaiveForces(mesh, lame)(x, naive);
  double difference = 0, largest = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    difference = std::max(difference, (f[n] - naive[n]).norm());
    largest = std::max(largest, f[n].norm());
  }
  return difference <= 1e-12 * largest;
}

void measure(int cells, bool shaken, double poisson, int iterations, int threads) {
  const LameParameters lame = lame_parameters(young, poisson);
  WorldSetup setup;
  setup.mesh = cube(cells, shaken);
  setup.materials = {{std::nullopt, {"neo_hookean", {lame.lambda, lame.mu}, density}}};
  setup.boundary.emplace_back();
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (setup.mesh.nodes[n].x() < 1e-9) setup.boundary[0].nodes.push_back(static_cast<int>(n));
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.step = step;
  setup.solver.threads = threads;
  if (iterations > 0) setup.solver.budget = Budget{iterations, 0};

  const double before = milliseconds();
  const auto world = make_world(setup);
  const double made = milliseconds();
  world->tick();  // builds the solver
  const double first = milliseconds();
  for (int k = 1; k < first_steps; ++k) world->tick();
  const SolverStats start = world->solver_stats();
  const NaiveForces naive_forces(setup.mesh, lame);
  std::vector<double> steps, naive;
  std::vector<Vec3> f;
  for (int k = 0; k < timed_steps; ++k) {
    const auto x = world->positions();
    const double begin = milliseconds();
    world->tick();
    const double middle = milliseconds();
    naive_forces(x, f);
    steps.push_back(middle - begin);
    naive.push_back(milliseconds() - middle);
  }
  const SolverStats end = world->solver_stats();
  if (world->halt()) std::printf("%s\n", world->halt()->message.c_str());
  const double each = 1.0 / timed_steps, least = *std::min_element(steps.begin(), steps.end());
  std::printf("%8zu%s %8zu %-10.*s %9.0f %9.0f %9.1f %9.1f %7.1f %7.1f %8.0f %8.0f\n", setup.mesh.tets.size(),
              shaken ? "*" : " ", setup.mesh.nodes.size(), static_cast<int>(end.preconditioner.size()),
              end.preconditioner.data(), made - before, first - made, median(steps), least,
              each * static_cast<double>(end.iterations - start.iterations),
              each * static_cast<double>(end.linear.iterations - start.linear.iterations), megabytes_at_most(),
              least / *std::min_element(naive.begin(), naive.end()));
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const double largest = count > 1 ? std::atof(arguments[1]) : 1e6, poisson = count > 2 ? std::atof(arguments[2]) : 0.3;
  const int iterations = count > 3 ? std::atoi(arguments[3]) : 0, threads = count > 4 ? std::atoi(arguments[4]) : 1;
  if (!(largest > 0) || !(poisson > -1 && poisson < 0.5) || iterations < 0 || threads < 1) {
    std::fprintf(
        stderr,
        "usage: bench_implicit_growth [LARGEST NUMBER OF TETRAHEDRA] [POISSON'S RATIO] [ITERATIONS] [THREADS]\n");
    return 2;
  }
  if (!naive_agrees(lame_parameters(young, poisson))) {
    std::fprintf(stderr, "the naive forces are not those of the program\n");
    return 1;
  }
  std::printf(
      "backward Euler, steps of 1/60 s, Neo-Hookean %g Pa, Poisson's ratio %g, %d threads; * nodes shaken; MB: peak so "
      "far\n",
      young, poisson, threads);
  std::printf("%8s  %8s %-10s %9s %9s %9s %9s %7s %7s %8s %8s\n", "tets", "nodes", "by", "make ms", "1st ms", "step ms",
              "least", "Newton", "PCG", "MB", "/naive");
  for (const auto& [cells, shaken] :
       {std::pair{8, false}, {13, false}, {13, true}, {18, false}, {27, false}, {27, true}, {39, false}, {58, false}})
    if (5.0 * cells * cells * cells <= largest) measure(cells, shaken, poisson, iterations, threads);
}
