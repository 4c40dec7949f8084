#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/lattice.hpp>

namespace heml {
namespace {

constexpr double max_cells = 2e8;
constexpr int largest_cell = 4;    // largest cells, in finest ones
constexpr int outside_margin = 8;  // finest cells outside on each side, so that no face of the grid is looked across
using Cell = std::array<int, 3>;   // in sides of finest cells, or in half sides where said

/// An array over a box of cells.
template <class Value>
class CellGrid {
 public:
  CellGrid(const Cell& size, Value value)
      : size_(size),
        values_(
            static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]),
            value) {}
  Value& operator()(int x, int y, int z) { return values_[index(x, y, z)]; }
  Value operator()(int x, int y, int z) const { return values_[index(x, y, z)]; }
  const Cell& size() const { return size_; }
  bool has(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < size_[0] && y < size_[1] && z < size_[2];
  }
  /// Calls visit(x, y, z) for all cells.
  template <class Visit>
  void for_each(Visit visit) const {
    for (int z = 0; z < size_[2]; ++z)
      for (int y = 0; y < size_[1]; ++y)
        for (int x = 0; x < size_[0]; ++x) visit(x, y, z);
  }

 private:
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(size_[0]) *
               (static_cast<std::size_t>(y) + static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(z));
  }
  Cell size_;
  std::vector<Value> values_;
};

Cell divided(const Cell& size, int by) { return {size[0] / by, size[1] / by, size[2] / by}; }
Cell grown(const Cell& size) { return {size[0] + 1, size[1] + 1, size[2] + 1}; }

/// Whether any of the 27 cells round one is set.
bool is_any_near(const CellGrid<char>& grid, int x, int y, int z) {
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (grid.has(x + dx, y + dy, z + dz) && grid(x + dx, y + dy, z + dz)) return true;
  return false;
}

class LatticeBuilder {
 public:
  LatticeBuilder(const RegionField& field, const Vec3& low, const Cell& size, double cell)
      : cell_(cell),
        low_(low),
        corner_labels_(grown(size), 0),
        centre_labels_(size, 0),
        sizes_(size, largest_cell),
        corner_nodes_(grown(size), -1),
        centre_nodes_(size, -1) {
    corner_labels_.for_each([&](int x, int y, int z) {
      corner_labels_(x, y, z) = static_cast<std::uint8_t>(field.label_at(point({2 * x, 2 * y, 2 * z})));
    });
    centre_labels_.for_each([&](int x, int y, int z) {
      centre_labels_(x, y, z) = static_cast<std::uint8_t>(field.label_at(point({2 * x + 1, 2 * y + 1, 2 * z + 1})));
    });
  }

  Lattice build() {
    choose_sizes();
    sizes_.for_each([&](int x, int y, int z) {
      const int size = sizes_(x, y, z);
      if (x % size || y % size || z % size) return;
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) add_face({x, y, z}, size, axis, side);
    });
    lattice_.cell = cell_;
    return std::move(lattice_);
  }

 private:
  /// Cells with several labels and all round them stay fine; sizes of cells that touch differ by a factor of two at
  /// most.
  void choose_sizes() {
    CellGrid<char> mixed(centre_labels_.size(), 0), fine2(divided(mixed.size(), 2), 0);
    mixed.for_each([&](int x, int y, int z) {
      const std::uint8_t label = centre_labels_(x, y, z);
      for (int c = 0; c < 8; ++c)
        if (corner_labels_(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)) != label) mixed(x, y, z) = 1;
    });
    mixed.for_each([&](int x, int y, int z) {
      if (is_any_near(mixed, x, y, z)) fine2(x / 2, y / 2, z / 2) = 1;
    });
    // Whether a cell of twice that size would touch a finest one.
    const auto is_fine_round = [&](int x, int y, int z) {
      for (int c = 0; c < 8; ++c)
        if (is_any_near(fine2, 2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2))) return true;
      return false;
    };
    CellGrid<char> fine4(divided(mixed.size(), 4), 0);
    fine4.for_each([&](int x, int y, int z) { fine4(x, y, z) = is_fine_round(x, y, z); });
    sizes_.for_each([&](int x, int y, int z) {
      if (fine2(x / 2, y / 2, z / 2))
        sizes_(x, y, z) = 1;
      else if (fine4(x / 4, y / 4, z / 4))
        sizes_(x, y, z) = 2;
    });
  }

  int size_at(const Cell& at) const { return sizes_.has(at[0], at[1], at[2]) ? sizes_(at[0], at[1], at[2]) : 0; }

  /// The elements between a cell and what lies across one of its faces, each once.
  void add_face(const Cell& cell, int size, int axis, int side) {
    Cell across = cell;
    across[axis] += side > 0 ? size : -1;
    const int other = size_at(across);
    if (other == 0) return;
    Cell centre;  // from here in half sides
    for (std::size_t d = 0; d < 3; ++d) centre[d] = 2 * cell[d] + size;
    if (other == size && side > 0) {
      Cell far = centre;
      far[axis] += 2 * size;
      add_equal(centre, far, size, axis);
    } else if (other < size) {
      add_fan(centre, size, axis, side);
    } else if (other > size) {
      add_quarter(centre, cell, size, axis, side);
    }
  }

  /// Corner (u, v = −1, 1) of a cell's face.
  static Cell face_corner(const Cell& centre, int size, int axis, int side, int u, int v) {
    Cell corner = centre;
    corner[axis] += side * size;
    corner[(axis + 1) % 3] += u * size;
    corner[(axis + 2) % 3] += v * size;
    return corner;
  }

  void add_equal(const Cell& centre, const Cell& far, int size, int axis) {
    constexpr std::array<std::array<int, 2>, 5> round{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Cell a = face_corner(centre, size, axis, 1, round[k][0], round[k][1]);
      const Cell b = face_corner(centre, size, axis, 1, round[k + 1][0], round[k + 1][1]);
      if (is_halved(a, b, size)) {
        add_tet(centre, far, a, middle(a, b));
        add_tet(centre, far, middle(a, b), b);
      } else {
        add_tet(centre, far, a, b);
      }
    }
  }

  /// Towards four smaller cells.
  void add_fan(const Cell& centre, int size, int axis, int side) {
    constexpr std::array<std::array<int, 2>, 5> round{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
    Cell face = centre;
    face[axis] += side * size;
    for (std::size_t k = 0; k < 4; ++k) {
      const Cell a = face_corner(centre, size, axis, side, round[k][0], round[k][1]);
      const Cell b = face_corner(centre, size, axis, side, round[k + 1][0], round[k + 1][1]);
      add_tet(centre, face, a, middle(a, b));
      add_tet(centre, face, middle(a, b), b);
    }
  }

  /// Towards a larger cell: this face is the quarter of its between the middle of its face and one of its corners.
  void add_quarter(const Cell& centre, const Cell& cell, int size, int axis, int side) {
    const auto outward = [&](int d) { return cell[d] / size % 2 == 0 ? -1 : 1; };  // to the larger face's corner
    const int u = outward((axis + 1) % 3), v = outward((axis + 2) % 3);
    const Cell corner = face_corner(centre, size, axis, side, u, v),
               face = face_corner(centre, size, axis, side, -u, -v);
    add_tet(centre, face, corner, face_corner(centre, size, axis, side, u, -v));
    add_tet(centre, face, corner, face_corner(centre, size, axis, side, -u, v));
  }

  static Cell middle(const Cell& a, const Cell& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

  /// Whether a cell smaller than `size` touches the edge between two corners.
  bool is_halved(const Cell& a, const Cell& b, int size) const {
    if (size == 1) return false;
    int along = 0;
    while (a[along] == b[along]) ++along;
    const Cell m = middle(a, b);  // an even number of half sides along each axis
    for (int k = 0; k < 4; ++k) {
      Cell at{m[0] / 2, m[1] / 2, m[2] / 2};
      at[(along + 1) % 3] -= k & 1;
      at[(along + 2) % 3] -= k >> 1;
      if (const int touching = size_at(at); touching > 0 && touching < size) return true;
    }
    return false;
  }

  Vec3 point(const Cell& half) const { return low_ + 0.5 * cell_ * Vec3(half[0], half[1], half[2]); }

  std::uint8_t label(const Cell& half) const {
    const bool is_corner = half[0] % 2 == 0;
    return (is_corner ? corner_labels_ : centre_labels_)(half[0] / 2, half[1] / 2, half[2] / 2);
  }

  int node(const Cell& half) {
    int& number = (half[0] % 2 == 0 ? corner_nodes_ : centre_nodes_)(half[0] / 2, half[1] / 2, half[2] / 2);
    if (number < 0) {
      number = static_cast<int>(lattice_.nodes.size());
      lattice_.nodes.push_back(point(half));
      lattice_.labels.push_back(label(half));
    }
    return number;
  }

  void add_tet(const Cell& a, const Cell& b, const Cell& c, const Cell& d) {
    if (label(a) == 0 && label(b) == 0 && label(c) == 0 && label(d) == 0) return;
    Tet tet{node(a), node(b), node(c), node(d)};
    const auto& x = lattice_.nodes;
    if (signed_volume(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]) < 0) std::swap(tet[2], tet[3]);
    lattice_.tets.push_back(tet);
  }

  double cell_;
  Vec3 low_;
  CellGrid<std::uint8_t> corner_labels_, centre_labels_;
  CellGrid<std::uint8_t> sizes_;  ///< of the cell that a finest cell belongs to
  CellGrid<int> corner_nodes_, centre_nodes_;
  Lattice lattice_;
};

}  // namespace

Lattice make_lattice(const RegionField& field, const Vec3& low, const Vec3& high, double cell,
                     const std::string& source) {
  Cell size;
  double cells = 1;
  for (int d = 0; d < 3; ++d) {
    const double count = std::ceil((high[d] - low[d]) / cell / largest_cell) * largest_cell + 2 * outside_margin;
    cells *= count;
    size[d] = static_cast<int>(std::min(count, max_cells));
  }
  if (cells > max_cells)
    throw InputError(source, "", fmt::format("elements of {:.3g} m would need a lattice of {:.2g} cells", cell, cells),
                     fmt::format("{:.0e} at most: ask for fewer tetrahedra (--tets)", max_cells));
  return LatticeBuilder(field, low - Vec3::Constant(outside_margin * cell), size, cell).build();
}

}  // namespace heml
