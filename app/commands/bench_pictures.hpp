#pragma once
// Charts of `heml bench`.
#include <filesystem>
#include <studies/bench.hpp>
#include <vector>

namespace heml {

/// Writes the charts that the rows have values for, and returns their files: `ratios.png`, speedup of each law over the
/// naive loop on the largest body of the kernel suite; `carried.png`, error of the forces of a body moved away from the
/// origin.
std::vector<std::filesystem::path> write_bench_pictures(const std::filesystem::path& folder,
                                                        const std::vector<BenchRow>& rows);

}  // namespace heml
