#pragma once
// Inverse 3×3 blocks of the diagonal of K, as the finest level of a preconditioner whose coarser levels are those of a
// scalar stand-in A (smoothed_aggregation.hpp). The blocks know of Poisson's ratio, of grasps, and of what deformation
// has made of the stiffness; A knows of the shear modulus at rest alone.
//
//   z = ω D⁻¹ r + W P (coarser levels) Pᵀ W r
//
// The coarser levels answer a volumetric load (λ + 2μ)/μ times as softly as K does, so ω is near that ratio; then no
// part of the sum hides the other. Of an isotropic node tr D / (3 A) is (λ + 4μ)/(3μ), from which the ratio is taken. W
// is 1, but less at nodes that are held stiffly, which the coarser levels would move as if they were free.
#include <heml/elastic/bsr_matrix.hpp>

namespace heml {

class BlockJacobi {
 public:
  /// diagonal: of A, #rows of K, above 0. Where a block is not positive definite, A's entry takes its place. Threads of
  /// the team share rows; the bits do not depend on their number.
  void set(const BsrMatrix& K, const std::vector<float>& diagonal, ThreadTeam& team);

  /// ω D⁻¹ r of a row.
  [[gnu::always_inline]] Eigen::Array4f apply(std::size_t row, const Eigen::Array4f& r) const {
    const Columns& inverse = inverse_[row];
    return inverse[0] * r[0] + inverse[1] * r[1] + inverse[2] * r[2];
  }

  /// A row where W is not 1.
  struct StiffRow {
    std::size_t row;
    float weight;
  };
  const std::vector<StiffRow>& stiff_rows() const { return stiff_rows_; }

  std::size_t bytes() const { return bytes_of(inverse_, stiff_rows_); }

 private:
  using Columns = std::array<Eigen::Array4f, 3>;
  std::vector<Columns> inverse_;  ///< ω D⁻¹
  std::vector<StiffRow> stiff_rows_;
};

}  // namespace heml
