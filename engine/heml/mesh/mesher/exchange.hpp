#pragma once
// The plain text the engine and its helper exchange: "#nodes #rows [#holes]", then x y z a node, then indices a row,
// then x y z a hole. The engine writes it, so the helper trusts it.
#include <cstdio>
#include <istream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesher {

/// A reason to stop that the engine passes on to people.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Exchange {
  std::vector<double> nodes;  ///< x y z, m
  std::vector<int> rows;      ///< `row` indices each
  std::vector<double> holes;  ///< x y z, m
};

Exchange read_exchange(std::istream& in, int row);
void write_exchange(std::FILE* file, const Exchange& exchange, int row);

/// Any surface file assimp knows: triangles as the file has them, nodes not joined. Throws Failure, and
/// std::bad_alloc where the memory is not enough.
Exchange read_surface(const std::string& path);

/// Tetrahedra in a closed surface; its nodes come first. max_volume: m³ of one, 0 for none. Throws Failure
/// and std::bad_alloc.
Exchange fill_surface(const Exchange& surface, double radius_edge_ratio, double max_volume);

}  // namespace mesher
