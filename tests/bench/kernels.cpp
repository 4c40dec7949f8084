// Time of one evaluation of the forces, each law, precision and instruction set, beside the naive loop timed in turn
// with it. For people, not for ctest: figures of a busy machine mean little, ratios of minima somewhat more.
//
//   bench_kernels [MESH | CELLS] [LAW | all] [THREADS] [ROUNDS]
//
// MESH: a file of tetrahedra; CELLS: a cube of so many cells a side, five tetrahedra each, its nodes shaken.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>  // sample materials check themselves with it
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <heml/elastic/fan_forces.hpp>
#include <heml/materials/laws.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/reorder.hpp>
#include <numeric>

#include "engine/materials/sample_materials.hpp"
#include "naive_forces.hpp"
#include "support.hpp"

namespace heml::bench {
namespace {

struct Body {
  TetMesh mesh;  // inner order
  NaiveMesh naive;
  std::vector<int> elements;
  std::vector<double> x;
};

Body body_of(TetMesh mesh) {
  Body body{reordered(mesh, locality_order(mesh)), {}, {}, {}};
  std::mt19937_64 random(1);
  body.elements.resize(body.mesh.tets.size());
  std::iota(body.elements.begin(), body.elements.end(), 0);
  double volume = 0;
  for (const Tet& tet : body.mesh.tets) {
    const auto X = [&](std::size_t c) { return body.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    Mat3 Dm;
    Dm << X(1) - X(0), X(2) - X(0), X(3) - X(0);
    const Mat3 B = Dm.inverse().transpose();  // column after column is row after row
    body.naive.tets.push_back(tet);
    std::copy(B.data(), B.data() + 9, body.naive.inverse.emplace_back().begin());
    body.naive.volume.push_back(Dm.determinant() / 6);
    volume += body.naive.volume.back();
  }
  const double edge = std::cbrt(volume / static_cast<double>(body.mesh.tets.size()));
  for (const Vec3& X : body.mesh.nodes) {
    const Vec3 moved = Vec3(1.1, 0.97, 0.97).asDiagonal() * X + test::random_vector(random, 0.02 * edge);
    body.x.insert(body.x.end(), moved.data(), moved.data() + 3);
  }
  return body;
}

struct Times {
  std::vector<double> seconds;
  double least() const { return *std::min_element(seconds.begin(), seconds.end()); }
  double median() {
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
  }
};

template <class Run>
void time(Times& times, int calls, const Run& run) {
  run();  // warm
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) run();
  times.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / calls);
}

std::size_t index_of(std::string_view law) {
  return [&]<std::size_t... k>(std::index_sequence<k...>) {
    std::size_t found = 0;
    ((std::tuple_element_t<k, LawList>::template Law<double, false>::name == law ? void(found = k) : void()), ...);
    return found;
  }
  (std::make_index_sequence<std::tuple_size_v<LawList>>{});
}

template <class Real>
void compare(const Body& body, std::string_view law, InstructionSet isa, ThreadTeam& team, int rounds) {
  const Material material = test::sample_material(law);
  FanForces<Real> fans(body.mesh, {{&body.elements, &material}}, false, isa);
  const std::vector<Real> x(body.x.begin(), body.x.end());
  std::vector<Real> f(x.size());
  std::vector<double> expected(x.size());
  const auto naive = naive_forces(index_of(law));
  with_law<double>(material, false, [&](const auto& numbers) {
    const double per_tet = 1e9 / static_cast<double>(body.mesh.tets.size());
    const int calls = 1 + static_cast<int>(200000 / body.mesh.tets.size());
    Times ours, theirs;
    for (int round = 0; round < rounds; ++round) {
      time(theirs, (calls + 3) / 4, [&] { naive(&numbers, body.naive, body.x.data(), expected.data(), x.size() / 3); });
      time(ours, calls, [&] { fans.forces(x.data(), f.data(), team); });
    }
    double error = 0, size = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      error = std::max(error, std::abs(static_cast<double>(f[i]) - expected[i]));
      size = std::max(size, std::abs(expected[i]));
    }
    fmt::print(
        "{:<20}{:<7}{:<9}{:>2} {:>8} tets  naive {:7.2f} {:7.2f}  ours {:7.2f} {:7.2f} ns/tet (least, median)  "
        "ratio {:5.2f}  {:5.1f} B/tet  error {:.0e}\n",
        law, sizeof(Real) == 4 ? "float" : "double", name_of(isa), team.size(), body.mesh.tets.size(),
        theirs.least() * per_tet, theirs.median() * per_tet, ours.least() * per_tet, ours.median() * per_tet,
        theirs.least() / ours.least(), fans.bytes_per_tet(), error / size);
  });
}

}  // namespace
}  // namespace heml::bench

int main(int argc, char** argv) {
  using namespace heml;
  doctest::Context asserts;
  asserts.setAsDefaultForAssertsOutOfTestCases();
  const std::string mesh = argc > 1 ? argv[1] : "9", only = argc > 2 ? argv[2] : "all";
  const int threads = argc > 3 ? std::atoi(argv[3]) : 1, rounds = argc > 4 ? std::atoi(argv[4]) : 30;
  const FlushDenormals flush;
  const int cells = std::atoi(mesh.c_str());
  const auto body =
      bench::body_of(cells > 0 ? make_box(Vec3(0.1, 0.1, 0.1), {cells, cells, cells}) : read_tet_mesh(mesh));
  ThreadTeam team(threads);
  for (const LawInfo& law : laws())
    if (law.is_continuum && (only == "all" || law.name == only))
      for (const InstructionSet isa : instruction_sets()) {
        bench::compare<float>(body, law.name, isa, team, rounds);
        bench::compare<double>(body, law.name, isa, team, rounds);
      }
}
