#pragma once
// Errors that come from outside: a file, a scene, a mesh, a material. Thrown only while loading, never in a step.
#include <stdexcept>
#include <string>

namespace heml {

/// Bad input. what() is the one line a user reads: "FILE: PLACE: PROBLEM (REMEDY)"; empty parts are left out.
/// The program ends with exit code 3.
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
