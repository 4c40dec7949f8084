#pragma once
// Limits of a mesh's coordinates, and their form in messages.
#include <fmt/format.h>

#include <heml/math/types.hpp>
#include <string>

namespace heml {

/// Largest accepted |coordinate|, m: beyond, a file is hardly in metres, and volumes overflow float.
inline constexpr double max_coordinate = 1e12;

inline std::string shown(const Vec3& x) { return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]); }

}  // namespace heml
