#pragma once
// Forces at the points of quadratic elements, of a law and the terms beside it, straight from the elements' ten nodes
// to them. Each instruction set has a file of its own (engine/CMakeLists.txt); loops over virtual corners
// (group_loops.hpp) do the rest: laws by expression of stretches, processors without AVX2.
#include <heml/elastic/instruction_set.hpp>
#include <heml/elastic/point_layout.hpp>
#include <heml/elastic/point_terms.hpp>
#include <heml/elastic/quadratic_map.hpp>
#include <heml/materials/material.hpp>
#include <memory>
#include <optional>
#include <span>

namespace heml {

/// Maximum number of a law's parameters that can differ between elements.
inline constexpr std::size_t max_point_parameters = 8;

/// Elements of a group that follow each other, and their nodes. Plain data only: files
/// compiled for other instruction sets share no inline code with the rest.
///
///   element k is that of four slots, one a point:  A | . . . . | . . . . |  and so V and m
///   record:  x y z · f f f ·                       of each of the block's nodes, on the kernel's stack
template <class Real>
struct PointBlock {
  std::size_t elements;
  const std::uint16_t* index;  ///< 10 an element: where the record of each node begins, in Reals
  const Real* A[6];            ///< 1/m²
  const Real* volume;          ///< m³
  const Real* fibre[3];        ///< 1/m, or null
  std::size_t parameters;      ///< of the law that differ between elements
  const Real* parameter[max_point_parameters];     ///< of the points as A
  std::size_t parameter_at[max_point_parameters];  ///< which of the law's it is
  const Real* kappa;           ///< Pa, of the volume term at the mean volume ratio (mean_dilatation.hpp), or null
  const std::uint32_t* place;  ///< 3 n of the block's nodes n: its own first, then those shared with other blocks
  std::size_t own, nodes;      ///< number of own nodes, whose forces are written to f directly, and of all
  Real* shared_force;          ///< 3 a shared node, summed later in the order of blocks
};
/// A parameter that differs between elements: which of ElementGroup::parameters, and which of the law's.
struct PointParameter {
  std::size_t field, parameter;
};

/// kappa: of the elements of the group. of_slot: 3 a slot of the layout's shared nodes.
template <class Real>
PointBlock<Real> point_block(const ElementGroup<Real>& group, const PointLayout& layout, std::size_t block,
                             std::span<const PointParameter> parameters, const Real* kappa, Real* of_slot);

/// Writes the forces (N) of a block at positions x (3 #V, m) into f (3 #V) and shared_force, overwritten. `law`: as a
/// struct of Real; terms: of_block(). Returns whether the law and the terms are defined at all points. Threads may call
/// it on different blocks.
template <class Real>
using PointKernel = bool (*)(const void* law, const PointBlock<Real>& block, const PointTerms<Real>& terms,
                             const Real* x, Real* f);

/// The law of a material that point kernels take, without a volume term that is a term of its own, else null; and the
/// kernel, null where the processor or `portable` has none and loops over virtual corners compute the same.
template <class Real>
struct PointForces {
  PointKernel<Real> kernel = nullptr;
  std::shared_ptr<const void> law;
  std::vector<PointParameter> parameters = {};
  PointTerms<Real> terms = {};             ///< its volume term: the rest is ViscoelasticTerm's and ActiveTerm's
  std::optional<std::size_t> kappa_field;  ///< which of ElementGroup::parameters is that term's κ
  InstructionSet instruction_set = InstructionSet::portable;
};

/// Of the slots of a block alone, from those of the group. Lists that are null stay so.
template <class Real>
PointTerms<Real> of_block(PointTerms<Real> terms, const PointLayout::Block& block);

/// isa: supported by the processor (asserted).
template <class Real>
PointForces<Real> point_forces(const Material& material, bool continuation, InstructionSet isa);

// Of the law with that index in LawList, or of InvariantEnergy<Real, false, with_fibre>; each is defined in its own
// file.
template <class Real>
PointKernel<Real> avx2_point_kernel(std::size_t law, bool continued);
template <class Real>
PointKernel<Real> avx2_point_energy_kernel(bool with_fibre);
template <class Real>
PointKernel<Real> avx512_point_kernel(std::size_t law, bool continued);
template <class Real>
PointKernel<Real> avx512_point_energy_kernel(bool with_fibre);

}  // namespace heml
