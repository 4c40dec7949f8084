#include <string>
namespace {
namespace shorter = std;

struct Name : shorter::string {
  int made_of = 0;
};
}  // namespace

int nothing_shared_third() { return Name().made_of; }
