// The loops of naive.hpp for every processor.
#include <studies/naive_elements.hpp>

namespace heml {

constinit const NaiveSet portable_naive_set = this_set;

}  // namespace heml
