#pragma once
// The commands of the program (app/docs/commands.md). Each returns the exit code and throws InputError for bad input,
// UsageError for wrong usage; main.cpp turns these into messages and codes.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace heml {

/// app/docs/commands.md, "Exit codes".
enum ExitCode {
  exit_done = 0,
  exit_check_failed = 1,
  exit_usage = 2,
  exit_input = 3,
  exit_not_solved = 4,
  exit_internal = 5
};

struct ImageSize {
  int width = 1280, height = 720;
};
/// "1280x720". Throws UsageError.
ImageSize parse_size(const std::string& text);

struct CaptureArguments {
  std::string scene;  ///< empty: the default scene
  std::filesystem::path out = "heml-frames";
  int frames = 60;
  ImageSize size;
  double fps = 30;
  bool panel = false;
  std::string side;           ///< StandardView by name; empty: as the scene says
  bool orthographic = false;  ///< even where the scene does not say so
  std::vector<std::string> comparisons;  ///< variants to run in lockstep (heml/session/variant.hpp)
};
int capture(const CaptureArguments& arguments);

struct RunArguments {
  std::string scene;  ///< empty: the default scene
  std::optional<std::filesystem::path> record;
  std::vector<std::string> comparisons;  ///< variants to run in lockstep (heml/session/variant.hpp)
  std::optional<ImageSize> size;         ///< none: as the window was left
  double exit_after = 0;  ///< s until the window closes; 0: never
  double draw_stall = 0;  ///< ms added to every drawing
  bool log_pictures = false;
};
int run(const RunArguments& arguments);

struct ReplayArguments {
  std::filesystem::path recording;
  bool verify = false;
  bool partial = false;  ///< accept a recording without an end
  std::optional<std::filesystem::path> frames, record;
  std::string instructions;  ///< of the recording written, by name; empty: as the recording played says, else the best
  ImageSize size;
  double fps = 30;
  int threads = 0;  ///< 0: as the recording says
};
int replay_recording(const ReplayArguments& arguments);

struct SolveArguments {
  std::string scene;
  std::filesystem::path out;
};
int solve_scene(const SolveArguments& arguments);

struct ExportArguments {
  std::string scene;
  std::filesystem::path out;
  std::string format;  ///< vtu, ply, obj, glb or usda; empty: glb or usda where `out` ends so, else vtu
  double fps = 30;
};
int export_frames(const ExportArguments& arguments);

struct ExplainArguments {
  std::string scene;
  std::optional<std::filesystem::path> save;  ///< the scene as a file to edit
  bool json = false;
  bool measure = false;
};
int explain_scene(const ExplainArguments& arguments);

struct ProbeArguments {
  std::filesystem::path material, gradients, out;
};
int probe(const ProbeArguments& arguments);

struct MaterialsArguments {
  bool json = false;
};
int materials(const MaterialsArguments& arguments);

struct BenchArguments {
  std::string suite;                          ///< one of bench_suites(); empty: all
  std::optional<std::filesystem::path> json;  ///< the rows
  std::optional<std::filesystem::path> out;   ///< folder for charts
  bool quick = false;
};
int bench(const BenchArguments& arguments);

struct StudyArguments {
  std::string kind;           ///< one of the studies in study.cpp
  std::filesystem::path out;  ///< folder of the report
  bool quick = false;
  std::vector<int> cases;  ///< by number; empty: all
  std::string scene;       ///< empty: the study's own
};
int study(const StudyArguments& arguments);
/// Throws UsageError where a number of `--case` is beyond the study's last.
void check_case_numbers(const StudyArguments& arguments, int last);
int study_accuracy(const StudyArguments& arguments);    ///< exit_check_failed: a value of the quick study has grown
int study_stability(const StudyArguments& arguments);   ///< exit_check_failed: a promised case falls short
int study_validation(const StudyArguments& arguments);  ///< exit_check_failed: a value misses its limit

struct TuneArguments {
  std::string scene;
  std::string within, error;  ///< exactly one is given, with its unit
  std::filesystem::path out;  ///< empty: NAME_tuned.json here
  bool quick = false;
};
int tune_scene(const TuneArguments& arguments);  ///< exit_check_failed: no method reaches the goal

struct FitArguments {
  std::string scene;
  std::filesystem::path data;           ///< read_places_csv()
  std::vector<std::string> parameters;  ///< PATH or PATH=NUMBER
  std::filesystem::path out;            ///< empty: NAME_fitted.json here
};
int fit(const FitArguments& arguments);

struct RefineArguments {
  std::string scene;
  std::filesystem::path out;
  std::optional<double> error;  ///< per cent of the energy norm; none: the scene's, or 10
  std::optional<int> tets;      ///< at most; none: the scene's, or 50,000
  std::optional<double> at;     ///< s; none: equilibrium
};
int refine_scene(const RefineArguments& arguments);  ///< exit_check_failed: the error needs more elements

struct HapticsArguments {
  std::string scene;
  std::filesystem::path handle, out;
  double max_stiffness = 1000;  ///< N/m
  double force = 4;             ///< N
};
int run_haptics(const HapticsArguments& arguments);

struct BenchTestArguments {
  std::string material;           ///< a file with one entry of a scene's `materials`, or a preset's name
  std::string test = "uniaxial";  ///< one of bench_test_names(), or "relaxation"
  std::filesystem::path out;
  std::optional<std::filesystem::path> plot, data;
  std::optional<double> from, to;  ///< stretch, γ, or s
  int points = 201;
  double step_stretch = 1.1;  ///< of a relaxation test
  bool fit_all = false;
};
int bench_test(const BenchTestArguments& arguments);

struct MeshArguments {
  std::filesystem::path surface, out;
  double radius_edge_ratio = 1.4;
  std::optional<double> max_volume;  ///< m³
  double scale = 1;
  bool improve = false;
  std::optional<int> tets;          ///< wanted number; none: what the shapes need, or label_map_tets
  std::vector<int> labels;          ///< of a label map; empty: all
  std::optional<double> min_angle;  ///< degrees; none: default_min_angle
  std::optional<double> tolerance;  ///< m, of the surface; none: improve.hpp's
};
int mesh_surface(const MeshArguments& arguments);

struct ReferenceArguments {
  std::filesystem::path out;  ///< folder of the pages
};
/// program: the command line, as the page of commands describes it.
int write_reference(const ReferenceArguments& arguments, const CLI::App& program);

}  // namespace heml
