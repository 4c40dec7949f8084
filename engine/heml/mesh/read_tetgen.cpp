// TetGen: H. Si, TetGen user's manual 1.5, section 5.2, files .node and .ele. The first attribute of a tetrahedron is
// its region; further ones, which have no names, become the fields "attribute1", "attribute2", ...
#include <fmt/format.h>

#include <cmath>
#include <heml/mesh/readers.hpp>
#include <limits>

namespace heml {
namespace {

constexpr long long max_attributes = 1000;  // per tetrahedron

// "number x y z attribute ... [marker]"
NodeNumbers read_nodes(Scanner& in, std::vector<Vec3>& nodes) {
  in.expect_line("the number of nodes");
  const std::size_t count = in.count("the number of nodes", 4);
  if (in.has_word()) in.integer("the dimension", 3, 3);
  NodeNumbers numbers;
  numbers.reserve(count);
  nodes.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    in.expect_line("a node");
    numbers.add(in.integer("a node number"));
    nodes.push_back(in.point("a coordinate"));
  }
  numbers.finish(in);
  if (in.next_line()) in.fail(fmt::format("lines go on after {} nodes", count));
  return numbers;
}

// TetGen writes region attributes as reals.
int read_region(Scanner& in) {
  const double region = in.number("a region attribute");
  if (region != std::nearbyint(region) || region < std::numeric_limits<int>::min() ||
      region > std::numeric_limits<int>::max())
    in.fail(fmt::format("a region attribute is {}", region), "an integer of 32 bits");
  return static_cast<int>(region);
}

}  // namespace

ReadMesh read_tetgen(std::string node_file, std::string_view nodes, std::string ele_file, std::string_view tets) {
  ReadMesh read;
  Scanner node_lines(std::move(node_file), nodes, '#', true);
  const NodeNumbers numbers = read_nodes(node_lines, read.mesh.nodes);
  Scanner in(std::move(ele_file), tets, '#', true);
  in.expect_line("the number of tetrahedra");
  const std::size_t count = in.count("the number of tetrahedra", 5);
  if (in.has_word()) in.integer("the nodes a tetrahedron", 4, 4);
  const long long attributes = in.has_word() ? in.integer("the attributes a tetrahedron", 0, max_attributes) : 0;
  for (long long a = 1; a < attributes; ++a) field_in(read.mesh, fmt::format("attribute{}", a), 1, in);
  read.mesh.tets.reserve(count);
  read.mesh.regions.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    in.expect_line("a tetrahedron");
    in.integer("a tetrahedron's number");
    Tet tet;
    for (int& node : tet) {
      const long long number = in.integer("a node number");
      node = numbers.find(number, in);
    }
    read.mesh.tets.push_back(tet);
    read.mesh.regions.push_back(attributes > 0 ? read_region(in) : 0);
    for (ElementField& field : read.mesh.fields) field.values.push_back(in.any_number("an attribute"));
  }
  if (in.next_line()) in.fail(fmt::format("lines go on after {} tetrahedra", count));
  return read;
}

}  // namespace heml
