#pragma once
// Kernel revision and build, which recordings name: states are the same to the bit for the same scene, kernel revision,
// build and instruction set.
#include <string>

namespace heml {

/// Raised by every change that alters a bit of any state: a recording of another revision cannot be compared. A change
/// without it fails the golden recordings (tests/golden).
constexpr long kernel_revision = 20;

std::string compiler_name();  ///< "GCC 12.2.0"

/// Compiler and processor family, e.g. "GCC 12.2.0, x86_64". Others may round differently.
std::string build_name();

}  // namespace heml
