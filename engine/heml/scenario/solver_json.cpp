#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/scenario/solver_json.hpp>

namespace heml {
namespace {

constexpr std::string_view elements[] = {"p1", "nodal_pressure"};
constexpr double max_ticks = 1e12;
constexpr double fastest_rate = 1e6;   // Hz
constexpr long max_iterations = 1000;  // of a stage

Budget budget_from(const JsonCursor& key) {
  key.allow({"iterations", "milliseconds"});
  Budget budget;
  if (key.only_one_of({"iterations", "milliseconds"}) == "iterations")
    budget.iterations = static_cast<int>(key["iterations"].integer(1, max_iterations));
  else
    budget.milliseconds = key["milliseconds"].positive();
  return budget;
}

/// Hz. A step of an implicit method costs as much as dozens of explicit ones and need not be short for stability.
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

}  // namespace

Integrator integrator_from(const JsonCursor& key) {
  std::vector<std::string_view> names;
  for (const IntegratorInfo& info : all_integrators()) names.emplace_back(info.name);
  return all_integrators()[key.one_of(names)].id;
}

SolverSettings solver_from(const JsonCursor& key) {
  key.allow({"integrator", "step", "rate", "duration", "damping", "precision", "threads", "element", "continuation",
             "recovery", "tolerance", "budget", "minimiser", "projection", "preconditioner"});
  SolverSettings solver;
  if (const auto integrator = key.find("integrator")) solver.integrator = integrator_from(*integrator);
  if (key.has("step") && key.has("rate")) key.fail("holds step and rate", "give one: a step is one tick");
  if (const auto step = key.find("step")) solver.step = step->positive();
  solver.rate = default_rate(solver.integrator);
  if (const auto rate = key.find("rate")) solver.rate = rate->between(1, fastest_rate);
  if (const auto duration = key.find("duration")) solver.duration = duration->non_negative();
  if (!(solver.duration / solver.tick() <= max_ticks))
    key.fail(fmt::format("a duration of {} s is too many steps of {} s", solver.duration, solver.tick()),
             fmt::format("at most {} steps", max_ticks));
  if (const auto damping = key.find("damping")) solver.damping = damping->non_negative();
  if (const auto precision = key.find("precision")) {
    constexpr std::string_view names[] = {"double", "float"};
    solver.single_precision = precision->one_of(names) == 1;
  }
  if (const auto threads = key.find("threads")) solver.threads = static_cast<int>(threads->integer(0, max_threads));
  if (const auto element = key.find("element")) solver.nodal_pressure = element->one_of(elements) == 1;
  if (const auto continuation = key.find("continuation")) solver.continuation = continuation->flag();
  if (const auto recovery = key.find("recovery")) solver.recovery = recovery->flag();
  if (const auto tolerance = key.find("tolerance")) solver.tolerance = tolerance->positive();
  if (const auto budget = key.find("budget")) solver.budget = budget_from(*budget);
  if (const auto name = key.find("minimiser")) solver.minimiser = static_cast<Minimiser>(name->one_of(minimiser_names));
  if (const auto name = key.find("projection"))
    solver.projection = static_cast<Projection>(name->one_of(projection_names));
  if (const auto name = key.find("preconditioner"))
    solver.preconditioner = static_cast<Preconditioner>(name->one_of(preconditioner_names));
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
  json["precision"] = solver.single_precision ? "float" : "double";
  json["threads"] = solver.threads;
  json["element"] = elements[solver.nodal_pressure ? 1 : 0];
  json["continuation"] = solver.continuation;
  json["recovery"] = solver.recovery;
  if (solver.tolerance) json["tolerance"] = *solver.tolerance;
  if (solver.budget)
    json["budget"] = solver.budget->milliseconds > 0 ? Json{{"milliseconds", solver.budget->milliseconds}}
                                                     : Json{{"iterations", solver.budget->iterations}};
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
