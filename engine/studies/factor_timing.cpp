#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <heml/dynamics/supernodal_ldlt.hpp>
#include <heml/elastic/body.hpp>
#include <studies/factor_timing.hpp>
#include <studies/interleaved_timing.hpp>

namespace heml {
namespace {

constexpr std::size_t max_simplicial_nodes = 2500;  // above, one factor takes seconds

/// The stiffness at rest. free must outlive it.
BlockMatrix stiffness_of(const TetMesh& mesh, const FreeNodes& free, ThreadTeam& team) {
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {bench_material("neo_hookean_iso")}, {});
  body.linearise(mesh.nodes[0].data(), team);
  BlockMatrix stiffness(free, mesh.tets);
  body.each_stiffness([&](const Tet& nodes, const ElementMatrix<double>& K) {
    stiffness.add_element(nodes, [&](int i, int j) { return K[i][j]; });
  });
  return stiffness;
}

}  // namespace

std::vector<BenchRow> factor_rows(const BenchBody& body, bool quick) {
  std::vector<bool> is_free;
  std::vector<Vec3> position;
  for (const Vec3& x : body.mesh.nodes) {
    is_free.push_back(x.x() > 1e-9);
    if (is_free.back()) position.push_back(x);
  }
  const FreeNodes free(is_free);
  ThreadTeam alone(1);
  const BlockMatrix stiffness = stiffness_of(body.mesh, free, alone);
  std::vector<BenchRow> rows;
  for (const int threads : bench_threads()) {
    ThreadTeam team(threads);
    SupernodalLdlt factor(stiffness, position, InstructionSet::best, team);
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> simplicial;
    Eigen::VectorXd x(3 * static_cast<Eigen::Index>(free.node.size()));
    std::vector<std::function<void()>> works = {[&] { factor.factor(stiffness); },
                                                [&] {
                                                  x.setOnes();
                                                  factor.solve(x, factor.pivots());
                                                }};
    if (threads == 1 && free.node.size() <= max_simplicial_nodes) {
      simplicial.analyzePattern(stiffness.lower());
      works.push_back([&] { simplicial.factorize(stiffness.lower()); });
    }
    TimingLimits limits;
    limits.seconds = quick ? 0.5 : 5;
    limits.min_rounds = 3;
    const auto times = time_interleaved(works, limits);
    const auto add = [&](const char* name, const Timing& time) {
      BenchRow& row = rows.emplace_back();
      row.name = name;
      row.mesh = body.name;
      row.nodes = body.mesh.nodes.size();
      row.tets = body.mesh.tets.size();
      row.precision = "double";
      row.isa = name_of(instruction_sets().back());
      row.threads = threads;
      row.unit = "ms";
      row.median = 1e3 * time.median;
      row.min = 1e3 * time.min;
      row.more = {{"spread", time.spread}, {"samples", time.samples}};
    };
    add("factor of the stiffness", times[0]);
    const double speed = 2e-9 * factor.multiplications() / times[0].min;
    rows.back().more["gflops"] = speed;
    rows.back().remark = fmt::format("{:.3g} GFLOP/s", speed);
    if (times.size() > 2) {
      rows.back().more["simplicial_ms"] = 1e3 * times[2].min;
      rows.back().remark += fmt::format("; {:.1f} times Eigen's simplicial factor", times[2].min / times[0].min);
    }
    add("solution with the factor", times[1]);
  }
  return rows;
}

}  // namespace heml
