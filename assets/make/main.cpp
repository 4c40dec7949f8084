// heml-make-assets FOLDER [NAME...]: makes the meshes of assets/meshes there, or those named.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <heml/mesh/quality.hpp>
#include <string>
#include <vector>

#include "mesher.hpp"

namespace {

using namespace heml;

/// Medit, 7 significant digits: a tenth of a micrometre on a body of decimetres, and small files.
void write(const std::string& path, const TetMesh& mesh) {
  std::ofstream file(path);
  file << fmt::format("MeshVersionFormatted 2\n# {}, metres, made by heml-make-assets\nDimension 3\n", mesh.source);
  file << fmt::format("Vertices\n{}\n", mesh.nodes.size());
  for (const Vec3& x : mesh.nodes) file << fmt::format("{:.7g} {:.7g} {:.7g} 0\n", x.x(), x.y(), x.z());
  file << fmt::format("Tetrahedra\n{}\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    file << fmt::format("{} {} {} {} {}\n", a + 1, b + 1, c + 1, d + 1, mesh.regions[t]);
  }
  file << "End\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

/// m, the least distance of a node from the opposite face: what limits the time step of explicit methods.
double min_altitude(const TetMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const Tet& tet : mesh.tets)
    for (int i = 0; i < 4; ++i) {
      const Vec3 &x = mesh.nodes[tet[i]], &a = mesh.nodes[tet[(i + 1) % 4]];
      const Vec3 normal = (mesh.nodes[tet[(i + 2) % 4]] - a).cross(mesh.nodes[tet[(i + 3) % 4]] - a).normalized();
      least = std::min(least, std::abs(normal.dot(x - a)));
    }
  return least;
}

void make_mesh(const std::string& folder, TetMesh mesh) {
  write(folder + "/" + mesh.source + ".mesh", mesh);
  fmt::print("{}\n{}\nleast altitude {:.3g} mm\n\n", mesh.source, to_text(check_tets(mesh)), 1e3 * min_altitude(mesh));
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty()) {
    fmt::print(stderr,
               "usage: heml-make-assets FOLDER [kidney] [kidney_coarse] [uterus] [liver] [irregular_cube] "
               "[inclusion]\n");
    return 2;
  }
  const auto wanted = [&](const char* name) {
    return arguments.size() == 1 || std::find(arguments.begin() + 1, arguments.end(), name) != arguments.end();
  };
  if (wanted("kidney")) make_mesh(arguments[0], make::mesh_of(make::kidney("kidney", 0.00575)));
  if (arguments.size() > 1 && wanted("kidney_coarse"))  // the start of kidney_adapted, which is shipped in its place
    make_mesh(arguments[0], make::mesh_of(make::kidney("kidney_coarse", 0.010)));
  if (wanted("uterus")) make_mesh(arguments[0], make::mesh_of(make::uterus()));
  if (wanted("liver")) make_mesh(arguments[0], make::mesh_of(make::liver()));
  if (wanted("irregular_cube")) make_mesh(arguments[0], make::irregular_cube());
  if (wanted("inclusion")) make_mesh(arguments[0], make::inclusion());
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "heml-make-assets: {}\n", error.what());
  return 1;
}
