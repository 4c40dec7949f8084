#pragma once
// The text that the engine and its helper exchange: "#nodes #rows [#holes]", then x y z per node, the node indices per
// row, x y z per hole. The helper trusts its input, which the engine writes.
#include <cstdio>
#include <istream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesher {

/// An error whose message the engine shows to the user.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Exchange {
  std::vector<double> nodes;  ///< #V×3, m
  std::vector<int> rows;      ///< `row` node indices per triangle (3) or tetrahedron (4)
  std::vector<double> holes;  ///< a point in each cavity, ×3, m
};

/// A surface to be drawn.
struct Skin {
  Exchange surface;          ///< triangles as in the file
  std::vector<float> looks;  ///< #V×5: texture coordinates u, v (up) and red, green, blue, 0 to 1
  bool has_places = false, has_colours = false;
  std::string texture;  ///< as the file names it; empty: none
};

Exchange read_exchange(std::istream& in, int row);
void write_exchange(std::FILE* file, const Exchange& exchange, int row);

/// Reads a surface in any format of assimp: triangles as in the file, nodes not merged. Throws Failure or
/// std::bad_alloc.
Exchange read_surface(const std::string& path);

/// Reads a surface in any format of assimp with what it says of colours. Throws Failure or std::bad_alloc.
Skin read_skin(const std::string& path);
/// "#has_places #has_colours", the texture in a line of its own, then as write_exchange() with five more numbers a
/// node.
void write_skin(std::FILE* file, const Skin& skin);

/// Fills a closed surface with tetrahedra; its nodes come first. max_volume: m³ per tetrahedron, 0: unlimited. Throws
/// Failure or std::bad_alloc.
Exchange fill_surface(const Exchange& surface, double radius_edge_ratio, double max_volume);

}  // namespace mesher
