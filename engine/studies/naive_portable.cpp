// The loops of naive.hpp for any processor.
#include <studies/naive_elements.hpp>

namespace heml {

constinit const NaiveSet portable_naive_set = this_set;

}  // namespace heml
