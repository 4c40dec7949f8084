#pragma once
// The loops of naive.hpp. They are compiled twice: for the very processor that builds them, where it can run that, and
// for every processor; which run is chosen where they run. Plain data, since what is inline elsewhere must not be
// compiled so.
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
  const int* ends;            ///< 2 a spring
  const double* rest_length;  ///< of each spring, m
};

/// Forces at x (3 #V, metres) into f (3 #V, overwritten), N.
using NaiveLoop = void (*)(const NaiveBody& body, const double* x, double* f);

/// The loops as compiled once.
struct NaiveSet {
  struct Entry {
    const char* law;
    NaiveLoop loop;
  };
  const char* flags;  ///< beside those of the rest: "-O3 -march=native", or "-O3"
  const Entry* entries;
  std::size_t count;
  const bool* compiled_for;  ///< the features of HEML_X86_FEATURES, from 1 on; 0: anything
  std::size_t features;
};
extern const NaiveSet native_naive_set, portable_naive_set;

/// The first feature that a set was compiled for and a processor lacks, an index into `has`; 0: none.
std::size_t missing_feature(const NaiveSet& set, std::span<const bool> has);

/// The native set where a processor has what it was compiled for, else the portable one. has: as
/// NaiveSet::compiled_for.
const NaiveSet& naive_set(std::span<const bool> has);

/// The loop of a law; nullptr: there is none.
NaiveLoop naive_loop(const NaiveSet& set, std::string_view law);

/// That of the set for this processor; the first call warns where it is not the native one.
NaiveLoop naive_loop(std::string_view law);

/// What that set was compiled with.
const char* naive_flags();

}  // namespace heml
