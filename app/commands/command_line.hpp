#pragma once
// The program's commands: name, help, options, and what they do. `--help` and the reference page (reference.hpp) both
// say what stands here.
#include <CLI/CLI.hpp>
#include <app/commands/commands.hpp>
#include <functional>
#include <span>
#include <string>

namespace heml {

/// What a command does once its options are read; returns the exit code.
using Action = std::function<int()>;

struct CommandDefinition {
  const char* name;
  const char* description;              ///< one line
  const char* footer;                   ///< what else there is to say: lines of prose; lines of a block are indented
  Action (*define)(CLI::App& command);  ///< gives the command its options
};
std::span<const CommandDefinition> command_definitions();

/// An exit code, as help lists it.
struct ExitCodeInfo {
  ExitCode code;
  const char* meaning;  ///< a few words
  const char* detail;   ///< the cases, where there is more to say
};
std::span<const ExitCodeInfo> exit_code_table();

/// What SCENE may be.
extern const char* const scene_files;

/// Runs what the arguments say. Throws InputError and UsageError.
int run_command_line(int argc, char** argv);

// Options of the commands, by what they are for: playing scenes, materials, meshes, measuring.
Action define_run(CLI::App& command);
Action define_capture(CLI::App& command);
Action define_replay(CLI::App& command);
Action define_solve(CLI::App& command);
Action define_export(CLI::App& command);
Action define_explain(CLI::App& command);
Action define_haptics(CLI::App& command);

Action define_probe(CLI::App& command);
Action define_materials(CLI::App& command);
Action define_bench_test(CLI::App& command);

Action define_mesh(CLI::App& command);
Action define_refine(CLI::App& command);

Action define_tune(CLI::App& command);
Action define_fit(CLI::App& command);
Action define_bench(CLI::App& command);
Action define_study(CLI::App& command);
Action define_reference(CLI::App& command);

}  // namespace heml
