// `heml study validation`: published and closed-form benchmarks.
#include <fmt/format.h>

#include <algorithm>
#include <app/commands/chart_picture.hpp>
#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <app/panel/theme.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <studies/validation/study.hpp>

namespace heml {
namespace {

using validation::Validated;

// Colours that are safe for colour-blind readers (Okabe & Ito). A curve of ours has the colour of the reference before
// it.
constexpr ImU32 inks[] = {panel::colours::rgba(0x0072b2), panel::colours::rgba(0xd55e00),
                          panel::colours::rgba(0x009e73), panel::colours::rgba(0xcc79a7),
                          panel::colours::rgba(0xe69f00)};
constexpr panel::ChartMark marks[] = {panel::ChartMark::rings, panel::ChartMark::crosses, panel::ChartMark::dots};

panel::Chart chart_of(const Validated& validated) {
  panel::Chart chart;
  chart.title = validated.benchmark->title;
  chart.subtitle = "lines: reference; marks: heml";
  chart.x_label = validated.benchmark->x_label;
  chart.y_quantity = validated.benchmark->y_label;
  chart.y_unit = validated.benchmark->y_unit;
  std::size_t references = 0, ours = 0;
  for (const validation::Curve& curve : validated.finding.curves) {
    panel::ChartSeries series{curve.name, {}, 0, panel::ChartMark::line, 1.6f};
    references += curve.reference, ours = curve.reference ? 0 : ours + 1;
    series.colour = inks[(std::max<std::size_t>(references, 1) - 1) % std::size(inks)];
    if (!curve.reference) series.mark = marks[(ours - 1) % std::size(marks)];
    for (const auto& [x, y] : curve.points) series.points.push_back({x, y});
    chart.series.push_back(std::move(series));
  }
  return chart;
}

std::vector<Validated> validate(const StudyArguments& arguments) {
  Results results(arguments.out / "results.jsonl");
  Progress progress("validating");
  StudyContext context;
  context.results = &results;
  double done = 0;
  context.step_done = [&](const std::string& what) {
    progress.show(++done / static_cast<double>(validation::benchmarks().size()), what);
  };
  return validation::run_study(arguments.quick, context);
}

}  // namespace

int study_validation(const StudyArguments& arguments) {
  const auto study = validate(arguments);
  std::map<std::string, std::filesystem::path> pictures;
  for (const Validated& validated : study) {
    if (validated.finding.curves.empty()) continue;
    const auto file = arguments.out / fmt::format("{}.png", validated.benchmark->name);
    write_chart(file, chart_of(validated));
    pictures[validated.benchmark->name] = file;
  }
  write_file(arguments.out / "rows.csv", csv_text(validation::row_table(study)));
  write_file(arguments.out / "report.html", validation::html_report(study, pictures, arguments.quick));
  fmt::print("{}\nthe report is {}\n", validation::answer(study), (arguments.out / "report.html").string());
  for (const std::string& line : validation::shortfalls(study)) log_line("error", line);
  return validation::is_sound(study) ? exit_done : exit_check_failed;
}

}  // namespace heml
