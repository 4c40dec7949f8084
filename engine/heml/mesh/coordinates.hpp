#pragma once
// What is asked of a mesh's coordinates, and how messages show them.
#include <fmt/format.h>

#include <heml/math/types.hpp>
#include <string>

namespace heml {

/// m: past this no file means metres, and volumes leave the range of float.
inline constexpr double max_coordinate = 1e12;

inline std::string shown(const Vec3& x) { return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]); }

}  // namespace heml
