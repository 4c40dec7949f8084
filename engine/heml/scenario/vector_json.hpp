#pragma once
// Vectors as JSON.
#include <heml/math/types.hpp>
#include <heml/scenario/json_text.hpp>

namespace heml {

inline Json vector_json(const Vec3& vector) { return Json::array({vector.x(), vector.y(), vector.z()}); }

}  // namespace heml
