#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/readers.hpp>
#include <limits>

namespace heml {
namespace {

struct VtkCell {
  int type;
  CellShape shape;
  std::size_t nodes;
};

/// vtkCellType.h; corners stand first in all of them.
constexpr VtkCell vtk_cells[] = {
    {10, CellShape::tetrahedron, 4}, {24, CellShape::tetrahedron, 10}, {11, CellShape::brick, 8},
    {12, CellShape::brick, 8},       {25, CellShape::brick, 20},       {29, CellShape::brick, 27},
    {33, CellShape::brick, 24},      {13, CellShape::wedge, 6},        {26, CellShape::wedge, 15},
    {31, CellShape::wedge, 12},      {32, CellShape::wedge, 18},       {14, CellShape::pyramid, 5},
    {27, CellShape::pyramid, 13},    {37, CellShape::pyramid, 19}};
constexpr int vtk_voxel = 11;                   // corners of its quadrilaterals by rows
constexpr std::size_t max_fields = 1000;        // field_in() searches linearly
constexpr std::size_t max_values_per_byte = 4;  // field values per byte of the file; fields may omit most tetrahedra

/// How many bytes the first character takes; 0: they are not UTF-8 (RFC 3629).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const unsigned first = byte(0), second = byte(1);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool bad = (first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) ||
                   (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90);
  return bad ? 0 : length;
}

void check_count(std::size_t fields, const Scanner& in) {
  if (fields > max_fields) in.fail(fmt::format("more than {} fields of elements", max_fields), "save fewer");
}

// Prisms of five and six sides, polyhedra, and cells of higher order (vtkCellType.h).
bool is_other_vtk_volume(long long type) {
  return type == 15 || type == 16 || type == 42 || (type >= 71 && type <= 74) || (type >= 78 && type <= 81);
}

const VtkCell* find_vtk_cell(long long type) {
  const auto found =
      std::find_if(std::begin(vtk_cells), std::end(vtk_cells), [&](const VtkCell& cell) { return cell.type == type; });
  return found == std::end(vtk_cells) ? nullptr : &*found;
}

void add_cell(const VtkCell& cell, const VtkCells& cells, std::size_t c, int first_node, const Scanner& in,
              ReadMesh& read) {
  constexpr std::string_view names[] = {"tetrahedron", "pyramid", "wedge", "brick"};
  const long long begin = cells.offsets[c], end = cells.offsets[c + 1];
  if (end - begin != static_cast<long long>(cell.nodes))
    in.fail(fmt::format("cell {} is a {} of {} nodes", c, names[static_cast<std::size_t>(cell.shape)], end - begin),
            fmt::format("{}", cell.nodes));
  const long long nodes = static_cast<long long>(read.mesh.nodes.size()) - first_node;
  std::array<int, 27> all{};
  for (std::size_t a = 0; a < cell.nodes; ++a) {
    const long long node = cells.connectivity[static_cast<std::size_t>(begin) + a];
    if (node < 0 || node >= nodes) in.fail(fmt::format("cell {} names node {}, there are {}", c, node, nodes));
    all[a] = first_node + static_cast<int>(node);
  }
  if (cell.type == vtk_voxel) {
    std::swap(all[2], all[3]);
    std::swap(all[6], all[7]);
  }
  if (cell.shape != CellShape::tetrahedron) return divide_cell(cell.shape, std::span(all).first(cell.nodes), read);
  read.mesh.tets.push_back({all[0], all[1], all[2], all[3]});
  if (cell.nodes == 10) add_midedges({all[4], all[5], all[6], all[7], all[8], all[9]}, vtk_midedges, read);
}

int region_of(const VtkCells& cells, std::size_t c, const Scanner& in) {
  const long long region = cells.regions.empty() ? 0 : cells.regions[c];
  if (region < std::numeric_limits<int>::min() || region > std::numeric_limits<int>::max())
    in.fail(fmt::format("region of cell {} is {}", c, region), "a 32-bit integer");
  return static_cast<int>(region);
}

void check_sizes(const VtkCells& cells, const Scanner& in) {
  const std::size_t count = cells.types.size();
  if (cells.offsets.size() != count + 1)
    in.fail(fmt::format("{} cells have {} cell types", cells.offsets.size() - 1, count));
  if (!cells.regions.empty() && cells.regions.size() != count)
    in.fail(fmt::format("{} cells have {} values of 'region'", count, cells.regions.size()));
  for (const ElementField& field : cells.fields)
    if (field.values.size() != field.components * count)
      in.fail(fmt::format("{} cells have {} values of {}", count, field.values.size(), in_quotes(field.name)),
              fmt::format("{} a cell", field.components));
}

// Copies the cells' values to the mesh's fields. cells_of_tets: of the mesh's last tetrahedra.
void add_fields(const VtkCells& cells, const std::vector<std::size_t>& cells_of_tets, const Scanner& in,
                TetMesh& mesh) {
  for (const ElementField& field : cells.fields) field_in(mesh, field.name, field.components, in);
  pad_fields(mesh, in);
  const std::size_t first_tet = mesh.tets.size() - cells_of_tets.size();
  for (const ElementField& field : cells.fields) {
    double* to = field_in(mesh, field.name, field.components, in).values.data() + field.components * first_tet;
    for (const std::size_t c : cells_of_tets)
      to = std::copy_n(field.values.data() + field.components * c, field.components, to);
  }
}

}  // namespace

void add_midedges(const std::array<int, 6>& nodes, const std::array<std::size_t, 6>& order, ReadMesh& read) {
  read.midedges.resize(read.mesh.tets.size(), {-1, -1, -1, -1, -1, -1});
  for (std::size_t e = 0; e < 6; ++e) read.midedges.back()[e] = nodes[order[e]];
}

void divide_cell(CellShape shape, std::span<const int> nodes, ReadMesh& read) {
  const std::size_t corners = corners_of(shape);
  read.bent += !split_cell(shape, nodes.first(corners), read.mesh.nodes, read.mesh.tets);
  read.middles.insert(read.middles.end(), nodes.begin() + static_cast<std::ptrdiff_t>(corners), nodes.end());
  ++read.divided;
}

std::string plain_name(std::string_view name) {
  std::string plain(name);
  for (char& c : plain)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  for (std::size_t i = 0; i < plain.size();) {
    const std::size_t length = utf8_length(std::string_view(plain).substr(i));
    if (length == 0) plain[i] = '?';
    i += std::max<std::size_t>(length, 1);
  }
  return plain;
}

ElementField& field_in(TetMesh& mesh, std::string_view name, std::size_t components, const Scanner& in) {
  const std::string plain = plain_name(name);
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(),
                                  [&](const ElementField& field) { return field.name == plain; });
  if (found == mesh.fields.end()) {
    check_count(mesh.fields.size() + 1, in);
    return mesh.fields.emplace_back(ElementField{plain, components, {}});
  }
  if (found->components != components)
    in.fail(fmt::format("{} has {} components here and {} before", in_quotes(plain), components, found->components));
  return *found;
}

void pad_fields(TetMesh& mesh, const Scanner& in) {
  std::size_t components = 0;
  for (const ElementField& field : mesh.fields) components += field.components;
  if (mesh.fields.empty() ||
      components <= max_values_per_byte * in.size() / std::max<std::size_t>(mesh.tets.size(), 1)) {
    for (ElementField& field : mesh.fields)
      field.values.resize(field.components * mesh.tets.size(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  in.fail(
      fmt::format("{} fields leave most of the {} tetrahedra without a value", mesh.fields.size(), mesh.tets.size()),
      "save fewer fields, or values for all tetrahedra");
}

void add_cell_field(ElementField field, const Scanner& in, VtkCells& cells) {
  std::erase_if(cells.fields, [&](const ElementField& other) { return other.name == field.name; });
  cells.fields.push_back(std::move(field));
  check_count(cells.fields.size(), in);
}

void NodeNumbers::finish(const Scanner& in) {
  const auto less = [](const Entry& a, const Entry& b) { return a.number < b.number; };
  if (!std::is_sorted(numbers_.begin(), numbers_.end(), less)) std::sort(numbers_.begin(), numbers_.end(), less);
  const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end(),
                                        [](const Entry& a, const Entry& b) { return a.number == b.number; });
  if (twice != numbers_.end()) in.fail(fmt::format("node number {} is given twice", twice->number));
}

int NodeNumbers::find_or_none(long long number) const {
  if (numbers_.empty() || number < numbers_.front().number || number > numbers_.back().number) return -1;
  const auto guess = static_cast<std::size_t>(number) - static_cast<std::size_t>(numbers_.front().number);
  if (guess < numbers_.size() && numbers_[guess].number == number) return numbers_[guess].node;
  const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), number,
                                   [](const Entry& entry, long long value) { return entry.number < value; });
  return at->number == number ? at->node : -1;
}

int NodeNumbers::find(long long number, const Scanner& in) const {
  const int node = find_or_none(number);
  if (node < 0) in.fail(fmt::format("names node {}, which the file does not give", number));
  return node;
}

void add_vtk_cells(const VtkCells& cells, int first_node, const Scanner& in, ReadMesh& read) {
  check_sizes(cells, in);
  const std::size_t first_tet = read.mesh.tets.size();
  std::vector<std::size_t> cells_of_tets;
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const long long begin = cells.offsets[c], end = cells.offsets[c + 1];
    if (begin < 0 || begin > end || end > static_cast<long long>(cells.connectivity.size()))
      in.fail(fmt::format("offsets of cell {} are {} and {}", c, begin, end),
              fmt::format("ascending, up to {}", cells.connectivity.size()));
    read.ignored += is_other_vtk_volume(cells.types[c]);
    const VtkCell* cell = find_vtk_cell(cells.types[c]);
    if (!cell) continue;
    add_cell(*cell, cells, c, first_node, in, read);
    read.mesh.regions.resize(read.mesh.tets.size(), region_of(cells, c, in));
    cells_of_tets.resize(read.mesh.tets.size() - first_tet, c);
  }
  add_fields(cells, cells_of_tets, in, read.mesh);
}

}  // namespace heml
