#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/solve.hpp>

namespace heml {

int solve_scene(const SolveArguments& arguments) {
  const Scene scene = read_scene(arguments.scene);
  SolveResult result;
  {
    Progress progress("solving");
    result = solve(scene, arguments.out, [&](double fraction) { progress.show(fraction); });
  }
  if (result.halt) {
    log_line("error", fmt::format("{}: {}; what was reached is in {}", scene.file, result.halt->message,
                                  arguments.out.string()));
    return exit_not_solved;
  }
  fmt::print("{} s in {} steps, {:.3g} s of computing; results in {}\n", result.time, result.steps, result.wall_seconds,
             arguments.out.string());
  return exit_done;
}

}  // namespace heml
