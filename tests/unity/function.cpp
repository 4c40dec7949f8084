#include <functional>
#define HALF 0.5
namespace {
namespace shorter = std;

std::function<void(int)> made_of(double) {
  return [](int) {};
}
}  // namespace

double function_first() {
  made_of(HALF)(1);
  return 1;
}
