#pragma once
// The tables of `heml bench`, one form per suite: aligned Markdown.
#include <studies/bench.hpp>

namespace heml {

/// The rows of one suite in the form of that suite, and their notes, each once.
std::string suite_tables(std::span<const BenchRow> rows);

// The forms that suite_tables() chooses from.

/// One line per mesh and law: the naive loop, then each precision and number of threads.
std::string kernel_tables(std::span<const BenchRow> rows);
/// Tables 2 and 3 of the paper with values measured here; operations of the other laws; errors of a translated body.
std::string paper_tables(std::span<const BenchRow> rows);
/// Peaks of the machine; then, per mesh, law and precision, the fraction the best instruction set reaches.
std::string roofline_tables(std::span<const BenchRow> rows);
/// One line per row.
std::string plain_table(std::span<const BenchRow> rows);

}  // namespace heml
