#include <array>
namespace {
constexpr double half(double of) { return of / 2; }
constexpr double sizes[] = {half(1), half(2)};
constexpr std::array<int, 2> made_of = {1, 2};
}  // namespace

int constant_second() { return made_of[0] + static_cast<int>(sizes[1]); }
