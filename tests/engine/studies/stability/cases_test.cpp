// Cases of the study that are fast enough for every build; `heml study stability` runs all of them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <set>
#include <studies/stability/case.hpp>

namespace heml::cases_test {

using namespace heml::stability;

namespace {

void check_holds(int number, const CaseVariant& variant, bool quick = true) {
  const Case& c = case_numbered(number);
  CAPTURE(to_text(variant));
  Trial trial;
  trial.variant = variant;
  trial.quick = quick;
  const Outcome outcome = c.run(trial);
  CAPTURE(outcome.value);
  CAPTURE(outcome.note);
  CAPTURE(outcome.stopped);
  CAPTURE(outcome.broken);
  CHECK(judge(outcome, c.limit_of(variant)) <= Verdict::recovered);
}

constexpr Integrator still = Integrator::static_equilibrium, implicit = Integrator::backward_euler,
                     verlet = Integrator::verlet;

}  // namespace

TEST_CASE("the list of cases is whole: 33, each once, in order") {
  int number = 0;
  for (const Case& c : cases()) CHECK(c.number == ++number);
  CHECK(number == 33);
}

TEST_CASE("the cases of forces hold for every law, in double and float") {
  for (const int number : {1, 2, 3, 5, 24, 25})
    for (const CaseVariant& variant : variants_of(case_numbered(number), false)) check_holds(number, variant);
}

TEST_CASE("no force 10 km from the origin, in double") {
  for (const CaseVariant& variant : variants_of(case_numbered(4), false))
    if (!variant.single) check_holds(4, variant);
}

TEST_CASE("extremes: stretched to five times its length, or pressed to a fifth, in at most 60 iterations") {
  check_holds(16, {"neo_hookean", still});
}

TEST_CASE("increments too far for an exponential law are not tried") {
  for (const char* law : {"fung_demiray", "veronda_westmann", "gent", "ogden"}) check_holds(16, {law, still});
  check_holds(16, {"gent", still, true});
}

TEST_CASE("extremes: a bar wrung by half a turn in a fifth of a second, in at most 8 iterations a step") {
  check_holds(17, {"neo_hookean", implicit});
}

TEST_CASE("extremes: a bar wrung by two turns has no more energy than was put in") {
  check_holds(18, {"neo_hookean", implicit});
}

TEST_CASE("extremes: one half a million times stiffer than the other moves as a rigid body does") {
  check_holds(19, {"neo_hookean", still});
}

TEST_CASE("extremes: with a sliver the explicit step is stable still, and implicit ones are as they were") {
  check_holds(22, {"neo_hookean", verlet});
  check_holds(22, {"neo_hookean", implicit});
}

TEST_CASE("extremes: one half ten thousand times heavier, both methods agree") {
  check_holds(23, {"neo_hookean", verlet});
}

TEST_CASE("extremes: backward Euler gains no energy without load, from any start") {
  for (const char* law : {"neo_hookean", "neo_hookean_iso"}) check_holds(11, {law, implicit});
  Trial trial;
  trial.variant = {"stvk", implicit};  // ends inverted when started compressed, as the law has no barrier against it
  const Outcome outcome = case_numbered(11).run(trial);
  CHECK(outcome.stopped.empty());
  CHECK(outcome.value <= case_numbered(11).limit);
}

TEST_CASE("the live limit carries a soft beam through its fall, where the limit taken at rest fails") {
  check_holds(9, {"neo_hookean", verlet});
}

TEST_CASE("undamped Verlet keeps its energy to 1e-5 of what swings, over a second") {
  check_holds(10, {"neo_hookean", verlet});
}

TEST_CASE("recovery: from a point, a line, a plane and random scatter, every law, to Poisson's ratio 0.499") {
  for (const auto law : continua()) check_holds(13, {std::string(law), implicit}, false);
}

TEST_CASE("recovery: with one half mirrored, every law, to Poisson's ratio 0.499") {
  for (const auto law : continua()) check_holds(15, {std::string(law), implicit}, false);
}

TEST_CASE("a flattened body of StVK with continuation pushes back, ever harder") {
  check_holds(14, {"stvk", implicit});
}

TEST_CASE("20 ms steps of 1 GPa settle on its equilibrium") { check_holds(20, {"neo_hookean", implicit}); }

TEST_CASE("budgets of one iteration gain no energy in single precision either") {
  check_holds(12, {"neo_hookean", implicit, true});
  check_holds(12, {"neo_hookean", Integrator::tr_bdf2, true});
}

TEST_CASE("float solves what is too stiff or too thin for float forces") {
  check_holds(19, {"neo_hookean", still, true});
  check_holds(21, {"neo_hookean_iso", still, true});
  check_holds(22, {"neo_hookean_iso", implicit, true});
}

TEST_CASE("second-order methods gain no energy from extreme shapes") {
  for (const Integrator integrator : {Integrator::bdf2, Integrator::tr_bdf2, Integrator::sdirk2})
    check_holds(11, {"yeoh", integrator});
}

TEST_CASE("second-order methods gain no energy from extreme shapes in single precision") {
  check_holds(11, {"neo_hookean", Integrator::bdf2, true});
  check_holds(11, {"mooney_rivlin", Integrator::tr_bdf2, true});
}

TEST_CASE("symplectic Euler keeps the energy that its velocities have at the time of its positions") {
  check_holds(10, {"neo_hookean", Integrator::symplectic_euler});
  check_holds(29, {"mooney_rivlin", Integrator::symplectic_euler});
}

TEST_CASE("what softens without end has no solution, and the end of a run proves it") {
  for (const char* law : {"stvk", "mass_spring"}) {
    Trial trial;
    trial.variant = {law, still};
    const Outcome outcome = case_numbered(30).run(trial);
    CAPTURE(outcome.stopped);
    CHECK_FALSE(outcome.proof.empty());
    CHECK(judge(outcome, 1) == Verdict::unsolvable);
  }
}

TEST_CASE("a stretched body of StVK that inverts when it is let go has lost ellipticity before") {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::bdf2}) {
    Trial trial;
    trial.variant = {"stvk", integrator};
    const Outcome outcome = case_numbered(11).run(trial);
    CHECK(outcome.inverted > 0);
    CHECK(outcome.proof.find("ellipticity") != std::string::npos);
  }
}

TEST_CASE("every case has a scene, which can be read and has a title") {
  std::set<std::string> used;
  for (const Case& c : cases()) {
    const std::string prefix = fmt::format("{:02}_", c.number);
    CAPTURE(prefix);
    CHECK(std::any_of(c.scenes.begin(), c.scenes.end(), [&](auto name) { return name.starts_with(prefix); }));
    used.insert(c.scenes.begin(), c.scenes.end());
  }
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "scenes" / "extreme")) {
    if (entry.path().extension() != ".json") continue;
    CAPTURE(entry.path().filename().string());
    const Scene scene = read_scene(entry.path());
    CHECK(scene.name == entry.path().stem().string());
    CHECK_FALSE(scene.title.empty());
    CHECK_FALSE(scene.description.empty());
    CHECK_NOTHROW(load_world(scene));
    found.insert(scene.name);
  }
  CHECK(found == used);
}

}  // namespace heml::cases_test
