#pragma once
// The unit of work of a force kernel: a block of some two thousand tetrahedra, cut into fans, whose nodes fit the
// first-level cache.
//
// A fan is a sequence of tetrahedra round an edge pq, its axis, each sharing a face with the next. Each node is read
// once per fan:
//
//            r1 ──── r2         tetrahedra p q r0 r1, p q r1 r2, p q r2 r3:
//           ╱  ╲   ╱  ╲         6 nodes read where three tetrahedra alone would read 12,
//         r0 ── pq ─── r3       and lengths and products of shared edges are computed once
//
// Spokes go from the axis to the ring: b_i = r_i − p − φ_i a, a = q − p, with φ_i such that b_i is perpendicular to a
// at rest. Then A_ab = g_a·g_b has no entries between axis and ring, which halves the work on it.
//
// In a closed ring (m tetrahedra all round the edge) rm is r0 and is stored once.
//
// A group has as many fans of one size as a pack has lanes; fan l of a group is lane l of every pack.
//
//   size:    of each group: tetrahedra and ring nodes a fan
//   index:   [group][p q r0 r1 …][lane]      where the node's record begins, in Reals
//   shape:   [group][φ0 φ1 …, then constants of tetrahedron 0 … m−1][lane]
//   record:  x y z · f f f ·                 of each of the block's nodes, on the kernel's stack
//
// The constants are A*_aa, A*_00, A*_11, A*_01 of A* = 6V A and k = 1/6V; for a law of principal stretches the lower
// Cholesky factor of A* instead (aa 00 11 10); for a law with a fibre additionally √(6V) Dm⁻¹a0; then the law's
// parameters that differ between elements; then √(6V) Dm⁻¹a0 for
// active stress in a law without a fibre.
//
// Plain data only: files compiled for other instruction sets include this header.
#include <cstddef>
#include <cstdint>

namespace heml {

struct FanSize {
  std::uint8_t tets, ring;  ///< ring: number of ring nodes, tets + 1, or tets in a closed ring
  bool operator==(const FanSize&) const = default;
};

template <class Real>
struct FanBlock {
  const FanSize* size;
  std::size_t groups;
  const std::uint16_t* index;
  const Real* shape;
  const std::uint32_t* place;  ///< 3 n of the block's nodes n: its own first, then those shared with other blocks
  std::size_t own;             ///< number of nodes that no other block uses: their forces are written to f directly
  std::size_t nodes;           ///< number of own and shared nodes
  Real* shared_force;          ///< 3 a shared node, summed later in the order of blocks
};

/// Number of constants of a tetrahedron's rest shape.
constexpr std::size_t fan_constants(bool has_fibre) { return has_fibre ? 8 : 5; }

/// Maximum number of tetrahedra in a fan.
inline constexpr std::size_t max_fan_tets = 8;

/// Maximum number of nodes in a block, including 4 dummy nodes for lanes without a fan.
inline constexpr std::size_t max_block_nodes = 1024;

/// Writes the forces (N) of a block at positions x (3 #V, m) into f (3 #V) and shared_force, overwritten. `law`: the
/// law as a struct of Real. Returns whether the law is defined in every tetrahedron.
template <class Real>
using FanKernel = bool (*)(const void* law, const FanBlock<Real>& block, const Real* x, Real* f);

}  // namespace heml
