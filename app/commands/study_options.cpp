// Options of the commands about materials, meshes and measurements, and of the reference pages.
#include <app/commands/command_line.hpp>
#include <app/commands/number_options.hpp>
#include <app/commands/scene_option.hpp>
#include <memory>

namespace heml {
namespace {

constexpr const char* json_help = "for programs: numbers with 17 digits";

}  // namespace

Action define_probe(CLI::App& command) {
  const auto given = std::make_shared<ProbeArguments>();
  command.add_option("MATERIAL", given->material, "JSON: one entry of a scene's `materials`")->required();
  command.add_option("--F", given->gradients, "CSV: F11 ... F33 [dF11 ... dF33], one state a row")
      ->required()
      ->type_name("FILE");
  command.add_option("--out", given->out, "CSV: W, P11 ... P33 [dP11 ... dP33], Pa")->required()->type_name("FILE");
  return [given] { return probe(*given); };
}

Action define_materials(CLI::App& command) {
  const auto given = std::make_shared<MaterialsArguments>();
  command.add_flag("--json", given->json, json_help);
  return [given] { return materials(*given); };
}

Action define_bench_test(CLI::App& command) {
  const auto given = std::make_shared<BenchTestArguments>();
  command.add_option("MATERIAL", given->material, "JSON: one entry of a scene's `materials`; or a preset's name")
      ->required();
  command.add_option("--test", given->test, "uniaxial, equibiaxial, planar, shear or relaxation")
      ->capture_default_str()
      ->type_name("T");
  command.add_option("--out", given->out, "CSV of the curve; with --data also NAME.json: the fit")
      ->required()
      ->type_name("FILE");
  command.add_option("--plot", given->plot, "PNG of the curve")->type_name("FILE");
  command
      .add_option("--data", given->data,
                  "measured CSV to fit: stretch,stress (gamma,stress; time,stress), nominal stress in Pa")
      ->type_name("FILE");
  command.add_option("--from", given->from, "first stretch, shear or time")->type_name("X");
  command.add_option("--to", given->to, "last stretch, shear or time")->type_name("X");
  command.add_option("--points", given->points, "of the curve")->capture_default_str()->type_name("N");
  command.add_option("--step-stretch", given->step_stretch, "kept constant in a relaxation test")
      ->capture_default_str()
      ->type_name("X");
  command.add_flag("--fit-all", given->fit_all, "fit the bulk modulus (kappa, lambda) too");
  return [given] { return bench_test(*given); };
}

Action define_mesh(CLI::App& command) {
  const auto given = std::make_shared<MeshArguments>();
  command
      .add_option("SURFACE", given->surface,
                  "closed surface (.obj .stl .ply ...), label map (.nii .nrrd .mha ...) or tetrahedral mesh")
      ->required();
  command.add_option("--out", given->out, ".msh, .mesh, .vtk, .vtu or .node")->required()->type_name("FILE");
  command.add_option("--scale", given->scale, "multiplies coordinates: 0.001 for a file in millimetres")
      ->capture_default_str()
      ->check(positive_number())
      ->type_name("S");
  command
      .add_option("--radius-edge-ratio", given->radius_edge_ratio, "shape of tetrahedra: smaller is better and more")
      ->capture_default_str()
      ->check(number_between(1, 100))
      ->type_name("R");
  command.add_option("--max-volume", given->max_volume, "of one tetrahedron, m³")
      ->check(positive_number())
      ->type_name("V");
  const auto improve =
      command.add_flag("--improve", given->improve,
                       "better shapes: moves, swaps, collapses and splits; prints JSON lines, before and after");
  command
      .add_option("--tets", given->tets,
                  "with --improve: coarsens or refines to about so many tetrahedra; of a label map: 20000")
      ->check(whole_number_between(1, 10'000'000))
      ->type_name("N");
  command
      .add_option("--min-angle", given->min_angle,
                  "with --improve or a label map: smallest dihedral angle wanted, degrees; else 10")
      ->check(number_between(1, 30))
      ->type_name("A");
  command
      .add_option("--tolerance", given->tolerance,
                  "with --improve: distance that the surface may change, m; else 0.5 % of the body's diagonal")
      ->check(positive_number())
      ->needs(improve)
      ->type_name("D");
  command.add_option("--labels", given->labels, "of a label map: these alone, as 1,3")->delimiter(',')->type_name("L");
  return [given] { return mesh_surface(*given); };
}

Action define_refine(CLI::App& command) {
  const auto given = std::make_shared<RefineArguments>();
  add_scene(command, given->scene);
  command.add_option("--out", given->out, "folder for scene.json and its mesh.vtu")->required()->type_name("DIR");
  command
      .add_option("--error", given->error,
                  "estimated error to reach, per cent of the energy norm; else the scene's, or 10")
      ->check(number_between(0.1, 100))
      ->type_name("P");
  command.add_option("--tets", given->tets, "no more tetrahedra than these; else the scene's, or 50000")
      ->check(whole_number_between(1, 10'000'000))
      ->type_name("N");
  command
      .add_option("--at", given->at,
                  "time of its motion, s, whose error is estimated; else equilibrium under all loads")
      ->check(positive_number())
      ->type_name("T");
  return [given] { return refine_scene(*given); };
}

Action define_tune(CLI::App& command) {
  const auto given = std::make_shared<TuneArguments>();
  add_scene(command, given->scene);
  command
      .add_option("--within", given->within,
                  "the least error within so much computing time a frame of 1/60 s, for example 16ms")
      ->type_name("T");
  command.add_option("--error", given->error, "the least computing time within such an error, for example 1mm")
      ->type_name("E");
  command.add_option("--out", given->out, "the scene solved that way; else NAME_tuned.json")->type_name("FILE");
  command.add_flag("--quick", given->quick, "fewer methods, no other meshes");
  return [given] { return tune_scene(*given); };
}

Action define_fit(CLI::App& command) {
  const auto given = std::make_shared<FitArguments>();
  add_scene(command, given->scene);
  command.add_option("--data", given->data, "measured places of nodes, CSV")->type_name("FILE")->required();
  command
      .add_option("--parameter", given->parameters,
                  "a number to fit, by its path in the scene, perhaps with the value to begin at; once for each")
      ->type_name("PATH[=VALUE]")
      ->required()
      ->allow_extra_args(false);
  command.add_option("--out", given->out, "the scene with the fitted numbers; else NAME_fitted.json")
      ->type_name("FILE");
  return [given] { return fit(*given); };
}

Action define_bench(CLI::App& command) {
  const auto given = std::make_shared<BenchArguments>();
  command.add_option("SUITE", given->suite, "one of those below; none: all");
  command.add_option("--json", given->json, "write the rows into this file too")->type_name("FILE");
  command.add_option("--out", given->out, "draw charts into this folder (suites kernel and paper)")->type_name("DIR");
  command.add_flag("--quick", given->quick, "less than a minute: few and small bodies");
  return [given] { return bench(*given); };
}

Action define_study(CLI::App& command) {
  const auto given = std::make_shared<StudyArguments>();
  command
      .add_option("KIND", given->kind,
                  "accuracy: error against run time; stability: stiff and extreme cases; validation: published and "
                  "closed-form benchmarks")
      ->required();
  command.add_option("--out", given->out, "folder for report.html, its tables and charts")
      ->required()
      ->type_name("DIR");
  command.add_flag("--quick", given->quick, "within two minutes: fewer and smaller cases");
  takes_scene(command.add_option("--scene", given->scene, "accuracy: of this scene instead of the study's own"))
      ->type_name("SCENE");
  command
      .add_option("--case", given->cases,
                  "stability and accuracy: these of its cases alone, by number (may be given often)")
      ->check(whole_number_between(1, 99))
      ->type_name("N");
  return [given] { return study(*given); };
}

Action define_reference(CLI::App& command) {
  const auto given = std::make_shared<ReferenceArguments>();
  command.add_option("--out", given->out, "folder for the pages")->required()->type_name("DIR");
  const CLI::App* program = command.get_parent();
  return [given, program] { return write_reference(*given, *program); };
}

}  // namespace heml
