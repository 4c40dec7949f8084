// The loops of naive.hpp for the processor of the build machine.
#include <studies/naive_elements.hpp>

namespace heml {

constinit const NaiveSet native_naive_set = this_set;

}  // namespace heml
