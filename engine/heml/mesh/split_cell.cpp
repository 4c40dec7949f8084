#include <algorithm>
#include <cmath>
#include <heml/mesh/split_cell.hpp>

namespace heml {
namespace {

using Face = std::array<int, 4>;  // outward; the last is −1 in a triangle

constexpr Face tetrahedron_faces[] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
constexpr Face pyramid_faces[] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
constexpr Face wedge_faces[] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr Face brick_faces[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::span<const Face> faces_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return tetrahedron_faces;
    case CellShape::pyramid:
      return pyramid_faces;
    case CellShape::wedge:
      return wedge_faces;
    case CellShape::brick:
      return brick_faces;
  }
  return {};
}

void add_cone(int tip, std::span<int> face, std::vector<Tet>& tets) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    if (face[0] != face[k] && face[k] != face[k + 1] && face[k + 1] != face[0])
      tets.push_back({tip, face[0], face[k], face[k + 1]});
}

}  // namespace

bool split_cell(CellShape shape, std::span<const int> corners, const std::vector<Vec3>& nodes, std::vector<Tet>& tets) {
  const std::size_t first = tets.size();
  const int tip = *std::min_element(corners.begin(), corners.end());
  for (const Face& face : faces_of(shape)) {
    std::array<int, 4> around{};
    const std::size_t count = face[3] < 0 ? 3 : 4;
    for (std::size_t k = 0; k < count; ++k) around[k] = corners[static_cast<std::size_t>(face[k])];
    if (std::find(around.begin(), around.begin() + count, tip) == around.begin() + count)
      add_cone(tip, std::span(around).first(count), tets);
  }
  double sum = 0, of_magnitudes = 0;
  for (std::size_t t = first; t < tets.size(); ++t) {
    const auto X = [&](std::size_t i) { return nodes[static_cast<std::size_t>(tets[t][i])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    sum += volume;
    of_magnitudes += std::abs(volume);
  }
  if (sum < 0)
    for (std::size_t t = first; t < tets.size(); ++t) std::swap(tets[t][2], tets[t][3]);
  return of_magnitudes - std::abs(sum) <= 1e-9 * of_magnitudes;
}

}  // namespace heml
