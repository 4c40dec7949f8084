#include <array>
namespace {
constexpr std::array<int, 2> made_of = {1, 2};
}  // namespace

int constant_second() { return made_of[0]; }
