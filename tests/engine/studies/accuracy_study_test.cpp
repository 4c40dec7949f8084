// The accuracy study: its conclusions from known numbers, and detection of faulty engines.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/parameter_slots.hpp>
#include <numbers>
#include <studies/accuracy_report.hpp>
#include <studies/beam_theory.hpp>
#include <studies/pareto.hpp>

namespace heml::accuracy_study_test {

namespace {

constexpr const char* swinging = R"({
  "schema_version": 1, "name": "small beam",
  "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [4, 1, 1]}},
  "materials": [{"law": "neo_hookean_iso", "K1": 5e4, "kappa": 5e5}],
  "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": true}],
  "gravity": [0, -9.81, 0],
  "solver": {"duration": 0.04}
})";

Problem small_beam() { return problem_of(parse_scene(swinging, "folder/scene.json")); }

const std::vector<double> times{0.02, 0.04};

/// Worlds whose stiffness is that of the scene times `stiffness`.
MakeWorld broken(double stiffness) {
  return [=](WorldSetup setup) {
    for (RegionMaterial& entry : setup.materials) {
      auto& parameters = entry.material.parameters;
      parameters[0] *= stiffness;
      if (parameters.size() > 1) parameters[1] *= stiffness;
    }
    return make_world(std::move(setup));
  };
}

/// Worlds in which the volume term of one law has the wrong sign.
MakeWorld volume_of_wrong_sign(const std::string& law) {
  return [=](WorldSetup setup) {
    Material& material = setup.materials.front().material;
    if (material.law == law) material.parameters[*volume_parameter(material, *find_law(law))] *= -1;
    return make_world(std::move(setup));
  };
}

/// Result values of a beam whose sag is known in closed form.
std::vector<ResultValue> figures_with(const MakeWorld& make) {
  StudyContext context;
  context.make = make;
  AccuracyStudy study;
  study.locking = {study_beam(0, {8, 2, 2}, context)};
  return result_values(study);
}

std::vector<Vec3> scaled(const std::vector<Vec3>& x, double by) {
  std::vector<Vec3> result;
  for (const Vec3& at : x) result.push_back(by * at);
  return result;
}

}  // namespace

TEST_CASE("the Pareto front holds what nothing beats in both, ascending in cost") {
  const std::vector<CostAndError> points{{3, 1}, {1, 5}, {2, 6}, {2, 3}, {4, 1}, {5, 0.5}, {1, 5}};
  const auto front = pareto_front(points);
  REQUIRE(front.size() == 4);
  CHECK(points[front[0]].cost == 1);
  CHECK(front[1] == 3);
  CHECK(front[2] == 0);
  CHECK(front[3] == 5);
  CHECK(pareto_front({}).empty());
}

TEST_CASE("Richardson: solutions that converge with order 2 lead to their limit, and no uncertainty is left") {
  const std::vector<Vec3> rest(3, Vec3::Zero()), limit{Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)};
  const std::vector<double> mass{1, 2, 3};
  const auto exact =
      extrapolate({scaled(limit, 1 - 0.16), scaled(limit, 1 - 0.04), scaled(limit, 1 - 0.01)}, rest, mass);
  CHECK(exact.failure.empty());
  CHECK(exact.low == doctest::Approx(2));
  CHECK(rms_distance(exact.best, limit, mass) < 1e-12);
  CHECK(exact.uncertainty < 1e-12);
  CHECK(exact.far.z() == doctest::Approx(3));
  // Order 1: the limit is the extrapolation by the observed order, and lies within the uncertainty.
  const auto slow = extrapolate({scaled(limit, 1 - 0.4), scaled(limit, 1 - 0.2), scaled(limit, 1 - 0.1)}, rest, mass);
  CHECK(slow.low == doctest::Approx(1));
  CHECK(rms_distance(slow.best, limit, mass) <= slow.uncertainty * (1 + 1e-9));
  const auto wild = extrapolate({scaled(limit, 1), scaled(limit, 2), scaled(limit, 4)}, rest, mass);
  CHECK_FALSE(wild.failure.empty());
  CHECK_FALSE(extrapolate({limit, limit}, rest, mass).failure.empty());
}

TEST_CASE("Richardson: two meshes of quadratic elements lead to their limit if it lies between two orders") {
  const std::vector<Vec3> rest(3, Vec3::Zero()), limit{Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)};
  const std::vector<double> mass{1, 2, 3};
  Extrapolation linear;
  linear.low = 1;
  for (const double order : {1.0, 1.7, 3.0}) {
    CAPTURE(order);
    const auto two = extrapolate_quadratic({scaled(limit, 1 - 0.1), scaled(limit, 1 - 0.1 * std::pow(2, -order))},
                                           linear, rest, mass);
    REQUIRE(two.failure.empty());
    CHECK(rms_distance(two.best, limit, mass) <= two.uncertainty * (1 + 1e-9));
  }
  linear.low = 3;  // by chance
  const auto two = extrapolate_quadratic({scaled(limit, 1 - 0.1), scaled(limit, 1 - 0.025)}, linear, rest, mass);
  CHECK(rms_distance(two.best, limit, mass) <= two.uncertainty * (1 + 1e-9));
  CHECK_FALSE(extrapolate_quadratic({limit}, linear, rest, mass).failure.empty());
  linear.failure = "too irregular";
  CHECK(extrapolate_quadratic({limit, limit}, linear, rest, mass).failure == linear.failure);
}

TEST_CASE("the mesh error of a scene of quadratic elements is known, as it is of the same scene of linear ones") {
  const Problem linear = problem_of(parse_scene(R"({
    "schema_version": 1, "name": "block",
    "mesh": {"box": {"size": [0.1, 0.06, 0.06], "cells": [4, 2, 2]}},
    "materials": [{"law": "neo_hookean", "young": 1e5, "poisson": 0.3}],
    "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": true}],
    "gravity": [0, -9.81, 0]})",
                                                "folder/scene.json")),
                quadratic = with_element(linear, "p2");
  const MeshConvergenceStudy of_linear = study_mesh_convergence("block", linear, 2, {}),
                             of_quadratic = study_mesh_convergence("block", quadratic, 2, {});
  REQUIRE(of_quadratic.reference.failure.empty());
  CHECK(of_quadratic.meshes.size() == steps_of_mesh_convergence_study(quadratic, 2));
  const ConvergenceMesh *known = of_linear.find("p1", 1), *found = of_quadratic.find("p1", 1);
  REQUIRE(known);
  REQUIRE(found);
  CHECK(found->error == doctest::Approx(known->error).epsilon(0.05));
  const ConvergenceMesh* own = of_quadratic.find("p2", 0);
  REQUIRE(own);
  CHECK(own->error > 0);
  CHECK(own->error < known->error);
}

TEST_CASE("a swing's frequency and decay are read off its turning points") {
  std::vector<double> t, u;
  constexpr double frequency = 7, decay = 3;
  for (int k = 0; k <= 400; ++k) {
    t.push_back(k * 1e-3);
    u.push_back(1 - std::exp(-decay * t.back()) * std::cos(2 * std::numbers::pi * frequency * t.back()));
  }
  const auto first_mode = first_mode_of(t, u);
  REQUIRE(first_mode);
  CHECK(first_mode->frequency == doctest::Approx(frequency).epsilon(0.02));
  CHECK(first_mode->decay == doctest::Approx(decay).epsilon(0.05));
  CHECK_FALSE(first_mode_of({0, 1, 2}, {0, 0, 0}));
  std::vector<double> creeping;
  for (const double now : t) creeping.push_back(1 - std::exp(-now));
  CHECK_FALSE(first_mode_of(t, creeping));
}

TEST_CASE("a reference tells errors ten times what halving its step changes, and methods converge to it") {
  const Problem beam = small_beam();
  const TimeStudy study = study_time("test", beam, times, Breadth::whole, {});
  REQUIRE(study.reference.failure.empty());
  CHECK(study.reference.motion > 1e-4);
  CHECK(study.reference.resolution() == 10 * study.reference.change);
  CHECK(study.reference.resolution() < 1e-5 * study.reference.motion);
  const auto error = [&](Integrator integrator, double step) {
    for (const Measured& m : study.measured)
      if (m.method.integrator == integrator && m.method.step == step && m.method.iterations == 0) return m.error;
    return -1.0;
  };
  for (const Integrator integrator : implicit_integrators()) {
    CAPTURE(integrator_name(integrator));
    CHECK(error(integrator, 0.002) < error(integrator, 0.01));
  }
  CHECK(error(Integrator::tr_bdf2, 0.002) < error(Integrator::bdf2, 0.002));
  CHECK(error(Integrator::bdf2, 0.002) < error(Integrator::backward_euler, 0.002));
  for (const Measured& m : study.measured)
    if (!m.failed()) CHECK(m.error >= study.reference.resolution());
}

TEST_CASE("steps above the stable limit are reported as failed, and a missing result counts as worse") {
  const TimeStudy study = study_time("test", small_beam(), times, Breadth::whole, {});
  std::size_t failed = 0;
  for (const Measured& m : study.measured)
    if (m.method.integrator == Integrator::verlet && m.method.step && *m.method.step > study.reference.stable_step) {
      ++failed;
      CHECK(m.failed());
    }
  CHECK(failed == 1);
  // Verlet with stable steps did not fail. If its step were above the limit, it would have no value.
  SceneStudy scene;
  scene.name = "small beam";
  scene.time = {study};
  AccuracyStudy whole;
  whole.scenes = {scene};
  const Json committed = to_json(result_values(whole));
  CHECK(what_got_worse(result_values(whole), committed).empty());
  for (Measured& m : whole.scenes[0].time[0].measured)
    if (m.method.integrator == Integrator::verlet) m.run.failed = "ran away";
  const auto worse = what_got_worse(result_values(whole), committed);
  REQUIRE_FALSE(worse.empty());
  CHECK(worse[0].find("verlet") != std::string::npos);
}

TEST_CASE("a kernel that is twice too stiff is noticed") {
  const auto sound = figures_with(make_world);
  const Json committed = to_json(sound);
  REQUIRE(committed.contains("beam off theory, poisson 0"));
  CHECK(committed["beam off theory, poisson 0"] < 0.01);
  CHECK(what_got_worse(sound, committed).empty());
  CHECK_FALSE(what_got_worse(figures_with(broken(2)), committed).empty());
}

TEST_CASE("a volume term of the wrong sign is noticed") {
  AccuracyStudy study;
  study.laws = study_laws({});
  const Json committed = to_json(result_values(study));
  for (const std::string law : {"neo_hookean_iso", "neo_hookean"}) {
    CAPTURE(law);
    StudyContext wrong;
    wrong.make = volume_of_wrong_sign(law);
    study.laws = study_laws(wrong);
    const auto worse = what_got_worse(result_values(study), committed);
    REQUIRE(worse.size() == 1);
    CHECK(worse[0].find("force left by " + law) == 0);
  }
}

TEST_CASE("every law that settles is in balance by arithmetic that is not the engine's, and a broken one is not") {
  for (const LawCheck& law : study_laws({})) {
    CAPTURE(law.law);
    CHECK(law.failed == "");
    CHECK(law.left_over < 1e-6);
  }
  StudyContext twice;
  twice.make = broken(2);
  for (const LawCheck& law : study_laws(twice))
    if (law.law != "mass_spring") CHECK((!law.failed.empty() || law.left_over > 0.01));
}

TEST_CASE("results may grow by a tenth before they count as worse, and times do not count") {
  const Json committed = {{"a", 1.0}, {"b", 0.0}};
  CHECK(what_got_worse({{"a", 1.09}, {"b", 1e-12}, {"new", 5}}, committed).empty());
  CHECK(what_got_worse({{"a", 1.11}, {"b", 0}}, committed).size() == 1);
  CHECK(what_got_worse({{"a", 0.5}}, committed).size() == 1);
  CHECK(what_got_worse({{"a", std::nan("")}, {"b", 0}}, committed).size() == 1);
}

TEST_CASE("a beam's theory: bending alone is w L4 / 8 E I, shear adds a few per cent of a thick one") {
  const Cantilever slender{1, 0.01, 1e6, 0.3, 1000, 9.81};
  const double bending = 12 * 1000 * 9.81 / (8 * 1e6 * 0.01 * 0.01);
  CHECK(slender.sag() == doctest::Approx(bending).epsilon(1e-3));
  const Cantilever thick{0.1, 0.02, 5e5, 0.3, 1000, 9.8};
  CHECK(thick.sag() == doctest::Approx(7.35e-3 * 1.04).epsilon(0.01));
}

TEST_CASE("the report begins with its answers and holds every scene") {
  AccuracyStudy study;
  SceneStudy& scene = study.scenes.emplace_back();
  scene.name = scene.title = "block";
  scene.laws = {"stvk"};
  TimeStudy& time = scene.time.emplace_back();
  time.problem = "p1, 5 tetrahedra";
  time.element = "p1";
  Measured& good = time.measured.emplace_back();
  good.error = 3e-4;
  good.run.simulated = 1, good.run.seconds = 0.5;
  Measured& bad = time.measured.emplace_back();
  bad.run.failed = "ran away <here>";
  scene.convergence.reference.failure = "nothing settles";
  const std::string page = accuracy_page(study, {}, "heml study accuracy", {});
  const auto at = [&](const char* text) { return page.find(text); };
  CHECK(at("within 16 ms a frame, the smallest error is 0.3 mm") != std::string::npos);
  CHECK(at("the smallest error") < at("What nothing tried beats"));
  CHECK(at("What nothing tried beats") < at("All 2 runs"));
  CHECK(at("ran away &lt;here&gt;") != std::string::npos);
  CHECK(csv_text(run_table(study)).find("block,stvk,p1") != std::string::npos);
}

}  // namespace heml::accuracy_study_test
