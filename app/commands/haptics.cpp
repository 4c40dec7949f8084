// `heml haptics`: the forces on a haptic handle along a recorded motion.
#include <fmt/format.h>

#include <algorithm>
#include <app/commands/commands.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/haptic_run.hpp>
#include <heml/scenario/input_files.hpp>
#include <iterator>

namespace heml {
namespace {

std::string csv_of(const std::vector<HapticSample>& samples) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "time,x,y,z,fx,fy,fz,energy,damping\n");
  for (const HapticSample& f : samples)
    fmt::format_to(std::back_inserter(text), "{:.6g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g}\n", f.time,
                   f.handle.x(), f.handle.y(), f.handle.z(), f.force.x(), f.force.y(), f.force.z(), f.energy,
                   f.damping);
  return fmt::to_string(text);
}

}  // namespace

int run_haptics(const HapticsArguments& arguments) {
  HapticLimits limits;
  limits.max_stiffness = arguments.max_stiffness, limits.force = arguments.force;
  const Scene scene = read_scene(arguments.scene);
  std::vector<std::filesystem::path> inputs = input_files(scene);
  inputs.push_back(arguments.handle);
  check_output_file(inputs, arguments.out);
  const HapticRun run = run_with_handle(scene, read_handle_csv(arguments.handle), limits);
  write_file(arguments.out, csv_of(run.samples));
  if (run.halt) {
    log_line("error", fmt::format("{}: {}; the samples up to there are in {}", arguments.scene, run.halt->message,
                                  arguments.out.string()));
    return exit_not_solved;
  }
  double max_value = 0, damping = 0, energy = 0;
  for (const HapticSample& f : run.samples) {
    max_value = std::max(max_value, f.force.norm());
    damping = std::max(damping, f.damping);
    energy = std::min(energy, f.energy);
  }
  fmt::print(
      "{} cycles of 1 ms in {}: max force {:.3g} N; min energy input of the handle {:.3g} J, max added damping {:.3g} "
      "N s/m\n",
      run.samples.size(), arguments.out.string(), max_value, energy, damping);
  return exit_done;
}

}  // namespace heml
