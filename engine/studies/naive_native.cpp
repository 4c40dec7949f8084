// The loops of naive.hpp for the very processor that builds them.
#include <studies/naive_elements.hpp>

namespace heml {

constinit const NaiveSet native_naive_set = this_set;

}  // namespace heml
