#pragma once
// Gmsh's $ElementData: a field by element numbers, for all elements or some. Sections may precede the elements, and a
// field may be split into several sections (partitions), so fields are assembled at the end of the file.
#include <heml/mesh/gmsh_numbers.hpp>
#include <heml/mesh/readers.hpp>
#include <map>
#include <string>
#include <vector>

namespace heml {

/// The number of a tetrahedron in the file, and its index in the mesh.
struct GmshElement {
  long long number;
  int tet;
};

class GmshData {
 public:
  /// Reads a section, from after its first line to before its last. Uses only the first of several time steps of a
  /// field and sets read.more_steps; skips data that have another number of components than fields may (tet_mesh.hpp).
  void read(Scanner& in, GmshNumbers& numbers, ReadMesh& read);

  /// Adds the fields with a value for at least one of the tetrahedra. Throws InputError (Scanner::fail of `in`).
  void put(std::vector<GmshElement> tets, const Scanner& in, ReadMesh& read) const;

 private:
  struct Section {
    std::string name;
    long long step = 0;
    std::size_t components = 0, count = 0;  ///< values per element; number of elements
    std::vector<long long> elements;
    std::vector<double> values;  ///< components × #elements
  };
  static Section header(Scanner& in);

  std::vector<Section> sections_;
  std::map<std::string, long long> first_step_;  ///< first time step of each field
};

}  // namespace heml
