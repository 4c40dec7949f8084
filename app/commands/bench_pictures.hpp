#pragma once
// What `heml bench` measured, drawn.
#include <filesystem>
#include <studies/bench.hpp>
#include <vector>

namespace heml {

/// Writes what the rows have numbers for, and returns the files: `ratios.png`, how many times faster than the naive
/// loop each law is on the largest body of the kernel suite; `carried.png`, what precision a body loses that travels.
std::vector<std::filesystem::path> write_bench_pictures(const std::filesystem::path& folder,
                                                        const std::vector<BenchRow>& rows);

}  // namespace heml
