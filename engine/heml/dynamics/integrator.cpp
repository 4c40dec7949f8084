#include <array>
#include <heml/dynamics/integrator.hpp>
#include <heml/dynamics/integrator_list.hpp>

namespace heml {
namespace {
constexpr std::array<IntegratorInfo, integrator_count> table =
    []<std::size_t... k>(std::index_sequence<k...>) -> std::array<IntegratorInfo, integrator_count> {
  return {std::tuple_element_t<k, IntegratorList>::info...};
}
(std::make_index_sequence<integrator_count>{});
}  // namespace

const IntegratorInfo& info_of(Integrator integrator) { return table[static_cast<std::size_t>(integrator)]; }

std::span<const IntegratorInfo> all_integrators() { return table; }

const char* integrator_name(Integrator integrator) { return info_of(integrator).name; }

std::optional<Integrator> find_integrator(std::string_view name) {
  for (const IntegratorInfo& info : table)
    if (name == info.name) return info.id;
  return std::nullopt;
}

}  // namespace heml
