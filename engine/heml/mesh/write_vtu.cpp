#include <heml/mesh/mesh_text.hpp>
#include <heml/mesh/write_vtu.hpp>

namespace heml {
namespace {

// Escapes a name for an XML attribute.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : c == '&' ? "&amp;" : std::string(1, c);
  return text;
}

constexpr const char* head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"LittleEndian\">\n";

void begin_array(MeshText& out, const char* type, const std::string& name, std::size_t components = 1) {
  out.add("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type, escaped(name),
          components);
}
void end_array(MeshText& out) { out.add("</DataArray>\n"); }

template <class Field>
void add_fields(MeshText& out, const std::vector<Field>& fields, std::size_t count) {
  for (const Field& field : fields) {
    begin_array(out, "Float64", field.name, field.components);
    for (std::size_t k = 0; k < count; ++k) out.add_values(field, k);
    end_array(out);
  }
}

/// Mid-edge nodes follow the corners in VTK's order: 01, 12, 02, 03, 13, 23.
void add_cells(MeshText& out, const std::vector<Tet>& tets, const MidEdges& midedges) {
  constexpr std::array<std::size_t, 6> vtk_edges{0, 3, 1, 2, 4, 5};
  const bool quadratic = !midedges.empty();
  out.add("<Cells>\n");
  begin_array(out, "Int64", "connectivity");
  for (std::size_t t = 0; t < tets.size(); ++t) {
    out.add_nodes(tets[t], 0);
    if (quadratic)
      for (const std::size_t e : vtk_edges) out.add(" {}", midedges[t][e]);
    out.add("\n");
  }
  end_array(out);
  begin_array(out, "Int64", "offsets");
  for (std::size_t t = 1; t <= tets.size(); ++t) out.add("{}\n", (quadratic ? 10 : 4) * t);
  end_array(out);
  begin_array(out, "UInt8", "types");
  for (std::size_t t = 0; t < tets.size(); ++t) out.add("{}\n", quadratic ? 24 : 10);  // VTK_QUADRATIC_TETRA, VTK_TETRA
  end_array(out);
  out.add("</Cells>\n");
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<NodeField>& fields,
               const MidEdges& midedges) {
  MeshText out;
  out.add(head, "UnstructuredGrid");
  out.add("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n", mesh.nodes.size(),
          mesh.tets.size());
  begin_array(out, "Float64", "Points", 3);
  for (const Vec3& x : mesh.nodes) {
    out.add_point(x);
    out.add("\n");
  }
  end_array(out);
  out.add("</Points>\n");
  add_cells(out, mesh.tets, midedges);
  out.add("<PointData>\n");
  add_fields(out, fields, mesh.nodes.size());
  out.add("</PointData>\n<CellData>\n");
  begin_array(out, "Int32", "region");
  for (const int region : mesh.regions) out.add("{}\n", region);
  end_array(out);
  add_fields(out, mesh.fields, mesh.tets.size());
  out.add("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  out.save(path);
}

void write_pvd(const std::filesystem::path& path, const std::vector<SeriesFile>& files) {
  MeshText out;
  out.add(head, "Collection");
  out.add("<Collection>\n");
  for (const SeriesFile& each : files)
    out.add("<DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", each.time, escaped(each.file));
  out.add("</Collection>\n</VTKFile>\n");
  out.save(path);
}

}  // namespace heml
