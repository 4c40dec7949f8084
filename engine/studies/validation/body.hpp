#pragma once
// Bodies and static solves of the benchmarks.
#include <studies/validation/benchmark.hpp>

namespace heml::validation {

using Map = std::function<Vec3(const Vec3&)>;

/// A structured mesh of hexahedra, each split into six tetrahedra (heml/mesh/split_cell.hpp). Node k of a hexahedron
/// has the coordinates of k's bits.
TetMesh split_hexahedra(std::vector<Vec3> nodes, const std::vector<std::array<int, 8>>& hexahedra);

/// A shell of cubes: the surface of the cube [−1, 1]³ in n × n squares a side, times `layers` of radius
/// (largest coordinate) from `inner` to `outer`.
TetMesh cubic_shell(int n, int layers, double inner, double outer);
/// A tube of squares: the boundary of the square [−1, 1]² in n pieces a side, times `layers` of radius, times `storeys`
/// along z, from 0 to `height`.
TetMesh square_tube(int n, int layers, double inner, double outer, int storeys, double height);

/// A cup of cubes: the surface of the cube [−1, 1]³ without its top, in n × n squares at the bottom and n × `storeys`
/// on each side, times `layers` of radius from `inner` to `outer`.
TetMesh cubic_cup(int n, int storeys, int layers, double inner, double outer);

/// Maps a shell of cubes to one of spheres, a tube of squares to a round one, of equal angles.
Vec3 cube_to_sphere(const Vec3& x);
Vec3 square_to_circle(const Vec3& x);

/// A body of one material and element. Nodes, with those in the middle of edges, are moved by `map`: elements of
/// quadratic bodies are curved.
WorldSetup make_body(TetMesh mesh, const std::string& element, const Material& material, const Map& map = {});

/// Neo-Hookean with a volume term of its own ("neo_hookean_iso"), of these moduli at rest.
Material rubber(double shear, double bulk);
double bulk_of(double shear, double poisson);
/// Guccione's law with its C, bf, bt, bfs (Pa, -), fibres along z.
Material heart_muscle(const std::array<double, 4>& parameters, double bulk);

std::vector<int> nodes_where(const WorldSetup& setup, const std::function<bool(const Vec3&)>& chosen);
/// A node moved by a displacement, ramped over ramp_time.
Boundary moved(int node, const Vec3& displacement, double ramp_time = 0);

/// A place in an element at rest, straight or curved, by its barycentric coordinates.
Vec3 place_in(const WorldSetup& setup, std::size_t element, const std::array<double, 4>& coordinates);

/// Positions of material points given at rest: interpolated by the shape functions of linear or quadratic elements.
/// setup: as made by make_body(), not yet moved into a world. x: positions of its nodes.
std::vector<Vec3> carried(const WorldSetup& setup, const std::vector<Vec3>& x, const std::vector<Vec3>& points);

/// A world under its full load.
struct Solved {
  std::vector<Vec3> x;  ///< m
  std::vector<Vec3> reactions;
  std::size_t unknowns = 0;
  double seconds = 0;
  std::string failed;  ///< empty: converged
};
/// Coordinates of nodes that no boundary condition holds.
std::size_t unknowns_of(const WorldSetup& setup);
/// parts: of the load, solved one after the other, where the whole at once takes Newton's method longer.
Solved solve(const Trial& trial, WorldSetup setup, double tolerance = 1e-8, int parts = 1);

/// A row of a solve.
Row row_of(const Solved& solved, const std::string& quantity, const std::string& unit, double ours, double reference,
           const std::string& source, double limit, const std::string& method);

}  // namespace heml::validation
