#pragma once
// What ParaView opens: bodies with values at their nodes and elements, and series of them.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <string>
#include <vector>

namespace heml {

/// Values of every node under a name.
struct NodeField {
  std::string name;
  std::size_t components;      ///< 1 or 3
  std::vector<double> values;  ///< components × #V, node after node
};

/// .vtu (ASCII, 17 significant digits) with the mesh's regions and fields, these of any number of components, and with
/// values of nodes. Throws InputError when it cannot be written.
void write_vtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<NodeField>& fields = {});

/// One file of a series.
struct SeriesFile {
  double time;       ///< s
  std::string file;  ///< beside the .pvd
};

/// .pvd: the list of a series' files and their times. Throws InputError likewise.
void write_pvd(const std::filesystem::path& path, const std::vector<SeriesFile>& files);

}  // namespace heml
