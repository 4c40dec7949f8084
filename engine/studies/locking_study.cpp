#include <fmt/format.h>

#include <heml/mesh/generate.hpp>
#include <studies/beam_theory.hpp>
#include <studies/locking_study.hpp>

namespace heml {
namespace {

constexpr Cantilever beam{0.1, 0.02, 5e5, 0, 1000, 0.981};  // sags by 0.7 % of its length
constexpr int halvings = 2;

std::vector<double> poissons(bool quick) {
  return quick ? std::vector<double>{0, 0.3, 0.49} : std::vector<double>{0, 0.3, 0.45, 0.49, 0.499};
}

}  // namespace

Problem beam_problem(double poisson, const std::array<int, 3>& cells) {
  Problem problem;
  WorldSetup& setup = problem.setup;
  setup.mesh = make_box(Vec3(beam.length, beam.depth, beam.depth), cells);
  Material material;
  material.law = "neo_hookean_iso";
  material.parameters = {beam.young / (4 * (1 + poisson)), beam.young / (3 * (1 - 2 * poisson))};
  material.density = beam.density;
  setup.materials = {{std::nullopt, material}};
  Boundary constrained;
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (setup.mesh.nodes[n].x() < 1e-9) constrained.nodes.push_back(static_cast<int>(n));
  setup.boundary = {constrained};
  setup.gravity = Vec3(0, -beam.gravity, 0);
  return with_masses(std::move(problem));
}

std::array<int, 3> cells_of_locking_study(bool quick) { return quick ? std::array{8, 2, 2} : std::array{10, 2, 2}; }

std::size_t steps_of_locking_study(bool quick) {
  return poissons(quick).size() *
         steps_of_mesh_convergence_study(beam_problem(0.3, cells_of_locking_study(quick)), halvings);
}

LockingBeam study_beam(double poisson, const std::array<int, 3>& cells, const StudyContext& context) {
  Cantilever theory = beam;
  theory.poisson = poisson;
  const std::string key = fmt::format("beam of {} cells at rest, poisson {}", cells[0], poisson);
  return {poisson, theory.sag(), study_mesh_convergence(key, beam_problem(poisson, cells), halvings, context)};
}

std::vector<LockingBeam> study_locking(bool quick, const StudyContext& context) {
  std::vector<LockingBeam> beams;
  for (const double poisson : poissons(quick))
    beams.push_back(study_beam(poisson, cells_of_locking_study(quick), context));
  return beams;
}

double locking_of(const std::vector<LockingBeam>& beams, const ConvergenceMesh& mesh) {
  // At the smallest Poisson's ratio p2_pressure is p2.
  const std::string element = mesh.element == "p2_pressure" ? "p2" : mesh.element;
  const ConvergenceMesh* free = beams.front().convergence.find(element, mesh.halvings);
  return free ? mesh.relative - free->relative : mesh.relative;
}

}  // namespace heml
