#include <fmt/format.h>

#include <cstdio>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/write.hpp>
#include <iterator>

namespace heml {
namespace {

// Text for a file. 17 significant digits give every double back.
class Text {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  void add_point(const Vec3& x) { add("{:.17g} {:.17g} {:.17g}", x[0], x[1], x[2]); }
  void add_nodes(const Tet& tet, int first) {
    add("{} {} {} {}", tet[0] + first, tet[1] + first, tet[2] + first, tet[3] + first);
  }
  void add_values(const ElementField& field, std::size_t tet) {
    for (std::size_t i = 0; i < field.components; ++i)
      add("{:.17g}{}", field.values[field.components * tet + i], i + 1 < field.components ? ' ' : '\n');
  }

  void save(const std::filesystem::path& path) const {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    const bool written = file && std::fwrite(text_.data(), 1, text_.size(), file) == text_.size();
    if (!file || (std::fclose(file) != 0) || !written) throw InputError(path.string(), "", "cannot be written");
  }

 private:
  fmt::memory_buffer text_;
};

// A name in an XML attribute.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : c == '&' ? "&amp;" : std::string(1, c);
  return text;
}
// A name as one word, as VTK's own writer has it: %XX in the place of what would end it.
std::string encoded(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += c <= ' ' || c > '~' || c == '%' || c == '"' ? fmt::format("%{:02X}", static_cast<unsigned char>(c))
                                                        : std::string(1, c);
  return text;
}

Text gmsh(const TetMesh& mesh) {
  Text out;
  out.add("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.nodes.size());
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

Text medit(const TetMesh& mesh) {
  Text out;
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

Text vtk(const TetMesh& mesh) {
  Text out;
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

Text vtu(const TetMesh& mesh) {
  Text out;
  out.add("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n");
  out.add("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.nodes.size(),
          mesh.tets.size());
  out.add("<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n");
  for (const Vec3& x : mesh.nodes) {
    out.add_point(x);
    out.add("\n");
  }
  out.add("</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
  for (const Tet& tet : mesh.tets) {
    out.add_nodes(tet, 0);
    out.add("\n");
  }
  out.add("</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
  for (std::size_t t = 1; t <= mesh.tets.size(); ++t) out.add("{}\n", 4 * t);
  out.add("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) out.add("10\n");
  out.add("</DataArray>\n</Cells>\n<CellData>\n<DataArray type=\"Int32\" Name=\"region\" format=\"ascii\">\n");
  for (int region : mesh.regions) out.add("{}\n", region);
  out.add("</DataArray>\n");
  for (const ElementField& field : mesh.fields) {
    out.add("<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
            escaped(field.name), field.components);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) out.add_values(field, t);
    out.add("</DataArray>\n");
  }
  out.add("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  return out;
}

Text tetgen_nodes(const TetMesh& mesh) {
  Text out;
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

Text tetgen_tets(const TetMesh& mesh) {
  Text out;
  out.add("{} 4 1\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.add("{} ", t);
    out.add_nodes(mesh.tets[t], 0);
    out.add(" {}\n", mesh.regions[t]);
  }
  return out;
}

}  // namespace

void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh) {
  const std::string ending = path.extension().string();
  if (ending == ".mesh" || ending == ".node") warn_of_fields(path, mesh);
  if (ending == ".msh") return gmsh(mesh).save(path);
  if (ending == ".mesh") return medit(mesh).save(path);
  if (ending == ".vtk") return vtk(mesh).save(path);
  if (ending == ".vtu") return vtu(mesh).save(path);
  if (ending != ".node")
    throw InputError(path.string(), "", "meshes are written by ending, not as '" + ending + "'",
                     ".msh, .mesh, .vtk, .vtu or .node");
  tetgen_nodes(mesh).save(path);
  tetgen_tets(mesh).save(std::filesystem::path(path).replace_extension(".ele"));
}

}  // namespace heml
