#include <fmt/format.h>

#include <heml/mesh/from_surface.hpp>

namespace heml {

std::string unit_warning(const Vec3& low, const Vec3& high) {
  constexpr double largest_body = 2, smallest_body = 1e-3;  // m
  const double length = (high - low).maxCoeff();
  if (length < smallest_body)
    return fmt::format("{:.3g} m long: is the scale right? Organs are 0.01 to 0.5 m long", length);
  if (length <= largest_body) return "";
  for (const auto& [unit, factor] : {std::pair{"centimetres", 0.01}, std::pair{"millimetres", 0.001}})
    if (length * factor <= 0.5)
      return fmt::format("{:.3g} m long: is the file in {}? \"scale\": {} would make it {:.3g} m", length, unit, factor,
                         length * factor);
  return fmt::format("{:.3g} m long: is the scale right? Organs are 0.01 to 0.5 m long", length);
}

}  // namespace heml
