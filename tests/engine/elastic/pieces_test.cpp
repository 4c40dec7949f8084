// Divided elements: the pieces act as the whole element and inherit its internal state.
#include <doctest/doctest.h>

#include <heml/mesh/cut.hpp>

#include "small_body.hpp"

namespace heml::pieces_test {

using namespace heml::test;

namespace {

/// The small body and the body that a cut makes of it; both have the same node numbers.
struct CutBody {
  SmallBody small;
  MeshEdit edit;
  TetMesh pieces;
  std::vector<int> origins;  ///< of each piece
  std::vector<FieldParameter> fields;

  explicit CutBody(std::mt19937_64& random) : small(random, 0.1, Mat3(Vec3(1.15, 0.9, 1).asDiagonal())) {
    Material varied = sample_material("neo_hookean_iso");
    vary_parameters(varied, small.mesh, random);
    fields = varied.fields;
    std::vector<Vec3> x;
    for (std::size_t n = 0; n < small.mesh.nodes.size(); ++n) x.push_back(Eigen::Map<const Vec3>(&small.x[3 * n]));
    const Sweep sweep{{{Vec3(0.05, -1, -1), Vec3(0.05, -1, 1)}, {Vec3(0.066, 1, -1), Vec3(0.066, 1, 1)}}};
    Cut cut;
    REQUIRE(make_cut(sweep, small.mesh, x, full_topology(small.mesh), 1e-9, {}, cut).ok());
    edit = cut.edit;
    const auto tets = static_cast<int>(small.mesh.tets.size());
    TetMesh all = small.mesh;
    append(edit, all);
    const auto elements = apply_edit(full_topology(small.mesh), edit, tets).elements;
    pieces = with_elements(all, elements);
    for (const int t : elements) origins.push_back(t < tets ? t : edit.parents[static_cast<std::size_t>(t - tets)]);
  }

  std::vector<double> on_pieces(std::vector<double> values) const {
    append(edit, values, 3);
    return values;
  }
};

Material material_with(int kind) {
  Material material = sample_material("neo_hookean_iso");
  if (kind == 1) material.viscosity = 40, material.bulk_viscosity = 15;
  if (kind == 2) material.relaxation = {{0.5, 0.02}, {0.3, 0.2}};
  if (kind == 3) material.plasticity = Plasticity{100, 200};
  return material;
}

}  // namespace

TEST_CASE("pieces of elements act as the whole element and inherit its parameters, viscosity, relaxation and flow") {
  std::mt19937_64 random(11);
  const CutBody cut(random);
  REQUIRE(cut.pieces.tets.size() > cut.small.mesh.tets.size() + 20);
  ThreadTeam team(1);
  for (const int kind : {0, 1, 2, 3, 4}) {
    CAPTURE(kind);
    // Two bodies with the same history; one of them is cut.
    Material material = material_with(kind);
    if (kind == 4) material.fields = cut.fields;
    const auto whole_body = cut.small.of(material, true), pieces = cut.small.of(material, true);
    std::vector<double> past = cut.small.x;
    for (int step = 0; step < 2; ++step) {
      for (const auto& body : {whole_body.get(), pieces.get()}) {
        body->begin_step(0.01);
        body->commit(past.data());
      }
      for (double& value : past) value += uniform(random, -2e-3, 2e-3);
    }
    pieces->transfer_state(cut.pieces, std::vector<int>(cut.pieces.tets.size(), 0), cut.origins);

    std::vector<double> now = past;
    for (double& value : now) value += uniform(random, -1e-3, 1e-3);
    whole_body->begin_step(0.005);
    pieces->begin_step(0.005);
    const std::vector<double> split_now = cut.on_pieces(now);
    const auto f = forces_of(*whole_body, now), g = forces_of(*pieces, split_now);
    for (int trial = 0; trial < 3; ++trial) {
      std::vector<double> u(now.size());
      for (double& value : u) value = uniform(random, -1, 1);
      const std::vector<double> w = cut.on_pieces(u);
      double work = 0, of_pieces = 0, scale = 0;
      for (std::size_t i = 0; i < u.size(); ++i) work += f[i] * u[i], scale += std::abs(f[i] * u[i]);
      for (std::size_t i = 0; i < w.size(); ++i) of_pieces += g[i] * w[i];
      CHECK(std::abs(work - of_pieces) <= 1e-10 * scale);
    }
    CHECK(pieces->potential(split_now.data(), team) ==
          doctest::Approx(whole_body->potential(now.data(), team)).epsilon(1e-10));
    CHECK(pieces->plastic_work() == whole_body->plastic_work());
    if (kind == 3) CHECK(whole_body->plastic_work() > 0);
    // The history matters: without it the cut body has other forces.
    if (kind == 0 || kind == 4) continue;
    pieces->set_mesh(cut.pieces, std::vector<int>(cut.pieces.tets.size(), 0));
    pieces->begin_step(0.005);
    const auto forgot = forces_of(*pieces, split_now);
    double difference = 0;
    for (std::size_t i = 0; i < g.size(); ++i) difference = std::max(difference, std::abs(forgot[i] - g[i]));
    CHECK(difference > 1e-3 * largest(g));
  }
}

}  // namespace heml::pieces_test
