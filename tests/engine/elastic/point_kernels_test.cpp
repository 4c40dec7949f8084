// Point kernels against the loops over virtual corners, which the portable instruction set takes.
#include <doctest/doctest.h>

#include <algorithm>
#include <heml/elastic/body.hpp>
#include <heml/elastic/instruction_set.hpp>
#include <heml/materials/parameter_slots.hpp>

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
  // Beside a part in loops.
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

TEST_CASE("point kernels: other terms take the loops, beside the law in its kernel") {
  std::mt19937_64 random(64);
  const Sample sample(random);
  const InstructionSet best = instruction_sets().back();
  Material viscous = sample_material("neo_hookean_iso"), logarithmic = viscous;
  viscous.viscosity = 1;
  logarithmic.volume_term = VolumeTerm::logarithmic;
  const auto kernel_of = [&](const Material& material) {
    return sample.of<double>({material, material}, false, false, best)->kernels()[0].kernel;
  };
  CHECK(kernel_of(viscous) == "points and corners");
  CHECK(kernel_of(logarithmic) == "points and corners");
  // Side by side with one of a law alone: each adds up to what it is alone.
  ThreadTeam team(1);
  const Material plain = sample_material("neo_hookean_iso");
  std::vector<double> f(sample.body.x.size()), expected(f.size());
  for (const bool pressure : {false, true})
    for (const Material& other : {viscous, logarithmic}) {
      const auto mixed = sample.of<double>({plain, other}, false, pressure, best),
                 loops = sample.of<double>({plain, other}, false, pressure, InstructionSet::portable);
      CHECK(mixed->kernels().size() == 2);
      for (const auto& body : {mixed.get(), loops.get()}) body->begin_step(0.01);
      mixed->forces(sample.body.x.data(), f.data(), team);
      loops->forces(sample.body.x.data(), expected.data(), team);
      for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= 1e-12 * test::largest(expected));
    }
}

}  // namespace heml::point_kernels_test
