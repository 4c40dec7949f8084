#include <algorithm>
#include <array>
#include <heml/dynamics/integrator.hpp>
#include <heml/dynamics/integrator_list.hpp>

namespace heml {
namespace {
constexpr std::array<IntegratorInfo, integrator_count> table =
    []<std::size_t... k>(std::index_sequence<k...>)->std::array<IntegratorInfo, integrator_count> {
  return {std::tuple_element_t<k, IntegratorList>::info...};
}
(std::make_index_sequence<integrator_count>{});

std::vector<Integrator> of_kinds(std::initializer_list<IntegratorKind> kinds) {
  std::vector<Integrator> found;
  for (const IntegratorInfo& info : table)
    if (std::find(kinds.begin(), kinds.end(), info.kind) != kinds.end()) found.push_back(info.id);
  return found;
}
}  // namespace

const IntegratorInfo& info_of(Integrator integrator) { return table[static_cast<std::size_t>(integrator)]; }

std::span<const IntegratorInfo> all_integrators() { return table; }

std::vector<Integrator> explicit_integrators() { return of_kinds({IntegratorKind::explicit_steps}); }

std::vector<Integrator> implicit_integrators() { return of_kinds({IntegratorKind::implicit_steps}); }

std::vector<Integrator> moving_integrators() {
  return of_kinds({IntegratorKind::explicit_steps, IntegratorKind::implicit_steps});
}

const char* integrator_name(Integrator integrator) { return info_of(integrator).name; }

std::optional<Integrator> find_integrator(std::string_view name) {
  for (const IntegratorInfo& info : table)
    if (name == info.name) return info.id;
  return std::nullopt;
}

}  // namespace heml
