// The command line. Every command is a file in commands/.
#include <CLI/CLI.hpp>
#include <app/commands/commands.hpp>
#include <app/commands/number_options.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/mesher_process.hpp>

namespace heml {
namespace {

int run_program(int argc, char** argv) {
  CLI::App program{"heml: interactive real-time simulation of hyperelastic soft tissue"};
  program.set_version_flag("--version", HEML_VERSION);
  program.footer(
      "Without a command the default scene opens.\n"
      "SCENE is a scene file (.json), a recording (.jsonl), or a mesh or surface file (.msh .mesh .vtk .vtu .node .obj "
      ".stl .ply).\n"
      "Examples:\n"
      "  heml run liver.obj                                 grasp your own organ\n"
      "  heml capture scene.json --out frames --frames 90   frames without a display\n"
      "  heml run --record session.jsonl                    record what you do ...\n"
      "  heml replay session.jsonl --verify                 ... and check that it plays the same\n"
      "Exit codes: 0 done, 1 a check failed, 2 wrong usage, 3 bad input, 4 not converged or unstable, 5 internal "
      "error.");
  program.require_subcommand(0, 1);
  program.fallthrough(false);
  int code = exit_done;
  const std::string size_help = "size of frames, pixels";

  RunArguments run_arguments;
  std::string run_size = "1280x720";
  auto* run_command = program.add_subcommand("run", "open the window (headless: capture frames instead)");
  run_command->add_option("SCENE", run_arguments.scene, "scene, recording, mesh or surface; none: the default scene");
  run_command->add_option("--record", run_arguments.record, "append every action to this recording (.jsonl)");
  const std::string beside_help =
      "run up to three variants of the body side by side: laws, integrators, float, nodal_pressure; joined by +";
  run_command->add_option("--beside", run_arguments.comparisons, beside_help)->delimiter(',')->allow_extra_args(false);
  run_command->add_option("--size", run_size, "size of the window, pixels")->capture_default_str();
  run_command->add_option("--exit-after", run_arguments.exit_after, "close by itself after so many seconds")
      ->check(number_between(0));
  run_command
      ->add_option("--draw-stall", run_arguments.draw_stall, "delay every drawing by so many milliseconds (for tests)")
      ->check(number_between(0));
  run_command->add_flag("--log-pictures", run_arguments.log_pictures,
                        "a line on stderr for every picture: what it shows, and what is still to come (for tests)");

  CaptureArguments capture_arguments;
  std::string capture_size = "1280x720";
  auto* capture_command = program.add_subcommand("capture", "write frames as PNG; needs no display");
  capture_command->add_option("SCENE", capture_arguments.scene,
                              "scene, recording, mesh or surface; none: the default scene");
  capture_command->add_option("--out", capture_arguments.out, "folder for frame_00000.png ...")->required();
  capture_command->add_option("--frames", capture_arguments.frames, "how many")
      ->capture_default_str()
      ->check(whole_number_between(1));
  capture_command->add_option("--size", capture_size, size_help)->capture_default_str();
  capture_command->add_option("--fps", capture_arguments.fps, "frames per simulated second")
      ->capture_default_str()
      ->check(positive_number());
  capture_command->add_option("--beside", capture_arguments.comparisons, beside_help)
      ->delimiter(',')
      ->allow_extra_args(false);
  capture_command->add_flag("--panel", capture_arguments.panel, "draw the panel too");

  ReplayArguments replay_arguments;
  std::string replay_size = "1280x720";
  auto* replay_command = program.add_subcommand("replay", "play a recorded or hand-written session headless");
  replay_command
      ->add_option("RECORDING", replay_arguments.recording, "what `heml run --record` wrote, or a scene with events")
      ->required();
  auto* verify_flag =
      replay_command->add_flag("--verify", replay_arguments.verify,
                               "compare every checkpoint and the end; exit 1 where one differs or is missing");
  replay_command
      ->add_flag("--partial", replay_arguments.partial, "with --verify: the recording was cut short and has no end")
      ->needs(verify_flag);
  replay_command->add_option("--frames", replay_arguments.frames, "write frames into this folder");
  replay_command->add_option(
      "--record", replay_arguments.record,
      "write what is played as a recording, with checkpoints: of a scene with a script, or anew");
  replay_command->add_option("--size", replay_size, size_help)->capture_default_str();
  replay_command->add_option("--fps", replay_arguments.fps, "frames per simulated second")
      ->capture_default_str()
      ->check(positive_number());
  replay_command->add_option("--threads", replay_arguments.threads, "instead of the recording's; never changes a bit")
      ->check(thread_count());

  SolveArguments solve_arguments;
  auto* solve_command =
      program.add_subcommand("solve", "run a scene without drawing and write positions.csv and report.json");
  solve_command->add_option("SCENE", solve_arguments.scene, "scene, recording, mesh or surface")->required();
  solve_command->add_option("--out", solve_arguments.out, "folder for the results")->required();

  ExportArguments export_arguments;
  auto* export_command = program.add_subcommand("export", "play a scene or recording into files for other programs");
  export_command->add_option("SCENE", export_arguments.scene, "scene, recording, mesh or surface")->required();
  export_command->add_option("--out", export_arguments.out, "folder for frame_00000.vtu ...")->required();
  export_command
      ->add_option("--format", export_arguments.format,
                   "vtu: the body with its fields, and frames.pvd for ParaView; ply: the surface with scalars of its "
                   "nodes; obj: the surface")
      ->capture_default_str()
      ->check(CLI::IsMember({"vtu", "ply", "obj"}));
  export_command->add_option("--fps", export_arguments.fps, "frames per simulated second")
      ->capture_default_str()
      ->check(positive_number());
  export_command->footer(
      "Examples:\n"
      "  heml export session.jsonl --out frames              then open frames/frames.pvd in ParaView\n"
      "  heml export scene.json --out shape --format ply     surfaces for Blender or MeshLab");

  ExplainArguments explain_arguments;
  auto* explain_command =
      program.add_subcommand("explain", "what a scene makes the engine run, what is omitted, and why");
  explain_command->add_option("SCENE", explain_arguments.scene, "scene, recording, mesh or surface")->required();
  explain_command->add_flag("--json", explain_arguments.json, "for programs: numbers with 17 digits");
  explain_command->add_flag("--measure", explain_arguments.measure,
                            "run each feature on and off: what it costs, and the error of leaving it out");

  ProbeArguments probe_arguments;
  auto* probe_command = program.add_subcommand("probe", "evaluate a law at given deformation gradients");
  probe_command->add_option("MATERIAL", probe_arguments.material, "JSON: one entry of a scene's `materials`")
      ->required();
  probe_command->add_option("--F", probe_arguments.gradients, "CSV: F11 ... F33 [dF11 ... dF33]")->required();
  probe_command->add_option("--out", probe_arguments.out, "CSV: W, P11 ... P33 [dP11 ... dP33], Pa")->required();

  MeshArguments mesh_arguments;
  auto* mesh_command =
      program.add_subcommand("mesh", "fill a closed surface with tetrahedra (or convert a tetrahedral mesh)");
  mesh_command->add_option("SURFACE", mesh_arguments.surface, "surface (.obj .stl .ply ...) or tetrahedral mesh")
      ->required();
  mesh_command->add_option("--out", mesh_arguments.out, ".msh, .mesh, .vtk, .vtu or .node")->required();
  mesh_command->add_option("--scale", mesh_arguments.scale, "multiplies coordinates: 0.001 for a file in millimetres")
      ->capture_default_str()
      ->check(positive_number());
  mesh_command->add_option("--radius-edge-ratio", mesh_arguments.radius_edge_ratio, "shape: smaller is better and more")
      ->capture_default_str()
      ->check(number_between(1, 100));
  mesh_command->add_option("--max-volume", mesh_arguments.max_volume, "of one tetrahedron, m³")
      ->check(positive_number());

  MaterialsArguments materials_arguments;
  auto* materials_command = program.add_subcommand("materials", "every law, its parameters, and tissues with sources");
  materials_command->add_flag("--json", materials_arguments.json, "for programs: numbers with 17 digits");

  BenchArguments speed_arguments;
  auto* speed_command = program.add_subcommand("bench", "measure speed on this machine, against a naive loop");
  speed_command->add_option(
      "SUITE", speed_arguments.suite,
      "paper: the five bodies of the paper, HEML and Mass-Tensor; kernel: one force evaluation, every "
      "law; step: whole steps; threads: steps with one to all threads; roofline: what the machine could do. None: all");
  speed_command->add_option("--json", speed_arguments.json, "write the rows into this file too");
  speed_command->add_option("--out", speed_arguments.out, "draw charts into this folder (suites kernel and paper)");
  speed_command->add_flag("--quick", speed_arguments.quick, "less than a minute: few and small bodies");
  speed_command->footer(
      "Close other programs first: ratios are of times taken in turn and survive a busy machine, times do not.\n"
      "Examples:\n"
      "  heml bench --quick                            a first impression\n"
      "  heml bench kernel --json rows.json            all laws, 320 to a million tetrahedra; takes a while\n"
      "  heml bench paper --out pictures               the paper's tables, printed and measured");

  StudyArguments study_arguments;
  auto* study_command = program.add_subcommand("study", "reports about what the engine can be trusted with");
  study_command
      ->add_option("KIND", study_arguments.kind, "accuracy: error against run time; stability: stiff and extreme cases")
      ->required();
  study_command->add_option("--out", study_arguments.out, "folder for report.html, its tables and charts")->required();
  study_command->add_flag("--quick", study_arguments.quick, "within two minutes: fewer and smaller cases");
  study_command->add_option("--scene", study_arguments.scene, "accuracy: of this scene instead of the study's own");
  study_command
      ->add_option("--case", study_arguments.cases, "stability: these cases alone, by number (may be given often)")
      ->check(whole_number_between(1, 33));
  study_command->footer(
      "A run that was interrupted goes on where it stopped when it is given the same --out.\n"
      "Exit code 1: a case that is promised falls short, or an error of the quick accuracy study has grown.");

  TuneArguments tune_arguments;
  auto* tune_command = program.add_subcommand("tune", "find the best way to solve a scene, by measuring it");
  tune_command->add_option("SCENE", tune_arguments.scene, "scene, recording, mesh or surface")->required();
  tune_command->add_option("--within", tune_arguments.within,
                           "min error within so much computing per frame of 1/60 s: 16ms");
  tune_command->add_option("--error", tune_arguments.error, "min computing time within such an error: 1mm");
  tune_command->add_option("--out", tune_arguments.out, "the tuned scene; else NAME_tuned.json");
  tune_command->add_flag("--quick", tune_arguments.quick, "fewer methods, no other meshes");
  tune_command->footer("Close other programs first: what is fast enough is a matter of this machine and this hour.");

  RefineArguments refine_arguments;
  auto* refine_command = program.add_subcommand("refine", "a scene on a mesh that is finer where it errs most");
  refine_command->add_option("SCENE", refine_arguments.scene, "scene, recording, mesh or surface")->required();
  refine_command->add_option("--out", refine_arguments.out, "folder for scene.json and its mesh.vtu")->required();
  refine_command
      ->add_option("--error", refine_arguments.error,
                   "per cent of the energy norm, as estimated, to come down to; else 10")
      ->check(number_between(0.1, 100));
  refine_command->add_option("--tets", refine_arguments.tets, "and no more tetrahedra than these; else 50000")
      ->check(whole_number_between(1, 10'000'000));
  refine_command
      ->add_option("--at", refine_arguments.at,
                   "time of its motion, s, whose error is estimated; else equilibrium under all loads")
      ->check(positive_number());
  refine_command->footer(
      "Examples:\n"
      "  heml refine sagging.json --out fine --error 5\n"
      "  heml refine assets/scenes/kidney_pull.json --out fine --at 1 --tets 10000\n"
      "A scene may ask for it itself: \"mesh\": {..., \"refine\": {\"error\": 0.05, \"tets\": 10000}}.\n"
      "Exit code 1: that error would take more tetrahedra; the best of those allowed is written.");

  HapticsArguments haptics_arguments;
  auto* haptics_command =
      program.add_subcommand("haptics", "the forces that a haptic handle on the tool of a scene feels");
  haptics_command->add_option("SCENE", haptics_arguments.scene, "scene with a grasp, or a recording of one")
      ->required();
  haptics_command->add_option("--hand", haptics_arguments.handle, "CSV of the handle: time,x,y,z in seconds and metres")
      ->required();
  haptics_command
      ->add_option("--out", haptics_arguments.out,
                   "CSV: position, force on the handle, energy and added damping each ms")
      ->required();
  haptics_command->add_option("--stiffest", haptics_arguments.max_stiffness, "N/m that the device is stable with")
      ->check(positive_number())
      ->capture_default_str();
  haptics_command->add_option("--force", haptics_arguments.force, "N that it can give")
      ->check(positive_number())
      ->capture_default_str();

  BenchTestArguments bench_arguments;
  auto* bench_command =
      program.add_subcommand("bench-test", "the curve of a material test, and parameters fitted to a measured one");
  bench_command
      ->add_option("MATERIAL", bench_arguments.material, "JSON: one entry of a scene's `materials`; or a preset's name")
      ->required();
  bench_command->add_option("--test", bench_arguments.test, "uniaxial, equibiaxial, planar, shear or relaxation")
      ->capture_default_str();
  bench_command->add_option("--out", bench_arguments.out, "CSV of the curve; with --data also NAME.json: the fit")
      ->required();
  bench_command->add_option("--plot", bench_arguments.plot, "PNG of the curve");
  bench_command->add_option("--data", bench_arguments.data,
                            "measured CSV to fit: stretch,stress (gamma,stress; time,stress), nominal stress in Pa");
  bench_command->add_option("--from", bench_arguments.from, "first stretch, shear or time");
  bench_command->add_option("--to", bench_arguments.to, "last one");
  bench_command->add_option("--points", bench_arguments.points, "of the curve")->capture_default_str();
  bench_command->add_option("--step-stretch", bench_arguments.step_stretch, "stretch held in a relaxation test")
      ->capture_default_str();
  bench_command->add_flag("--fit-all", bench_arguments.fit_all, "fit the bulk modulus (kappa, lambda) too");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? exit_done : exit_usage;
  }
  if (*capture_command) {
    capture_arguments.size = parse_size(capture_size);
    code = capture(capture_arguments);
  } else if (*replay_command) {
    replay_arguments.size = parse_size(replay_size);
    code = replay_recording(replay_arguments);
  } else if (*solve_command) {
    code = solve_scene(solve_arguments);
  } else if (*export_command) {
    code = export_frames(export_arguments);
  } else if (*explain_command) {
    code = explain_scene(explain_arguments);
  } else if (*probe_command) {
    code = probe(probe_arguments);
  } else if (*mesh_command) {
    code = mesh_surface(mesh_arguments);
  } else if (*materials_command) {
    code = materials(materials_arguments);
  } else if (*speed_command) {
    code = bench(speed_arguments);
  } else if (*study_command) {
    code = study(study_arguments);
  } else if (*tune_command) {
    code = tune_scene(tune_arguments);
  } else if (*haptics_command) {
    code = run_haptics(haptics_arguments);
  } else if (*refine_command) {
    code = refine_scene(refine_arguments);
  } else if (*bench_command) {
    code = bench_test(bench_arguments);
  } else {
    run_arguments.size = parse_size(run_size);
    code = run(run_arguments);
  }
  return code;
}

/// Runs the program; turns exceptions into messages and exit codes.
int guarded_run(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    log_line("error", error.what());
    return exit_input;
  } catch (const UsageError& error) {
    log_line("error", error.what());
    return exit_usage;
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return exit_done;  // of a print: flushed_output() reports it
    log_line("internal error", error.what());
    return exit_internal;
  }
}

/// Flushes stdout. If that fails, reports it once and returns exit_input, or `code` if that is an error already.
int flushed_output(int code) {
  errno = 0;
  const bool failed = std::fflush(stdout) != 0;
  if (!failed && !std::ferror(stdout)) return code;
  log_line("error",
           fmt::format("standard output: cannot be written{}{} (check where it goes, and the space left there)",
                       errno ? ": " : "", errno ? std::strerror(errno) : ""));
  return code == exit_done ? exit_input : code;
}

void end_by_signal(int signal) {
  kill_helper();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Signals that end the program end the mesher's process first. Ignored signals (nohup) stay ignored.
void handle_signals() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM})
    if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace
}  // namespace heml

int main(int argc, char** argv) {
  heml::handle_signals();
  return heml::flushed_output(heml::guarded_run(argc, argv));
}
