#pragma once
// The stability report: what a person reads.
#include <string>
#include <studies/stability/penalty.hpp>
#include <studies/stability/study.hpp>

namespace heml::stability {

std::string html_report(const std::vector<Cell>& cells, const std::vector<PenaltyRow>& penalty, bool quick);
std::string csv_of(const std::vector<Cell>& cells);
/// A sentence, for the terminal and the head of the report: how many promises hold.
std::string answer(const std::vector<Cell>& cells);
/// A line a promised cell that falls short.
std::vector<std::string> shortfalls(const std::vector<Cell>& cells);

}  // namespace heml::stability
