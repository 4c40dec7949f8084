// The study detects deliberately faulty engines.
#include <doctest/doctest.h>

#include <heml/elastic/body.hpp>
#include <studies/stability/measures.hpp>

namespace heml::faults_test {

using namespace heml::stability;

namespace {

Verdict verdict_of(int number, const Trial& trial) {
  const Case& c = case_numbered(number);
  return judge(c.run(trial), c.limit_of(trial.variant));
}

bool holds(int number, const Trial& trial) { return verdict_of(number, trial) <= Verdict::recovered; }

Trial of_forces(ForceFault fault) {
  Trial trial;
  trial.variant = {"neo_hookean_iso", std::nullopt, false};
  trial.force_fault = std::move(fault);
  return trial;
}

Trial of_motion(Integrator integrator, std::function<void(WorldSetup&)> fault) {
  Trial trial;
  trial.variant = {"neo_hookean", integrator, false};
  trial.quick = true;
  trial.world_fault = std::move(fault);
  return trial;
}

void twice(const TetMesh&, const Material&, const std::vector<double>&, std::vector<double>& f) {
  for (double& each : f) each *= 2;
}

/// Reverses the sign of the volume term's forces: subtracts twice the difference from the law with a tiny bulk modulus.
void volume_term_with_wrong_sign(const TetMesh& mesh, const Material& material, const std::vector<double>& x,
                                 std::vector<double>& f) {
  Material without = material;
  without.parameters[1] = 1e-9;  // kappa
  ElasticBody<double> whole(mesh, std::vector<int>(mesh.tets.size(), 0), {material}, {true, false});
  ElasticBody<double> shape(mesh, std::vector<int>(mesh.tets.size(), 0), {without}, {true, false});
  ThreadTeam team(1);
  std::vector<double> all(f.size()), isochoric(f.size());
  whole.forces(x.data(), all.data(), team);
  shape.forces(x.data(), isochoric.data(), team);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] -= 2 * (all[i] - isochoric[i]);
}

/// Violates conservation of momentum: one force component is too large by a thousandth.
void unbalanced_force(const TetMesh&, const Material&, const std::vector<double>&, std::vector<double>& f) {
  f[0] *= 1.001;
}

}  // namespace

TEST_CASE("a wrong factor 2 in the forces is noticed, and right forces are not") {
  for (const int number : {1, 2, 3}) {
    CAPTURE(number);
    CHECK(verdict_of(number, of_forces({})) == Verdict::stable);
    CHECK(verdict_of(number, of_forces(twice)) == Verdict::wrong);
  }
}

TEST_CASE("a wrong sign of the volume term in the forces is noticed") {
  for (const int number : {1, 2, 3}) {
    CAPTURE(number);
    CHECK(verdict_of(number, of_forces(volume_term_with_wrong_sign)) == Verdict::wrong);
  }
}

TEST_CASE("forces that make momentum are noticed") {
  CHECK(verdict_of(5, of_forces({})) == Verdict::stable);
  CHECK(verdict_of(5, of_forces(unbalanced_force)) == Verdict::wrong);
}

TEST_CASE("a step above the stable limit is noticed") {
  const auto too_long = [](WorldSetup& setup) { setup.solver.step = 5e-3; };
  for (const int number : {10, 33}) {
    CAPTURE(number);
    CHECK(verdict_of(number, of_motion(Integrator::verlet, {})) == Verdict::stable);
    CHECK(verdict_of(number, of_motion(Integrator::verlet, too_long)) == Verdict::diverged);
  }
}

TEST_CASE("a world twice as stiff, or with a volume term of the wrong sign, does not settle where it should") {
  const auto stiff = [](WorldSetup& setup) {
    for (double& parameter : setup.materials[0].material.parameters) parameter *= 2;
  };
  const auto volume = [](WorldSetup& setup) { setup.materials[0].material.parameters[0] *= -1; };  // lambda
  for (const int number : {20, 27}) {
    CAPTURE(number);
    CHECK(holds(number, of_motion(Integrator::backward_euler, {})));
    CHECK_FALSE(holds(number, of_motion(Integrator::backward_euler, stiff)));
    CHECK_FALSE(holds(number, of_motion(Integrator::backward_euler, volume)));
  }
}

TEST_CASE("a collapsed body without recovery does not hold") {
  const auto off = [](WorldSetup& setup) { setup.solver.recovery = false; };
  CHECK(verdict_of(15, of_motion(Integrator::backward_euler, {})) == Verdict::recovered);
  CHECK(verdict_of(15, of_motion(Integrator::backward_euler, off)) == Verdict::diverged);
}

}  // namespace heml::faults_test
