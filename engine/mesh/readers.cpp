#include <algorithm>
#include <fmt/format.h>
#include <heml/mesh/readers.hpp>
#include <limits>

namespace heml {
namespace {

constexpr int vtk_tetra = 10;

// Cells of VTK with a volume, other than the linear tetrahedron (vtkCellType.h).
bool is_other_volume(long long type) {
  return (type >= 11 && type <= 16) || (type >= 24 && type <= 27) || type == 29 || (type >= 31 && type <= 33) ||
         type == 37 || type == 42 || (type >= 71 && type <= 74) || (type >= 78 && type <= 81);
}

}  // namespace

void NodeNumbers::close(const Scanner& in) {
  const auto less = [](const Entry& a, const Entry& b) { return a.number < b.number; };
  if (!std::is_sorted(numbers_.begin(), numbers_.end(), less)) std::sort(numbers_.begin(), numbers_.end(), less);
  const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end(),
                                        [](const Entry& a, const Entry& b) { return a.number == b.number; });
  if (twice != numbers_.end()) in.fail(fmt::format("node number {} is given twice", twice->number));
}

int NodeNumbers::find(long long number, const Scanner& in) const {
  if (!numbers_.empty() && number >= numbers_.front().number && number <= numbers_.back().number) {
    const auto guess = static_cast<std::size_t>(number) - static_cast<std::size_t>(numbers_.front().number);
    if (guess < numbers_.size() && numbers_[guess].number == number) return numbers_[guess].node;
    const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), number,
                                     [](const Entry& entry, long long value) { return entry.number < value; });
    if (at->number == number) return at->node;
  }
  in.fail(fmt::format("names node {}, which the file does not give", number));
}

void add_vtk_cells(const VtkCells& cells, int first_node, const Scanner& in, ReadMesh& read) {
  const std::size_t count = cells.types.size();
  if (cells.offsets.size() != count + 1)
    in.fail(fmt::format("{} cells have {} cell types", cells.offsets.size() - 1, count));
  if (!cells.regions.empty() && cells.regions.size() != count)
    in.fail(fmt::format("{} cells have {} values of 'region'", count, cells.regions.size()));
  const long long nodes = static_cast<long long>(read.mesh.nodes.size()) - first_node;
  for (std::size_t c = 0; c < count; ++c) {
    const long long begin = cells.offsets[c], end = cells.offsets[c + 1];
    if (begin < 0 || begin > end || end > static_cast<long long>(cells.connectivity.size()))
      in.fail(fmt::format("offsets of cell {} are {} and {}", c, begin, end),
              fmt::format("ascending, up to {}", cells.connectivity.size()));
    read.ignored += is_other_volume(cells.types[c]);
    if (cells.types[c] != vtk_tetra) continue;
    if (end - begin != 4) in.fail(fmt::format("cell {} is a tetrahedron of {} nodes", c, end - begin), "4");
    Tet tet;
    for (int a = 0; a < 4; ++a) {
      const long long node = cells.connectivity[begin + a];
      if (node < 0 || node >= nodes) in.fail(fmt::format("cell {} names node {}, there are {}", c, node, nodes));
      tet[a] = first_node + static_cast<int>(node);
    }
    const long long region = cells.regions.empty() ? 0 : cells.regions[c];
    if (region < std::numeric_limits<int>::min() || region > std::numeric_limits<int>::max())
      in.fail(fmt::format("region of cell {} is {}", c, region), "a 32-bit integer");
    read.mesh.tets.push_back(tet);
    read.mesh.regions.push_back(static_cast<int>(region));
  }
}

}  // namespace heml
