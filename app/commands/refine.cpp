// `heml refine`: writes a scene with a mesh that is finer where the estimated error is greatest.
#include <fmt/format.h>

#include <algorithm>
#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <cmath>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/adapt.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/positions_csv.hpp>

namespace heml {
namespace {

RefineGoal goal_of(const RefineArguments& arguments, const Scene& scene) {
  RefineGoal goal = scene.mesh.refine.value_or(RefineGoal());
  if (arguments.error) goal.error = *arguments.error / 100;
  if (arguments.tets) goal.tets = *arguments.tets;
  return goal;
}

/// How near an error is to the goal's, 0 to 1: errors fall by about the same factor a mesh.
double share_done(double first, double now, double goal) {
  return first > goal ? std::clamp(std::log(first / now) / std::log(first / goal), 0.0, 1.0) : 0;
}

Adaptation adapt_visibly(const Scene& scene, const RefineGoal& goal, const std::optional<double>& at) {
  Progress progress("refining");
  double first = 0, done = 0;
  return adapt(scene, load_setup(scene), goal, at,
               {[&](const AdaptedMesh& mesh) {
                  if (first == 0) first = mesh.error;
                  done = std::max(done, share_done(first, mesh.error, goal.error));
                  progress.print_result(text_of(mesh));
                },
                [&](std::size_t tets) {
                  progress.show(std::max(done, static_cast<double>(tets) / goal.tets),
                                fmt::format("solving {} tetrahedra", tets));
                }});
}

void write(const std::filesystem::path& out, const Scene& scene, const Adaptation& adaptation) {
  make_folder(out);
  AdaptedScene finer = adapted_scene(scene, adaptation, out / "mesh.vtu");
  if (!adaptation.setup.initial_positions.empty()) {
    finer.scene.initial_positions = out / "initial.csv";
    write_positions_csv(finer.scene.initial_positions, adaptation.setup.initial_positions);
  }
  write_tet_mesh(out / "mesh.vtu", finer.mesh);
  write_file(out / "scene.json", scene_text(finer.scene, std::filesystem::absolute(out)));
}

}  // namespace

int refine_scene(const RefineArguments& arguments) {
  Scene scene = read_scene(arguments.scene);
  check_output_folder(input_files(scene), arguments.out,
                      {arguments.out / "mesh.vtu", arguments.out / "scene.json", arguments.out / "initial.csv"});
  const RefineGoal goal = goal_of(arguments, scene);
  scene.mesh.refine.reset();
  scene.recorded_mesh.reset();
  const Adaptation adaptation = adapt_visibly(scene, goal, arguments.at);
  write(arguments.out, scene, adaptation);
  fmt::print("written: {}\n", (arguments.out / "scene.json").string());
  if (adaptation.reached) return exit_done;
  warn("{}: {}{}", scene.file, why_not_reached(adaptation, goal), adaptation.stagnated ? "" : " (--tets)");
  return exit_check_failed;
}

}  // namespace heml
