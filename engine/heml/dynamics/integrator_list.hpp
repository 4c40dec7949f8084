#pragma once
// The one list of integrators: a row for each, in the order of the enum. An explicit method is a template with
// first_half_step, second_half_step and damping_divisor (explicit_step.hpp); an implicit one has
// `static bool step(ImplicitStep&)` (implicit_stage.hpp). A row that is missing, or out of order, does not compile.
#include <heml/dynamics/backward_euler.hpp>
#include <heml/dynamics/bdf2.hpp>
#include <heml/dynamics/integrator.hpp>
#include <heml/dynamics/sdirk2.hpp>
#include <heml/dynamics/symplectic_euler.hpp>
#include <heml/dynamics/tr_bdf2.hpp>
#include <heml/dynamics/verlet.hpp>
#include <tuple>
#include <utility>

namespace heml {

/// Carries the template of an explicit method, so that the list holds it for every scalar.
template <template <class> class M>
struct ExplicitMethod {
  template <class Real>
  using Scheme = M<Real>;
  static constexpr IntegratorInfo info = M<double>::info;
};

struct StaticEquilibrium {
  static constexpr IntegratorInfo info{
      Integrator::static_equilibrium, "static", "Static equilibrium", "ST", IntegratorKind::equilibrium, 0, 1};
};

struct AutomaticChoice {
  static constexpr IntegratorInfo info{Integrator::automatic, "auto", "Automatic", "AU", IntegratorKind::chosen, 0, 0};
};

using IntegratorList = std::tuple<ExplicitMethod<SymplecticEuler>, ExplicitMethod<Verlet>, BackwardEuler, Bdf2, TrBdf2,
                                  Sdirk2, StaticEquilibrium, AutomaticChoice>;

static_assert(std::tuple_size_v<IntegratorList> == integrator_count, "an integrator has no row in IntegratorList");
static_assert(
    []<std::size_t... k>(std::index_sequence<k...>) {
      return ((std::tuple_element_t<k, IntegratorList>::info.id == static_cast<Integrator>(k)) && ...);
    }(std::make_index_sequence<integrator_count>{}),
    "the rows of IntegratorList are not in the order of the enum");

/// Calls use(row) for the row of an integrator and returns its result; use must accept every row.
template <class Result, class Use>
Result visit_integrator(Integrator integrator, const Use& use) {
  Result result{};
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    ((static_cast<Integrator>(k) == integrator ? void(result = use(std::tuple_element_t<k, IntegratorList>{}))
                                               : void()),
     ...);
  }
  (std::make_index_sequence<integrator_count>{});
  return result;
}

}  // namespace heml
