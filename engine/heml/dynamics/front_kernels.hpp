#pragma once
// Dense kernels of the supernodal factor (dynamics/supernodal_ldlt.hpp), compiled once per instruction set. Results of
// different sets differ by round-off.
//
// A front is the dense matrix in which a supernode eliminates its unknowns (pivots). Its rows are the pivots and below
// them the later unknowns that they are coupled with (updates). Rows are stored in strips of eight, column after
// column:
//
//            pivots (k)
//          ┌────────────┐
//   strip 0│ d 8×8      │        panel: every strip has k columns, k rounded up to a multiple of 8
//   strip 1│     d      │
//   strip 2│            │ updates
//          ├────────────┼──────┐
//   strip 3│            │ 8    │ update: lower half; strip t has 8 (t + 1) columns
//   strip 4│            │ 8 16 │
//          └────────────┴──────┘
//
// Rows and columns of padding are 0. The panel becomes L (its unit diagonal and what is above it are not defined), and
// the update matrix loses L D Lᵀ.
#include <cstddef>
#include <heml/elastic/instruction_set.hpp>

namespace heml {

inline constexpr std::size_t strip_rows = 8;

constexpr std::size_t strips_of(std::size_t rows) { return (rows + strip_rows - 1) / strip_rows; }
/// Size of the update matrix with so many strips, and the offset of the strip of that number.
constexpr std::size_t triangle_size(std::size_t strips) { return strip_rows * strip_rows * strips * (strips + 1) / 2; }

struct Front {
  std::size_t pivots = 0;  ///< k
  std::size_t pivot_strips = 0, update_strips = 0;
  double* panel = nullptr;
  double* update = nullptr;
  double* pivot = nullptr;   ///< k, D
  double* scaled = nullptr;  ///< L D in the layout of the panel; scratch memory

  std::size_t strips() const { return pivot_strips + update_strips; }
  std::size_t strip_size() const { return strip_rows * strip_rows * pivot_strips; }
  std::size_t panel_size() const { return strips() * strip_size(); }
};

struct StripRange {
  std::size_t first, last;  ///< [first, last)
};

struct FrontKernels {
  /// Subtracts the products of all pivots before a range of columns from these columns of the panel. columns: strips of
  /// pivots; rows: strips of the panel.
  void (*reduce)(const Front&, StripRange columns, StripRange rows);
  /// Eliminates the pivots of a strip within the strip, after those of strips [from, strip).
  void (*factor_diagonal)(const Front&, std::size_t from, std::size_t strip);
  /// The same in rows below.
  void (*factor_below)(const Front&, std::size_t from, std::size_t strip, StripRange rows);
  /// Subtracts L D Lᵀ from strips of the update matrix.
  void (*subtract)(const Front&, StripRange rows);
  /// z = L⁻¹ z, z: #rows of the front with padding.
  void (*forward)(const Front&, double* z);
  /// z = L⁻ᵀ z of the pivots, with the updates given.
  void (*backward)(const Front&, double* z);
};

/// isa: one of instruction_sets().
const FrontKernels& front_kernels(InstructionSet isa);

// Each is defined in its own file.
extern const FrontKernels portable_front_kernels, avx2_front_kernels, avx512_front_kernels;

}  // namespace heml
