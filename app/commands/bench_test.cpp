// `heml bench-test`: curves of material tests, and parameters from measured ones.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <app/commands/chart_picture.hpp>
#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/theme.hpp>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/scenario/curve_csv.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {
namespace {

constexpr ImU32 law_colour = panel::colours::rgba(0x2a8578), given_colour = panel::colours::rgba(0xb4bcbb),
                data_colour = panel::colours::rgba(0xc2552d);
constexpr int max_points = 100000;

/// The tested material and its title in the chart.
struct TestedMaterial {
  Material material;
  std::string title;
  std::optional<StretchRange> stretch_range;  ///< of a preset
};

/// What a curve would silently leave out.
void expect_passive_and_elastic(const Material& material, const std::string& name) {
  const auto refuse = [&](const char* key) {
    throw InputError(name, key,
                     "has no part in a material test, whose curves are of passive tissue that does not yield",
                     "leave it out");
  };
  if (material.active_stress > 0) refuse("active_stress");
  if (material.plasticity) refuse("plasticity");
}

TestedMaterial tested_material(const std::string& name) {
  std::error_code error;
  const bool is_file = std::filesystem::exists(name, error);
  const Preset* preset = is_file ? nullptr : find_preset(name);
  if (preset) return {preset->material, fmt::format("{} ({})", preset->title, preset->name), preset->stretch_range};
  if (!is_file && std::filesystem::path(name).extension() != ".json") {
    std::vector<std::string_view> names;
    for (const Preset& known : presets()) names.push_back(known.name);
    throw InputError(name, "", "is neither a file nor a preset",
                     names.empty() ? "give a JSON file with one entry of a scene's `materials`"
                                   : fmt::format("did you mean '{}'? Presets: {}", nearest_name(name, names),
                                                 fmt::join(names, ", ")));
  }
  const Material material = read_material(name);
  const LawInfo& law = *find_law(material.law);
  if (!law.is_continuum)
    throw UsageError(fmt::format("{}: {} has no continuum energy, so no material test curve", name, law.name));
  if (!material.fields.empty() || !material.fibre_field.empty())
    throw InputError(name, "", "takes parameters from mesh fields, which a material test does not have",
                     "give numbers");
  expect_passive_and_elastic(material, name);
  return {material, fmt::format("{} ({})", law.title, std::filesystem::path(name).filename().string()), std::nullopt};
}

MeasuredTest test_of(const BenchTestArguments& arguments) {
  if (arguments.test == "relaxation") {
    if (!(arguments.step_stretch > 0) || !std::isfinite(arguments.step_stretch))
      throw UsageError(fmt::format("--step-stretch must be greater than 0, is {}", arguments.step_stretch));
    return Relaxation{arguments.step_stretch};
  }
  const auto names = bench_test_names();
  const auto found = std::find(names.begin(), names.end(), arguments.test);
  if (found == names.end())
    throw UsageError(fmt::format("--test {}: must be {} or relaxation", arguments.test, fmt::join(names, ", ")));
  return static_cast<BenchTest>(found - names.begin());
}

/// The range of the curve: stretch, γ or s.
StretchRange range_of(const BenchTestArguments& arguments, const MeasuredTest& test, const TestedMaterial& tested,
                      const std::optional<MeasuredCurve>& data) {
  StretchRange range{0.7, 1.5};
  if (const auto* bench = std::get_if<BenchTest>(&test)) {
    if (*bench == BenchTest::shear)
      range = {-0.5, 0.5};
    else if (tested.stretch_range)
      range = *tested.stretch_range;
  } else {
    double longest = 0;
    for (const PronyTerm& term : tested.material.relaxation) longest = std::max(longest, term.tau);
    range = {0, longest > 0 ? 5 * longest : 1};
  }
  if (data) {
    const auto [low, high] = std::minmax_element(data->amount.begin(), data->amount.end());
    const double rest =
        std::holds_alternative<Relaxation>(test) || std::get<BenchTest>(test) == BenchTest::shear ? 0 : 1;
    range = {std::min(rest, *low), std::max(rest, *high)};
  }
  range = {arguments.from.value_or(range.low), arguments.to.value_or(range.high)};
  const bool stretches = amount_name(test) == "stretch";
  if (!(range.low < range.high) || !std::isfinite(range.low) || !std::isfinite(range.high) ||
      (stretches && !(range.low > 0)) || (amount_name(test) == "time" && !(range.low >= 0)))
    throw UsageError(fmt::format("--from {} --to {}: must be finite{}, the first below the second", range.low,
                                 range.high, stretches ? " stretches above 0" : ""));
  return range;
}

/// Rows of amount, nominal stress, Cauchy stress (Pa), stretch in y, stretch in z; amounts where the law is not
/// defined.
struct CurveTable {
  std::vector<std::array<double, 5>> rows;
  std::vector<double> unreached;
};

CurveTable curve_of(const Material& material, const MeasuredTest& test, const std::vector<double>& amounts) {
  const auto law = make_material_point(material, false);
  CurveTable table;
  if (const auto* step = std::get_if<Relaxation>(&test)) {
    const BenchCurve held = run_bench(*law, BenchTest::uniaxial, std::span(&step->stretch, 1));
    if (!held.unreached.empty()) return {{}, amounts};
    const BenchPoint& p = held.points.front();
    for (const double time : amounts) {
      const double factor = relaxation_factor(material.relaxation, time);
      table.rows.push_back({time, factor * p.nominal, factor * p.cauchy, p.F(1, 1), p.F(2, 2)});
    }
    return table;
  }
  const BenchCurve curve = run_bench(*law, std::get<BenchTest>(test), amounts);
  for (const BenchPoint& p : curve.points) table.rows.push_back({p.amount, p.nominal, p.cauchy, p.F(1, 1), p.F(2, 2)});
  table.unreached = curve.unreached;
  return table;
}

void write_curve(const std::filesystem::path& path, const CurveTable& table, const MeasuredTest& test) {
  const std::string_view amount = amount_name(test);
  std::string text = fmt::format("{}{},nominal_stress_Pa,cauchy_stress_Pa,stretch_y,stretch_z\n", amount,
                                 amount == "time" ? "_s" : "");
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += fmt::format("{}{:.17g}", i ? "," : "", row[i]);
    text += '\n';
  }
  write_file(path, text);
}

panel::ChartSeries line_of(std::string name, const CurveTable& table, ImU32 colour, float thickness) {
  panel::ChartSeries series{std::move(name), {}, colour, panel::ChartMark::line, thickness};
  for (const auto& row : table.rows) series.points.push_back({row[0], row[1]});
  return series;
}

/// "Ogden: μ1 −358 Pa, α1 −4.7, κ 41.8 kPa".
std::string parameters_text(const Material& material) {
  const LawInfo& law = *find_law(material.law);
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  std::string text = fmt::format("{}:", law.title);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const double value = material.parameters[i];
    text += fmt::format("{} {} {}{}", i ? "," : "", slots[i].symbol(), value < 0 ? "−" : "",
                        slots[i].info->unit.empty() ? fmt::format("{:.3g}", std::abs(value))
                                                    : panel::quantity(std::abs(value), slots[i].info->unit));
  }
  return text;
}

panel::Chart chart_of(const TestedMaterial& tested, const MeasuredTest& test, const BenchTestArguments& arguments) {
  panel::Chart chart;
  chart.title = tested.title;
  chart.y_quantity = "Nominal stress";
  chart.y_unit = "Pa";
  const std::string_view amount = amount_name(test);
  chart.x_label = amount == "time" ? "Time, s" : amount == "gamma" ? "Shear γ" : "Stretch λ";
  if (tested.stretch_range && amount == "stretch")
    chart.band = {tested.stretch_range->low, tested.stretch_range->high, "measured range"};
  const std::string name =
      amount == "time" ? fmt::format("relaxation at a stretch of {:g}", arguments.step_stretch) : arguments.test;
  chart.subtitle = fmt::format("{} · {}", name, parameters_text(tested.material));
  return chart;
}

/// Adds the curve and, for a fit, the start curve and the measured points.
void add_curves(panel::Chart& chart, const CurveTable& given, const CurveTable& curve,
                const std::optional<FitResult>& fit, const std::optional<MeasuredCurve>& data) {
  if (fit) chart.series.push_back(line_of("start", given, given_colour, 0.8f));
  chart.series.push_back(
      line_of(fit ? fmt::format("fitted, R² {:.4g}", fit->r_squared) : "nominal stress", curve, law_colour, 1));
  if (!data) return;
  panel::ChartSeries dots{"measured", {}, data_colour, panel::ChartMark::dots};
  for (std::size_t i = 0; i < data->amount.size(); ++i) dots.points.push_back({data->amount[i], data->stress[i]});
  chart.series.push_back(std::move(dots));
}

void print_fit(const FitResult& fit) {
  fmt::print("{:<24} {:>14}   {}\n", "parameter", "value", "standard error");
  for (const FittedParameter& p : fit.parameters) {
    const std::string error = std::isinf(p.standard_error) ? "not determined by these data"
                              : p.determined
                                  ? fmt::format("{:.3g} {}", p.standard_error, p.unit)
                                  : fmt::format("{:.3g} {}: poorly determined by these data", p.standard_error, p.unit);
    fmt::print("{:<24} {:>14.6g}   {}\n", p.unit.empty() ? p.name : p.name + ", " + p.unit, p.value, error);
  }
  fmt::print("rms {:.4g} Pa, R² {:.6f}, {} iterations\n", fit.rms, fit.r_squared, fit.iterations);
}

std::filesystem::path fitted_entry(const BenchTestArguments& arguments) {
  return std::filesystem::path(arguments.out).replace_extension(".json");
}

void check_files(const BenchTestArguments& arguments) {
  std::vector<std::filesystem::path> inputs{arguments.material};
  if (arguments.data) inputs.push_back(*arguments.data);
  check_output_file(inputs, arguments.out);
  if (arguments.data) check_output_file(inputs, fitted_entry(arguments));
  if (arguments.plot) check_output_file(inputs, *arguments.plot, "--plot");
}

/// Fits, prints the parameters, and writes an entry for `materials` of scenes.
FitResult fit_to_data(const BenchTestArguments& arguments, const MeasuredTest& test, const MeasuredCurve& data,
                      const TestedMaterial& tested) {
  const FitOptions options{arguments.fit_all};
  if (const std::string problem = fit_problem(tested.material, test, data, options); !problem.empty())
    throw InputError(arguments.data->string(), "", problem);
  const FitResult fit = [&] {
    Progress progress("fitting");
    return fit_material(tested.material, test, data, options, [&](double share) { progress.show(share); });
  }();
  print_fit(fit);
  const std::filesystem::path entry = fitted_entry(arguments);
  write_file(entry, json_text(material_json({std::nullopt, fit.material}), entry.string(), true) + "\n");
  fmt::print("an entry for `materials` is in {}\n", entry.string());
  const SmallStrainModuli rest = small_strain_moduli(fit.material);
  if (!arguments.fit_all && rest.bulk < 10 * rest.shear)
    warn(
        "the bulk modulus was fixed at {:.4g} Pa, only {:.3g} times the fitted shear modulus: the tissue is not nearly "
        "incompressible any more; start from a larger one",
        rest.bulk, rest.bulk / rest.shear);
  return fit;
}

}  // namespace

int bench_test(const BenchTestArguments& arguments) {
  const MeasuredTest test = test_of(arguments);
  if (arguments.points < 2 || arguments.points > max_points)
    throw UsageError(fmt::format("--points must be from 2 to {}, is {}", max_points, arguments.points));
  if (arguments.data && arguments.out.extension() == ".json")
    throw UsageError("--out must not end in .json: the fitted material is written under that name");
  check_files(arguments);
  TestedMaterial tested = tested_material(arguments.material);
  const std::optional<MeasuredCurve> data =
      arguments.data ? std::make_optional(read_curve_csv(*arguments.data, test)) : std::nullopt;
  if (std::holds_alternative<Relaxation>(test) && tested.material.relaxation.empty())
    throw InputError(arguments.material, "", "the material has no relaxation",
                     "add \"relaxation\": [{\"gamma\": .., \"tau\": ..}]");
  const StretchRange range = range_of(arguments, test, tested, data);
  const std::vector<double> amounts = evenly_spaced(range.low, range.high, arguments.points);

  CurveTable given;
  std::optional<FitResult> fit;
  if (data) {
    given = curve_of(tested.material, test, amounts);
    fit = fit_to_data(arguments, test, *data, tested);
    tested.material = fit->material;
  }
  const CurveTable curve = curve_of(tested.material, test, amounts);
  write_curve(arguments.out, curve, test);
  if (arguments.plot) {
    panel::Chart chart = chart_of(tested, test, arguments);
    add_curves(chart, given, curve, fit, data);
    write_chart(*arguments.plot, chart);
  }
  if (curve.rows.empty()) {
    log_line("error", fmt::format("{}: the law is not defined anywhere from {} to {}", arguments.material, range.low,
                                  range.high));
    return exit_not_solved;
  }
  if (!curve.unreached.empty())
    warn(
        "{}: the curve covers only {:.6g} to {:.6g}: outside the law is not defined, or the free faces have no "
        "equilibrium",
        arguments.material, curve.rows.front()[0], curve.rows.back()[0]);
  if (fit && !fit->converged) {
    log_line("error",
             fmt::format("{}: the fit did not converge; what was reached is written", arguments.data->string()));
    return exit_not_solved;
  }
  fmt::print("{} points in {}\n", curve.rows.size(), arguments.out.string());
  return exit_done;
}

}  // namespace heml
