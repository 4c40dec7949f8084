#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <studies/html_page.hpp>
#include <studies/machine.hpp>
#include <studies/validation/study.hpp>

namespace heml::validation {
namespace {

std::string percent(double part) { return std::isnan(part) ? "" : fmt::format("{:.2g}", 100 * part); }

TextTable table_of(const Validated& validated) {
  TextTable table;
  table.head = {"method", "quantity", "ours", "reference", "unit", "error, %", "limit, %", "verdict", "unknowns", "s"};
  for (const Row& r : validated.finding.rows)
    table.rows.push_back({r.method, r.quantity, fmt::format("{:.5g}", r.ours), fmt::format("{:.5g}", r.reference),
                          r.unit, percent(r.error()), percent(r.limit), verdict_name(r.verdict()),
                          std::to_string(r.unknowns), fmt::format("{:.2g}", r.seconds)});
  table.first_number = 2;
  table.end_numbers = 4;
  return table;
}

template <class Use>
void each_row(const std::vector<Validated>& study, const Use& use) {
  for (const Validated& validated : study)
    for (const Row& row : validated.finding.rows) use(row);
}

bool falls_short(const Row& row) { return row.verdict() == Verdict::misses || row.verdict() == Verdict::fails; }

}  // namespace

bool is_sound(const std::vector<Validated>& study) { return shortfalls(study).empty(); }

std::vector<std::string> shortfalls(const std::vector<Validated>& study) {
  std::vector<std::string> lines;
  each_row(study, [&](const Row& r) {
    if (falls_short(r))
      lines.push_back(fmt::format("{}, {}, {}: {:.5g} {} for {:.5g}, error {} %, limit {} %{}{}", r.benchmark, r.method,
                                  r.quantity, r.ours, r.unit, r.reference, percent(r.error()), percent(r.limit),
                                  r.failed.empty() ? "" : ": ", r.failed));
  });
  return lines;
}

std::string answer(const std::vector<Validated>& study) {
  std::size_t limited = 0, compared = 0;
  each_row(study, [&](const Row& r) { ++(std::isnan(r.limit) ? compared : limited); });
  const std::size_t missed = shortfalls(study).size();
  return fmt::format("{} of {} values of {} benchmarks are within their limits; {} more are for comparison.",
                     limited - std::min(limited, missed), limited, study.size(), compared);
}

TextTable row_table(const std::vector<Validated>& study) {
  TextTable table;
  table.head = {"problem", "quantity", "unit",    "ours",    "reference", "source",
                "error",   "limit",    "verdict", "element", "unknowns",  "seconds"};
  each_row(study, [&](const Row& r) {
    table.rows.push_back({r.benchmark, r.quantity, r.unit, fmt::format("{:.17g}", r.ours),
                          fmt::format("{:.17g}", r.reference), r.source, fmt::format("{:.17g}", r.error()),
                          std::isnan(r.limit) ? "" : fmt::format("{:.17g}", r.limit), verdict_name(r.verdict()),
                          r.method, std::to_string(r.unknowns), fmt::format("{:.17g}", r.seconds)});
  });
  return table;
}

std::string html_report(const std::vector<Validated>& study,
                        const std::map<std::string, std::filesystem::path>& pictures, bool quick) {
  HtmlPage page("heml: published and closed-form benchmarks");
  page.answer(answer(study));
  for (const std::string& line : shortfalls(study)) page.paragraph("Falls short: " + line);
  page.paragraph(fmt::format(
      "Each value is compared with a published one, a closed form, an ordinary integral or another program. "
      "References share no code with the engine. The error is relative to the reference; a value without limit is for "
      "comparison{}.",
      quick ? "; this quick report leaves most of those out" : ""));
  for (const Validated& validated : study) {
    page.heading(validated.benchmark->title);
    page.paragraph(validated.benchmark->description);
    page.paragraph(std::string("Reference: ") + validated.benchmark->source);
    if (const auto found = pictures.find(validated.benchmark->name); found != pictures.end())
      page.png(found->second, validated.benchmark->title);
    page.table(table_of(validated));
  }
  const Machine machine = this_machine();
  page.heading("Made with");
  page.paragraph(fmt::format("heml {}, {}, {} cores, {}, {}; solves on one thread. Made by:", machine.version,
                             machine.cpu, machine.cores, machine.compiler, machine.flags));
  page.command(fmt::format("heml study validation --out DIR{}", quick ? " --quick" : ""));
  return page.text();
}

}  // namespace heml::validation
