#include <heml/mesh/mesh_text.hpp>
#include <heml/mesh/write_surface.hpp>

namespace heml {
namespace {

MeshText ply(const TriangleMesh& surface, const std::vector<NodeField>& fields) {
  MeshText out;
  out.add("ply\nformat ascii 1.0\ncomment metres\nelement vertex {}\n", surface.nodes.size());
  for (const char axis : {'x', 'y', 'z'}) out.add("property double {}\n", axis);
  for (const NodeField& field : fields)
    if (field.components == 1) out.add("property double {}\n", field.name);
  out.add("element face {}\nproperty list uchar int vertex_indices\nend_header\n", surface.triangles.size());
  for (std::size_t n = 0; n < surface.nodes.size(); ++n) {
    out.add_point(surface.nodes[n]);
    for (const NodeField& field : fields)
      if (field.components == 1) out.add(" {:.17g}", field.values[n]);
    out.add("\n");
  }
  for (const Triangle& t : surface.triangles) out.add("3 {} {} {}\n", t[0], t[1], t[2]);
  return out;
}

MeshText obj(const TriangleMesh& surface) {
  MeshText out;
  out.add("# metres\n");
  for (const Vec3& x : surface.nodes) {
    out.add("v ");
    out.add_point(x);
    out.add("\n");
  }
  for (const Triangle& t : surface.triangles) out.add("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

}  // namespace

void write_surface(const std::filesystem::path& path, const TriangleMesh& surface,
                   const std::vector<NodeField>& fields) {
  const std::string ending = path.extension().string();
  if (ending == ".ply") return ply(surface, fields).save(path);
  if (ending == ".obj") return obj(surface).save(path);
  throw InputError(path.string(), "", "surfaces are written by ending, not as '" + ending + "'", ".ply or .obj");
}

}  // namespace heml
