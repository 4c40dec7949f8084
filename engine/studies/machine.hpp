#pragma once
// The machine and the build that a measurement was made with.
#include <cstddef>
#include <heml/scenario/json_text.hpp>
#include <string>

namespace heml {

struct Machine {
  std::string cpu;                       ///< "AMD EPYC ..."
  int cores = 1;                         ///< available to this program
  std::size_t L1 = 0, L2 = 0, L3 = 0;    ///< bytes, of one core and (L3) of all; 0: not known
  std::string compiler, flags, version;  ///< of this program
  std::string naive_flags;               ///< of the naive loops, in addition
  std::string commit;  ///< of the source, with a + if it has local changes; "unknown" outside a repository
};

Machine this_machine();
Json to_json(const Machine& machine);

}  // namespace heml
