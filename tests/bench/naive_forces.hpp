#pragma once
// What the kernels are measured against: forces as a textbook writes them, in double, one element after the other:
// F = Ds Dm⁻¹, P = F S + wJ cof F, scatter-add. Compiled with -O3 -march=native.
#include <array>
#include <cstddef>
#include <vector>

namespace heml::bench {

struct NaiveMesh {
  std::vector<std::array<int, 4>> tets;
  std::vector<std::array<double, 9>> inverse;  ///< Dm⁻¹, row after row, 1/m
  std::vector<double> volume;                  ///< m³
  double fibre[3] = {1, 0, 0};
};

/// Forces (3 #V, N) at x of the law with that index in LawList, `law` being its struct of double, not continued.
using NaiveForces = void (*)(const void* law, const NaiveMesh& mesh, const double* x, double* f, std::size_t nodes);
NaiveForces naive_forces(std::size_t law);

}  // namespace heml::bench
