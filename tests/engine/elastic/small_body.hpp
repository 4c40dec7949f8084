#pragma once
// A small irregular body of one material, displaced from rest.
#include <heml/elastic/body.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/reorder.hpp>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"

namespace heml::test {

/// Names of the continuum laws, or of all laws.
inline std::vector<std::string_view> law_names(bool with_springs = false) {
  std::vector<std::string_view> names;
  for (const LawInfo& law : laws())
    if (law.is_continuum || with_springs) names.push_back(law.name);
  return names;
}

/// A box of irregular tetrahedra in inner order.
inline TetMesh irregular_box(std::mt19937_64& random, const std::array<int, 3>& cells) {
  TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), cells);
  for (Vec3& X : mesh.nodes) X += random_vector(random, 0.012 / cells[0]);
  return reordered(mesh, hilbert_order(mesh));
}

/// Makes all parameters of the material but lists differ between the elements: fields of the mesh.
inline void vary_parameters(Material& material, TetMesh& mesh, std::mt19937_64& random) {
  mesh.fields.clear();
  material.fields.clear();
  const std::vector<ParameterSlot> slots = parameter_slots(material, *find_law(material.law));
  for (std::size_t k = 0; k < slots.size(); ++k) {
    if (slots[k].info->is_list()) continue;
    ElementField field{"parameter " + std::to_string(k), 1, {}};
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      field.values.push_back(material.parameters[k] * uniform(random, 0.7, 1.4));
    material.fields.push_back({k, field.name});
    mesh.fields.push_back(std::move(field));
  }
}

/// Pushes a corner of a tetrahedron as near to its opposite face as `left` of its height, the first one where all
/// others stay upright.
inline void flatten_one(TetMesh& mesh, double left) {
  for (const Tet& tet : mesh.tets)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto at = [&](std::size_t k) -> Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[(c + k) % 4])]; };
      const Vec3 before = at(0), normal = (at(2) - at(1)).cross(at(3) - at(1)).normalized();
      at(0) -= (1 - left) * normal.dot(at(0) - at(1)) * normal;
      const auto upright = [&](const Tet& t) {
        const auto X = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
        return signed_volume(X(0), X(1), X(2), X(3)) > 1e-12;
      };
      if (std::all_of(mesh.tets.begin(), mesh.tets.end(), upright)) return;
      at(0) = before;
    }
}

/// A small irregular body, stretched by F and with random displacements of `noise` times an edge length.
struct SmallBody {
  TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), {3, 2, 2});
  std::vector<double> x;

  SmallBody(std::mt19937_64& random, double noise, const Mat3& F = Mat3::Identity(), const Vec3& shift = Vec3::Zero()) {
    for (Vec3& X : mesh.nodes) X += random_vector(random, 0.004);
    for (const Vec3& X : mesh.nodes) {
      const Vec3 moved = F * X + shift + random_vector(random, noise * 0.03);
      x.insert(x.end(), {moved.x(), moved.y(), moved.z()});
    }
  }

  std::vector<double> rest() const {
    std::vector<double> result;
    for (const Vec3& X : mesh.nodes) result.insert(result.end(), {X.x(), X.y(), X.z()});
    return result;
  }

  template <class Real = double>
  std::unique_ptr<ElasticBody<Real>> of(const Material& material, bool continuation,
                                        bool nodal_pressure = false) const {
    return std::make_unique<ElasticBody<Real>>(mesh, std::vector<int>(mesh.tets.size(), 0), std::vector{material},
                                               BodyOptions{continuation, nodal_pressure});
  }
  template <class Real = double>
  std::unique_ptr<ElasticBody<Real>> of(std::string_view law, bool continuation) const {
    return of<Real>(sample_material(law), continuation);
  }
};

inline std::vector<double> forces_of(ElasticBody<double>& body, const std::vector<double>& x, int threads = 1) {
  ThreadTeam team(threads);
  std::vector<double> f(x.size());
  body.forces(x.data(), f.data(), team);
  return f;
}

inline double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

/// Largest difference between the forces and −∂U/∂x by fourth-order differences, relative to the largest force.
inline double gradient_error(ElasticBody<double>& body, const std::vector<double>& at, double h = 2e-7) {
  const auto f = forces_of(body, at);
  ThreadTeam team(1);
  double worst = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto U = [&](double by) {
      auto x = at;
      x[i] += by;
      return body.potential(x.data(), team);
    };
    const double slope = (8 * (U(h) - U(-h)) - (U(2 * h) - U(-2 * h))) / (12 * h);
    worst = std::max(worst, std::abs(f[i] + slope));
  }
  return worst / largest(f);
}

/// Largest difference between −K dx and differences of the forces along a random dx, relative to its largest entry.
inline double stiffness_error(ElasticBody<double>& body, const std::vector<double>& at, std::mt19937_64& random) {
  std::vector<double> dx(at.size()), change(at.size());
  for (double& d : dx) d = uniform(random, -1, 1);
  ThreadTeam team(1);
  body.linearise(at.data(), team);
  body.force_differential(dx.data(), change.data(), team);
  const double h = 1e-7;
  const auto along = [&](double by) {
    auto x = at;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += by * dx[i];
    return forces_of(body, x);
  };
  const auto a = along(h), b = along(-h), c = along(2 * h), d = along(-2 * h);
  double worst = 0;
  for (std::size_t i = 0; i < at.size(); ++i)
    worst = std::max(worst, std::abs(change[i] - (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h)));
  return worst / largest(change);
}

}  // namespace heml::test
