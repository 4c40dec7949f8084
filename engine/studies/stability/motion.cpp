// Cases of long and large motion.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/elastic/body.hpp>
#include <heml/materials/point.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/world/facts.hpp>
#include <studies/stability/measures.hpp>
#include <studies/stability/no_solution.hpp>

namespace heml::stability {
namespace {

/// The longest stable step for small vibrations about rest, s: 2/ω of the highest mode, by power iteration.
double limit_at_rest(const WorldSetup& setup) {
  std::vector<Material> materials;
  for (const RegionMaterial& entry : setup.materials) materials.push_back(entry.material);
  ElasticBody<double> body(setup.mesh, material_of_elements(setup.mesh, setup.materials), materials, {});
  ThreadTeam team(1);
  const std::vector<double> x = flat(setup.mesh.nodes), mass = body.masses();
  std::vector<double> w(x.size()), change(x.size());
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = noise(9, i);
  for (const Boundary& entry : setup.boundary)
    for (const int n : entry.nodes)
      for (std::size_t i = 0; i < 3; ++i) w[3 * static_cast<std::size_t>(n) + i] = 0;
  body.linearise(x.data(), team);
  double omega_squared = 0;
  for (int k = 0; k < 500; ++k) {
    double size = 0;
    for (const double c : w) size = std::max(size, std::abs(c));
    for (double& c : w) c /= size;
    body.force_differential(w.data(), change.data(), team);
    double wKw = 0, wMw = 0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      wKw -= w[i] * change[i];
      wMw += w[i] * w[i] * mass[i / 3];
      w[i] = w[i] == 0 ? 0 : -change[i] / mass[i / 3];
    }
    omega_squared = wKw / wMw;
  }
  return 2 / std::sqrt(omega_squared);
}

/// Work of the support that carries nodes from x to x_after against forces f of the body, J. All 3 #V.
double work_of_support(const std::vector<int>& nodes, const std::vector<double>& x, const std::vector<double>& x_after,
                       const std::vector<double>& f) {
  double work = 0;
  for (const int n : nodes)
    for (std::size_t i = 3 * static_cast<std::size_t>(n); i < 3 * static_cast<std::size_t>(n) + 3; ++i)
      work -= f[i] * (x_after[i] - x[i]);
  return work;
}

/// Largest gain of energy of an isolated body in one tick, relative to its initial energy.
Outcome max_gain(World& world, int ticks) {
  const double first = total(world.energies());
  double before = first, worst = 0;
  std::string lost_upright;  // ellipticity, before the first element was inverted
  for (int k = 0; k < ticks && !world.halt(); ++k) {
    if (lost_upright.empty() && inverted(world) == 0) lost_upright = proof_of_no_solution(world);
    world.tick();
    const double now = total(world.energies());
    worst = std::max(worst, (now - before) / first);
    before = now;
  }
  if (world.halt()) return stopped(world);
  Outcome outcome = ended(world, worst);
  if (outcome.inverted > 0 && outcome.proof.empty()) outcome.proof = lost_upright;
  return outcome;
}

/// The proof for a world that inverts elements in its first tick: from its motion in steps a tenth as long.
std::string proof_by_short_steps(const Trial& trial, WorldSetup setup, const World& inverted_world) {
  setup.solver.step = *setup.solver.step / 10;
  const auto world = trial.world(std::move(setup));
  return max_gain(*world, 10 * static_cast<int>(inverted_world.ticks())).proof;
}

/// The proof for a law that stores a finite energy where an element is flat: Verlet's method, in live stable steps,
/// turns elements inside out too, so that a method that did not would be wrong. Empty where it does not.
std::string proof_by_explicit_motion(const Trial& trial, WorldSetup setup, double duration) {
  const Mat3 flat = Vec3(1, 1, 0).asDiagonal();
  if (!make_material_point(setup.materials[0].material, setup.solver.continuation)->valid(flat)) return {};
  setup.solver.integrator = Integrator::verlet;
  setup.solver.step.reset();
  const auto world = trial.world(std::move(setup));
  while (!world->halt() && world->time() < duration) {
    world->tick();
    if (const int count = inverted(*world); count > 0)
      return fmt::format("the law lets elements pass flat: in steps of {:.1g} ms {} are inside out at {:.3g} s",
                         1e3 * world->setup().solver.tick() / world->substeps(), count, world->time());
  }
  return {};
}

}  // namespace

Outcome beam_drop(const Trial& trial) {
  WorldSetup setup = trial.setup("09_beam_drop");
  const double duration = setup.solver.duration;
  double swing = 0;
  const auto world = trial.world(setup);
  while (!world->halt() && world->time() < duration - 1e-9) {
    world->tick();
    swing = std::max(swing, std::abs(world->energies().potential));
  }
  if (world->halt()) return stopped(*world);
  Outcome outcome = ended(*world, std::abs(total(world->energies())) / swing);
  // A fixed step at the limit of the rest shape must fail, or the case would not detect a wrong limit.
  setup.solver.step = 0.9 * limit_at_rest(setup);
  const auto fixed = make_world(setup);
  const bool reached = run_until(*fixed, duration);
  const double kept = std::abs(total(fixed->energies())) / swing;
  const bool told = !reached || kept > 10 * outcome.value;
  outcome.note = reached ? fmt::format("0.9 of the limit at rest: energy off by {:.1e}", kept)
                         : fmt::format("0.9 of the limit at rest fails at {:.2f} s", fixed->time());
  if (!told && trial.variant.law == "neo_hookean" && !trial.variant.single)
    outcome.broken = "the limit at rest did not fail";
  return outcome;
}

Outcome no_energy_from_nothing(const Trial& trial) {
  Outcome outcome;
  for (const char* scene : {"11_stretched", "11_compressed", "11_thinned", "11_twisted"})
    for (const double poisson : {0.3, 0.45}) {
      WorldSetup setup = trial.setup(scene);
      set_young_poisson(setup, 1e4, poisson);
      const auto world = trial.world(setup);
      if (world->halt()) return stopped(*world);
      Outcome one = max_gain(*world, 25);
      if (one.inverted > 0 && one.proof.empty()) one.proof = proof_by_short_steps(trial, setup, *world);
      if (one.inverted > 0 && one.proof.empty()) one.proof = proof_by_explicit_motion(trial, setup, world->time());
      outcome = worse(outcome, one);
    }
  return outcome;
}

Outcome no_energy_from_budgets(const Trial& trial) {
  Outcome outcome;
  for (const char* scene : {"11_stretched", "11_compressed", "11_twisted", "12_shaken"})
    for (const Minimiser minimiser : {Minimiser::newton, Minimiser::lbfgs})
      for (const int iterations : {1, 3}) {
        WorldSetup setup = trial.setup(scene);
        setup.solver.continuation = true;
        setup.solver.minimiser = minimiser;
        setup.solver.budget = Budget{iterations, 0};
        const auto world = trial.world(setup);
        Outcome one = max_gain(*world, 15);
        one.inverted = 0;  // not required 0.15 s after a random start with one iteration per step
        outcome = worse(outcome, one);
      }
  return outcome;
}

Outcome half_a_turn(const Trial& trial) {
  const WorldSetup setup = trial.setup("17_half_a_turn");
  const auto world = trial.world(setup);
  long before = 0, most = 0;
  while (!world->halt() && world->time() < setup.solver.duration - 1e-9) {
    world->tick();
    most = std::max(most, world->solver_stats().iterations - before);
    before = world->solver_stats().iterations;
  }
  if (world->halt()) return stopped(*world);
  return ended(*world, static_cast<double>(most));
}

Outcome two_turns(const Trial& trial) {
  // That it stores more with every angle would be too much: pressed by its own twist, a bar of a law that softens
  // buckles into a loop and snaps, under Verlet's short steps as well.
  const WorldSetup setup = trial.setup("18_two_turns");
  const auto world = trial.world(setup);
  const std::vector<int>& end = setup.boundary[1].nodes;
  std::vector<double> x(3 * setup.mesh.nodes.size()), x_before = flat(world->positions()), f(x.size()),
                                                      f_before(x.size());
  double put_in = 0, excesses = 0;
  while (!world->halt() && world->time() < setup.solver.duration - 1e-9) {
    world->tick();
    world->write_vectors(NodeVector::position, x);
    world->write_vectors(NodeVector::force, f);
    put_in += std::max(work_of_support(end, x_before, x, f_before), work_of_support(end, x_before, x, f));
    const Energies energies = world->energies();
    if (!(energies.elastic + energies.kinetic <= put_in)) ++excesses;
    x_before = x;
    f_before = f;
  }
  if (world->halt()) return stopped(*world);
  return ended(*world, excesses, fmt::format("least J {:.2f}", min_J(*world)));
}

Outcome sliver(const Trial& trial) {
  // The same body without the sliver: four parts of one tetrahedron are merged.
  WorldSetup bad = trial.setup("22_sliver"), good = bad;
  const std::size_t last = good.mesh.nodes.size() - 1;
  std::vector<Tet>& tets = good.mesh.tets;
  Tet whole = tets[tets.size() - 1];  // its corner 3 is the node inside
  whole[3] = tets[tets.size() - 2][3];
  tets.resize(tets.size() - 4);
  tets.push_back(whole);
  good.mesh.nodes.resize(last);
  good.mesh.regions.resize(tets.size());
  if (is_explicit(*trial.variant.integrator)) {
    bad.solver.step.reset(), good.solver.step.reset();
    const auto world = trial.world(bad);
    const double ratio = world->stable_step() / make_world(good)->stable_step();
    const double share = world->stable_step() / limit_at_rest(bad);
    const int limited_by = world->facts().step.element;
    if (!run_until(*world, 0.004)) return stopped(*world);
    Outcome outcome =
        ended(*world, std::max(share - 0.9, 0.0),
              fmt::format("{:.2f} of the longest stable step, {:.4f} of that without the sliver", share, ratio));
    // Springs have no elements that could be named.
    if (find_law(trial.variant.law)->is_continuum && ratio < 0.98 &&
        limited_by < static_cast<int>(bad.mesh.tets.size()) - 4)
      outcome.broken = "another element is told to limit it";
    return outcome;
  }
  std::vector<double> sag, iterations;
  Outcome outcome;
  for (const WorldSetup& setup : {good, bad}) {
    const auto world = trial.world(setup);
    if (!run_until(*world, setup.solver.duration)) return stopped(*world);
    auto x = world->positions();
    x.resize(last);
    sag.push_back(rms_difference(x, good.mesh.nodes));
    iterations.push_back(static_cast<double>(world->solver_stats().iterations));
    outcome = ended(*world, 0);
  }
  outcome.value = std::abs(sag[1] / sag[0] - 1);
  outcome.note = fmt::format("{:.0f} iterations, {:.0f} without", iterations[1], iterations[0]);
  if (iterations[1] > 1.2 * iterations[0] + 5) outcome.broken = "many more iterations than without";
  return outcome;
}

Outcome soak(const Trial& trial) {
  const WorldSetup setup = trial.setup("33_soak");
  const auto world = trial.world(setup);
  const long steps = trial.quick ? 20'000 : 1'000'000;
  double swing = 0;
  for (long k = 0; k < steps && !world->halt(); ++k) {
    world->tick();
    if (k < 5000) swing = std::max(swing, std::abs(world->energies().potential));
  }
  if (world->halt()) return stopped(*world);
  return ended(*world, std::abs(total(world->energies())) / swing, fmt::format("{} steps", world->steps()));
}

}  // namespace heml::stability
