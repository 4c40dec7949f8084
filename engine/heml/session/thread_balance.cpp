#include <algorithm>
#include <cmath>
#include <heml/session/thread_balance.hpp>

namespace heml {
namespace {
constexpr double tolerated = 0.15;  // of a core: load of publishing and of the panel of an idle window
constexpr int looks_to_be_sure = 2;
}  // namespace

std::optional<int> ThreadBalance::look(double wall, double others) {
  const bool is_first = others_ < 0;
  if (!is_first) load_ = (others - others_) / (wall - wall_);
  wall_ = wall;
  others_ = others;
  if (is_first) return std::nullopt;
  const int free = std::clamp(static_cast<int>(std::floor(cores_ - load_ + tolerated)), 1, cores_);
  looks_with_more_ = free > threads_ ? looks_with_more_ + 1 : 0;
  if (free == threads_ || (free > threads_ && looks_with_more_ < looks_to_be_sure)) return std::nullopt;
  looks_with_more_ = 0;
  return threads_ = free;
}

}  // namespace heml
