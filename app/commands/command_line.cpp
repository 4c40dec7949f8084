#include <fmt/format.h>

#include <app/commands/command_line.hpp>
#include <utility>
#include <vector>

namespace heml {
namespace {

constexpr CommandDefinition definitions[] = {
    {"run", "opens the window; without a usable display says so in one line and captures frames into ./heml-frames", "",
     define_run},
    {"capture", "writes frames as PNG, without a display", "Frame k, frame_0000k.png, shows simulated time k/fps.",
     define_capture},
    {"replay", "plays a recorded or hand-written session headless", "", define_replay},
    {"solve", "runs a scene without drawing: a static solve, or dynamics to its duration",
     "Writes positions.csv, positions_<k>.csv for the k-th of outputs.times, and report.json; where the scene asks\n"
     "for them .vtu files, markers.csv and history.csv; and after a recovery recovery.jsonl, which shows it again.",
     define_solve},
    {"export", "plays a scene or recording into files for other programs",
     "Examples:\n"
     "  heml export session.jsonl --out frames              # then open frames/frames.pvd in ParaView\n"
     "  heml export scene.json --out shape --format ply     # surfaces for Blender or MeshLab\n"
     "  heml export scene.json --out film.glb               # the moving surface for Blender and the web",
     define_export},
    {"explain", "says what a scene makes the engine run, what it leaves out and why, what it costs, what to change", "",
     define_explain},
    {"probe", "evaluates a law at given deformation gradients",
     "A state outside the range of the law gives nan in its row, one warning, and exit code 0.", define_probe},
    {"materials", "prints every law with its parameters, every tissue preset with its source", "", define_materials},
    {"bench-test", "computes the curve of a material test, or fits parameters to a measured one", "",
     define_bench_test},
    {"mesh",
     "fills a closed surface or a label map with tetrahedra, with a quality report; or improves a tetrahedral mesh",
     "Examples:\n"
     "  heml mesh liver.stl --scale 0.001 --out liver.msh\n"
     "  heml mesh liver.msh --out better.msh --improve                  # no angle below 10 degrees\n"
     "  heml mesh scan.vtu --out coarse.vtu --improve --tets 20000\n"
     "  heml mesh labels.nii.gz --out organs.msh --labels 1,3            # one region a label\n"
     "A label map (.nii .nii.gz .nrrd .nhdr .mha .mhd) comes to metres, right, anterior and superior.\n"
     "--improve keeps regions, fields and interfaces between regions, but not the order of nodes and elements.\n"
     "It prints tets, min_dihedral_deg, slivers (below 5 degrees), explicit_step_s (10 kPa, Poisson's ratio 0.45,\n"
     "1000 kg/m³) and surface_distance_m. Inverted elements are untangled or refused by number. Elements that the\n"
     "surface forces below the wanted angle are listed.",
     define_mesh},
    {"refine", "writes a scene on a mesh that is finer where its estimated error is greatest",
     "Examples:\n"
     "  heml refine sagging.json --out fine --error 5\n"
     "  heml refine assets/scenes/kidney_pull.json --out fine --at 1 --tets 10000\n"
     "A scene may ask for it itself: \"mesh\": {..., \"refine\": {\"error\": 0.05, \"tets\": 10000}}.\n"
     "Exit code 1: that error would take more tetrahedra; the best of those allowed is written.",
     define_refine},
    {"tune", "finds the best way to solve a scene, by measuring it",
     "Give one of --within and --error. Close other programs first: what is fast enough depends on this machine and\n"
     "its load.",
     define_tune},
    {"fit", "finds numbers of a scene with which its nodes rest where they were measured",
     "Examples:\n"
     "  heml fit kidney.json --data measured.csv --parameter materials[0].young\n"
     "  heml fit kidney.json --data measured.csv --parameter materials[0].young=8000 --parameter loads[0].force[1]\n"
     "measured.csv has the header node,x,y,z or node,x,y,z,sigma (metres; sigma: standard deviation of a coordinate).\n"
     "Loads act in full, events are left out. Standard errors and intervals are linearised at the solution.",
     define_fit},
    {"haptics", "computes the force that a recorded motion of a haptic handle meets, every millisecond",
     "The force comes each millisecond, however slow the engine.", define_haptics},
    {"bench", "measures speed on this machine, against a naive loop",
     "Close other programs first: ratios are of times taken in turn and survive a busy machine, times do not.\n"
     "Suites:\n"
     "  paper      the five bodies of the paper, HEML and Mass-Tensor\n"
     "  kernel     one force evaluation, every law\n"
     "  step       whole steps\n"
     "  terms      steps with viscosity, relaxation and the like, beside the law alone\n"
     "  threads    steps with one to all threads\n"
     "  roofline   what the machine could do\n"
     "Examples:\n"
     "  heml bench --quick                            # a first impression\n"
     "  heml bench kernel --json rows.json            # all laws, 320 to a million tetrahedra; takes a while\n"
     "  heml bench paper --out pictures               # the paper's tables, printed and measured",
     define_bench},
    {"study", "reports what the engine can be trusted with: accuracy, stability, validation",
     "A run that was interrupted goes on where it stopped when it is given the same --out.\n"
     "Exit code 1: a promised case falls short, an error of the quick accuracy study has grown, or a benchmark misses "
     "its limit.",
     define_study},
    {"reference", "writes the reference pages: commands.md, scene-format.md, laws.md",
     "The pages are made from the tables by which the program reads commands, scenes and laws.", define_reference},
};

constexpr ExitCodeInfo exit_codes[] = {
    {exit_done, "done", ""},
    {exit_check_failed, "a check failed",
     "`replay --verify` differs or is incomplete; a promised study case falls short or a value of the quick accuracy "
     "study has grown; `tune` found nothing good enough; `refine` has not reached its error"},
    {exit_usage, "wrong usage", ""},
    {exit_input, "bad input",
     "file, scene, mesh or material; an event that the world refuses; an output that cannot be written"},
    {exit_not_solved, "not converged, unstable, or beyond a law's range",
     "what was reached is written, and marked as such"},
    {exit_internal, "internal error", ""},
};

std::string program_footer() {
  std::string codes;
  for (const ExitCodeInfo& info : exit_codes)
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(info.code), info.meaning);
  return fmt::format(
      "Without a command the default scene opens.\n"
      "SCENE is {}.\n"
      "Examples:\n"
      "  heml run liver.obj                                 grasp your own organ\n"
      "  heml capture scene.json --out frames --frames 90   frames without a display\n"
      "  heml run --record session.jsonl                    record what you do ...\n"
      "  heml replay session.jsonl --verify                 ... and check that it plays the same\n"
      "Exit codes: {}.",
      scene_files, codes);
}

}  // namespace

const char* const scene_files =
    "a scene file (.json), a recording (.jsonl), a model of FEBio (.feb), or a mesh, surface or label map (.msh .mesh "
    ".vtk .vtu .inp .node .obj .stl .ply .nii .nrrd .mha)";

std::span<const CommandDefinition> command_definitions() { return definitions; }

std::span<const ExitCodeInfo> exit_code_table() { return exit_codes; }

int run_command_line(int argc, char** argv) {
  CLI::App program{"heml: interactive real-time simulation of hyperelastic soft tissue"};
  program.set_version_flag("--version", HEML_VERSION);
  program.footer(program_footer());
  program.require_subcommand(0, 1);
  program.fallthrough(false);
  std::vector<std::pair<CLI::App*, Action>> commands;
  for (const CommandDefinition& definition : definitions) {
    CLI::App* command = program.add_subcommand(definition.name, definition.description);
    command->footer(definition.footer);
    commands.emplace_back(command, definition.define(*command));
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? exit_done : exit_usage;
  }
  for (const auto& [command, action] : commands)
    if (*command) return action();
  return run(RunArguments());
}

}  // namespace heml
