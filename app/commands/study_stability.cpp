// `heml study stability`.
#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <studies/stability/matrix.hpp>
#include <studies/stability/report.hpp>

namespace heml {

int study_stability(const StudyArguments& arguments) {
  using namespace stability;
  check_case_numbers(arguments, static_cast<int>(stability::cases().size()));
  const auto promises = read_promises(promises_file());
  std::vector<Cell> cells;
  {
    Progress progress("measuring");
    StudyOptions options;
    options.quick = arguments.quick;
    options.only = arguments.cases;
    options.progress = [&](const std::string& what, double fraction) { progress.show(fraction, what); };
    cells = run_study(arguments.out / "results.jsonl", options);
  }
  check_promises(promises, cells);
  const auto write = [&](const char* name, const std::string& text) { write_file(arguments.out / name, text); };
  write("report.html", html_report(cells, compare_with_penalty(arguments.quick), arguments.quick));
  write("matrix.svg", matrix_svg(cells));
  write("cells.csv", csv_of(cells));
  write("holding.json", promises_text(cells));
  fmt::print("{}\n", answer(cells));
  const auto missed = shortfalls(cells);
  for (const std::string& line : missed) warn("falls short of its promise: {}", line);
  log_info("wrote {}", (arguments.out / "report.html").string());
  return missed.empty() ? exit_done : exit_check_failed;
}

}  // namespace heml
