#pragma once
// One reader a format, on text in memory: what read_tet_mesh() and the fuzzers call.
#include <heml/mesh/scanner.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <string_view>
#include <vector>

namespace heml {

/// What a reader found: all nodes and the linear tetrahedra; and what it passed over.
struct ReadMesh {
  TetMesh mesh;
  long ignored = 0;           ///< other cells with a volume
  bool real_regions = false;  ///< a cell array `region` that is not of integers
  bool more_steps = false;    ///< fields given for several time steps, of which the first was taken
};

ReadMesh read_gmsh(std::string file, std::string_view text);
ReadMesh read_medit(std::string file, std::string_view text);
ReadMesh read_vtk(std::string file, std::string_view text);
ReadMesh read_vtu(std::string file, std::string_view text);
ReadMesh read_tetgen(std::string node_file, std::string_view nodes, std::string ele_file, std::string_view tets);

/// The mesh's field of that name, made without values where there is none. Throws through `in` for one of other
/// components, and for too many fields.
ElementField& field_in(TetMesh& mesh, std::string_view name, std::size_t components, const Scanner& in);

/// Gives every field a place for every tetrahedron: not a number where there was none. Throws through `in` when that is
/// far more than the file holds.
void pad_fields(TetMesh& mesh, const Scanner& in);

/// Numbers a file gives its nodes (any, with gaps), to places in reading order. Fast where they simply count up.
class NodeNumbers {
 public:
  void reserve(std::size_t count) { numbers_.reserve(count); }
  void add(long long number) { numbers_.push_back({number, static_cast<int>(numbers_.size())}); }
  void close(const Scanner& in);                        ///< after the last add(); throws for a number given twice
  int find(long long number, const Scanner& in) const;  ///< throws for a number not given

 private:
  struct Entry {
    long long number;
    int node;
  };
  std::vector<Entry> numbers_;  ///< ascending after close()
};

/// Cells in VTK's arrays: cell c has the nodes connectivity[offsets[c]] .. connectivity[offsets[c+1]−1], from 0.
struct VtkCells {
  std::vector<long long> offsets;  ///< #C+1
  std::vector<long long> connectivity;
  std::vector<long long> types;      ///< #C, VTK's cell types
  std::vector<long long> regions;    ///< #C, or empty
  std::vector<ElementField> fields;  ///< of cells: #C in the place of #T
};

/// Adds an array of the cells; one of the same name before it is forgotten. Throws through `in` for too many.
void add_cell_field(ElementField field, const Scanner& in, VtkCells& cells);

/// Appends the tetrahedra among the cells and their fields; nodes are counted from `first_node`. Throws through `in`
/// for arrays that do not fit each other or the mesh's nodes.
void add_vtk_cells(const VtkCells& cells, int first_node, const Scanner& in, ReadMesh& read);

}  // namespace heml
