#pragma once
// Times of mesh edits: a cut and a removal of about a hundred elements.
#include <studies/bench.hpp>

namespace heml {

/// Rows of suite `step`, ms, of a regular cube of n cells a side, in float: the elastic body alone, its layout updated
/// and rebuilt, interleaved; and the whole command applied to a world.
std::vector<BenchRow> edit_rows(int n, bool quick);

}  // namespace heml
