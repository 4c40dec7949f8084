#include <fmt/format.h>

#include <cmath>
#include <heml/scenario/adapt.hpp>
#include <studies/refinement_study.hpp>

namespace heml {
namespace {

double relative(double squared, double stored) { return std::sqrt(squared / (2 * stored + squared)); }

Json adapt_beam(const Problem& problem, int max_tets) {
  Json meshes = Json::array();
  const auto add = [&](const AdaptedMesh& mesh) {
    meshes.push_back(
        {{"tets", mesh.tets}, {"estimated", mesh.error}, {"stored", mesh.stored}, {"potential", mesh.potential}});
  };
  adapt(problem.scene, problem.setup, RefineGoal{0, max_tets}, {}, {add});
  return meshes;
}

}  // namespace

RefinementStudy study_refinement(const LockingBeam& beam, const std::array<int, 3>& cells, int max_tets,
                                 const StudyContext& context) {
  RefinementStudy study{beam.poisson, {}};
  std::optional<double> least;  // Π*
  for (const ConvergenceMesh& mesh : beam.convergence.meshes) {
    if (!mesh.known || !mesh.estimated) continue;
    least = mesh.potential - *mesh.known / 2;
    study.meshes.push_back(
        {false, mesh.tets, relative(*mesh.known, mesh.stored), relative(*mesh.estimated, mesh.stored)});
  }
  if (!least) return study;
  const Problem problem = beam_problem(beam.poisson, cells);
  const Json found = context.kept(
      fmt::format("beam of {} cells adapted to {} tetrahedra, poisson {}", cells[0], max_tets, beam.poisson),
      [&] { return adapt_beam(problem, max_tets); });
  for (const Json& mesh : found)
    study.meshes.push_back({true, mesh["tets"],
                            relative(2 * (mesh["potential"].get<double>() - *least), mesh["stored"]),
                            mesh["estimated"]});
  return study;
}

}  // namespace heml
