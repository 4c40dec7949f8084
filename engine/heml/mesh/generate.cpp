#include <fmt/format.h>

#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/generate.hpp>

namespace heml {
namespace {

constexpr double max_tets = 1e8;

void check_box(const Vec3& size, const std::array<int, 3>& cells, const Vec3& origin) {
  for (int i = 0; i < 3; ++i) {
    if (!(size[i] > 0) || !std::isfinite(size[i]))
      throw InputError("", "box.size", fmt::format("must be lengths greater than 0, has {}", size[i]));
    if (!std::isfinite(origin[i])) throw InputError("", "box.origin", fmt::format("must be finite, has {}", origin[i]));
    if (cells[i] < 1) throw InputError("", "box.cells", fmt::format("must be at least 1 each, has {}", cells[i]));
  }
  const double tets = 5.0 * cells[0] * cells[1] * cells[2];
  if (tets > max_tets)
    throw InputError("", "box.cells",
                     fmt::format("{} × {} × {} cells make {:.3g} tetrahedra", cells[0], cells[1], cells[2], tets),
                     fmt::format("at most {:.0e}", max_tets));
}

}  // namespace

TetMesh make_box(const Vec3& size, const std::array<int, 3>& cells, const Vec3& origin) {
  check_box(size, cells, origin);
  const auto [nx, ny, nz] = cells;
  TetMesh mesh;
  mesh.source = fmt::format("box {}x{}x{}", nx, ny, nz);
  mesh.nodes.reserve(std::size_t(nx + 1) * (ny + 1) * (nz + 1));
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.nodes.push_back(origin + size.cwiseProduct(Vec3(double(i) / nx, double(j) / ny, double(k) / nz)));

  // In each cell the corners with i+j+k even span the central tetrahedron, and each of the other four a corner one. So
  // the diagonals of neighbours agree. Bits of c: the corner's offset in x, y, z.
  mesh.tets.reserve(std::size_t(5) * nx * ny * nz);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const auto node = [i, j, k, nx = nx, ny = ny](int c) {
          return i + (c & 1) + (nx + 1) * (j + (c >> 1 & 1) + (ny + 1) * (k + (c >> 2 & 1)));
        };
        if ((i + j + k) % 2 == 0) {
          mesh.tets.push_back({node(0), node(3), node(6), node(5)});
          for (int c : {1, 2, 4, 7}) mesh.tets.push_back({node(c), node(c ^ 2), node(c ^ 1), node(c ^ 4)});
        } else {
          mesh.tets.push_back({node(1), node(2), node(4), node(7)});
          for (int c : {0, 3, 5, 6}) mesh.tets.push_back({node(c), node(c ^ 1), node(c ^ 2), node(c ^ 4)});
        }
      }
  mesh.regions.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace heml
