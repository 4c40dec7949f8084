#pragma once
// The loops of naive.hpp. Plain data: they are compiled for the very processor that builds them, where it can run
// that, and what is inline elsewhere must not be compiled so.
#include <cstddef>
#include <string_view>

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

/// The loop of a law; nullptr: there is none.
NaiveLoop naive_loop(std::string_view law);

/// What the loops were compiled with beside the flags of the rest: "-O3 -march=native", or "-O3".
const char* naive_flags();

}  // namespace heml
