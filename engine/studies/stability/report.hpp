#pragma once
// The stability report as HTML, CSV and text.
#include <string>
#include <studies/stability/penalty.hpp>
#include <studies/stability/study.hpp>

namespace heml::stability {

std::string html_report(const std::vector<Cell>& cells, const std::vector<PenaltyRow>& penalty, bool quick);
std::string csv_of(const std::vector<Cell>& cells);
/// How many promises hold, in a sentence for the terminal and the head of the report.
std::string answer(const std::vector<Cell>& cells);
/// One line per promised cell that falls short.
std::vector<std::string> shortfalls(const std::vector<Cell>& cells);

}  // namespace heml::stability
