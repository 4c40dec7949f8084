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
  const bool at_rest = scene.solver.integrator == Integrator::static_equilibrium;
  const std::string pace = at_rest ? "" : fmt::format(" ({:.3g} times real time)", result.time / result.wall_seconds);
  fmt::print("{} in {} {}, {:.3g} s of computing{}; results in {}\n",
             at_rest ? std::string("equilibrium") : fmt::format("{} s", result.time), result.steps,
             at_rest ? "increments of the load" : "steps", result.wall_seconds, pace, arguments.out.string());
  return exit_done;
}

}  // namespace heml
