#include <algorithm>
#include <cstdint>
#include <heml/mesh/reorder.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr int bits = 21;  // per dimension; 63 in total

// Position of a cell along the Hilbert curve through a grid of 2^21 cells per dimension (J. Skilling, Programming the
// Hilbert curve, AIP Conf. Proc. 707 (2004), "AxestoTranspose" for n = 3).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (int i = 0; i < 3; ++i) {
      if (x[i] & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & p;
        x[0] ^= t;
        x[i] ^= t;
      }
    }
  }
  for (int i = 1; i < 3; ++i) x[i] ^= x[i - 1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  for (std::uint32_t& value : x) value ^= t;
  std::uint64_t key = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (int i = 0; i < 3; ++i) key = key << 1 | (x[i] >> b & 1);
  return key;
}

// Grid over the bounding cube of the nodes in use.
struct Grid {
  Vec3 low;
  double scale;

  std::uint64_t key(const Vec3& point) const {
    std::array<std::uint32_t, 3> cell;
    for (int i = 0; i < 3; ++i)
      cell[i] = static_cast<std::uint32_t>(std::clamp((point[i] - low[i]) * scale, 0.0, (1u << bits) - 1.0));
    return hilbert_key(cell);
  }
};

// Sorts items by ascending key, ties by number; `rank` is the inverse of `order`.
void sort_by_key(const std::vector<std::uint64_t>& keys, std::vector<int>& order, std::vector<int>& rank) {
  order.resize(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  rank.resize(keys.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<int>(i);
}

}  // namespace

Reordering hilbert_order(const TetMesh& mesh, const MidEdges& midedges) {
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Tet& tet : mesh.tets)
    for (int node : tet) used[node] = 1;
  for (const auto& nodes : midedges)
    for (int node : nodes) used[node] = 1;
  Eigen::AlignedBox3d box;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (used[n]) box.extend(mesh.nodes[n]);
  const double extent = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  const Grid grid{box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.min()), extent > 0 ? ((1u << bits) - 1) / extent : 0};

  Reordering order;
  std::vector<std::uint64_t> keys(mesh.nodes.size());
  constexpr std::uint64_t last = ~std::uint64_t{0};  // key of orphans, above every 63-bit key
  for (std::size_t n = 0; n < keys.size(); ++n) keys[n] = used[n] ? grid.key(mesh.nodes[n]) : last;
  sort_by_key(keys, order.file_node, order.new_node);

  keys.resize(mesh.tets.size());
  for (std::size_t t = 0; t < keys.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    keys[t] = grid.key((mesh.nodes[tet[0]] + mesh.nodes[tet[1]] + mesh.nodes[tet[2]] + mesh.nodes[tet[3]]) / 4);
  }
  sort_by_key(keys, order.file_tet, order.new_tet);
  return order;
}

TetMesh reordered(const TetMesh& mesh, const Reordering& order) {
  TetMesh result;
  result.source = mesh.source;
  result.region_names = mesh.region_names;
  result.nodes.reserve(mesh.nodes.size());
  for (int node : order.file_node) result.nodes.push_back(mesh.nodes[node]);
  result.tets.reserve(mesh.tets.size());
  result.regions.reserve(mesh.tets.size());
  for (int t : order.file_tet) {
    Tet tet = mesh.tets[t];
    for (int& node : tet) node = order.new_node[node];
    result.tets.push_back(tet);
    result.regions.push_back(mesh.regions[t]);
  }
  if (!mesh.burns.empty())
    for (int t : order.file_tet) result.burns.push_back(mesh.burns[t]);
  for (const ElementField& field : mesh.fields) {
    ElementField& inner = result.fields.emplace_back(ElementField{field.name, field.components, {}});
    inner.values.reserve(field.values.size());
    for (int t : order.file_tet)
      for (std::size_t i = 0; i < field.components; ++i)
        inner.values.push_back(field.values[field.components * static_cast<std::size_t>(t) + i]);
  }
  return result;
}

MidEdges reordered(const MidEdges& midedges, const Reordering& order) {
  MidEdges result;
  if (midedges.empty()) return result;
  for (int t : order.file_tet) {
    std::array<int, 6> nodes = midedges[t];
    for (int& node : nodes) node = order.new_node[node];
    result.push_back(nodes);
  }
  return result;
}

}  // namespace heml
