#pragma once
// The loops of naive.hpp, compiled twice: for the processor of the build machine and for any processor. The set is
// chosen at run time. The interface is plain data, since inline functions shared with other files must not be compiled
// for one processor.
#include <cstddef>
#include <iterator>
#include <span>
#include <string_view>
#include <studies/x86_features.hpp>

namespace heml {

struct NaiveBody {
  std::size_t nodes, tets, springs, parameters;
  const int* corners;         ///< 4 #T
  const double* Dm_inverse;   ///< 9 #T, row-major, 1/m
  const double* volume;       ///< #T, m³
  const double* parameter;    ///< of the law, SI, in the order of Material::parameters
  double fibre[3];            ///< unit
  const int* ends;            ///< 2 per spring
  const double* rest_length;  ///< of each spring, m
};

/// Forces at x (3 #V, metres) into f (3 #V, overwritten), N.
using NaiveLoop = void (*)(const NaiveBody& body, const double* x, double* f);

/// The loops of one compilation.
struct NaiveSet {
  struct Entry {
    const char* law;
    NaiveLoop loop;
  };
  const char* flags;  ///< in addition to the common ones: "-O3 -march=native", or "-O3"
  const Entry* entries;
  std::size_t count;
  const bool* compiled_for;  ///< by feature of HEML_X86_FEATURES, from index 1 on; 0 is a placeholder
  std::size_t features;
};
extern const NaiveSet native_naive_set, portable_naive_set;

/// Index into `has` of the first feature that the set requires and the processor lacks; 0: none.
std::size_t missing_feature(const NaiveSet& set, std::span<const bool> has);

/// The native set if the processor has all features it requires, else the portable one. has: indexed like
/// NaiveSet::compiled_for.
const NaiveSet& naive_set(std::span<const bool> has);

/// The loop of a law; nullptr: there is none.
NaiveLoop naive_loop(const NaiveSet& set, std::string_view law);

/// The same from the set for this processor; the first call warns if that is not the native one.
NaiveLoop naive_loop(std::string_view law);

/// Compiler flags of the set for this processor.
const char* naive_flags();

}  // namespace heml
