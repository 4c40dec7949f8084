#pragma once
// Whose bits the states of a recording are. They are the same for the same scene, kernel revision, build and
// instruction set; recordings say all of these.
#include <string>

namespace heml {

/// Raised by every change that alters a bit of any state: a recording of another revision cannot be compared. A change
/// without it fails the golden recordings (tests/golden).
constexpr long kernel_revision = 1;

std::string compiler_name();  ///< "GCC 12.2.0"

/// Compiler and processor family; others round differently in places.
std::string build_name();

}  // namespace heml
