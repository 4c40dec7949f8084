// The fan kernels: every law, instruction set and precision against the scalar code of one element in double.
#include <doctest/doctest.h>

#include <heml/elastic/fan_cut.hpp>
#include <heml/elastic/fan_forces.hpp>
#include <heml/elastic/tension.hpp>
#include <heml/materials/laws.hpp>
#include <numeric>

#include "small_body.hpp"

namespace heml::fan_forces_test {

using test::irregular_box;
using test::law_names;
using test::sample_material;

namespace {

std::vector<int> all_of(const TetMesh& mesh) {
  std::vector<int> elements(mesh.tets.size());
  std::iota(elements.begin(), elements.end(), 0);
  return elements;
}

/// Forces by the scalar code, element by element.
template <class Real = double>
std::vector<double> reference(const TetMesh& mesh, const Material& material, bool continuation,
                              const std::vector<double>& at) {
  const std::vector<Real> x(at.begin(), at.end());
  std::vector<double> f(x.size(), 0.0);
  with_law<Real>(material, continuation, [&](const auto& law) {
    for (const Tet& tet : mesh.tets) {
      const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
      Mat3 Dm;
      Dm << X(1) - X(0), X(2) - X(0), X(3) - X(0);
      const Mat3 g = Dm.inverse(), A = g * g.transpose();
      const Vec3 m = g * material.fibre;
      const double entries[6] = {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(0, 2), A(1, 2)};
      RestShape<Real> rest;
      for (int i = 0; i < 6; ++i) rest.A[i] = static_cast<Real>(entries[i]);
      for (int i = 0; i < 3; ++i) rest.fibre[i] = static_cast<Real>(m[i]);
      rest.volume = static_cast<Real>(Dm.determinant() / 6);
      Real out[12];
      const auto corner = [&](std::size_t c) { return &x[3 * static_cast<std::size_t>(tet[c])]; };
      corner_forces(law, corner(0), corner(1), corner(2), corner(3), rest, out);
      for (std::size_t i = 0; i < 12; ++i)
        f[3 * static_cast<std::size_t>(tet[i / 3]) + i % 3] += static_cast<double>(out[i]);
    }
  });
  return f;
}

template <class Real>
std::vector<Real> run(FanForces<Real>& fans, const std::vector<double>& at, int threads) {
  ThreadTeam team(threads);
  const std::vector<Real> x(at.begin(), at.end());
  std::vector<Real> f(x.size(), Real(7));
  CHECK(fans.forces(x.data(), f.data(), team));
  return f;
}

/// Largest difference, relative to the largest force.
template <class Number>
double difference(const std::vector<Number>& f, const std::vector<double>& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double d = std::abs(static_cast<double>(f[i]) - expected[i]);
    if (!(d <= worst)) worst = d;  // also true for NaN
  }
  return worst / test::largest(expected);
}

/// Positions that float represents exactly, so that rounding them adds no error.
std::vector<double> moved(const TetMesh& mesh, std::mt19937_64& random, double noise, const Mat3& F) {
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) {
    const Vec3 to = F * X + test::random_vector(random, noise * 0.03);
    for (int i = 0; i < 3; ++i) x.push_back(static_cast<double>(static_cast<float>(to[i])));
  }
  return x;
}

struct Pose {
  std::string name;
  bool continuation;
  double noise;
  Mat3 F;
};

std::vector<Pose> poses() {
  const auto stretch = [](double a, double b, double c) { return Mat3(Vec3(a, b, c).asDiagonal()); };
  return {{"shaken", false, 0.06, stretch(1, 1, 1)},
          {"stretched", false, 0.01, stretch(1.6, 0.8, 0.9)},
          {"turned inside out", true, 0.8, stretch(1, 1, 1)},
          {"mirrored", true, 0.05, stretch(-1, 1, 1)},
          {"flat", true, 0, stretch(1, 1, 0)},
          {"a line", true, 0, stretch(1.5, 0, 0)},
          {"three times as long", true, 0.05, stretch(3, 1, 0.5)}};
}

template <class Real>
void check_kernels(InstructionSet isa, double tolerance) {
  std::mt19937_64 random(31);
  const TetMesh mesh = irregular_box(random, {3, 2, 2});
  const std::vector<int> elements = all_of(mesh);
  ThreadTeam alone(1);
  for (const auto law : law_names())
    for (const Pose& pose : poses()) {
      CAPTURE(std::string(law));
      CAPTURE(std::string(name_of(isa)));
      CAPTURE(pose.name);
      const Material material = sample_material(law);
      const auto x = moved(mesh, random, pose.noise, pose.F);
      FanForces<Real> fans(mesh, {{&elements, &material}}, pose.continuation, isa, alone);
      const auto expected = reference(mesh, material, pose.continuation, x);
      // Scalar code in the same precision has the same error where the law is ill-conditioned, as Ogden's for a flat
      // body.
      const double scalar = difference(reference<Real>(mesh, material, pose.continuation, x), expected);
      CHECK(difference(run(fans, x, 1), expected) <= tolerance + 3 * scalar);
    }
}

}  // namespace

TEST_CASE("fast kernels in double give the forces of the scalar code, in extreme states too") {
  for (const InstructionSet isa : instruction_sets()) check_kernels<double>(isa, 1e-11);
}

TEST_CASE("fast kernels in float give the forces of the scalar code to float's precision") {
  for (const InstructionSet isa : instruction_sets()) check_kernels<float>(isa, 2e-5);
}

template <class Real>
void check_threads(double tolerance) {
  std::mt19937_64 random(32);
  const TetMesh mesh = irregular_box(random, {18, 17, 12});
  const std::vector<int> elements = all_of(mesh);
  const auto x = moved(mesh, random, 0.01, Mat3::Identity());
  for (const auto law : {"stvk", "mooney_rivlin"})
    for (const InstructionSet isa : instruction_sets()) {
      const Material material = sample_material(law);
      ThreadTeam three(3);
      FanForces<Real> fans(mesh, {{&elements, &material}}, true, isa, three);
      const auto one = run(fans, x, 1);
      CHECK(difference(one, reference(mesh, material, true, x)) <= tolerance);
      for (const int threads : {2, 3, 16}) CHECK(run(fans, x, threads) == one);
    }
}

TEST_CASE("fast kernels give the same bits for any number of threads") {
  check_threads<double>(1e-11);
  check_threads<float>(1e-4);
}

TEST_CASE("a kernel says when its law is not defined") {
  std::mt19937_64 random(33);
  const TetMesh mesh = irregular_box(random, {3, 2, 2});
  const std::vector<int> elements = all_of(mesh);
  const auto upright = moved(mesh, random, 0.02, Mat3::Identity());
  const auto mirrored = moved(mesh, random, 0, Vec3(1, 1, -1).asDiagonal());
  const Material material = sample_material("neo_hookean");
  ThreadTeam team(1);
  std::vector<double> f(upright.size());
  for (const InstructionSet isa : instruction_sets()) {
    FanForces<double> fans(mesh, {{&elements, &material}}, false, isa, team);
    CHECK(fans.forces(upright.data(), f.data(), team));
    CHECK_FALSE(fans.forces(mirrored.data(), f.data(), team));
    auto nowhere = upright;
    nowhere[0] = std::nan("");
    CHECK_FALSE(fans.forces(nowhere.data(), f.data(), team));
  }
}

TEST_CASE("the layout of fans is the same whoever makes it") {
  std::mt19937_64 random(37);
  const TetMesh mesh = irregular_box(random, {18, 17, 12});
  const std::vector<FanElements> parts = {{all_of(mesh)}};
  ThreadTeam alone(1), three(3);
  const FanLayout<float> one(mesh, parts, 8, alone), other(mesh, parts, 8, three);
  CHECK(one.blocks.size() > 4);
  CHECK(one.size == other.size);
  CHECK(one.index == other.index);
  CHECK(one.shape == other.shape);
  CHECK(one.nodes.place == other.nodes.place);
  CHECK(one.nodes.shared_slot == other.nodes.shared_slot);
}

TEST_CASE("blocks of all parts are of about equal size and follow each other as their elements do") {
  std::mt19937_64 random(41);
  const TetMesh mesh = irregular_box(random, {16, 14, 12});
  std::vector<FanElements> parts(2);
  // Part 1 is a slab in the middle of the numbers, so that its blocks lie between those of part 0.
  const int count = static_cast<int>(mesh.tets.size());
  for (int t = 0; t < count; ++t) parts[t > count / 3 && t < count / 3 + count / 5].elements.push_back(t);
  ThreadTeam team(1);
  const FanLayout<double> layout(mesh, parts, 8, team);
  REQUIRE(layout.blocks.size() > 4);
  CHECK(layout.blocks.front().part == 0);
  CHECK(layout.blocks.back().part == 0);
  int before = -1;
  std::size_t least = layout.elements(), most = 0;
  for (const auto& block : layout.blocks) {
    const int middle = layout.element[block.element + block.elements / 2];
    CHECK(middle > before);
    before = middle;
    least = std::min(least, block.elements), most = std::max(most, block.elements);
  }
  CHECK(most < 1.5 * least);
}

TEST_CASE("another law reuses the layout if its constants are the same") {
  std::mt19937_64 random(38);
  const TetMesh mesh = irregular_box(random, {4, 3, 3});
  const std::vector<int> elements = all_of(mesh);
  const auto x = moved(mesh, random, 0.02, Mat3::Identity());
  ThreadTeam alone(1);
  const auto made = [&](const Material& material) {
    return FanForces<double>(mesh, {{&elements, &material}}, false, InstructionSet::best, alone);
  };
  const Material stvk = sample_material("stvk"), mooney = sample_material("mooney_rivlin");
  FanForces<double> fans = made(stvk), anew = made(mooney);
  CHECK(fans.update_laws({{&elements, &mooney}}, false));
  CHECK(run(fans, x, 1) == run(anew, x, 1));

  Material along = sample_material("hgo"), across = along;
  across.fibre = along.fibre.unitOrthogonal();
  const Material ogden = sample_material("ogden");
  const auto before = run(fans, x, 1);
  CHECK_FALSE(fans.update_laws({{&elements, &ogden}}, false));
  CHECK_FALSE(fans.update_laws({{&elements, &along}}, false));
  CHECK_FALSE(fans.update_laws({{&elements, &mooney}, {&elements, &mooney}}, false));
  CHECK(run(fans, x, 1) == before);
  FanForces<double> fibres = made(along);
  CHECK(fibres.update_laws({{&elements, &along}}, false));
  CHECK_FALSE(fibres.update_laws({{&elements, &across}}, false));
}

TEST_CASE("fans contain every tetrahedron once, not inverted, in groups of one size") {
  std::mt19937_64 random(34);
  const auto check = [](const TetMesh& mesh, std::size_t lanes) {
    const auto fans = cut_into_fans(mesh.tets, lanes);
    CHECK(fans.size() % lanes == 0);
    std::vector<int> seen(mesh.tets.size(), 0);
    std::size_t unused = 0;
    for (std::size_t k = 0; k < fans.size(); ++k) {
      const Fan& fan = fans[k];
      CHECK(fan.size() == fans[k / lanes * lanes].size());
      CHECK(fan.tets.size() <= max_fan_tets);
      if (!fan.tets.empty()) CHECK((fan.ring.size() == fan.tets.size() || fan.ring.size() == fan.tets.size() + 1));
      if (fan.tets.empty()) ++unused;
      for (std::size_t i = 0; i < fan.tets.size(); ++i) {
        ++seen[fan.tets[i]];
        Tet corners{fan.p, fan.q, fan.ring[i], fan.ring[(i + 1) % fan.ring.size()]}, expected = mesh.tets[fan.tets[i]];
        const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(corners[c])]; };
        CHECK(signed_volume(X(0), X(1), X(2), X(3)) > 0);
        std::sort(corners.begin(), corners.end());
        std::sort(expected.begin(), expected.end());
        CHECK(corners == expected);
      }
    }
    CHECK(unused < lanes);
    CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  };
  const TetMesh box = irregular_box(random, {4, 3, 3});
  for (const std::size_t lanes : {2, 4, 8, 16}) check(box, lanes);

  TetMesh one = box;
  one.tets.resize(1);
  check(one, 8);

  TetMesh wheel;  // more tetrahedra round one edge than a fan may have
  wheel.nodes = {{0, 0, 0}, {0, 0, 1}};
  for (int k = 0; k < 19; ++k) {
    wheel.nodes.push_back({std::cos(k * 2 * M_PI / 19), std::sin(k * 2 * M_PI / 19), 0.5});
    wheel.tets.push_back({0, 1, k + 2, (k + 1) % 19 + 2});
  }
  for (const std::size_t lanes : {1, 4}) check(wheel, lanes);

  wheel.nodes.resize(8);  // as many as one fan may have
  wheel.tets.clear();
  for (int k = 0; k < 6; ++k) wheel.tets.push_back({0, 1, k + 2, (k + 1) % 6 + 2});
  for (int k = 0; k < 6; ++k) {
    const double angle = k * M_PI / 3;
    wheel.nodes[static_cast<std::size_t>(k) + 2] = {std::cos(angle), std::sin(angle), 0.5};
  }
  check(wheel, 1);
  CHECK(cut_into_fans(wheel.tets, 1).front().size() == FanSize{6, 6});
}

TEST_CASE("fast kernels take elements that share no node, and nodes of no element") {
  std::mt19937_64 random(35);
  const TetMesh box = irregular_box(random, {6, 6, 5});
  TetMesh shards;
  for (const Tet& tet : box.tets) {
    const int first = static_cast<int>(shards.nodes.size());
    for (const int n : tet) shards.nodes.push_back(box.nodes[static_cast<std::size_t>(n)]);
    shards.tets.push_back({first, first + 1, first + 2, first + 3});
    if (shards.tets.size() % 7 == 0) shards.nodes.push_back(Vec3::Zero());
  }
  const std::vector<int> elements = all_of(shards);
  const Material material = sample_material("mooney_rivlin");
  const auto x = moved(shards, random, 0.01, Mat3::Identity());
  ThreadTeam alone(1);
  for (const InstructionSet isa : instruction_sets()) {
    FanForces<double> fans(shards, {{&elements, &material}}, true, isa, alone);
    CHECK(difference(run(fans, x, 2), reference(shards, material, true, x)) <= 1e-11);
    CHECK(fans.bytes_per_tet() > 7 * sizeof(double));
  }
}

TEST_CASE("a body names the kernels of a law alone and with further terms") {
  std::mt19937_64 random(39);
  const TetMesh mesh = irregular_box(random, {4, 3, 3});
  const std::vector<int> elements = all_of(mesh), one_material(mesh.tets.size(), 0);
  const auto x = moved(mesh, random, 0.02, Mat3::Identity());
  ThreadTeam alone(1);
  const Material plain = sample_material("mooney_rivlin");
  Material viscous = plain, relaxing = plain, other_volume = plain, plastic = plain;
  viscous.viscosity = 3;
  relaxing.relaxation = {{0.4, 0.1}};
  other_volume.volume_term = VolumeTerm::simo_taylor;
  plastic.plasticity = Plasticity{50, 20};
  const auto forces = [&](const Material& material, bool nodal_pressure, const char* kernel) {
    ElasticBody<double> body(mesh, one_material, {material}, {false, nodal_pressure});
    CHECK(body.kernels().front().kernel == kernel);
    body.begin_step(0.01);
    return test::forces_of(body, x);
  };
  FanForces<double> fans(mesh, {{&elements, &plain}}, false, InstructionSet::best, alone);
  CHECK(forces(plain, false, "fans") == run(fans, x, 1));
  for (const Material& material : {viscous, relaxing, other_volume})
    CHECK(forces(material, false, "fans") != run(fans, x, 1));
  CHECK(forces(plain, true, "fans") != run(fans, x, 1));
  forces(plastic, false, "fans");
  plastic.viscosity = 3;
  forces(plastic, false, "fans");

  // A law without its volume term equals the law with κ = 0.
  Material isochoric = plain;
  isochoric.parameters.back() = 0;
  FanForces<double> without(mesh, {{&elements, &plain, true}}, false, InstructionSet::best, alone);
  CHECK(difference(run(without, x, 1), reference(mesh, isochoric, false, x)) <= 1e-11);
}

TEST_CASE("fast kernels stand beside the loops of other materials, and a body says which runs what") {
  std::mt19937_64 random(36);
  test::SmallBody small(random, 0.05);
  Material plain = sample_material("neo_hookean"), other = sample_material("mooney_rivlin");
  other.volume_term = VolumeTerm::logarithmic;
  std::vector<int> material_of;
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) material_of.push_back(static_cast<int>(t % 3));
  for (const InstructionSet isa : instruction_sets()) {
    ElasticBody<double> body(small.mesh, material_of, {plain, other, sample_material("mass_spring")},
                             {true, false, isa});
    CHECK(test::gradient_error(body, small.x) <= 1e-6);
    const auto kernels = body.kernels();
    REQUIRE(kernels.size() == 3);
    CHECK(kernels[0].kernel == "fans");
    CHECK(kernels[0].instructions == name_of(isa));
    CHECK(kernels[0].elements == small.mesh.tets.size() / 3);
    CHECK(kernels[1].kernel == "fans");
    CHECK(kernels[1].bytes_per_tet > kernels[0].bytes_per_tet / 2);
  }
}

}  // namespace heml::fan_forces_test
