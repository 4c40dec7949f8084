#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/file_contents.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/readers.hpp>

namespace heml {
namespace {

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

ReadMesh read_by_ending(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".node" || ending == ".ele") {
    auto node = path, ele = path;
    node.replace_extension(".node");
    ele.replace_extension(".ele");
    for (const auto& file : {node, ele})
      if (std::error_code error; !std::filesystem::exists(file, error))
        throw InputError(file.string(), "", "there is no such file", "TetGen's .node and .ele stand side by side");
    return read_tetgen(node.string(), file_contents(node), ele.string(), file_contents(ele));
  }
  const std::string text = file_contents(path);
  if (ending == ".inp") return read_abaqus(path.string(), text);
  if (ending == ".feb") return read_feb(path.string(), text);
  if (ending == ".msh") return read_gmsh(path.string(), text);
  if (ending == ".mesh") return read_medit(path.string(), text);
  if (ending == ".vtk") return read_vtk(path.string(), text);
  return read_vtu(path.string(), text);
}

/// Number of tetrahedra of four nodes.
std::size_t count_linear(const ReadMesh& read) {
  std::size_t quadratic = 0;
  for (const auto& nodes : read.midedges) quadratic += nodes[0] >= 0;
  return read.mesh.tets.size() - quadratic;
}

/// Of a list, the nodes that are no corners of tetrahedra, each once.
std::vector<int> without_corners(std::vector<int> nodes, const TetMesh& mesh) {
  std::vector<bool> is_corner(mesh.nodes.size(), false);
  for (const Tet& tet : mesh.tets)
    for (const int n : tet) is_corner[static_cast<std::size_t>(n)] = true;
  std::erase_if(nodes, [&](int n) { return is_corner[static_cast<std::size_t>(n)]; });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Leaves out nodes of no tetrahedron, and numbers the others anew; tells of numbers that are not those of the file.
void leave_out(const std::filesystem::path& path, const std::vector<int>& nodes, TetMesh& mesh) {
  std::vector<bool> dropped(mesh.nodes.size(), false);
  for (const int n : nodes) dropped[static_cast<std::size_t>(n)] = true;
  std::vector<int> number(mesh.nodes.size(), -1);
  std::vector<Vec3> kept;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (dropped[n]) continue;
    number[n] = static_cast<int>(kept.size());
    kept.push_back(mesh.nodes[n]);
  }
  for (Tet& tet : mesh.tets)
    for (int& n : tet) n = number[static_cast<std::size_t>(n)];
  const auto first = std::find(dropped.begin(), dropped.end(), true);
  if (const auto moved = std::find(first, dropped.end(), false) - dropped.begin(); moved < std::ssize(dropped))
    warn(
        "{}: nodes are numbered anew, without those left out: \"nodes\" of a scene and results count from 0 what is "
        "left; node {} of the file, counted from 0, is {} there, and those before node {} keep their numbers",
        path.string(), moved, number[static_cast<std::size_t>(moved)], first - dropped.begin());
  mesh.nodes = std::move(kept);
}

/// The nodes of ten-node tetrahedra that are in the middle of edges alone; tells of them.
std::vector<int> unused_midedges(const std::filesystem::path& path, std::size_t linear, const ReadMesh& read) {
  std::vector<int> middles;
  for (const auto& nodes : read.midedges)
    if (nodes[0] >= 0) middles.insert(middles.end(), nodes.begin(), nodes.end());
  middles = without_corners(std::move(middles), read.mesh);
  warn("{}: {} tetrahedra have ten nodes; their {} mid-edge nodes were left out{}", path.string(),
       read.mesh.tets.size() - linear, middles.size(),
       linear > 0 ? fmt::format(", since {} have four", linear) : " (solver.element p2 uses them)");
  return middles;
}

/// The nodes of bricks, wedges and pyramids that are no corners; tells of the cells and of them.
std::vector<int> unused_middles(const std::filesystem::path& path, const ReadMesh& read) {
  const std::vector<int> middles = without_corners(read.middles, read.mesh);
  warn("{}: {} bricks, wedges and pyramids were divided into tetrahedra{}", path.string(), read.divided,
       middles.empty()
           ? ""
           : fmt::format("; the {} nodes in the middle of their edges and faces were left out", middles.size()));
  if (read.bent > 0)
    warn("{}: {} of them are so bent that their tetrahedra overlap: mesh it with tetrahedra, or with straighter cells",
         path.string(), read.bent);
  return middles;
}

}  // namespace

bool is_tet_mesh_file(const std::filesystem::path& path) {
  constexpr std::array endings{".msh", ".mesh", ".vtk", ".vtu", ".inp", ".feb", ".node", ".ele"};
  return std::find(endings.begin(), endings.end(), ending_of(path)) != endings.end();
}

TetMesh read_tet_mesh(const std::filesystem::path& path, MidEdges* midedges) {
  if (!is_tet_mesh_file(path))
    throw InputError(path.string(), "", "is no mesh of tetrahedra this program knows",
                     ".msh, .mesh, .vtk, .vtu, .inp, .feb, or .node with .ele");
  ReadMesh read = read_by_ending(path);
  read.mesh.source = path.string();
  if (read.mesh.tets.empty())
    throw InputError(path.string(), "",
                     fmt::format("holds {} nodes but no tetrahedra, and {} other cells with a volume",
                                 read.mesh.nodes.size(), read.ignored),
                     "a surface is filled by heml mesh");
  if (read.real_regions) warn("{}: the cell array 'region' is not of integers and was ignored", path.string());
  if (read.more_steps) warn("{}: holds fields for several time steps; the first was taken", path.string());
  if (read.ignored > 0)
    warn("{}: {} cells with a volume are of kinds that are not read and were ignored", path.string(), read.ignored);
  if (midedges) midedges->clear();
  const std::size_t linear = count_linear(read);
  std::vector<int> unused;
  if (midedges && linear == 0)
    *midedges = std::move(read.midedges);
  else if (!read.midedges.empty())
    unused = unused_midedges(path, linear, read);
  if (read.divided > 0) {
    const std::vector<int> middles = unused_middles(path, read);
    unused.insert(unused.end(), middles.begin(), middles.end());
  }
  if (!unused.empty()) leave_out(path, unused, read.mesh);
  return std::move(read.mesh);
}

}  // namespace heml
