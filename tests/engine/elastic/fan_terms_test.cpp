// Kernels with terms: every law, instruction set and precision against the loops by slot in double, over several steps.
#include <doctest/doctest.h>

#include <heml/elastic/fan_forces.hpp>
#include <heml/elastic/plastic_flow.hpp>
#include <heml/materials/parameter_slots.hpp>

#include "small_body.hpp"

namespace heml::fan_terms_test {

using test::irregular_box;
using test::largest;
using test::sample_material;
using test::vary_parameters;

namespace {

std::vector<double> moved(const TetMesh& mesh, std::mt19937_64& random, double noise, const Mat3& F) {
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) {
    const Vec3 to = F * X + test::random_vector(random, noise * 0.03);
    for (int i = 0; i < 3; ++i) x.push_back(static_cast<double>(static_cast<float>(to[i])));
  }
  return x;
}

/// The forces of a body of one material by the loops over slots.
class LoopBody {
 public:
  LoopBody(const TetMesh& mesh, const Material& material, bool continuation, bool nodal_pressure = false)
      : terms_(make_terms<double>(material, continuation, nodal_pressure)) {
    std::vector<int> elements;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) elements.push_back(static_cast<int>(t));
    group_ = make_group<double>(mesh, elements, material);
    flow_ = make_flow<double>(material, continuation, group_);
    corners_ = map_corners<double>({&group_}, mesh.nodes.size());
    std::vector<double> rest;
    for (const Vec3& X : mesh.nodes) rest.insert(rest.end(), {X.x(), X.y(), X.z()});
    for (const auto& term : terms_) term->begin_step(0), term->reset_history(group_, rest.data());
    if (!nodal_pressure) return;
    const std::vector<double> kappa = volume_moduli(group_, material);
    pressure_ = std::make_unique<NodalPressure<double>>(std::vector<const ElementGroup<double>*>{&group_}, corners_,
                                                        std::vector<std::vector<double>>{kappa}, material.volume_term,
                                                        continuation);
  }
  void begin_step(double h) {
    for (const auto& term : terms_) term->begin_step(h);
  }
  void commit(const std::vector<double>& x) {
    for (const auto& term : terms_) term->commit(group_, x.data());
    if (flow_) plastic_work_ += flow_->flow(group_, x.data());
  }
  double plastic_work() const { return plastic_work_; }
  std::vector<double> forces(const std::vector<double>& x) {
    std::vector<double> corner(12 * group_.volume.size()), f(x.size());
    ThreadTeam alone(1);
    for (const auto& term : terms_) term->forces(group_, x.data(), 0, group_.packets(), corner.data(), true);
    if (pressure_) pressure_->add_forces(x.data(), corner.data(), alone);
    for (std::size_t n = 0; n < f.size() / 3; ++n)
      for (std::size_t k = corners_.start[n]; k < corners_.start[n + 1]; ++k)
        for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] += corner[3 * corners_.corners[k] + i];
    return f;
  }

 private:
  ElementGroup<double> group_;
  CornerMap corners_;
  std::vector<std::unique_ptr<GroupTerm<double>>> terms_;
  std::unique_ptr<NodalPressure<double>> pressure_;
  std::unique_ptr<PlasticFlow<double>> flow_;
  double plastic_work_ = 0;
};

template <class Real>
std::vector<Real> forces_of(ElasticBody<Real>& body, const std::vector<double>& at, int threads = 1) {
  ThreadTeam team(threads);
  const std::vector<Real> x(at.begin(), at.end());
  std::vector<Real> f(x.size());
  body.forces(x.data(), f.data(), team);
  return f;
}

template <class Real>
void commit(ElasticBody<Real>& body, const std::vector<double>& at) {
  const std::vector<Real> x(at.begin(), at.end());
  body.commit(x.data());
}

template <class Real>
double difference(const std::vector<Real>& f, const std::vector<double>& expected) {
  double worst = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double d = std::abs(static_cast<double>(f[i]) - expected[i]);
    if (!(d <= worst)) worst = d;  // also true for NaN
  }
  return worst / largest(expected);
}

/// Materials of a law with each term that it takes, and with all of them.
std::vector<std::pair<std::string, Material>> with_terms(std::string_view law) {
  const Material plain = sample_material(law);
  Material viscous = plain, relaxing = plain, logarithmic = plain, simo_taylor = plain;
  viscous.viscosity = 3, viscous.bulk_viscosity = 2;
  relaxing.relaxation = {{0.7, 0.02}, {0.4, 0.5}, {0.2, 10}};
  logarithmic.volume_term = VolumeTerm::logarithmic;
  simo_taylor.volume_term = VolumeTerm::simo_taylor;
  Material all = relaxing;
  all.viscosity = 3, all.volume_term = VolumeTerm::simo_taylor;
  if (!find_law(law)->has_volume_term) return {{"viscous", viscous}};
  return {{"viscous", viscous},
          {"relaxing", relaxing},
          {"logarithmic", logarithmic},
          {"simo_taylor", simo_taylor},
          {"all", all}};
}

template <class Real>
void check_kernels(InstructionSet isa, double tolerance, bool varying = false) {
  std::mt19937_64 random(61);
  TetMesh mesh = irregular_box(random, {3, 2, 2});
  const std::vector<int> one_material(mesh.tets.size(), 0);
  for (const auto law : test::law_names()) {
    auto materials = with_terms(law);
    if (varying) materials.emplace_back("alone", sample_material(law));
    for (auto& named : materials)
      for (const bool continuation : {false, true}) {
        Material& material = named.second;
        if (varying) vary_parameters(material, mesh, random);
        CAPTURE(std::string(law));
        CAPTURE(named.first);
        CAPTURE(std::string(name_of(isa)));
        CAPTURE(continuation);
        ElasticBody<Real> body(mesh, one_material, {material}, {continuation, false, isa});
        CHECK(body.kernels().front().kernel == "fans");
        LoopBody loops(mesh, material, continuation);
        for (const double stretch : {1.05, 1.2, 1.15, 0.9}) {
          const auto x = moved(mesh, random, 0.03, Vec3(stretch, 1, 1 / stretch).asDiagonal());
          body.begin_step(static_cast<Real>(0.01));
          loops.begin_step(0.01);
          CHECK(difference(forces_of(body, x), loops.forces(x)) <= tolerance);
          commit(body, x);
          loops.commit(x);
        }
      }
  }
}

Material flowing(std::string_view law, double yield) {
  Material material = sample_material(law);
  material.plasticity = Plasticity{yield, 40};
  return material;
}

/// Steps with more and more strain, of which the yields let no element flow, some, or all.
template <class Real>
void check_flow(InstructionSet isa, double tolerance, const Material& plain, bool nodal_pressure = false) {
  std::mt19937_64 random(67);
  TetMesh mesh = irregular_box(random, {3, 2, 2});
  const std::vector<int> one_material(mesh.tets.size(), 0);
  for (const double yield : {1e6, 150.0, 5.0})
    for (const bool varying : {false, true}) {
      Material material = plain;
      material.plasticity = Plasticity{yield, 40};
      if (varying) vary_parameters(material, mesh, random);
      CAPTURE(material.law);
      CAPTURE(std::string(name_of(isa)));
      CAPTURE(yield);
      ElasticBody<Real> body(mesh, one_material, {material}, {true, nodal_pressure, isa});
      CHECK(body.kernels().front().kernel == "fans");
      LoopBody loops(mesh, material, true, nodal_pressure);
      for (const double stretch : {1.02, 1.1, 1.25, 1.2, 0.9}) {
        const auto x = moved(mesh, random, 0.03, Vec3(stretch, 1, 1 / stretch).asDiagonal());
        body.begin_step(static_cast<Real>(0.01));
        loops.begin_step(0.01);
        CHECK(difference(forces_of(body, x), loops.forces(x)) <= tolerance);
        commit(body, x);
        loops.commit(x);
        CHECK(difference(forces_of(body, x), loops.forces(x)) <= tolerance);
        CHECK(std::abs(body.plastic_work() - loops.plastic_work()) <= tolerance * loops.plastic_work());
      }
      CHECK((body.plastic_work() > 0) == (yield < 1e6));
    }
}

Material remembering() {
  Material material = sample_material("mooney_rivlin");
  material.viscosity = 2;
  material.relaxation = {{0.7, 0.02}, {0.4, 0.5}};
  return material;
}

}  // namespace

TEST_CASE("kernels with terms in double give the forces of the loops") {
  for (const InstructionSet isa : instruction_sets()) check_kernels<double>(isa, 1e-12);
}

TEST_CASE("kernels with terms in float give the forces of the loops to float's precision") {
  for (const InstructionSet isa : instruction_sets()) check_kernels<float>(isa, 1e-4);
}

TEST_CASE("kernels of parameters that differ between elements give the forces of the loops, alone and with terms") {
  for (const InstructionSet isa : instruction_sets()) {
    check_kernels<double>(isa, 1e-12, true);
    check_kernels<float>(isa, 1e-4, true);
  }
}

TEST_CASE("kernels of elements that flow give the forces of the loops, after flow too, any law") {
  for (const InstructionSet isa : instruction_sets())
    for (const LawInfo& law : laws()) {
      if (!law.has_volume_term || law.has_fibre) continue;
      check_flow<double>(isa, 1e-11, sample_material(law.name));
      check_flow<float>(isa, 1e-3, sample_material(law.name));
    }
  Material other = sample_material("mooney_rivlin");
  other.volume_term = VolumeTerm::logarithmic;
  for (const InstructionSet isa : instruction_sets()) {
    check_flow<double>(isa, 1e-11, other);
    check_flow<double>(isa, 1e-11, other, true);
  }
}

TEST_CASE("kernels of elements that flow and remember stress give the forces of the loops") {
  for (const InstructionSet isa : instruction_sets())
    for (const auto law : {"neo_hookean_iso", "mooney_rivlin", "ogden"})
      for (const auto& named : with_terms(law)) {
        CAPTURE(named.first);
        check_flow<double>(isa, 1e-11, named.second);
        check_flow<float>(isa, 1e-3, named.second);
      }
}

TEST_CASE("the bound of the step from remembered stress is the same with a yield that is never reached") {
  std::mt19937_64 random(69);
  const TetMesh mesh = irregular_box(random, {3, 2, 2});
  const std::vector<int> one_material(mesh.tets.size(), 0);
  ThreadTeam team(1);
  for (const InstructionSet isa : instruction_sets()) {
    Material plastic = remembering();
    plastic.plasticity = Plasticity{1e9, 0};
    ElasticBody<double> relaxing(mesh, one_material, {remembering()}, {false, false, isa}),
        flowing(mesh, one_material, {plastic}, {false, false, isa});
    for (const double stretch : {1.2, 1.4}) {
      const auto x = moved(mesh, random, 0.03, Vec3(stretch, 1, 1 / stretch).asDiagonal());
      for (ElasticBody<double>* body : {&relaxing, &flowing}) {
        body->begin_step(0.01);
        forces_of(*body, x);
        commit(*body, x);
      }
      const double expected = relaxing.frequency_bound(x.data(), team);
      CHECK(flowing.frequency_bound(x.data(), team) == doctest::Approx(expected).epsilon(1e-10));
    }
  }
}

TEST_CASE("elements flow alike whether fans were evaluated before, on any threads, after a snapshot and an edit") {
  std::mt19937_64 random(68);
  const TetMesh mesh = irregular_box(random, {16, 12, 10});
  const Material material = flowing("mooney_rivlin", 60);
  const std::vector<int> one_material(mesh.tets.size(), 0);
  const auto first = moved(mesh, random, 0.005, Vec3(1.1, 1, 0.95).asDiagonal());
  const auto second = moved(mesh, random, 0.005, Vec3(1.15, 1, 0.9).asDiagonal());
  ElasticBody<float> evaluated(mesh, one_material, {material}, {}), other(mesh, one_material, {material}, {});
  for (const bool later : {false, true}) {
    forces_of(evaluated, first, 2);
    if (later) forces_of(other, second);
    commit(evaluated, first);
    commit(other, first);
    CHECK(evaluated.plastic_work() == other.plastic_work());
    CHECK(evaluated.plastic_work() > 0);
    const auto snapshot = other.snapshot();
    CHECK(forces_of(evaluated, second, 3) == forces_of(other, second));
    commit(other, second);
    CHECK(forces_of(evaluated, first) != forces_of(other, first));
    const std::vector<float> x(second.begin(), second.end());
    other.restore(snapshot, x.data());
    CHECK(forces_of(evaluated, first) == forces_of(other, first));
  }
  std::vector<int> all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) all.push_back(static_cast<int>(t));
  other.keep_elements(all);
  const auto f = forces_of(evaluated, second);
  CHECK(difference(forces_of(other, second), std::vector<double>(f.begin(), f.end())) <= 1e-4);
}

TEST_CASE("a material whose parameters come from other fields gets their values") {
  std::mt19937_64 random(66);
  TetMesh mesh = irregular_box(random, {3, 2, 2});
  Material material = sample_material("mooney_rivlin");
  vary_parameters(material, mesh, random);
  Material other = material;
  std::swap(other.fields[0].field, other.fields[1].field);
  const std::vector<int> one_material(mesh.tets.size(), 0);
  ElasticBody<double> changed(mesh, one_material, {material}, {}), made(mesh, one_material, {other}, {});
  const auto x = moved(mesh, random, 0.03, Vec3(1.1, 1, 0.9).asDiagonal());
  CHECK(difference(forces_of(changed, x), forces_of(made, x)) > 1e-3);
  changed.set_material(0, other, x.data());
  CHECK(forces_of(changed, x) == forces_of(made, x));
}

TEST_CASE("crushed and inverted elements relax as in the loops") {
  std::mt19937_64 random(62);
  const TetMesh mesh = irregular_box(random, {3, 2, 2});
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {remembering()}, {true});
  LoopBody loops(mesh, remembering(), true);
  for (const Mat3& F : {Mat3(Vec3(1, 1, 0.01).asDiagonal()), Mat3(Vec3(1, -1, 1).asDiagonal())}) {
    const auto x = moved(mesh, random, 0.5, F);
    body.begin_step(0.01);
    loops.begin_step(0.01);
    CHECK(difference(forces_of(body, x), loops.forces(x)) <= 1e-9);
    commit(body, x);
    loops.commit(x);
  }
}

TEST_CASE("nodal pressure in the fans gives the forces of the loops, with terms beside it too") {
  std::mt19937_64 random(63);
  TetMesh mesh = irregular_box(random, {4, 3, 3});
  const std::vector<int> one_material(mesh.tets.size(), 0);
  Material plain = sample_material("mooney_rivlin"), other = remembering();
  other.volume_term = VolumeTerm::logarithmic;
  for (const InstructionSet isa : instruction_sets())
    for (const bool varying : {false, true})
      for (Material material : {plain, other, sample_material("ogden"), sample_material("hgo")}) {
        CAPTURE(material.law);
        if (varying) vary_parameters(material, mesh, random);
        ElasticBody<double> body(mesh, one_material, {material}, {false, true, isa});
        ElasticBody<float> single(mesh, one_material, {material}, {false, true, isa});
        CHECK(body.kernels().front().kernel == "fans");
        LoopBody loops(mesh, material, false, true);
        const auto x = moved(mesh, random, 0.03, Vec3(1.1, 1, 0.9).asDiagonal());
        body.begin_step(0.01), single.begin_step(0.01f), loops.begin_step(0.01);
        CHECK(difference(forces_of(body, x), loops.forces(x)) <= 1e-11);
        CHECK(difference(forces_of(single, x), loops.forces(x)) <= 1e-3);
      }
}

TEST_CASE("the state reached does not depend on what was evaluated before commit, on threads or on a snapshot") {
  std::mt19937_64 random(64);
  const TetMesh mesh = irregular_box(random, {16, 12, 10});
  const std::vector<int> one_material(mesh.tets.size(), 0);
  const auto first = moved(mesh, random, 0.005, Vec3(1.1, 1, 0.95).asDiagonal());
  const auto second = moved(mesh, random, 0.005, Vec3(1.15, 1, 0.9).asDiagonal());
  ElasticBody<float> evaluated(mesh, one_material, {remembering()}, {}), other(mesh, one_material, {remembering()}, {});
  for (const bool later : {false, true}) {
    for (ElasticBody<float>* body : {&evaluated, &other}) body->begin_step(0.01f);
    forces_of(evaluated, first, 2);
    if (later) forces_of(other, second);
    commit(evaluated, first);
    commit(other, first);
    const auto snapshot = other.snapshot();
    CHECK(forces_of(evaluated, second, 3) == forces_of(other, second));
    commit(other, second);
    CHECK(forces_of(evaluated, first) != forces_of(other, first));
    const std::vector<float> x(second.begin(), second.end());
    other.restore(snapshot, x.data());
    CHECK(forces_of(evaluated, first) == forces_of(other, first));
    CHECK(forces_of(evaluated, second) == forces_of(other, second));
  }
}

TEST_CASE("the state survives the way through slots that an edit of the mesh takes") {
  std::mt19937_64 random(65);
  const TetMesh mesh = irregular_box(random, {5, 4, 3});
  std::vector<int> material_of, all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    material_of.push_back(static_cast<int>(t % 2));
    all.push_back(static_cast<int>(t));
  }
  Material viscous = sample_material("ogden");
  viscous.viscosity = 4;
  ElasticBody<double> kept(mesh, material_of, {remembering(), viscous}, {}),
      edited(mesh, material_of, {remembering(), viscous}, {});
  const auto x = moved(mesh, random, 0.03, Vec3(1.1, 1, 0.9).asDiagonal());
  for (ElasticBody<double>* body : {&kept, &edited}) {
    body->begin_step(0.01);
    commit(*body, x);
    body->begin_step(0.01);
  }
  edited.keep_elements(all);
  const auto next = moved(mesh, random, 0.03, Vec3(1.2, 1, 0.9).asDiagonal());
  const auto f = forces_of(kept, next);
  CHECK(difference(forces_of(edited, next), f) <= 1e-12);
  edited.reset_history(x.data());
  CHECK(difference(forces_of(edited, next), f) > 1e-3);
}

}  // namespace heml::fan_terms_test
