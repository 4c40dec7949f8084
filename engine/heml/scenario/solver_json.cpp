#include <fmt/format.h>

#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/solver_json.hpp>
#include <vector>

namespace heml {
namespace {

constexpr double max_ticks = 1e12;

Budget budget_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("solver.budget"));
  Budget budget;
  if (key.only_one_of({"iterations", "milliseconds"}) == "iterations")
    budget.iterations = object.get<int>("iterations");
  else
    budget.milliseconds = object.get<double>("milliseconds");
  object.read("linear", budget.linear);
  return budget;
}

}  // namespace

// A step of an implicit method costs as much as dozens of explicit ones and need not be short for stability.
double default_rate(Integrator integrator) {
  switch (info_of(integrator).kind) {
    case IntegratorKind::implicit_steps:
      return 100;
    case IntegratorKind::equilibrium:
      return 30;  // increments of the load that a viewer sees
    case IntegratorKind::explicit_steps:
    case IntegratorKind::chosen:
      break;
  }
  return SolverSettings{}.rate;
}

std::span<const std::string_view> integrator_names() {
  static const auto names = [] {
    std::vector<std::string_view> all;
    for (const IntegratorInfo& info : all_integrators()) all.emplace_back(info.name);
    return all;
  }();
  return names;
}

Integrator integrator_from(const JsonCursor& key) { return static_cast<Integrator>(key.one_of(integrator_names())); }

SolverSettings solver_from(const JsonCursor& key) {
  const ObjectReader object(key, keys_of("solver"));
  SolverSettings solver;
  object.read("integrator", solver.integrator);
  if (key.has("step") && key.has("rate")) key.fail("holds step and rate", "give one: a step is one tick");
  object.read("step", solver.step);
  solver.rate = default_rate(solver.integrator);
  object.read("rate", solver.rate);
  object.read("duration", solver.duration);
  if (!(solver.duration / solver.tick() <= max_ticks))
    key.fail(fmt::format("a duration of {} s is too many steps of {} s", solver.duration, solver.tick()),
             fmt::format("at most {} steps", max_ticks));
  object.read("damping", solver.damping);
  object.read("mass_scaling", solver.mass_scaling);
  if (const auto precision = object.choice("precision")) solver.single_precision = *precision == 1;
  object.read("threads", solver.threads);
  if (const auto element = object.choice("element")) {
    solver.nodal_pressure = *element % 2 == 1;
    solver.quadratic = *element >= 2;
  }
  object.read("continuation", solver.continuation);
  object.read("recovery", solver.recovery);
  object.read("tolerance", solver.tolerance);
  if (const auto budget = object.find("budget")) solver.budget = budget_from(*budget);
  object.read("minimiser", solver.minimiser);
  object.read("projection", solver.projection);
  object.read("preconditioner", solver.preconditioner);
  return solver;
}

Json solver_json(const SolverSettings& solver) {
  Json json = {{"integrator", integrator_name(solver.integrator)}};
  if (solver.step)
    json["step"] = *solver.step;
  else
    json["rate"] = solver.rate;
  json["duration"] = solver.duration;
  json["damping"] = solver.damping;
  if (solver.mass_scaling > 0) json["mass_scaling"] = solver.mass_scaling;
  json["precision"] = precision_names[solver.single_precision ? 1 : 0];
  json["threads"] = solver.threads;
  json["element"] = solver.element();
  json["continuation"] = solver.continuation;
  json["recovery"] = solver.recovery;
  if (solver.tolerance) json["tolerance"] = *solver.tolerance;
  if (solver.budget) {
    Json& budget = json["budget"];
    if (solver.budget->milliseconds > 0)
      budget["milliseconds"] = solver.budget->milliseconds;
    else
      budget["iterations"] = solver.budget->iterations;
    if (solver.budget->linear > 0) budget["linear"] = solver.budget->linear;
  }
  const SolverSettings usual;
  if (solver.minimiser != usual.minimiser)
    json["minimiser"] = minimiser_names[static_cast<std::size_t>(solver.minimiser)];
  if (solver.projection != usual.projection)
    json["projection"] = projection_names[static_cast<std::size_t>(solver.projection)];
  if (solver.preconditioner)
    json["preconditioner"] = preconditioner_names[static_cast<std::size_t>(*solver.preconditioner)];
  return json;
}

}  // namespace heml
