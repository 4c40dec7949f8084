#pragma once
// Sparse matrix in float in the sliced ELLPACK format (SELL-4), for products with three right-hand sides at once.
//
//   slice s:   row 4s     v0 v1 v2 v3 .        four rows, padded with zeros to the longest of them
//              row 4s+1   v0 v1 .  .  .
//              row 4s+2   v0 v1 v2 v3 v4       stored column by column: [k][4]
//              row 4s+3   v0 v1 v2 .  .
//
// A row is summed in the order of its entries, so the bits are those of a row-by-row product. But four rows are summed
// side by side: one alone waits for the result of each addition before the next.
#include <cstring>
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/scalar_matrix.hpp>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/bsr_matrix.hpp>
#include <heml/math/bytes.hpp>

namespace heml {

class SlicedEllMatrix {
 public:
  SlicedEllMatrix() = default;  ///< no rows
  explicit SlicedEllMatrix(const ScalarMatrix& A);

  std::size_t rows() const { return rows_; }
  std::size_t bytes() const { return bytes_of(start_, column_, value_); }

  /// Calls write(row, (A x)_row) for every row, on all threads of the team.
  template <class Write>
  void each_product(const MultiVector& x, ThreadTeam& team, const Write& write) const {
    const std::size_t slices = start_.size() - 1, grain = 1 + slices * entry_grain / (value_.size() + 1);
    team.parallel_for(slices, grain, [&](std::size_t begin, std::size_t end) {
      if (has_avx2())
        multiply_wide(x, write, begin, end);
      else
        multiply(x, write, begin, end);
    });
  }

 private:
  typedef float Four __attribute__((vector_size(16)));
  static constexpr std::size_t lanes = 4;
  static constexpr std::size_t entry_grain = 4096;  ///< min. entries per thread, which outweigh the cost of a fork

  template <class Write>
  [[gnu::always_inline]] inline void multiply(const MultiVector& x, const Write& write_row, std::size_t begin,
                                              std::size_t end) const {
    const Write write = write_row;  // a copy that no store may change: its pointers stay in registers
    for (std::size_t s = begin; s < end; ++s) {
      Four sum[lanes] = {};
      for (std::size_t k = start_[s]; k < start_[s + 1]; ++k) {
        const float* value = &value_[lanes * k];
        const int* column = &column_[lanes * k];
#pragma GCC unroll 4
        for (std::size_t l = 0; l < lanes; ++l) {
          Four at;
          std::memcpy(&at, x[static_cast<std::size_t>(column[l])].data(), sizeof at);
          sum[l] += value[l] * at;
        }
      }
      for (std::size_t l = 0, row = lanes * s; l < lanes && row < rows_; ++l, ++row) {
        Eigen::Array4f of_row;
        std::memcpy(of_row.data(), &sum[l], sizeof sum[l]);
        write(row, of_row);
      }
    }
  }
  template <class Write>
  HEML_WIDE void multiply_wide(const MultiVector& x, const Write& write, std::size_t begin, std::size_t end) const {
    multiply(x, write, begin, end);
  }

  std::size_t rows_ = 0;
  std::vector<std::size_t> start_{0};  ///< of each slice, in groups of `lanes` entries
  std::vector<int> column_;
  std::vector<float> value_;
};

}  // namespace heml
