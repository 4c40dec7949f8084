#include <algorithm>
#include <chrono>
#include <cmath>
#include <heml/mesh/quadratic.hpp>
#include <heml/mesh/split_cell.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <studies/validation/body.hpp>

namespace heml::validation {
namespace {

/// Nodes by lattice coordinates, numbered as they are asked for.
struct Lattice {
  std::map<std::array<int, 4>, int> known = {};
  std::vector<Vec3> nodes = {};
  int at(const std::array<int, 4>& key, const Vec3& place) {
    const auto [found, is_new] = known.try_emplace(key, static_cast<int>(nodes.size()));
    if (is_new) nodes.push_back(place);
    return found->second;
  }
};

double between(double from, double to, int part, int parts) { return from + (to - from) * part / parts; }

/// An element's map from barycentric coordinates to places.
class ElementMap {
 public:
  ElementMap(const WorldSetup& setup, std::size_t t) : nodes_(setup.mesh.nodes) {
    const Tet& tet = setup.mesh.tets[t];
    node_.assign(tet.begin(), tet.end());
    if (!setup.midedges.empty()) node_.insert(node_.end(), setup.midedges[t].begin(), setup.midedges[t].end());
  }
  Vec3 at(const std::vector<Vec3>& x, const std::array<double, 4>& place) const {
    Vec3 sum = Vec3::Zero();
    const auto N = shape_functions(place);
    for (std::size_t k = 0; k < node_.size(); ++k)
      sum += (node_.size() == 4 ? place[k] : N[k]) * x[static_cast<std::size_t>(node_[k])];
    return sum;
  }
  /// The place of a point at rest by Newton's method with differences, of points in the element or near it.
  std::optional<std::array<double, 4>> place_of(const Vec3& point) const {
    const auto full = [](const Vec3& b) { return std::array{1 - b.sum(), b.x(), b.y(), b.z()}; };
    const auto corner = [&](std::size_t k) { return nodes_[static_cast<std::size_t>(node_[k])]; };
    double size = 0;
    for (const std::size_t k : {1, 2, 3}) size += (corner(k) - corner(0)).norm();
    if ((point - corner(0)).norm() > size) return std::nullopt;
    Vec3 b(0.25, 0.25, 0.25);
    for (int k = 0; k < 12; ++k) {
      Mat3 slope;
      for (int i = 0; i < 3; ++i) {
        const Vec3 step = 1e-5 * Vec3::Unit(i);
        slope.col(i) = (at(nodes_, full(b + step)) - at(nodes_, full(b - step))) / 2e-5;
      }
      const Vec3 change = slope.inverse() * (point - at(nodes_, full(b)));
      b += change;
      if (!(b.norm() < 10)) return std::nullopt;
      if (change.norm() < 1e-12) return full(b);
    }
    return std::nullopt;
  }

 private:
  const std::vector<Vec3>& nodes_;
  std::vector<int> node_;
};

/// Angle of equal steps for a coordinate in [−1, 1].
double warped(double u) { return std::tan(std::numbers::pi / 4 * u); }

}  // namespace

TetMesh split_hexahedra(std::vector<Vec3> nodes, const std::vector<std::array<int, 8>>& hexahedra) {
  TetMesh mesh{std::move(nodes), {}, {}, "hexahedra"};
  for (const auto& h : hexahedra)
    split_cell(CellShape::brick, std::array{h[0], h[1], h[3], h[2], h[4], h[5], h[7], h[6]}, mesh.nodes, mesh.tets);
  mesh.regions.assign(mesh.tets.size(), 0);
  return mesh;
}

TetMesh cubic_shell(int n, int layers, double inner, double outer) {
  Lattice lattice;
  std::vector<std::array<int, 8>> hexahedra;
  for (int side = 0; side < 6; ++side)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int layer = 0; layer < layers; ++layer) {
          std::array<int, 8> hexahedron{};
          for (int k = 0; k < 8; ++k) {
            const int axis = side / 2, depth = layer + (k >> 2 & 1);
            std::array<int, 4> key{};
            key[static_cast<std::size_t>(axis)] = side % 2 == 0 ? 0 : n;
            key[static_cast<std::size_t>((axis + 1) % 3)] = i + (k & 1);
            key[static_cast<std::size_t>((axis + 2) % 3)] = j + (k >> 1 & 1);
            key[3] = depth;
            const Vec3 on_cube(between(-1, 1, key[0], n), between(-1, 1, key[1], n), between(-1, 1, key[2], n));
            hexahedron[static_cast<std::size_t>(k)] = lattice.at(key, between(inner, outer, depth, layers) * on_cube);
          }
          hexahedra.push_back(hexahedron);
        }
  return split_hexahedra(std::move(lattice.nodes), hexahedra);
}

TetMesh cubic_cup(int n, int storeys, int layers, double inner, double outer) {
  Lattice lattice;
  std::vector<std::array<int, 8>> hexahedra;
  const auto add = [&](const std::array<std::array<int, 3>, 4>& face) {  // corners by place along x, y and upwards
    for (int layer = 0; layer < layers; ++layer) {
      std::array<int, 8> hexahedron{};
      for (int k = 0; k < 8; ++k) {
        const auto& [i, j, up] = face[static_cast<std::size_t>(k & 3)];
        const int depth = layer + (k >> 2 & 1);
        const Vec3 on_cube(between(-1, 1, i, n), between(-1, 1, j, n), between(-1, 1, up, storeys));
        hexahedron[static_cast<std::size_t>(k)] =
            lattice.at({i, j, up, depth}, between(inner, outer, depth, layers) * on_cube);
      }
      hexahedra.push_back(hexahedron);
    }
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) add({{{i, j, 0}, {i + 1, j, 0}, {i, j + 1, 0}, {i + 1, j + 1, 0}}});
  for (int i = 0; i < n; ++i)
    for (int up = 0; up < storeys; ++up)
      for (const int side : {0, n}) {
        add({{{i, side, up}, {i + 1, side, up}, {i, side, up + 1}, {i + 1, side, up + 1}}});
        add({{{side, i, up}, {side, i + 1, up}, {side, i, up + 1}, {side, i + 1, up + 1}}});
      }
  return split_hexahedra(std::move(lattice.nodes), hexahedra);
}

TetMesh square_tube(int n, int layers, double inner, double outer, int storeys, double height) {
  Lattice lattice;
  std::vector<std::array<int, 8>> hexahedra;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i)
      for (int layer = 0; layer < layers; ++layer)
        for (int storey = 0; storey < storeys; ++storey) {
          std::array<int, 8> hexahedron{};
          for (int k = 0; k < 8; ++k) {
            const int axis = side / 2, depth = layer + (k >> 1 & 1), floor = storey + (k >> 2 & 1);
            std::array<int, 4> key{};
            key[static_cast<std::size_t>(axis)] = side % 2 == 0 ? 0 : n;
            key[static_cast<std::size_t>(1 - axis)] = i + (k & 1);
            key[2] = floor, key[3] = depth;
            Vec3 place =
                between(inner, outer, depth, layers) * Vec3(between(-1, 1, key[0], n), between(-1, 1, key[1], n), 0);
            place.z() = between(0, height, floor, storeys);
            hexahedron[static_cast<std::size_t>(k)] = lattice.at(key, place);
          }
          hexahedra.push_back(hexahedron);
        }
  return split_hexahedra(std::move(lattice.nodes), hexahedra);
}

Vec3 cube_to_sphere(const Vec3& x) {
  const double radius = x.cwiseAbs().maxCoeff();
  return radius * Vec3(x / radius).unaryExpr(&warped).normalized();
}

Vec3 square_to_circle(const Vec3& x) {
  const double radius = x.head<2>().cwiseAbs().maxCoeff();
  Vec3 round = radius * Vec3(warped(x.x() / radius), warped(x.y() / radius), 0).normalized();
  round.z() = x.z();
  return round;
}

WorldSetup make_body(TetMesh mesh, const std::string& element, const Material& material, const Map& map) {
  WorldSetup setup;
  setup.mesh = std::move(mesh);
  setup.solver.quadratic = is_quadratic(element);
  setup.solver.nodal_pressure = element.ends_with("pressure");
  if (setup.solver.quadratic) setup.midedges = add_midedge_nodes(setup.mesh);
  if (map)
    for (Vec3& node : setup.mesh.nodes) node = map(node);
  setup.materials = {{std::nullopt, material}};
  setup.solver.threads = 1;
  return setup;
}

Material rubber(double shear, double bulk) {
  Material material;
  material.law = "neo_hookean_iso";
  material.parameters = {shear / 2, bulk};
  return material;
}

double bulk_of(double shear, double poisson) { return 2 * shear * (1 + poisson) / (3 * (1 - 2 * poisson)); }

Material heart_muscle(const std::array<double, 4>& parameters, double bulk) {
  Material material;
  material.law = "guccione";
  material.parameters.assign(parameters.begin(), parameters.end());
  material.parameters.push_back(bulk);
  material.fibre = Vec3::UnitZ();
  return material;
}

std::vector<int> nodes_where(const WorldSetup& setup, const std::function<bool(const Vec3&)>& chosen) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (chosen(setup.mesh.nodes[n])) nodes.push_back(static_cast<int>(n));
  return nodes;
}

Boundary moved(int node, const Vec3& displacement, double ramp_time) {
  Boundary boundary;
  boundary.nodes = {node};
  boundary.translate = displacement;
  boundary.ramp_time = ramp_time;
  return boundary;
}

Vec3 place_in(const WorldSetup& setup, std::size_t element, const std::array<double, 4>& coordinates) {
  return ElementMap(setup, element).at(setup.mesh.nodes, coordinates);
}

std::vector<Vec3> carried(const WorldSetup& setup, const std::vector<Vec3>& x, const std::vector<Vec3>& points) {
  std::vector<Vec3> result;
  for (const Vec3& point : points) {
    Vec3 best = Vec3::Zero();
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < setup.mesh.tets.size() && deepest < -1e-9; ++t) {
      const ElementMap element(setup, t);
      const auto place = element.place_of(point);
      const double depth = place ? *std::min_element(place->begin(), place->end()) : deepest;
      if (depth > deepest) deepest = depth, best = element.at(x, *place);
    }
    result.push_back(best);
  }
  return result;
}

std::size_t unknowns_of(const WorldSetup& setup) {
  std::vector<AxisSet> held(setup.mesh.nodes.size(), AxisSet::none());
  for (const Boundary& boundary : setup.boundary)
    for (const int n : boundary.nodes) {
      AxisSet& axes = held[static_cast<std::size_t>(n)];
      axes = axes.with(boundary.axes);
    }
  std::size_t count = 0;
  for (const AxisSet& axes : held)
    count += static_cast<std::size_t>(std::count(axes.has.begin(), axes.has.end(), false));
  return count;
}

Solved solve(const Trial& trial, WorldSetup setup, double tolerance, int parts) {
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.tolerance = tolerance;
  Solved solved;
  solved.unknowns = unknowns_of(setup);
  const auto began = std::chrono::steady_clock::now();
  const auto world = trial.make(std::move(setup));
  for (int k = 1; k <= parts && !world->halt(); ++k) world->load_to(static_cast<double>(k) / parts);
  solved.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  solved.x = world->positions();
  solved.reactions = world->reactions();
  if (world->halt()) solved.failed = world->halt()->message;
  return solved;
}

Row row_of(const Solved& solved, const std::string& quantity, const std::string& unit, double ours, double reference,
           const std::string& source, double limit, const std::string& method) {
  return {{}, quantity, unit, ours, reference, source, limit, method, solved.unknowns, solved.seconds, solved.failed};
}

}  // namespace heml::validation
