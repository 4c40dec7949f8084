#pragma once
// What an edit of a mesh takes: a cut and a removal of about a hundred elements.
#include <studies/bench.hpp>

namespace heml {

/// Rows of suite `step`, ms, of a regular cube of n cells a side, in float: of the elastic body alone, its layout
/// followed and made anew, in turn; and of the whole command, as a world takes it.
std::vector<BenchRow> edit_rows(int n, bool quick);

}  // namespace heml
