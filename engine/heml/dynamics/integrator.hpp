#pragma once
// The integrators by name. The types behind them: integrator_list.hpp. Adding one: engine/docs/adding.md.
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace heml {

enum class Integrator {
  symplectic_euler,
  verlet,
  backward_euler,
  bdf2,
  tr_bdf2,
  sdirk2,
  static_equilibrium,  ///< "static"
  automatic            ///< "auto"; stays last
};

inline constexpr std::size_t integrator_count = static_cast<std::size_t>(Integrator::automatic) + 1;

enum class IntegratorKind {
  explicit_steps,  ///< no system is solved; stable up to a step
  implicit_steps,  ///< one minimisation a stage
  equilibrium,     ///< no time: a static solve at each load
  chosen           ///< one of the others, from tick to tick
};

struct IntegratorInfo {
  Integrator id;
  const char* name;   ///< in scene files
  const char* title;  ///< for people
  const char* code;   ///< two letters, for narrow tables
  IntegratorKind kind;
  int order;   ///< of accuracy in time; 0: does not apply
  int stages;  ///< systems solved in a step; explicit methods: force evaluations
};

const IntegratorInfo& info_of(Integrator integrator);
/// All of them, in the order of the enum.
std::span<const IntegratorInfo> all_integrators();
std::vector<Integrator> explicit_integrators();
std::vector<Integrator> implicit_integrators();
/// Explicit and implicit ones: all that step in time by themselves.
std::vector<Integrator> moving_integrators();
/// The name in scene files.
const char* integrator_name(Integrator integrator);
/// By the name in scene files; none: there is no such integrator.
std::optional<Integrator> find_integrator(std::string_view name);

inline bool is_explicit(Integrator integrator) { return info_of(integrator).kind == IntegratorKind::explicit_steps; }
inline bool is_implicit(Integrator integrator) { return info_of(integrator).kind == IntegratorKind::implicit_steps; }

}  // namespace heml
