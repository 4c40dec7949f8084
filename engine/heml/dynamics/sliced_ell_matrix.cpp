#include <algorithm>
#include <heml/dynamics/sliced_ell_matrix.hpp>

namespace heml {

SlicedEllMatrix::SlicedEllMatrix(const ScalarMatrix& A) : rows_(static_cast<std::size_t>(A.rows())) {
  for (std::size_t first = 0; first < rows_; first += lanes) {
    std::size_t width = 0;
    for (std::size_t row = first; row < std::min(first + lanes, rows_); ++row)
      width = std::max(width, static_cast<std::size_t>(A.innerVector(static_cast<Eigen::Index>(row)).nonZeros()));
    const std::size_t begin = start_.back(), end = begin + width;
    start_.push_back(end);
    column_.resize(lanes * end, 0);
    value_.resize(lanes * end, 0.0f);
    for (std::size_t l = 0; l < lanes && first + l < rows_; ++l) {
      std::size_t k = lanes * begin + l;
      int last = 0;  // padding repeats the last column, so that it reads nothing that the row does not
      for (ScalarMatrix::InnerIterator entry(A, static_cast<Eigen::Index>(first + l)); entry; ++entry, k += lanes) {
        column_[k] = last = static_cast<int>(entry.col());
        value_[k] = static_cast<float>(entry.value());
      }
      for (; k < lanes * end; k += lanes) column_[k] = last;
    }
  }
  column_.shrink_to_fit();
  value_.shrink_to_fit();
}

}  // namespace heml
