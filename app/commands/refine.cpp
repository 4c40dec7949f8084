// `heml refine`: writes a scene with a mesh that is finer where the estimated error is greatest.
#include <fmt/format.h>

#include <app/commands/commands.hpp>
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
  const Adaptation adaptation = adapt(scene, load_setup(scene), goal, arguments.at,
                                      [](const AdaptedMesh& mesh) { fmt::print("{}\n", text_of(mesh)); });
  write(arguments.out, scene, adaptation);
  fmt::print("written: {}\n", (arguments.out / "scene.json").string());
  if (adaptation.reached) return exit_done;
  warn("{:.3g} % would need more than {} tetrahedra (--tets)", 100 * goal.error, goal.tets);
  return exit_check_failed;
}

}  // namespace heml
