#pragma once
// Gmsh's $ElementData: a field by element numbers, of all elements or of some. Sections may stand before the elements,
// and one field may be spread over several of them (partitions), so they are put together when the file has ended.
#include <heml/mesh/readers.hpp>
#include <map>
#include <string>
#include <vector>

namespace heml {

/// What the file calls a tetrahedron.
struct GmshElement {
  long long number;
  int tet;
};

class GmshData {
 public:
  /// A section from behind its first line to before its last. Of a field given for several time steps the first is
  /// taken, which read.more_steps tells; data of other than 1 or 3 components are passed over.
  void read(Scanner& in, ReadMesh& read);

  /// Adds the fields that name at least one of the tetrahedra. Throws through `in`.
  void put(std::vector<GmshElement> tets, const Scanner& in, ReadMesh& read) const;

 private:
  struct Section {
    std::string name;
    long long step = 0;
    std::size_t components = 0, count = 0;  ///< of each element; of elements
    std::vector<long long> elements;
    std::vector<double> values;  ///< components × #elements
  };
  static Section header(Scanner& in);

  std::vector<Section> sections_;
  std::map<std::string, long long> first_step_;  ///< of each field
};

}  // namespace heml
