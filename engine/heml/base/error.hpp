#pragma once
// Exceptions for bad input (file, scene, mesh, material) and wrong usage. Never thrown within a step.
#include <stdexcept>
#include <string>

namespace heml {

/// Bad input: exit code 3. what() is one line, "FILE: PLACE: PROBLEM (REMEDY)", without the parts that are empty.
class InputError : public std::runtime_error {
 public:
  /// file: path as the user gave it. place: key path, line, element or node ("materials[1].poisson", "line 12",
  /// "element 34"). problem: what is wrong, with the value seen. remedy: what would be right.
  InputError(const std::string& file, const std::string& place, const std::string& problem,
             const std::string& remedy = "");
};

/// Wrong usage of the command line: exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace heml
