#pragma once
// What a force kernel works on: a block of some two thousand tetrahedra, small enough that its nodes stay in the first
// cache, cut into fans.
//
// A fan is tetrahedra round an edge pq, each sharing a face with the next. Its nodes are read once for all of them:
//
//            r1 ──── r2         tetrahedra p q r0 r1, p q r1 r2, p q r2 r3:
//           ╱  ╲   ╱  ╲         6 nodes read where three tetrahedra alone would read 12,
//         r0 ── pq ─── r3       and lengths and products of shared edges are made once
//
// Edges of the ring are taken from the axis, b_i = r_i − p − φ_i a, a = q − p, with φ_i such that b_i is square to a at
// rest: then A_ab = g_a·g_b has no entries between axis and ring, and half of the work on it is gone.
//
// Where the ring is closed (m tetrahedra all round the edge) rm is r0, and there once.
//
// A group is as many fans of one size as the processor has lanes; fan l of a group is lane l of every pack.
//
//   size:    of each group: tetrahedra and ring nodes a fan
//   index:   [group][p q r0 r1 …][lane]      where the node's record begins, in Reals
//   shape:   [group][φ0 φ1 …, then constants of tetrahedron 0 … m−1][lane]
//   record:  x y z · f f f ·                 of each of the block's nodes, on the kernel's stack
//
// The constants are A*_aa, A*_00, A*_11, A*_01 of A* = 6V A and k = 1/6V; for a law of principal stretches the lower
// Cholesky factor of A* instead (aa 00 11 10); for a fibre √(6V) Dm⁻¹a0 more.
//
// Plain data: also seen by files that are compiled for processors the rest is not compiled for.
#include <cstddef>
#include <cstdint>

namespace heml {

struct FanSize {
  std::uint8_t tets, ring;  ///< ring: nodes, one more than tetrahedra, or as many where it is closed
  bool operator==(const FanSize&) const = default;
};

template <class Real>
struct FanBlock {
  const FanSize* size;
  std::size_t groups;
  const std::uint16_t* index;
  const Real* shape;
  const std::uint32_t* place;  ///< 3 n of the block's nodes n: its own first, then those shared with other blocks
  std::size_t own;             ///< nodes no other block touches: their forces go to f at once
  std::size_t nodes;           ///< own and shared
  Real* shared_force;          ///< 3 a shared node, summed later in the order of blocks
};

/// Constants of a tetrahedron.
constexpr std::size_t fan_constants(bool has_fibre) { return has_fibre ? 8 : 5; }

/// Most tetrahedra of a fan.
inline constexpr std::size_t max_fan_tets = 8;

/// Most nodes a block may have, 4 unused ones for lanes without a fan among them.
inline constexpr std::size_t max_block_nodes = 1024;

/// Forces (N) of a block at positions x (3 #V, metres) into f (3 #V) and shared_force, overwritten. `law` is the
/// kernel's law as a struct of Real. Returns whether it is defined in every tetrahedron.
template <class Real>
using FanKernel = bool (*)(const void* law, const FanBlock<Real>& block, const Real* x, Real* f);

}  // namespace heml
