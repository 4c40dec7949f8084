// Advice on a scene, and the features that it does not use.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/scenario/explain.hpp>

namespace heml {
namespace {

constexpr double locks = 0.45;            // Poisson's ratio from which linear tetrahedra visibly lock
constexpr double locks_quadratic = 0.47;  // and coarse quadratic ones
constexpr double bulky = 100;             // κ/μ from which pressure waves alone set the stable step
constexpr double worth_scaling = 1.5;     // times longer steps from which mass scaling is advised
constexpr double waste = 1.5;             // ratio of stable step to scene step from which a longer step is advised

/// Computing time over simulated time of an explicit method, by the cost model of "auto".
double explicit_share(const WorldFacts& world, const SolverSettings& solver) {
  const double stable = world.step.stable;
  return world.method.explicit_share * (solver.step ? std::max(stable / *solver.step, 1.0) : 1.0);
}

void advise_on_locking(const SolverSettings& solver, const MaterialFacts& material, std::vector<Advice>& advice) {
  const double from = solver.quadratic ? locks_quadratic : locks;
  if (solver.nodal_pressure || material.poisson < from) return;
  const LawInfo& law = *find_law(material.kernel.law);
  const std::string text =
      fmt::format("{}: Poisson's ratio is {:.4g} at rest, and {} tetrahedra (\"{}\") are too stiff from {} on",
                  law.name, material.poisson, solver.quadratic ? "quadratic" : "linear", solver.element(), from);
  const char* remedy = solver.quadratic ? "p2_pressure" : "nodal_pressure";
  if (law.has_volume_term)
    advice.push_back({"locking", text,
                      fmt::format("\"element\": \"{}\" in solver: {} a force evaluation", remedy,
                                  solver.quadratic ? "one more pass" : "two more passes")});
  else
    advice.push_back(
        {"locking", text,
         fmt::format("a law with a volume term of its own (neo_hookean_iso, ...) and \"element\": \"{}\", or a finer "
                     "mesh",
                     remedy)});
}

void advise_on_volume(const Explanation& explained, const MaterialFacts& material, std::vector<Advice>& advice) {
  const auto [shear, bulk] = material.rest;
  if (!(bulk > bulky * shear) || explained.world.solver) return;
  advice.push_back({"volume_stiffness",
                    fmt::format("{}: the bulk modulus is {:.3g} times the shear modulus, which makes explicit steps "
                                "{:.2g} times shorter than those of a Poisson's ratio of 0.45",
                                material.kernel.law, bulk / shear, std::sqrt((bulk / shear + 4.0 / 3) / 11)),
                    "a smaller bulk modulus where volume matters little, or an implicit method"});
}

void advise_on_mesh(const Explanation& explained, std::vector<Advice>& advice) {
  const LimitFacts& limit = explained.limit;
  const double longer = explained.world.step.scaled_step;
  if (!explained.world.solver && longer >= worth_scaling)
    advice.push_back({"mass_scaling",
                      fmt::format("{:.0f} % more mass, at the nodes that limit explicit steps, would make them {:.2g} "
                                  "times as long",
                                  1e2 * StepFacts::offered, longer),
                      fmt::format("\"mass_scaling\": {}, where so little does not matter", StepFacts::offered)});
  if (!explained.world.solver && limit.cause != LimitFacts::Cause::none)
    advice.push_back(
        {"limiting_element",
         fmt::format("element {} and those round it make explicit steps {:.2g} times shorter than the median "
                     "of the mesh would",
                     limit.element, std::sqrt(explained.world.step.median_ratio)),
         limit.cause == LimitFacts::Cause::stiff ? "soften its material, or an implicit method"
                                                 : "improve the mesh there, or an implicit method"});
  if (explained.quality.slivers > 0)
    advice.push_back(
        {"sliver",
         fmt::format("{} tetrahedra have a dihedral angle under 5°; the worst, element {}, {:.3g}°",
                     explained.quality.slivers, explained.quality.worst_tet, explained.quality.worst_dihedral),
         "mesh the body anew: heml mesh says how good a mesh is"});
}

void advise_on_method(const Explanation& explained, std::vector<Advice>& advice) {
  const SolverSettings& solver = explained.setup.solver;
  const WorldFacts& world = explained.world;
  if (solver.is_static()) return;
  const double share = explicit_share(world, solver);
  if (!is_explicit(solver.integrator)) {
    if (solver.integrator != Integrator::automatic && share <= world.method.enough)
      advice.push_back({"implicit",
                        fmt::format("verlet would take about {:.2g} of real time and needs no solver", share),
                        "\"integrator\": \"verlet\" or \"auto\""});
    return;
  }
  if (solver.step && *solver.step > world.step.stable)
    advice.push_back({"step",
                      fmt::format("the step of {:.3g} s is {:.3g} times the stable one at the start; it may run away",
                                  *solver.step, *solver.step / world.step.stable),
                      "leave `step` out, so that steps follow the stable one, or take a smaller one"});
  else if (solver.step && *solver.step * waste < world.step.stable)
    advice.push_back({"step",
                      fmt::format("the step of {:.3g} s is {:.3g} times shorter than stability asks", *solver.step,
                                  world.step.stable / *solver.step),
                      "leave `step` out unless the error in time matters"});
  if (share > 1 && std::isfinite(share))
    advice.push_back({"real_time",
                      fmt::format("by the model of cost a simulated second takes about {:.2g} s of one core", share),
                      "\"integrator\": \"auto\", float precision, a coarser or better mesh"});
}

bool lies_on_a_table(const WorldSetup& setup) {
  return std::any_of(setup.tables.begin(), setup.tables.end(),
                     [&](const Table& table) { return table.normal.dot(setup.gravity) < 0; });
}

}  // namespace

std::vector<Advice> advice_on(const Explanation& explained) {
  std::vector<Advice> advice;
  for (const MaterialFacts& material : explained.materials) {
    advise_on_locking(explained.setup.solver, material, advice);
    advise_on_volume(explained, material, advice);
  }
  advise_on_mesh(explained, advice);
  advise_on_method(explained, advice);
  if (explained.world.constrained_nodes == 0 && !explained.setup.gravity.isZero(0) && !lies_on_a_table(explained.setup))
    advice.push_back(
        {"free_fall", "nothing holds the body, and gravity pulls at it", "a `boundary` entry, or a table"});
  return advice;
}

std::vector<OmittedFeature> omitted_features_of(const Scene& scene, const WorldSetup& setup, const WorldFacts& facts) {
  std::vector<OmittedFeature> left;
  const auto leave = [&](bool unused, const char* feature, std::string why) {
    if (unused) left.push_back({feature, std::move(why)});
  };
  const auto none = [&](const auto& asks) {
    return std::none_of(facts.kernels.begin(), facts.kernels.end(),
                        [&](const KernelInfo& kernel) { return asks(setup.materials[kernel.material].material); });
  };
  const SolverSettings& solver = setup.solver;
  const char* unasked = "no material asks for it";
  leave(none([](const Material& m) { return m.viscosity > 0 || m.bulk_viscosity > 0; }), "viscosity", unasked);
  leave(none([](const Material& m) { return !m.relaxation.empty(); }), "relaxation", unasked);
  leave(none([](const Material& m) { return m.plasticity.has_value(); }), "plasticity", unasked);
  leave(none([](const Material& m) { return m.active_stress > 0; }), "active stress", unasked);
  leave(none([](const Material& m) { return !m.fields.empty(); }), "parameters of each element",
        "uniform materials run the vectorised loops");
  leave(none([](const Material& m) { return find_law(m.law)->has_fibre; }), "fibres", "no law has them");
  leave(none([](const Material& m) { return !find_law(m.law)->is_continuum; }), "springs",
        "no material is mass_spring");
  leave(!solver.nodal_pressure, solver.quadratic ? "mean dilatation" : "nodal pressure",
        fmt::format("\"element\" is \"{}\": pressure is of each {}", solver.element(),
                    solver.quadratic ? "integration point" : "tetrahedron"));
  leave(!solver.continuation, "continuation", "off: a state outside a law's range ends the run (exit code 4)");
  leave(!solver.recovery, "recovery", "off: a body that collapses or runs away ends the run (exit code 4)");
  leave(!facts.solver.has_value(), "linear solver",
        fmt::format("{} solves nothing: no matrix, no factor", integrator_name(facts.method.used)));
  leave(facts.solver && !solver.budget, "budget", "none: every stage is solved to its tolerance");
  leave(facts.solver && facts.solver->minimiser == Minimiser::newton, "L-BFGS", "Newton's method minimises");
  leave(facts.solver.has_value(), "live stable step", "implicit methods have no limit");
  leave(solver.damping == 0, "mass damping", "0");
  leave(solver.mass_scaling == 0, "mass scaling", "0: every node has its own mass");
  leave(setup.gravity.isZero(0), "gravity", "0");
  leave(setup.loads.empty(), "loads", "none: an empty list");
  leave(scene.events.empty(), "tools and edits",
        "no events: grasps are an empty list, no loop asks which elements live");
  leave(facts.threads == 1, "worker threads", "one thread");
  leave(setup.tables.empty(), "tables", "none: an empty list");
  leave(!setup.self_contact, "self-contact",
        "\"self_contact\" is not given: no surface is searched, tissue passes tissue");
  leave(!setup.tearing, "tearing", "\"tearing\" is not given: no stretch is looked at");
  leave(scene.mesh.surface.empty(), "surface mesher", "the mesh has tetrahedra: assimp and TetGen were not started");
  leave(true, "drawing", "only run, capture and replay --frames load OSMesa or open a window");
  return left;
}

}  // namespace heml
