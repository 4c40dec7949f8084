// `heml study accuracy`: error against run time.
#include <fmt/format.h>

#include <app/commands/accuracy_pictures.hpp>
#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/text_file.hpp>

namespace heml {
namespace {

/// Values of the quick study to compare with; `cp DIR/figures.json` onto this file updates them.
constexpr const char* committed = "studies/accuracy_quick.json";

std::vector<std::string> worse_than_committed(const AccuracyStudy& study) {
  const auto file = assets_folder() / committed;
  return what_got_worse(result_values(study), parse_json(read_text_file(file), file.string()));
}

std::string cases_of(const StudyArguments& arguments) {
  std::string words;
  for (const int number : arguments.cases) words += fmt::format(" --case {}", number);
  return words;
}

std::string command_of(const StudyArguments& arguments) {
  return fmt::format("heml study accuracy --out {}{}{}", arguments.out.string(), arguments.quick ? " --quick" : "",
                     arguments.scene.empty() ? "" : " --scene " + arguments.scene) +
         cases_of(arguments);
}

AccuracyStudy measure(const StudyArguments& arguments, Results& results) {
  Progress progress("studying");
  AccuracyOptions options;
  options.quick = arguments.quick;
  if (!arguments.scene.empty()) options.scene = read_scene(arguments.scene);
  options.only = arguments.cases;
  options.results = &results;
  options.progress = [&](double fraction, const std::string& doing) { progress.show(fraction, doing); };
  return study_accuracy(options);
}

/// Refuses cases that the study has not.
void check_cases(const StudyArguments& arguments) {
  if (arguments.cases.empty()) return;
  if (!arguments.scene.empty())
    throw UsageError("study accuracy: --case chooses among the study's own, without --scene");
  check_case_numbers(arguments, accuracy_case_count(arguments.quick));
}

/// Refuses a scene of which the report would overwrite a file.
void check_scene(const StudyArguments& arguments) {
  if (arguments.scene.empty()) return;
  const auto files = {arguments.out / "results.jsonl", arguments.out / "runs.csv", arguments.out / "figures.json",
                      arguments.out / "report.html"};
  refuse_overwriting(input_files(read_scene(arguments.scene)), files);
}

void write_files(const StudyArguments& arguments, const AccuracyStudy& study, const std::vector<std::string>& worse) {
  const auto pictures = write_accuracy_pictures(arguments.out, study);
  write_file(arguments.out / "runs.csv", csv_text(run_table(study)));
  write_file(arguments.out / "figures.json",
             json_text(to_json(result_values(study)), (arguments.out / "figures.json").string(), true) + "\n");
  write_file(arguments.out / "report.html", accuracy_page(study, pictures, command_of(arguments), worse));
}

}  // namespace

int study_accuracy(const StudyArguments& arguments) {
  check_cases(arguments);
  check_scene(arguments);
  Results results(arguments.out / "results.jsonl");
  const AccuracyStudy study = measure(arguments, results);
  const bool has_figures = arguments.quick && arguments.scene.empty() && arguments.cases.empty();
  const auto worse = has_figures ? worse_than_committed(study) : std::vector<std::string>{};
  write_files(arguments, study, worse);
  for (const std::string& answer : answers_of(study)) fmt::print("{}\n", answer);
  fmt::print("the report is {}\n", (arguments.out / "report.html").string());
  for (const std::string& sentence : worse) log_line("error", sentence);
  return worse.empty() ? exit_done : exit_check_failed;
}

}  // namespace heml
