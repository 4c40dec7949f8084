// `heml fit`: numbers of a scene from measured places of its nodes.
#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <charconv>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <set>
#include <studies/scene_fit.hpp>

namespace heml {
namespace {

/// "materials[0].young" or "materials[0].young=5000".
FitStart start_of(const std::string& given) {
  const std::size_t equals = given.find('=');
  if (equals == given.npos) return {given, std::nullopt};
  double value = 0;
  const char *begin = given.data() + equals + 1, *end = given.data() + given.size();
  const auto [read, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || read != end || !std::isfinite(value))
    throw UsageError(fmt::format("--parameter {}: must be PATH or PATH=NUMBER", given));
  return {given.substr(0, equals), value};
}

std::filesystem::path out_of(const FitArguments& arguments, const Scene& scene) {
  if (!arguments.out.empty()) return arguments.out;
  const auto stem = std::filesystem::path(scene.file).stem().string();
  return (stem.empty() ? std::string("scene") : stem) + "_fitted.json";
}

void print_fit(const SceneFit& fit) {
  fmt::print("{:<32} {:>13} {:>15}   {}\n", "parameter", "value", "standard error", "95 % confidence");
  for (const FittedNumber& number : fit.numbers)
    if (std::isinf(number.standard_error))
      fmt::print("{:<32} {:>13.6g}   not determined by these places\n", number.path, number.value);
    else
      fmt::print("{:<32} {:>13.6g} {:>15.3g}   {:.6g} to {:.6g}\n", number.path, number.value, number.standard_error,
                 number.low, number.high);
  fmt::print("rms {:.4g} mm, {} equilibria, {} iterations\n", fit.rms * 1e3, fit.equilibria, fit.iterations);
}

}  // namespace

int fit(const FitArguments& arguments) {
  if (arguments.parameters.empty()) throw UsageError("fit: give at least one --parameter PATH");
  std::vector<FitStart> starts;
  std::set<std::string> paths;
  for (const std::string& given : arguments.parameters) {
    starts.push_back(start_of(given));
    if (!paths.insert(starts.back().path).second)
      throw UsageError(fmt::format("--parameter {}: is given twice", starts.back().path));
  }
  const Scene scene = read_scene(arguments.scene);
  const std::filesystem::path out = out_of(arguments, scene);
  std::vector<std::filesystem::path> inputs = input_files(scene);
  inputs.push_back(arguments.data);
  check_output_file(inputs, out);
  const MeasuredPlaces measured = read_places_csv(arguments.data);
  const SceneFit found = [&] {
    Progress progress("fitting");
    return fit_scene(scene, measured, starts, [&](double share) { progress.show(share); });
  }();
  print_fit(found);
  write_file(out, scene_text(found.scene, std::filesystem::absolute(out).parent_path()));
  fmt::print("fitted scene: {}\n", out.string());
  if (found.converged) return exit_done;
  log_line("error", fmt::format("{}: the fit did not converge; what was reached is written", arguments.data.string()));
  return exit_not_solved;
}

}  // namespace heml
