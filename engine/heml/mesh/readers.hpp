#pragma once
// One reader per format, for text in memory. Called by read_tet_mesh() and the fuzzers. All throw InputError.
#include <heml/mesh/quadratic.hpp>
#include <heml/mesh/scanner.hpp>
#include <heml/mesh/split_cell.hpp>
#include <string_view>
#include <vector>

namespace heml {

/// Result of a reader: all nodes, the tetrahedra, and what was skipped.
struct ReadMesh {
  TetMesh mesh;
  MidEdges midedges = {};     ///< of the tetrahedra up to the last of ten nodes; −1 in linear ones
  long divided = 0;           ///< number of bricks, wedges and pyramids among the cells
  long bent = 0;              ///< of them, those whose tetrahedra overlap
  std::vector<int> middles = {};  ///< their nodes that are no corners
  long ignored = 0;           ///< number of other volume cells
  bool real_regions = false;  ///< skipped a cell array `region` of real numbers
  bool more_steps = false;    ///< skipped further time steps of a field
};

ReadMesh read_abaqus(std::string file, std::string_view text);
ReadMesh read_feb(std::string file, std::string_view text);  ///< feb_mesh.hpp
ReadMesh read_gmsh(std::string file, std::string_view text);
ReadMesh read_medit(std::string file, std::string_view text);
ReadMesh read_vtk(std::string file, std::string_view text);
ReadMesh read_vtu(std::string file, std::string_view text);
ReadMesh read_tetgen(std::string node_file, std::string_view nodes, std::string ele_file, std::string_view tets);

/// Where a file format keeps each of tet_edges among the mid-edge nodes of a ten-node tetrahedron.
inline constexpr std::array<std::size_t, 6> gmsh_midedges{0, 2, 3, 1, 5, 4}, vtk_midedges{0, 2, 3, 1, 4, 5};

/// Gives the last tetrahedron of `read` its mid-edge nodes, in the order of its file.
void add_midedges(const std::array<int, 6>& nodes, const std::array<std::size_t, 6>& order, ReadMesh& read);

/// Appends the tetrahedra of a cell of another shape, without their regions. nodes: of the cell, its corners first.
void divide_cell(CellShape shape, std::span<const int> nodes, ReadMesh& read);

/// A name that fits on a line of every format: without control characters, and with ? for bytes that are not UTF-8.
std::string plain_name(std::string_view name);

/// The mesh's field of that name; creates it without values if there is none. Throws (Scanner::fail of `in`) if it has
/// another number of components, or there are too many fields.
ElementField& field_in(TetMesh& mesh, std::string_view name, std::size_t components, const Scanner& in);

/// Extends every field to all tetrahedra with NaN. Throws (Scanner::fail of `in`) if that makes far more values than
/// the file can hold.
void pad_fields(TetMesh& mesh, const Scanner& in);

/// Maps a file's node numbers (arbitrary, with gaps) to indices in reading order. find() takes constant time if numbers
/// are consecutive, else logarithmic.
class NodeNumbers {
 public:
  void reserve(std::size_t count) { numbers_.reserve(count); }
  void add(long long number) { numbers_.push_back({number, static_cast<int>(numbers_.size())}); }
  void finish(const Scanner& in);                       ///< after the last add(); throws for a duplicate number
  int find(long long number, const Scanner& in) const;  ///< throws for an unknown number
  int find_or_none(long long number) const;             ///< −1 for an unknown number

 private:
  struct Entry {
    long long number;
    int node;
  };
  std::vector<Entry> numbers_;  ///< ascending after finish()
};

/// Cells as VTK stores them: cell c has the nodes connectivity[offsets[c]] .. connectivity[offsets[c+1]−1], from 0.
struct VtkCells {
  std::vector<long long> offsets;  ///< #C+1
  std::vector<long long> connectivity;
  std::vector<long long> types;      ///< #C, VTK's cell types
  std::vector<long long> regions;    ///< #C, or empty
  std::vector<ElementField> fields;  ///< values of all cells: components × #C
};

/// Adds a field of the cells, replacing one of the same name. Throws (Scanner::fail of `in`) if there are too many.
void add_cell_field(ElementField field, const Scanner& in, VtkCells& cells);

/// Appends the tetrahedra of the cells and their fields; node 0 of the cells is the mesh's `first_node`. Throws
/// (Scanner::fail of `in`) if the arrays do not match each other or the mesh's nodes.
void add_vtk_cells(const VtkCells& cells, int first_node, const Scanner& in, ReadMesh& read);

}  // namespace heml
