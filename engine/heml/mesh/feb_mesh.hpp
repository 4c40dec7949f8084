#pragma once
// The mesh of a FEBio file (FEBio User's Manual, file format 2.5, 3.0, 4.0): nodes, parts, and named sets.
//
//   2.5          <Geometry>  <Elements type mat name>, NodeSet of <node id/>
//   3.0          <Mesh>      <Elements type name>, NodeSet of <n id/>      <MeshDomains> give parts their materials
//   4.0          <Mesh>      the same, NodeSet of a list of numbers
#include <heml/mesh/readers.hpp>
#include <heml/mesh/xml.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// An Elements block. Region k + 1 of the mesh is parts[k].
struct FebPart {
  XmlElement tag;
  std::string name;                       ///< "part 3" where the file gives none
  std::string element;                    ///< tet4, hex8, ...
  std::string material;                   ///< number (2.5) or name; empty: the file gives none
  std::optional<XmlElement> domain = {};  ///< of it in MeshDomains
  bool divided = false;                   ///< its elements into tetrahedra (split_cell.hpp)
};

struct FebSurface {
  std::vector<Triangle> triangles;  ///< corners, wound as in the file; two for a quadrilateral
  std::vector<int> nodes;           ///< of its triangles, with those in the middle of edges; ascending, each once
  bool has_other_facets = false;    ///< of further kinds, which are left out
};

/// Nodes are numbered from 0 in the order of the file.
struct FebMesh {
  ReadMesh read;
  std::vector<FebPart> parts;
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, FebSurface> surfaces;
  std::vector<XmlElement> unread;  ///< children of the mesh that are of no use here
};

/// The root of a FEBio file; checks its version. Throws InputError.
XmlElement feb_root(const XmlDocument& document);

/// Throws InputError naming the line.
FebMesh read_feb_mesh(const XmlElement& root);

}  // namespace heml
