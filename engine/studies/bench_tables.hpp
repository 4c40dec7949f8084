#pragma once
// The tables of `heml bench`, a suite each: Markdown, columns aligned.
#include <studies/bench.hpp>

namespace heml {

/// One suite's rows, in the form that suits it; notes of rows said once each.
std::string suite_tables(std::span<const BenchRow> rows);

// What suite_tables() takes.

/// A line a mesh and law: what a naive loop takes, then precisions and numbers of threads.
std::string kernel_tables(std::span<const BenchRow> rows);
/// Tables 2 and 3 of the paper beside ours; operations of the other laws; errors of a body that is carried away.
std::string paper_tables(std::span<const BenchRow> rows);
/// What the machine has; then, a line a mesh, law and precision, what of it the best instruction set reaches.
std::string roofline_tables(std::span<const BenchRow> rows);
/// A line a row.
std::string plain_table(std::span<const BenchRow> rows);

}  // namespace heml
