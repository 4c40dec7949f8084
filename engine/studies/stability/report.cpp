#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <studies/html_page.hpp>
#include <studies/machine.hpp>
#include <studies/stability/matrix.hpp>
#include <studies/stability/report.hpp>

namespace heml::stability {
namespace {

bool holds(const Cell& cell) { return is_sound(cell.verdict) && cell.verdict != Verdict::unsolvable; }

std::vector<const Cell*> cells_of(const std::vector<Cell>& cells, int number, bool single) {
  std::vector<const Cell*> found;
  for (const Cell& cell : cells)
    if (cell.number == number && cell.variant.single == single) found.push_back(&cell);
  return found;
}

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

/// "24 of 24: at most 1.2e-11, limit 1e-06": how many hold, and the largest value of these.
std::string summary(const std::vector<const Cell*>& cells, double limit) {
  if (cells.empty()) return "not asked";
  double worst = -1;
  std::size_t good = 0;
  for (const Cell* cell : cells)
    if (holds(*cell)) {
      worst = std::max(worst, cell->outcome.value);
      ++good;
    }
  if (good == 0) return fmt::format("none of {}", cells.size());
  return fmt::format("{} of {}: at most {}, limit {}", good, cells.size(), short_number(worst), short_number(limit));
}

TextTable table_of_cases(const std::vector<Cell>& cells) {
  TextTable table;
  table.head = {"", "case", "holds when", "figure", "double", "float", "scenes"};
  for (const Case& c : cases()) {
    std::string scenes;
    for (const auto& scene : c.scenes) scenes += fmt::format("{}{}", scenes.empty() ? "" : ", ", scene);
    table.rows.push_back({std::to_string(c.number), c.name, c.holds, c.measured,
                          summary(cells_of(cells, c.number, false), c.limit),
                          summary(cells_of(cells, c.number, true), c.float_limit), scenes});
  }
  table.end_numbers = 1;
  return table;
}

Cells line_of(const Cell& cell) {
  const Case& c = case_numbered(cell.number);
  const Outcome& o = cell.outcome;
  std::string words = o.stopped;
  if (o.inverted > 0) words += fmt::format("{}{} inside out", words.empty() ? "" : "; ", o.inverted);
  for (const std::string& more : {o.broken, o.proof, o.note})
    if (!more.empty()) words += (words.empty() ? "" : "; ") + more;
  return {std::to_string(cell.number),
          c.name,
          cell.variant.law,
          cell.variant.integrator ? integrator_name(*cell.variant.integrator) : "",
          cell.variant.single ? "float" : "double",
          verdict_name(cell.verdict),
          short_number(o.value),
          short_number(c.limit_of(cell.variant)),
          cell.promised ? (cell.short_of_promise ? "falls short" : "promised") : "",
          words};
}

TextTable table_of_cells(const std::vector<const Cell*>& cells) {
  TextTable table;
  table.head = {"", "case", "law", "integrator", "precision", "verdict", "figure", "limit", "promise", "what was seen"};
  for (const Cell* cell : cells) table.rows.push_back(line_of(*cell));
  return table;
}

template <class Take>
std::vector<const Cell*> taken(const std::vector<Cell>& cells, const Take& take) {
  std::vector<const Cell*> found;
  for (const Cell& cell : cells)
    if (take(cell)) found.push_back(&cell);
  return found;
}

TextTable table_of_penalty(const std::vector<PenaltyRow>& rows) {
  TextTable table;
  table.head = {
      "start", "method", "back", "inside out", "away from rest", "longest step at rest", "stress changed at 1.3"};
  for (const PenaltyRow& row : rows)
    table.rows.push_back({row.start, row.method, row.back() ? "yes" : "no",
                          fmt::format("{} of {}", row.inverted, row.elements), percent(row.away),
                          fmt::format("× {:.2f}", row.max_step), percent(row.changed_stress)});
  table.first_number = 3;
  table.end_numbers = 7;
  return table;
}

/// For every method, from how many starts the body comes back to rest.
std::string penalty_answer(const std::vector<PenaltyRow>& rows) {
  std::vector<std::string> methods, words;
  for (const PenaltyRow& row : rows)
    if (std::find(methods.begin(), methods.end(), row.method) == methods.end()) methods.push_back(row.method);
  for (const std::string& method : methods) {
    int starts = 0, back = 0;
    for (const PenaltyRow& row : rows)
      if (row.method == method) ++starts, back += row.back();
    words.push_back(fmt::format("{}: {} of {}", method, back, starts));
  }
  return fmt::format("Back at rest with nothing inside out: {}.", fmt::join(words, "; "));
}

template <class Take>
void add_by_case(HtmlPage& page, const std::vector<Cell>& cells, const Take& take) {
  for (const Case& c : cases()) {
    const auto of_case = taken(cells, [&](const Cell& cell) { return cell.number == c.number && take(cell); });
    if (!of_case.empty())
      page.details(fmt::format("{} {}: {} of {}", c.number, c.name, of_case.size(),
                               taken(cells, [&](const Cell& cell) { return cell.number == c.number; }).size()),
                   table_of_cells(of_case));
  }
}

void add_failures(HtmlPage& page, const std::vector<Cell>& cells) {
  page.heading("What does not hold");
  if (taken(cells, [](const Cell& cell) { return !is_sound(cell.verdict); }).empty())
    page.paragraph("Nothing that was asked.");
  else
    page.paragraph("These are not promised, unless the column says so.");
  add_by_case(page, cells, [](const Cell& cell) { return !is_sound(cell.verdict); });
  if (taken(cells, [](const Cell& cell) { return cell.verdict == Verdict::unsolvable; }).empty()) return;
  page.heading("What has no solution");
  page.paragraph(
      "Saint Venant-Kirchhoff and springs soften without end when pressed. A run of them that stopped, or ended with "
      "elements inside out, has no solution where the static solver has followed its equilibria to a limit point, or "
      "where elements that are not inside out have lost ellipticity: the lowest eigenvalue of their acoustic tensor is "
      "negative for some direction. The last column says which.");
  add_by_case(page, cells, [](const Cell& cell) { return cell.verdict == Verdict::unsolvable; });
}

}  // namespace

std::vector<std::string> shortfalls(const std::vector<Cell>& cells) {
  std::vector<std::string> lines;
  for (const Cell& cell : cells)
    if (cell.short_of_promise)
      lines.push_back(fmt::format("case {} ({}), {}: {}, {} {}, limit {}{}{}", cell.number,
                                  case_numbered(cell.number).name, to_text(cell.variant), verdict_name(cell.verdict),
                                  case_numbered(cell.number).measured, short_number(cell.outcome.value),
                                  short_number(case_numbered(cell.number).limit_of(cell.variant)),
                                  cell.outcome.stopped.empty() ? "" : ": ", cell.outcome.stopped));
  return lines;
}

std::string answer(const std::vector<Cell>& cells) {
  const auto promised = taken(cells, [](const Cell& cell) { return cell.promised; });
  const auto missed = taken(cells, [](const Cell& cell) { return cell.short_of_promise; });
  const auto others = taken(cells, [](const Cell& cell) { return !cell.promised; });
  const auto count = [&](Verdict verdict) {
    return std::count_if(cells.begin(), cells.end(), [&](const Cell& cell) { return cell.verdict == verdict; });
  };
  return fmt::format(
      "{} of {} promised runs hold{}. Of {} runs in all {} are stable and {} recovered, {} are proven to have no "
      "solution; {} end inverted, {} diverge, {} are finite and wrong, none of them promised{}.",
      promised.size() - missed.size(), promised.size(), missed.empty() ? "" : "; the others fall short", cells.size(),
      count(Verdict::stable), count(Verdict::recovered), count(Verdict::unsolvable), count(Verdict::inverted),
      count(Verdict::diverged), count(Verdict::wrong), missed.empty() ? "" : fmt::format(" but {}", missed.size()));
}

std::string csv_of(const std::vector<Cell>& cells) {
  TextTable table = table_of_cells(taken(cells, [](const Cell&) { return true; }));
  table.head.front() = "number";
  for (std::size_t k = 0; k < cells.size(); ++k) table.rows[k][6] = fmt::format("{}", cells[k].outcome.value);
  return csv_text(table);
}

std::string html_report(const std::vector<Cell>& cells, const std::vector<PenaltyRow>& penalty, bool quick) {
  HtmlPage page("heml: stiff and extreme cases");
  page.answer(answer(cells));
  const auto missed = shortfalls(cells);
  for (const std::string& line : missed) page.paragraph("Falls short: " + line);
  page.paragraph(
      fmt::format("Every case is a question with a number for an answer and a limit for the number, asked of every "
                  "law, integrator and "
                  "precision for which it makes sense{}. That nothing is infinite is never enough.",
                  quick ? " (this quick report asks two laws of what moves)" : ""));
  page.svg(matrix_svg(cells), "The survival matrix. Point at a cell for its figure.");
  page.heading("The cases");
  page.paragraph(
      "How many ways hold, the largest figure among those, and its limit. Cases with a scene can be watched:");
  page.command("heml run assets/scenes/extreme/13_scatter.json");
  page.table(table_of_cases(cells));
  add_failures(page, cells);
  page.heading("Signed penalty volumes, and continued laws");
  page.paragraph(
      "The paper names signed penalty volumes (Irving, Teran & Fedkiw 2004) as a way to deal with inverted elements: "
      "½ k V (1 − v/V)² added for every element, k in units of λ + 2μ. The engine continues each law below its range "
      "instead, and, where asked, steps a collapsed body under a stable stand-in. All are let go from the collapses of "
      "cases 13 and 15 and from the disorder of case 12 (10 kPa, ν 0.45), and stepped for two seconds with damping.");
  page.answer(penalty_answer(penalty));
  page.table(table_of_penalty(penalty));
  page.paragraph(
      "A penalty is there at all deformations: it changes the stress of sound elements and shortens the explicit step, "
      "the "
      "more the stronger it is. A continuation begins where the law ends and does neither. Folded into itself a body "
      "may be "
      "at rest under either; that is what recovery is for.");
  page.heading("All runs");
  for (const Case& c : cases()) {
    const auto of_case = taken(cells, [&](const Cell& cell) { return cell.number == c.number; });
    if (!of_case.empty()) page.details(fmt::format("{} {}: {}", c.number, c.name, c.holds), table_of_cells(of_case));
  }
  const Machine machine = this_machine();
  page.heading("Made with");
  page.paragraph(fmt::format("heml {}, {}, {} cores, {}, {}. Made by:", machine.version, machine.cpu, machine.cores,
                             machine.compiler, machine.flags));
  page.command(fmt::format("heml study stability --out DIR{}", quick ? " --quick" : ""));
  return page.text();
}

}  // namespace heml::stability
