// Point kernels against the loops over virtual corners, which the portable instruction set takes.
#include <doctest/doctest.h>

#include <algorithm>
#include <heml/elastic/body.hpp>
#include <heml/elastic/energy_term.hpp>
#include <heml/elastic/instruction_set.hpp>
#include <heml/materials/parameter_slots.hpp>

#include "engine/materials/energy_materials.hpp"
#include "quadratic_body.hpp"

namespace heml::point_kernels_test {

using test::QuadraticBody;
using test::sample_material;

/// A curved mesh of an odd number of elements in two materials, so that packets are padded.
struct Sample {
  QuadraticBody body;
  std::vector<int> material_of;

  explicit Sample(std::mt19937_64& random) : body(random, 0.05, true) {
    material_of.assign(body.mesh.tets.size(), 0);
    for (std::size_t t = 0; t < material_of.size(); t += 4) material_of[t] = 1;
  }

  template <class Real>
  std::unique_ptr<ElasticBody<Real>> of(const std::vector<Material>& materials, bool continuation, bool pressure,
                                        InstructionSet isa) const {
    BodyOptions options;
    options.continuation = continuation;
    options.nodal_pressure = pressure;
    options.instruction_set = isa;
    return std::make_unique<ElasticBody<Real>>(body.mesh, material_of, materials, options, body.midedges);
  }
};

template <class Real>
std::vector<Real> converted(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

template <class Real>
void check_law(const Sample& sample, const Material& material, bool continuation, bool pressure, double tolerance) {
  ThreadTeam team(1), many(3);
  const std::vector<Real> x = converted<Real>(sample.body.x);
  std::vector<Real> expected(x.size()), f(x.size()), again(x.size());
  const std::vector<Material> materials(2, material);
  const auto portable = sample.of<Real>(materials, continuation, pressure, InstructionSet::portable);
  CHECK(portable->forces(x.data(), expected.data(), team));
  CHECK(portable->kernels()[0].kernel == "points");
  Real size = 0;
  for (const Real value : expected) size = std::max(size, std::abs(value));
  for (const InstructionSet isa : instruction_sets()) {
    if (isa == InstructionSet::portable) continue;
    CAPTURE(name_of(isa));
    const auto body = sample.of<Real>(materials, continuation, pressure, isa);
    CHECK(body->kernels()[0].kernel == "points");
    CHECK(body->kernels()[0].instructions == name_of(isa));
    CHECK(body->forces(x.data(), f.data(), team));
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= tolerance * size);
    body->forces(x.data(), again.data(), many);
    CHECK(f == again);
  }
}

TEST_CASE("point kernels: forces of every law are those of the loops over virtual corners, to round-off") {
  std::mt19937_64 random(61);
  const Sample sample(random);
  CHECK(std::count(sample.material_of.begin(), sample.material_of.end(), 0) % 2 == 1);
  for (const auto law : test::law_names()) {
    if (!find_law(law)->is_continuum) continue;
    for (const bool continuation : {false, true}) {
      CAPTURE(std::string(law));
      CAPTURE(continuation);
      check_law<double>(sample, sample_material(law), continuation, false, 1e-12);
      check_law<float>(sample, sample_material(law), continuation, false, 2e-4);
    }
  }
}

TEST_CASE("point kernels: mean dilatation of every law with a volume term") {
  std::mt19937_64 random(62);
  const Sample sample(random);
  int seen = 0;
  for (const auto law : test::law_names()) {
    const LawInfo& info = *find_law(law);
    Material material = sample_material(law);
    if (!info.is_continuum || !info.has_volume_term) continue;
    const auto kappa = *volume_parameter(material, info);
    material.parameters[kappa] *= 40;  // nearly incompressible: most of it is the element's
    CAPTURE(std::string(law));
    check_law<double>(sample, material, false, true, 1e-12);
    check_law<float>(sample, material, false, true, 2e-4);
    ++seen;
  }
  CHECK(seen >= 5);
}

TEST_CASE("point kernels: parameters that differ between elements, whole and with mean dilatation") {
  std::mt19937_64 random(66);
  Sample sample(random);
  for (const auto law : test::law_names()) {
    Material material = sample_material(law);
    test::vary_parameters(material, sample.body.mesh, random);
    CAPTURE(std::string(law));
    for (const bool pressure : {false, find_law(law)->has_volume_term}) {
      check_law<double>(sample, material, true, pressure, 1e-12);
      check_law<float>(sample, material, true, pressure, 2e-4);
    }
  }
}

TEST_CASE("point kernels: bodies of several blocks, which share nodes") {
  std::mt19937_64 random(65);
  Sample sample(random);
  sample.body.mesh = make_box(Vec3(0.1, 0.08, 0.06), {6, 6, 5});
  sample.body.midedges = add_midedge_nodes(sample.body.mesh);
  sample.body.x.clear();
  for (const Vec3& X : sample.body.mesh.nodes) {
    const Vec3 moved = X + test::random_vector(random, 0.0005);
    sample.body.x.insert(sample.body.x.end(), {moved.x(), moved.y(), moved.z()});
  }
  sample.material_of.assign(sample.body.mesh.tets.size(), 0);
  for (std::size_t t = 0; t < sample.material_of.size(); ++t) sample.material_of[t] = t % 3 == 0 || t > 700;
  CHECK(sample.material_of.size() > 3 * max_point_block_elements);
  check_law<double>(sample, sample_material("neo_hookean"), false, false, 1e-12);
  check_law<float>(sample, sample_material("neo_hookean"), false, false, 2e-4);
  check_law<double>(sample, sample_material("neo_hookean_iso"), false, true, 1e-12);
  Material varying = sample_material("neo_hookean_iso");
  test::vary_parameters(varying, sample.body.mesh, random);
  check_law<double>(sample, varying, false, true, 1e-12);
  // Beside a part with a further term.
  ThreadTeam team(1), many(3);
  Material plain = sample_material("neo_hookean"), viscous = plain;
  viscous.volume_term = VolumeTerm::quadratic, viscous.viscosity = 1;
  std::vector<double> f(sample.body.x.size()), again(f.size()), expected(f.size());
  const auto mixed = sample.of<double>({plain, viscous}, false, false, instruction_sets().back());
  mixed->forces(sample.body.x.data(), f.data(), team);
  mixed->linearise(sample.body.x.data(), team);
  mixed->force_differential(sample.body.x.data(), again.data(), team);  // writes what every element pulls
  mixed->forces(sample.body.x.data(), again.data(), many);
  CHECK(f == again);
  sample.of<double>({plain, viscous}, false, false, InstructionSet::portable)
      ->forces(sample.body.x.data(), expected.data(), team);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= 1e-12 * test::largest(expected));
}

TEST_CASE("point kernels: an undefined law is told of one element, whichever lane it is in") {
  std::mt19937_64 random(63);
  Sample sample(random);
  ThreadTeam team(1);
  std::vector<double> f(sample.body.x.size());
  for (const InstructionSet isa : instruction_sets()) {
    CAPTURE(name_of(isa));
    for (std::size_t t = 0; t < sample.body.mesh.tets.size(); ++t) {
      std::vector<double> x = sample.body.x;
      const auto body = sample.of<double>(std::vector(2, sample_material("neo_hookean")), false, false, isa);
      CHECK(body->forces(x.data(), f.data(), team));
      const Vec3 middle = sample.body.at(sample.body.midedges[t][5]);  // turns what is beside it inside out
      const Vec3 corner = sample.body.at(sample.body.mesh.tets[t][2]);
      Eigen::Map<Vec3>(&x[3 * static_cast<std::size_t>(sample.body.midedges[t][5])]) += 2 * (corner - middle);
      std::vector<double> ratios;
      body->volume_ratios(x.data(), ratios);
      CHECK(*std::min_element(ratios.begin(), ratios.end()) < 0);
      CHECK_FALSE(body->forces(x.data(), f.data(), team));
    }
  }
}

/// Materials of a law with each further term, and with all of them.
std::vector<Material> with_terms(const Material& plain) {
  std::vector<Material> result;
  const auto add = [&](const auto& change) { change(result.emplace_back(plain)); };
  add([](Material& m) { m.viscosity = 2, m.bulk_viscosity = 1; });
  add([](Material& m) { m.relaxation = {{0.4, 0.02}}; });
  add([](Material& m) { m.relaxation = {{0.4, 0.02}, {0.2, 0.005}, {0.7, 0.1}}; });
  add([](Material& m) { m.volume_term = VolumeTerm::logarithmic; });
  add([](Material& m) { m.volume_term = VolumeTerm::simo_taylor; });
  add([](Material& m) { m.active_stress = 3000, m.fibre = Vec3(0.6, 0, 0.8); });
  add([](Material& m) {
    m.viscosity = 2, m.relaxation = {{0.4, 0.02}, {0.2, 0.005}}, m.volume_term = VolumeTerm::simo_taylor;
    m.active_stress = 3000, m.fibre = Vec3(0.6, 0, 0.8);
  });
  return result;
}

/// Steps of two bodies through the same positions: forces agree, and so do internal states at the end.
template <class Real>
void check_steps(const Sample& sample, const Material& material, bool pressure, InstructionSet isa, double tolerance) {
  ThreadTeam team(1), many(3);
  std::mt19937_64 random(67);
  const std::vector<Material> materials(2, material);
  const auto loops = sample.of<Real>(materials, false, pressure, InstructionSet::portable),
             points = sample.of<Real>(materials, false, pressure, isa);
  CHECK(points->kernels()[0].kernel == "points");
  CHECK(points->kernels()[0].instructions == name_of(isa));
  std::vector<Real> x = converted<Real>(sample.body.x), expected(x.size()), f(x.size()), again(x.size());
  for (int step = 0; step < 4; ++step) {
    for (Real& value : x) value += static_cast<Real>(test::uniform(random, -1e-4, 1e-4));
    for (const auto& body : {loops.get(), points.get()}) body->begin_step(Real(0.003));
    CHECK(loops->forces(x.data(), expected.data(), team));
    CHECK(points->forces(x.data(), f.data(), team));
    Real size = 0;
    for (const Real value : expected) size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= tolerance * size);
    points->forces(x.data(), again.data(), many);
    CHECK(f == again);
    if (step == 2) points->forces(converted<Real>(sample.body.x).data(), again.data(), team);  // not where it commits
    for (const auto& body : {loops.get(), points.get()}) body->commit(x.data());
  }
  CHECK(points->plastic_work() == doctest::Approx(loops->plastic_work()).epsilon(tolerance));
  CHECK((points->plastic_work() > 0) == material.plasticity.has_value());
  const InternalState<Real> by_loops = loops->internal_state(), by_points = points->internal_state();
  REQUIRE(by_loops.values.size() == by_points.values.size());
  for (std::size_t k = 0; k < by_loops.values.size(); ++k) {
    Real size = 0;
    for (const Real value : by_loops.values[k]) size = std::max(size, std::abs(value));
    REQUIRE(by_loops.values[k].size() == by_points.values[k].size());
    const bool is_of_flow = material.plasticity && k < 7;  // plastic strain and A
    const std::size_t each = 12 + 6 * material.relaxation.size();
    const std::size_t first = is_of_flow || material.viscosity > 0 ? 0 : 6;
    for (std::size_t i = 0; i < by_loops.values[k].size(); ++i)
      if (i % each >= first)  // without viscosity Gram matrices are not used
        CHECK(std::abs(by_loops.values[k][i] - by_points.values[k][i]) <= tolerance * size);
  }
}

TEST_CASE("point kernels: terms beside the law are those of the loops, over steps") {
  std::mt19937_64 random(64);
  Sample sample(random);
  for (const auto law : {"neo_hookean_iso", "mooney_rivlin", "ogden", "hgo"}) {
    CAPTURE(std::string(law));
    Material plain = sample_material(law);
    for (const bool varies : {false, true}) {
      if (varies) test::vary_parameters(plain, sample.body.mesh, random);
      for (Material material : with_terms(plain)) {
        if (std::string_view(law) == "hgo") material.fibre = plain.fibre;
        const InstructionSet best = instruction_sets().back();
        for (const bool pressure : {false, true}) check_steps<double>(sample, material, pressure, best, 1e-11);
        check_steps<float>(sample, material, false, best, 1e-3);
      }
    }
  }
  for (const InstructionSet isa : instruction_sets())
    if (isa != InstructionSet::portable)
      check_steps<double>(sample, with_terms(sample_material("neo_hookean_iso")).back(), false, isa, 1e-11);
}

TEST_CASE("point kernels: what flows is what the loops find, beside viscosity and relaxation too") {
  std::mt19937_64 random(71);
  Sample sample(random);
  for (const auto law : {"neo_hookean_iso", "mooney_rivlin", "ogden", "yeoh"}) {
    CAPTURE(std::string(law));
    Material plastic = sample_material(law);
    plastic.plasticity = Plasticity{30, 10};
    for (const bool varies : {false, true}) {
      if (varies) test::vary_parameters(plastic, sample.body.mesh, random);
      Material viscous = plastic, relaxing = plastic;
      viscous.viscosity = 2, relaxing.relaxation = {{0.4, 0.02}};
      for (const Material& material : {plastic, viscous, relaxing})
        for (const bool pressure : {false, true}) {
          check_steps<double>(sample, material, pressure, instruction_sets().back(), 1e-9);
          check_steps<float>(sample, material, pressure, instruction_sets().back(), 5e-3);
        }
    }
  }
}

TEST_CASE("point kernels: laws by expression, alone and with viscosity") {
  std::mt19937_64 random(70);
  const Sample sample(random);
  for (const test::SameEnergy& same : test::same_energies()) {
    if (!has_kernel(same.expression)) continue;
    CAPTURE(same.expression.law);
    Material viscous = same.expression;
    viscous.viscosity = 2;
    for (const Material& material : {same.expression, viscous}) {
      check_law<double>(sample, material, false, false, 1e-11);
      check_law<float>(sample, material, false, false, 2e-3);
    }
  }
}

TEST_CASE("point kernels: a state goes on where it was restored, to the bit") {
  std::mt19937_64 random(68);
  const Sample sample(random);
  ThreadTeam team(1);
  const std::vector<Material> materials(2, with_terms(sample_material("neo_hookean_iso")).back());
  const auto body = sample.of<double>(materials, false, false, instruction_sets().back());
  std::vector<double> x = sample.body.x, f(x.size()), expected(x.size());
  const auto step = [&](double shift, std::vector<double>& force) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = sample.body.x[i] * (1 + shift);
    body->begin_step(0.003);
    body->forces(x.data(), force.data(), team);
    body->commit(x.data());
  };
  step(0.01, f), step(0.02, f);
  const auto snapshot = body->snapshot();
  const std::vector<double> there = x;
  step(0.03, f), step(0.05, expected);
  body->restore(snapshot, there.data());
  step(0.03, f), step(0.05, f);
  CHECK(f == expected);
}

TEST_CASE("point kernels: a volume term that is not defined is told") {
  std::mt19937_64 random(69);
  const Sample sample(random);
  ThreadTeam team(1);
  Material material = sample_material("neo_hookean_iso");
  material.volume_term = VolumeTerm::logarithmic;
  std::vector<double> mirrored = sample.body.x, f(mirrored.size());
  for (std::size_t i = 0; i < mirrored.size(); i += 3) mirrored[i] *= -1;
  for (const bool pressure : {false, true})
    for (const InstructionSet isa : instruction_sets()) {
      const auto body = sample.of<double>({material, material}, false, pressure, isa);
      CHECK(body->forces(sample.body.x.data(), f.data(), team));
      CHECK_FALSE(body->forces(mirrored.data(), f.data(), team));
    }
}

}  // namespace heml::point_kernels_test
