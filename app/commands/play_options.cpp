// Options of the commands that play a scene.
#include <app/commands/command_line.hpp>
#include <app/commands/number_options.hpp>
#include <app/commands/scene_option.hpp>
#include <heml/scenario/standard_view.hpp>
#include <memory>

namespace heml {
namespace {

void add_comparisons(CLI::App& command, std::vector<std::string>& comparisons) {
  command
      .add_option("--beside", comparisons,
                  "comparison runs: the same body, up to three, computed in other ways: laws, integrators, float, "
                  "nodal_pressure; joined by +, for example ogden+tr_bdf2")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B,C");
}

/// The value of `--size` becomes a size once it is read.
void add_size(CLI::App& command, std::string& size, const char* help) {
  command.add_option("--size", size, help)->capture_default_str()->type_name("WxH");
}

void add_fps(CLI::App& command, double& fps) {
  command.add_option("--fps", fps, "frames per simulated second")
      ->capture_default_str()
      ->check(positive_number())
      ->type_name("F");
}

constexpr const char* usual_size = "1280x720";
constexpr const char* frame_size_help = "size of frames, pixels";

}  // namespace

Action define_run(CLI::App& command) {
  const auto given = std::make_shared<RunArguments>();
  const auto size = std::make_shared<std::string>();
  add_scene_or_default(command, given->scene);
  command
      .add_option("--record", given->record,
                  "write every action as it happens into this recording (.jsonl), a new file")
      ->type_name("FILE");
  add_comparisons(command, given->comparisons);
  command.add_option("--size", *size, "size of the window, pixels; else as it was left, at first 1280x720")
      ->type_name("WxH");
  command.add_option("--exit-after", given->exit_after, "close by itself after so many seconds")
      ->check(number_between(0))
      ->type_name("S");
  command.add_option("--draw-stall", given->draw_stall, "delay every drawing by so many milliseconds (for tests)")
      ->check(number_between(0))
      ->type_name("MS");
  command.add_flag("--log-pictures", given->log_pictures,
                   "a line on stderr for every frame drawn: what it shows, and what is still to come (for tests)");
  return [given, size] {
    if (!size->empty()) given->size = parse_size(*size);
    return run(*given);
  };
}

Action define_capture(CLI::App& command) {
  const auto given = std::make_shared<CaptureArguments>();
  const auto size = std::make_shared<std::string>(usual_size);
  add_scene_or_default(command, given->scene);
  command.add_option("--out", given->out, "folder for frame_00000.png ...")->required()->type_name("DIR");
  command.add_option("--frames", given->frames, "how many")
      ->capture_default_str()
      ->check(whole_number_between(1))
      ->type_name("N");
  add_size(command, *size, frame_size_help);
  add_fps(command, given->fps);
  add_comparisons(command, given->comparisons);
  command.add_flag("--panel", given->panel, "draw the panel too");
  command.add_option("--view", given->side, "the side that faces the camera, in place of the scene's view")
      ->check(CLI::IsMember(std::vector<std::string>(standard_view_names.begin(), standard_view_names.end())))
      ->type_name("SIDE");
  command.add_flag("--orthographic", given->orthographic, "without perspective");
  return [given, size] {
    given->size = parse_size(*size);
    return capture(*given);
  };
}

Action define_replay(CLI::App& command) {
  const auto given = std::make_shared<ReplayArguments>();
  const auto size = std::make_shared<std::string>(usual_size);
  takes_scene(command
                  .add_option("RECORDING", given->recording,
                              "what `heml run --record` wrote, or a scene with events, or the name of an installed one")
                  ->required());
  auto* verify = command.add_flag("--verify", given->verify,
                                  "compare every checkpoint and the end; exit 1 where one differs or is missing");
  command.add_flag("--partial", given->partial, "with --verify: the recording was cut short by a crash and has no end")
      ->needs(verify);
  command.add_option("--frames", given->frames, "write frames into this folder")->type_name("DIR");
  auto* record =
      command
          .add_option("--record", given->record,
                      "write what is played as a recording, with checkpoints: of a scene with a script, or anew")
          ->type_name("FILE");
  command
      .add_option("--instructions", given->instructions,
                  "with --record: compute with these (portable, avx2, avx512) instead of the best; recordings made "
                  "with portable ones play on every processor")
      ->needs(record)
      ->excludes(verify)
      ->type_name("SET");
  add_size(command, *size, frame_size_help);
  add_fps(command, given->fps);
  command.add_option("--threads", given->threads, "in place of the recording's; never changes a bit")
      ->check(thread_count())
      ->type_name("N");
  return [given, size] {
    given->size = parse_size(*size);
    return replay_recording(*given);
  };
}

Action define_solve(CLI::App& command) {
  const auto given = std::make_shared<SolveArguments>();
  add_scene(command, given->scene);
  command.add_option("--out", given->out, "folder for the results")->required()->type_name("DIR");
  return [given] { return solve_scene(*given); };
}

Action define_export(CLI::App& command) {
  const auto given = std::make_shared<ExportArguments>();
  add_scene(command, given->scene);
  command.add_option("--out", given->out, "folder for frame_00000.vtu ..., or a file name in .glb or .usda")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--format", given->format,
                  "vtu: the body with its fields, and frames.pvd for ParaView; ply: the surface with scalars of its "
                  "nodes; obj: the surface; glb: the surface as one animated file for Blender and the web; usda: "
                  "surface and tetrahedra as one animated file of OpenUSD. Default: by the ending of --out, else vtu")
      ->check(CLI::IsMember({"vtu", "ply", "obj", "glb", "usda"}))
      ->type_name("F");
  add_fps(command, given->fps);
  return [given] { return export_frames(*given); };
}

Action define_explain(CLI::App& command) {
  const auto given = std::make_shared<ExplainArguments>();
  add_scene(command, given->scene);
  command.add_flag("--json", given->json, "for programs: numbers with 17 digits");
  command.add_flag("--measure", given->measure,
                   "run each feature on and off: its cost, and the error of leaving it out");
  command
      .add_option("--save", given->save,
                  "write the scene that is run as a scene file: what was chosen for a mesh, or read from a .feb model")
      ->type_name("FILE");
  return [given] { return explain_scene(*given); };
}

Action define_haptics(CLI::App& command) {
  const auto given = std::make_shared<HapticsArguments>();
  takes_scene(command.add_option("SCENE", given->scene, "scene with a grasp, or a recording of one")->required());
  command.add_option("--hand", given->handle, "CSV of the handle: time,x,y,z in seconds and metres")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--out", given->out,
                  "CSV: time,x,y,z, force on the handle fx,fy,fz, energy and added damping, each ms")
      ->required()
      ->type_name("FILE");
  command.add_option("--stiffest", given->max_stiffness, "N/m that the device is stable with")
      ->check(positive_number())
      ->capture_default_str()
      ->type_name("K");
  command.add_option("--force", given->force, "N that it can give")
      ->check(positive_number())
      ->capture_default_str()
      ->type_name("F");
  return [given] { return run_haptics(*given); };
}

}  // namespace heml
