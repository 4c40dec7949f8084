#include <algorithm>
#include <array>
#include <heml/base/log.hpp>
#include <heml/mesh/mesh_text.hpp>
#include <heml/mesh/write.hpp>
#include <heml/mesh/write_vtu.hpp>

namespace heml {
namespace {

// A name as one word, encoded like VTK's own writer: %XX for characters that would end a word.
std::string encoded(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += c <= ' ' || c > '~' || c == '%' || c == '"' ? fmt::format("%{:02X}", static_cast<unsigned char>(c))
                                                        : std::string(1, c);
  return text;
}

MeshText gmsh(const TetMesh& mesh) {
  MeshText out;
  out.add("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  if (!mesh.region_names.empty()) {
    out.add("$PhysicalNames\n{}\n", mesh.region_names.size());
    for (const auto& [region, name] : mesh.region_names) {
      std::string plain = name;
      for (char& c : plain)
        if (c == '"' || static_cast<unsigned char>(c) < ' ') c = ' ';
      out.add("3 {} \"{}\"\n", region, plain);
    }
    out.add("$EndPhysicalNames\n");
  }
  out.add("$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    out.add("{} ", n + 1);
    out.add_point(mesh.nodes[n]);
    out.add("\n");
  }
  out.add("$EndNodes\n$Elements\n{}\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.add("{} 4 2 {} {} ", t + 1, mesh.regions[t], mesh.regions[t]);
    out.add_nodes(mesh.tets[t], 1);
    out.add("\n");
  }
  out.add("$EndElements\n");
  for (const ElementField& field : mesh.fields) {
    out.add("$ElementData\n1\n\"{}\"\n1\n0\n3\n0\n{}\n{}\n", field.name, field.components, mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      out.add("{} ", t + 1);
      out.add_values(field, t);
    }
    out.add("$EndElementData\n");
  }
  return out;
}

MeshText medit(const TetMesh& mesh) {
  MeshText out;
  out.add("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", mesh.nodes.size());
  for (const Vec3& x : mesh.nodes) {
    out.add_point(x);
    out.add(" 0\n");
  }
  out.add("Tetrahedra\n{}\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.add_nodes(mesh.tets[t], 1);
    out.add(" {}\n", mesh.regions[t]);
  }
  out.add("End\n");
  return out;
}

MeshText vtk(const TetMesh& mesh) {
  MeshText out;
  out.add("# vtk DataFile Version 3.0\ntetrahedral mesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n",
          mesh.nodes.size());
  for (const Vec3& x : mesh.nodes) {
    out.add_point(x);
    out.add("\n");
  }
  out.add("CELLS {} {}\n", mesh.tets.size(), 5 * mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    out.add("4 ");
    out.add_nodes(tet, 0);
    out.add("\n");
  }
  out.add("CELL_TYPES {}\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) out.add("10\n");
  out.add("CELL_DATA {}\nSCALARS region int 1\nLOOKUP_TABLE default\n", mesh.tets.size());
  for (int region : mesh.regions) out.add("{}\n", region);
  if (!mesh.fields.empty()) out.add("FIELD FieldData {}\n", mesh.fields.size());
  for (const ElementField& field : mesh.fields) {
    out.add("{} {} {} double\n", encoded(field.name), field.components, mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) out.add_values(field, t);
  }
  return out;
}

MeshText tetgen_nodes(const TetMesh& mesh) {
  MeshText out;
  out.add("{} 3 0 0\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    out.add("{} ", n);
    out.add_point(mesh.nodes[n]);
    out.add("\n");
  }
  return out;
}

void warn_of_fields(const std::filesystem::path& path, const TetMesh& mesh) {
  if (mesh.fields.empty()) return;
  std::string names;
  for (const ElementField& field : mesh.fields) names += (names.empty() ? "" : ", ") + field.name;
  warn("{}: this format has no place for fields of elements; left out: {}", path.string(), names.substr(0, 200));
}

MeshText tetgen_tets(const TetMesh& mesh) {
  MeshText out;
  out.add("{} 4 1\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.add("{} ", t);
    out.add_nodes(mesh.tets[t], 0);
    out.add(" {}\n", mesh.regions[t]);
  }
  return out;
}

}  // namespace

bool is_written_mesh_file(const std::filesystem::path& path) {
  constexpr std::array endings{".msh", ".mesh", ".vtk", ".vtu", ".node"};
  return std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end();
}

void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  const std::string ending = path.extension().string();
  if (ending == ".mesh" || ending == ".node") warn_of_fields(path, mesh);
  if (ending == ".msh") return gmsh(mesh).save(path);
  if (ending == ".mesh") return medit(mesh).save(path);
  if (ending == ".vtk") return vtk(mesh).save(path);
  if (ending == ".vtu") return write_vtu(path, mesh);
  if (ending != ".node")
    throw InputError(path.string(), "", "meshes are written by ending, not as '" + ending + "'",
                     ".msh, .mesh, .vtk, .vtu or .node");
  tetgen_nodes(mesh).save(path);
  tetgen_tets(mesh).save(std::filesystem::path(path).replace_extension(".ele"));
}

}  // namespace heml
