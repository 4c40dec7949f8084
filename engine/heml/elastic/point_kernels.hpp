#pragma once
// Forces of a uniform law at the points of quadratic elements, straight from the elements' ten nodes to them. Each
// instruction set has a file of its own (engine/CMakeLists.txt); loops over virtual corners (group_loops.hpp) do the
// rest: other terms, laws by expression, parameters by element, processors without AVX2.
#include <heml/elastic/instruction_set.hpp>
#include <heml/elastic/quadratic_map.hpp>
#include <heml/materials/material.hpp>
#include <memory>

namespace heml {

/// The elements of a group as a kernel sees them. Plain data only: files compiled for other instruction sets share no
/// inline code with the rest.
///
///   element k of the group is that of slots 4k .. 4k + 3, one a point:  A | . . . . | . . . . |  and so V and m
template <class Real>
struct PointBlock {
  const int* point;      ///< of each slot, 4 · element + point
  const int* nodes;      ///< 10 an element, by its inner number
  const Real* A[6];      ///< 1/m²
  const Real* volume;    ///< m³
  const Real* fibre[3];  ///< 1/m, or null
  const Real* kappa;     ///< Pa, of a quadratic volume term at the mean volume ratio (mean_dilatation.hpp), or null
};
template <class Real>
PointBlock<Real> point_block(const ElementGroup<Real>& group, const QuadraticNodes* nodes, const Real* kappa);

/// Writes what elements [begin, end) of a group pull at their nodes into of_element (30 #T, see VirtualCorners::sum());
/// other elements keep theirs. x: 3 #V, m. `law`: as a struct of Real. Returns whether the law is defined at all
/// points. Bits do not depend on the ranges; threads may call it on disjoint ones.
template <class Real>
using PointKernel = bool (*)(const void* law, const PointBlock<Real>& block, const Real* x, std::size_t begin,
                             std::size_t end, Real* of_element);

/// The law of a material that point kernels take, else null; and the kernel, null where the processor or `portable` has
/// none and loops over virtual corners compute the same.
template <class Real>
struct PointForces {
  PointKernel<Real> kernel = nullptr;
  std::shared_ptr<const void> law;
  InstructionSet instruction_set = InstructionSet::portable;
};

/// isa: supported by the processor (asserted).
template <class Real>
PointForces<Real> point_forces(const Material& material, bool continuation, InstructionSet isa);

// Of the law with that index in LawList; each is defined in its own file.
template <class Real>
PointKernel<Real> avx2_point_kernel(std::size_t law, bool continued);
template <class Real>
PointKernel<Real> avx512_point_kernel(std::size_t law, bool continued);

}  // namespace heml
