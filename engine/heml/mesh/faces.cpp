#include <algorithm>
#include <heml/mesh/faces.hpp>

namespace heml {
namespace {
struct Face {
  int middle, highest;  ///< sorted nodes; the lowest one is the index of the bucket
  int id;               ///< 4·tet + local face
};

Triangle sorted_face(const Tet& tet, int face) {
  const auto& local = tet_faces[face];
  Triangle nodes{tet[local[0]], tet[local[1]], tet[local[2]]};
  if (nodes[0] > nodes[1]) std::swap(nodes[0], nodes[1]);
  if (nodes[1] > nodes[2]) std::swap(nodes[1], nodes[2]);
  if (nodes[0] > nodes[1]) std::swap(nodes[0], nodes[1]);
  return nodes;
}
}  // namespace

// Buckets by lowest node (a counting sort), then a short sort in each: much faster than sorting all faces.
std::vector<std::uint8_t> face_counts(std::span<const Tet> tets, int nodes) {
  std::vector<std::size_t> start(nodes + 1, 0);
  for (const Tet& tet : tets)
    for (int f = 0; f < 4; ++f) ++start[sorted_face(tet, f)[0] + 1];
  for (int n = 0; n < nodes; ++n) start[n + 1] += start[n];

  std::vector<Face> faces(4 * tets.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (int f = 0; f < 4; ++f) {
      const Triangle face = sorted_face(tets[t], f);
      faces[next[face[0]]++] = {face[1], face[2], static_cast<int>(4 * t) + f};
    }

  std::vector<std::uint8_t> counts(faces.size());
  const auto same = [](const Face& a, const Face& b) { return a.middle == b.middle && a.highest == b.highest; };
  for (int n = 0; n < nodes; ++n) {
    const auto first = faces.begin() + start[n], last = faces.begin() + start[n + 1];
    std::sort(first, last, [](const Face& a, const Face& b) {
      return a.middle != b.middle ? a.middle < b.middle : a.highest < b.highest;
    });
    for (auto group = first; group != last;) {
      const auto end = std::find_if(group, last, [&](const Face& face) { return !same(face, *group); });
      const auto count = static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(end - group, 255));
      for (; group != end; ++group) counts[group->id] = count;
    }
  }
  return counts;
}

}  // namespace heml
