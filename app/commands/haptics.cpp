// `heml haptics`: what a recorded hand would feel.
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

std::string csv_of(const std::vector<FeltForce>& felt) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "time,x,y,z,fx,fy,fz,energy,damping\n");
  for (const FeltForce& f : felt)
    fmt::format_to(std::back_inserter(text), "{:.6g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g}\n", f.time,
                   f.hand.x(), f.hand.y(), f.hand.z(), f.force.x(), f.force.y(), f.force.z(), f.energy, f.damping);
  return fmt::to_string(text);
}

}  // namespace

int feel_scene(const HapticsArguments& arguments) {
  HapticLimits limits;
  limits.stiffest = arguments.stiffest, limits.force = arguments.force;
  const Scene scene = read_scene(arguments.scene);
  std::vector<std::filesystem::path> inputs = input_files(scene);
  inputs.push_back(arguments.hand);
  check_output_file(inputs, arguments.out);
  const HapticRun run = run_with_hand(scene, read_hand_csv(arguments.hand), limits);
  write_file(arguments.out, csv_of(run.felt));
  if (run.halt) {
    log_line("error", fmt::format("{}: {}; what was felt up to there is in {}", arguments.scene, run.halt->message,
                                  arguments.out.string()));
    return exit_not_solved;
  }
  double greatest = 0, damping = 0, energy = 0;
  for (const FeltForce& f : run.felt) {
    greatest = std::max(greatest, f.force.norm());
    damping = std::max(damping, f.damping);
    energy = std::min(energy, f.energy);
  }
  fmt::print(
      "{} turns of 1 ms in {}: at most {:.3g} N; least energy put in {:.3g} J, damping added up to {:.3g} N s/m\n",
      run.felt.size(), arguments.out.string(), greatest, energy, damping);
  return exit_done;
}

}  // namespace heml
