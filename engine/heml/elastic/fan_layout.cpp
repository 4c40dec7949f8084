#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/elastic/fan_cut.hpp>
#include <heml/elastic/fan_layout.hpp>
#include <optional>
#include <span>

namespace heml {
namespace {

constexpr std::size_t max_block_elements = 2560;                     // so that their nodes fit the first-level cache
constexpr std::size_t max_mesh_nodes_a_block = max_block_nodes - 4;  // the other four are dummies

std::size_t at(int n) { return static_cast<std::size_t>(n); }

/// Elements and nodes of one block of a new layout.
struct Chunk {
  std::size_t part;
  std::vector<int> elements;
  std::vector<int> nodes;           ///< distinct; ascending, or in the order of the kept block
  std::optional<std::size_t> kept;  ///< the block of the old layout that it equals
};

Chunk chunk_of(const TetMesh& mesh, std::size_t part, std::span<const int> elements) {
  Chunk chunk{part, {elements.begin(), elements.end()}, {}, {}};
  for (const int t : elements)
    for (const int n : mesh.tets[at(t)]) chunk.nodes.push_back(n);
  std::sort(chunk.nodes.begin(), chunk.nodes.end());
  chunk.nodes.erase(std::unique(chunk.nodes.begin(), chunk.nodes.end()), chunk.nodes.end());
  return chunk;
}

/// Cuts elements into `count` chunks; doubles the number while a chunk has too many nodes.
void add_chunks(const TetMesh& mesh, std::size_t part, std::span<const int> elements, std::size_t count,
                std::vector<Chunk>& chunks) {
  const std::size_t first = chunks.size(), size = elements.size();
  for (bool fits = false; !fits; count *= 2) {
    fits = true;
    chunks.resize(first);
    for (std::size_t b = 0; b < count && fits; ++b) {
      const std::size_t begin = size * b / count, end = size * (b + 1) / count;
      chunks.push_back(chunk_of(mesh, part, elements.subspan(begin, end - begin)));
      fits = chunks.back().nodes.size() <= max_mesh_nodes_a_block;
    }
  }
}

/// All parts cut into chunks of about equal size. The chunks follow each other as their nodes do, whatever their part,
/// so that the thread that runs a block has most of its nodes in its cache.
std::vector<Chunk> chunks_of(const TetMesh& mesh, const std::vector<FanElements>& parts) {
  std::vector<std::size_t> sizes;
  for (const FanElements& part : parts) sizes.push_back(part.elements.size());
  const std::vector<std::size_t> counts = block_counts(sizes, max_block_elements);
  std::vector<Chunk> chunks;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (counts[p] > 0) add_chunks(mesh, p, parts[p].elements, counts[p], chunks);
  const auto middle = [](const Chunk& chunk) { return chunk.elements[chunk.elements.size() / 2]; };
  std::sort(chunks.begin(), chunks.end(), [&](const Chunk& a, const Chunk& b) { return middle(a) < middle(b); });
  return chunks;
}

/// Constants of one tetrahedron whose edges b0 and b1 are perpendicular to its edge a, in the order of fan_block.hpp.
std::array<double, fan_constants(true)> constants_of(const Vec3& a, const Vec3& b0, const Vec3& b1, FanShape shape,
                                                     const Vec3& fibre) {
  Mat3 Dm;
  Dm << a, b0, b1;
  const Mat3 g = Dm.inverse();
  const double six_volumes = Dm.determinant();
  const Mat3 A = six_volumes * g * g.transpose();
  const Vec3 m = std::sqrt(six_volumes) * g * fibre;
  if (shape != FanShape::principal) return {A(0, 0), A(1, 1), A(2, 2), A(1, 2), 1 / six_volumes, m[0], m[1], m[2]};
  const double l00 = std::sqrt(A(1, 1)), l10 = A(1, 2) / l00;
  return {std::sqrt(A(0, 0)), l00, std::sqrt(A(2, 2) - l10 * l10), l10, 1 / six_volumes, m[0], m[1], m[2]};
}

/// Rest positions of the nodes of a fan; those of a dummy fan are a right-angled corner.
struct FanNodes {
  Vec3 p, axis;
  std::vector<Vec3> spoke;   ///< perpendicular to the axis
  std::vector<double> foot;  ///< φ
};

FanNodes nodes_of(const TetMesh& mesh, const Fan& fan) {
  const bool unused = fan.tets.empty();
  const auto X = [&](int n, const Vec3& otherwise) { return unused ? otherwise : mesh.nodes[at(n)]; };
  FanNodes nodes;
  nodes.p = X(fan.p, Vec3::Zero());
  nodes.axis = X(fan.q, Vec3::UnitX()) - nodes.p;
  for (std::size_t i = 0; i < fan.ring.size(); ++i) {
    const Vec3 b = X(fan.ring[i], i == 0 ? Vec3::UnitY() : Vec3::UnitZ()) - nodes.p;
    nodes.foot.push_back(b.dot(nodes.axis) / nodes.axis.squaredNorm());
    nodes.spoke.push_back(b - nodes.foot.back() * nodes.axis);
  }
  return nodes;
}

/// The groups of one chunk.
template <class Real>
struct Groups {
  std::vector<FanSize> size;
  std::vector<std::uint16_t> index;
  std::vector<Real> shape;
};

/// record(node, corner): offset of a node's record; corner picks the dummy node where node is −1.
template <class Real, class Record>
Groups<Real> groups_of(const TetMesh& mesh, const FanElements& part, const Chunk& chunk, std::size_t lanes,
                       const Record& record) {
  Groups<Real> groups;
  std::vector<Tet> tets;
  for (const int t : chunk.elements) tets.push_back(mesh.tets[at(t)]);
  const std::size_t of_shape = fan_constants(part.shape == FanShape::fibre), constants = part.constants();
  const std::vector<Fan> fans = cut_into_fans(tets, lanes);
  for (std::size_t first = 0; first < fans.size(); first += lanes) {
    const FanSize size = fans[first].size();
    const std::size_t index = groups.index.size(), shape = groups.shape.size();
    groups.size.push_back(size);
    groups.index.resize(index + (2 + size.ring) * lanes);
    groups.shape.resize(shape + (size.ring + size.tets * constants) * lanes);
    for (std::size_t l = 0; l < lanes; ++l) {
      const Fan& fan = fans[first + l];
      const FanNodes nodes = nodes_of(mesh, fan);
      groups.index[index + l] = record(fan.p, 0);
      groups.index[index + lanes + l] = record(fan.q, 1);
      for (std::size_t i = 0; i < size.ring; ++i) {
        groups.index[index + (i + 2) * lanes + l] = record(fan.ring[i], i + 2);
        groups.shape[shape + i * lanes + l] = static_cast<Real>(nodes.foot[i]);
      }
      for (std::size_t i = 0; i < size.tets; ++i) {
        const bool has_fibre = part.fibre && !fan.tets.empty();
        const Vec3 fibre = has_fibre ? part.fibre(chunk.elements[fan.tets[i]]) : Vec3::UnitX();
        const double scale = fan.tets.empty() ? 1 : rest_scale(mesh, at(chunk.elements[fan.tets[i]]));
        const auto values = constants_of(scale * nodes.axis, scale * nodes.spoke[i],
                                         scale * nodes.spoke[(i + 1) % size.ring], part.shape, fibre);
        // A dummy fan has the parameters of any element, for which the law is defined.
        const std::size_t t = at(chunk.elements[fan.tets.empty() ? 0 : fan.tets[i]]);
        const std::size_t beside = of_shape + part.parameters.size();
        for (std::size_t c = 0; c < constants; ++c) {
          const double value = c < of_shape ? values[c]
                               : c < beside ? (*part.parameters[c - of_shape])[t]
                                            : values[fan_constants(false) + c - beside];
          groups.shape[shape + (size.ring + i * constants + c) * lanes + l] = static_cast<Real>(value);
        }
      }
    }
  }
  return groups;
}

/// Groups of all chunks that are not kept, one chunk per thread at a time.
template <class Real>
std::vector<Groups<Real>> all_groups(const TetMesh& mesh, const std::vector<FanElements>& parts,
                                     const std::vector<Chunk>& chunks, std::size_t lanes, ThreadTeam& team) {
  std::vector<std::size_t> fresh;
  for (std::size_t c = 0; c < chunks.size(); ++c)
    if (!chunks[c].kept) fresh.push_back(c);
  std::vector<Groups<Real>> groups(chunks.size());
  team.parallel_for(fresh.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint16_t> local(mesh.nodes.size());
    for (std::size_t k = begin; k < end; ++k) {
      const Chunk& chunk = chunks[fresh[k]];
      const std::vector<int>& nodes = chunk.nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i) local[at(nodes[i])] = static_cast<std::uint16_t>(8 * i);
      groups[fresh[k]] = groups_of<Real>(mesh, parts[chunk.part], chunk, lanes, [&](int n, std::size_t corner) {
        return n < 0 ? static_cast<std::uint16_t>(8 * (nodes.size() + corner)) : local[at(n)];
      });
    }
  });
  return groups;
}

/// Appends [begin, end) of a list, the data of a kept block.
template <class List>
void add_slice(const List& from, std::size_t begin, std::size_t end, List& to) {
  to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
            from.begin() + static_cast<std::ptrdiff_t>(end));
}

/// Adds the groups of all chunks: copies those of kept chunks from the old layout and cuts the others.
template <class Real>
void add_groups(const TetMesh& mesh, const std::vector<FanElements>& parts, const std::vector<Chunk>& chunks,
                std::size_t lanes, const FanLayout<Real>& before, FanLayout<Real>& layout, ThreadTeam& team) {
  const auto groups = all_groups<Real>(mesh, parts, chunks, lanes, team);
  for (std::size_t b = 0; b < chunks.size(); ++b) {
    auto& block = layout.blocks[b];
    block.group = layout.size.size(), block.index = layout.index.size(), block.shape = layout.shape.size();
    if (const auto kept = chunks[b].kept) {
      const auto& old = before.blocks[*kept];
      const bool last = *kept + 1 == before.blocks.size();
      block.groups = old.groups;
      add_slice(before.size, old.group, old.group + old.groups, layout.size);
      add_slice(before.index, old.index, last ? before.index.size() : before.blocks[*kept + 1].index, layout.index);
      add_slice(before.shape, old.shape, last ? before.shape.size() : before.blocks[*kept + 1].shape, layout.shape);
    } else {
      block.groups = groups[b].size.size();
      layout.size.insert(layout.size.end(), groups[b].size.begin(), groups[b].size.end());
      layout.index.insert(layout.index.end(), groups[b].index.begin(), groups[b].index.end());
      layout.shape.insert(layout.shape.end(), groups[b].shape.begin(), groups[b].shape.end());
    }
  }
}

/// Flags the nodes that kept blocks share, which stay shared.
template <class Real>
std::vector<char> kept_as_shared(const TetMesh& mesh, const std::vector<Chunk>& chunks, const FanLayout<Real>& before) {
  std::vector<char> shared(mesh.nodes.size(), 0);
  for (const Chunk& chunk : chunks)
    for (std::size_t i = chunk.kept ? before.nodes.blocks[*chunk.kept].own : chunk.nodes.size(); i < chunk.nodes.size();
         ++i)
      shared[at(chunk.nodes[i])] = 1;
  return shared;
}

template <class Real>
FanLayout<Real> layout_of(const TetMesh& mesh, const std::vector<FanElements>& parts, std::vector<Chunk> chunks,
                          std::size_t lanes, const FanLayout<Real>& before, ThreadTeam& team) {
  FanLayout<Real> layout;
  std::vector<std::vector<int>*> nodes;
  for (Chunk& chunk : chunks) nodes.push_back(&chunk.nodes);
  layout.nodes = NodeBlocks(std::move(nodes), kept_as_shared(mesh, chunks, before));
  for (std::size_t b = 0; b < chunks.size(); ++b) {
    const Chunk& chunk = chunks[b];
    assert(!chunk.kept || layout.nodes.blocks[b].own == before.nodes.blocks[*chunk.kept].own);
    layout.blocks.push_back({chunk.part, 0, 0, 0, layout.element.size(), 0, chunk.elements.size()});
    layout.element.insert(layout.element.end(), chunk.elements.begin(), chunk.elements.end());
  }
  add_groups(mesh, parts, chunks, lanes, before, layout, team);
  return layout;
}

}  // namespace

template <class Real>
FanLayout<Real>::FanLayout(const TetMesh& mesh, const std::vector<FanElements>& parts, std::size_t lanes,
                           ThreadTeam& team) {
  *this = layout_of(mesh, parts, chunks_of(mesh, parts), lanes, FanLayout(), team);
}

template <class Real>
FanLayout<Real> FanLayout<Real>::after_edit(const TetMesh& before, const TetMesh& mesh,
                                            const std::vector<FanElements>& parts, const std::vector<int>& origins,
                                            std::size_t lanes, ThreadTeam& team) const {
  std::vector<std::size_t> block_of(before.tets.size(), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t k = 0; k < blocks[b].elements; ++k) block_of[at(element[blocks[b].element + k])] = b;
  std::vector<std::vector<int>> of_block(blocks.size());
  std::vector<char> touched(blocks.size(), 0);
  for (const FanElements& part : parts)
    for (const int t : part.elements) {
      const int origin = origins[at(t)];
      const std::size_t b = block_of[at(origin)];
      of_block[b].push_back(t);
      if (mesh.tets[at(t)] != before.tets[at(origin)] || rest_scale(mesh, at(t)) != rest_scale(before, at(origin)))
        touched[b] = 1;
    }
  std::vector<Chunk> chunks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block& block = blocks[b];
    const std::size_t left = of_block[b].size();
    if (touched[b] || left != block.elements) {
      const std::size_t count = block_counts({left}, max_block_elements)[0];
      if (count > 0) add_chunks(mesh, block.part, of_block[b], count, chunks);
      continue;
    }
    chunks.push_back({block.part, std::move(of_block[b]), {}, b});
    const NodeBlocks::Block& old = nodes.blocks[b];
    for (std::size_t k = 0; k < old.nodes; ++k)
      chunks.back().nodes.push_back(static_cast<int>(nodes.place[old.place + k] / 3));
  }
  return layout_of(mesh, parts, std::move(chunks), lanes, *this, team);
}

template <class Real>
double FanLayout<Real>::bytes_per_tet() const {
  const std::size_t bytes = sizeof(FanSize) * size.size() + sizeof(std::uint16_t) * index.size() +
                            sizeof(Real) * shape.size() +
                            (sizeof(std::uint32_t) + 6 * sizeof(Real)) * nodes.place.size() +
                            (sizeof(std::size_t) + 3 * sizeof(Real)) * nodes.shared_slots;
  return element.empty() ? 0 : static_cast<double>(bytes) / static_cast<double>(element.size());
}

template struct FanLayout<float>;
template struct FanLayout<double>;

}  // namespace heml
