#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <heml/elastic/fan_cut.hpp>
#include <heml/elastic/fan_layout.hpp>

namespace heml {
namespace {

constexpr std::size_t most_block_elements = 2560;                      // whose nodes fit the first cache
constexpr std::size_t most_mesh_nodes_a_block = most_block_nodes - 4;  // and four that are nobody's

std::size_t at(int n) { return static_cast<std::size_t>(n); }

/// A contiguous piece of a part's elements, its distinct nodes ascending.
struct Piece {
  std::size_t part, begin, end;
  std::vector<int> nodes;
};

Piece piece_of(const TetMesh& mesh, const std::vector<int>& elements, std::size_t part, std::size_t begin,
               std::size_t end) {
  Piece piece{part, begin, end, {}};
  for (std::size_t i = begin; i < end; ++i)
    for (const int n : mesh.tets[at(elements[i])]) piece.nodes.push_back(n);
  std::sort(piece.nodes.begin(), piece.nodes.end());
  piece.nodes.erase(std::unique(piece.nodes.begin(), piece.nodes.end()), piece.nodes.end());
  return piece;
}

/// A power of two of pieces, from 16 on a multiple of it, so that threads get equal shares; more where elements share
/// few nodes.
std::vector<Piece> pieces_of(const TetMesh& mesh, const std::vector<FanElements>& parts) {
  std::vector<Piece> pieces;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& elements = parts[p].elements;
    const std::size_t first = pieces.size();
    std::size_t count = 1;
    while (elements.size() > count * most_block_elements) count += std::min<std::size_t>(count, 16);
    for (bool fits = false; !fits; count *= 2) {
      fits = true;
      pieces.resize(first);
      for (std::size_t b = 0; b < count && fits; ++b) {
        pieces.push_back(piece_of(mesh, elements, p, elements.size() * b / count, elements.size() * (b + 1) / count));
        fits = pieces.back().nodes.size() <= most_mesh_nodes_a_block;
      }
    }
  }
  return pieces;
}

/// The rest shape of one tetrahedron whose edges b0, b1 are square to its edge a, in the order of fan_block.hpp.
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
  return {std::sqrt(A(0, 0)), l00, std::sqrt(A(2, 2) - l10 * l10), l10, 1 / six_volumes, 0, 0, 0};
}

/// Where each fan's nodes are: in the mesh, or, of a lane left over, a right-angled corner.
struct FanNodes {
  Vec3 p, axis;
  std::vector<Vec3> spoke;   ///< square to the axis
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

/// The groups of one piece.
template <class Real>
struct Groups {
  std::vector<FanSize> size;
  std::vector<std::uint16_t> index;
  std::vector<Real> shape;
};

/// record: where the record of a node begins.
template <class Real, class Record>
Groups<Real> groups_of(const TetMesh& mesh, const FanElements& part, const Piece& piece, std::size_t lanes,
                       const Record& record) {
  Groups<Real> groups;
  std::vector<Tet> tets;
  for (std::size_t i = piece.begin; i < piece.end; ++i) tets.push_back(mesh.tets[at(part.elements[i])]);
  const std::size_t constants = fan_constants(part.shape == FanShape::fibre);
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
        const bool has_fibre = part.shape == FanShape::fibre && !fan.tets.empty();
        const Vec3 fibre = has_fibre ? part.fibre[piece.begin + fan.tets[i]] : Vec3::UnitX();
        const auto values =
            constants_of(nodes.axis, nodes.spoke[i], nodes.spoke[(i + 1) % size.ring], part.shape, fibre);
        for (std::size_t c = 0; c < constants; ++c)
          groups.shape[shape + (size.ring + i * constants + c) * lanes + l] = static_cast<Real>(values[c]);
      }
    }
  }
  return groups;
}

/// Those of all pieces, as many at a time as the team has threads.
template <class Real>
std::vector<Groups<Real>> all_groups(const TetMesh& mesh, const std::vector<FanElements>& parts,
                                     const std::vector<Piece>& pieces, std::size_t lanes, ThreadTeam& team) {
  std::vector<Groups<Real>> groups(pieces.size());
  team.for_ranges(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint16_t> local(mesh.nodes.size());
    for (std::size_t p = begin; p < end; ++p) {
      const std::vector<int>& nodes = pieces[p].nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i) local[at(nodes[i])] = static_cast<std::uint16_t>(8 * i);
      groups[p] = groups_of<Real>(mesh, parts[pieces[p].part], pieces[p], lanes, [&](int n, std::size_t corner) {
        return n < 0 ? static_cast<std::uint16_t>(8 * (nodes.size() + corner)) : local[at(n)];
      });
    }
  });
  return groups;
}

}  // namespace

template <class Real>
FanLayout<Real>::FanLayout(const TetMesh& mesh, const std::vector<FanElements>& parts, std::size_t lanes,
                           ThreadTeam& team) {
  std::vector<Piece> pieces = pieces_of(mesh, parts);
  std::vector<std::size_t> touches(mesh.nodes.size(), 0), rank(mesh.nodes.size(), 0);
  for (const Piece& piece : pieces)
    for (const int n : piece.nodes) ++touches[at(n)];
  shared_start.push_back(0);
  for (std::size_t n = 0; n < touches.size(); ++n) {
    if (touches[n] == 1) continue;
    rank[n] = shared_node.size();
    shared_node.push_back(static_cast<int>(n));
    shared_start.push_back(shared_start.back() + touches[n]);
  }
  shared_slot.resize(shared_start.back());
  std::vector<std::size_t> fill(shared_start.begin(), shared_start.end() - 1);

  for (Piece& piece : pieces) {
    std::vector<int>& nodes = piece.nodes;
    const auto shared = std::stable_partition(nodes.begin(), nodes.end(), [&](int n) { return touches[at(n)] == 1; });
    Block block{piece.part, 0, 0, 0, place.size(), shared_slots, 0, 0, nodes.size()};
    block.own = static_cast<std::size_t>(shared - nodes.begin());
    for (auto n = shared; n != nodes.end(); ++n) shared_slot[fill[rank[at(*n)]]++] = shared_slots++;
    for (const int n : nodes) place.push_back(3 * static_cast<std::uint32_t>(n));
    elements += piece.end - piece.begin;
    blocks.push_back(block);
  }
  const auto groups = all_groups<Real>(mesh, parts, pieces, lanes, team);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Block& block = blocks[b];
    block.group = size.size(), block.index = index.size(), block.shape = shape.size();
    block.groups = groups[b].size.size();
    size.insert(size.end(), groups[b].size.begin(), groups[b].size.end());
    index.insert(index.end(), groups[b].index.begin(), groups[b].index.end());
    shape.insert(shape.end(), groups[b].shape.begin(), groups[b].shape.end());
  }
}

template <class Real>
double FanLayout<Real>::bytes_per_tet() const {
  const std::size_t bytes = sizeof(FanSize) * size.size() + sizeof(std::uint16_t) * index.size() +
                            sizeof(Real) * shape.size() + (sizeof(std::uint32_t) + 6 * sizeof(Real)) * place.size() +
                            (sizeof(std::size_t) + 3 * sizeof(Real)) * shared_slots;
  return elements ? static_cast<double>(bytes) / static_cast<double>(elements) : 0;
}

template struct FanLayout<float>;
template struct FanLayout<double>;

}  // namespace heml
