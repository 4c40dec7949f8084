#pragma once
// Files for ParaView: meshes with fields of nodes and elements (.vtu), and time series of them (.pvd).
#include <filesystem>
#include <heml/mesh/quadratic.hpp>
#include <string>
#include <vector>

namespace heml {

/// A named field of nodes.
struct NodeField {
  std::string name;
  std::size_t components;      ///< 1 or 3
  std::vector<double> values;  ///< components × #V, contiguous per node
};

/// Writes .vtu (ASCII, 17 significant digits) with the mesh's regions and fields, which may have any number of
/// components, and with fields of nodes; with mid-edge nodes as quadratic cells. Throws InputError if it cannot be
/// written.
void write_vtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<NodeField>& fields = {},
               const MidEdges& midedges = {});

/// One file of a time series.
struct SeriesFile {
  double time;       ///< s
  std::string file;  ///< relative to the folder of the .pvd
};

/// Writes .pvd: the files of a time series and their times. Throws InputError if it cannot be written.
void write_pvd(const std::filesystem::path& path, const std::vector<SeriesFile>& files);

}  // namespace heml
