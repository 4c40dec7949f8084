#include <algorithm>
#include <cmath>
#include <heml/dynamics/block_jacobi.hpp>

namespace heml {
namespace {

constexpr std::size_t row_grain = 512;     // min. rows per thread
constexpr std::size_t sampled_rows = 512;  // whose median ratio is taken
constexpr float share_of_ratio = 0.8f;     // ω over (λ + 2μ)/μ: fewest iterations for Poisson's ratios 0 to 0.45
constexpr float stiff_from = 4;            // times the median ratio
constexpr float min_pivot = 1e-4f;         // relative to the block: smaller ones count as not positive

}  // namespace

void BlockJacobi::set(const BsrMatrix& K, const std::vector<float>& diagonal, ThreadTeam& team) {
  const auto ratio_of = [&](std::size_t row) { return K.diagonal_block(row).trace() / (3 * diagonal[row]); };
  std::vector<float> ratio;
  for (std::size_t row = 0; row < K.rows(); row += 1 + K.rows() / sampled_rows)
    if (const float of_row = ratio_of(row); std::isfinite(of_row)) ratio.push_back(of_row);
  float usual = 1;
  if (!ratio.empty()) {
    const auto middle = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
    std::nth_element(ratio.begin(), middle, ratio.end());
    usual = std::max(1.0f, *middle);
  }
  const float weight = share_of_ratio * (3 * usual - 2);
  stiff_rows_.clear();
  for (std::size_t row = 0; row < K.rows(); ++row)
    if (const float times = ratio_of(row) / usual; times > stiff_from) stiff_rows_.push_back({row, stiff_from / times});
  inverse_.resize(K.rows());
  team.parallel_for(K.rows(), row_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const Eigen::Matrix3f D = K.diagonal_block(row);
      const float minor = D(0, 0) * D(1, 1) - D(0, 1) * D(0, 1), size = D.trace() / 3;
      const Eigen::Matrix3f inverse = D.inverse();
      const bool is_positive = D(0, 0) > min_pivot * size && minor > min_pivot * size * size &&
                               D.determinant() > min_pivot * size * size * size && inverse.allFinite();
      for (int j = 0; j < 3; ++j) {
        Eigen::Array4f& column = inverse_[row][static_cast<std::size_t>(j)];
        column.setZero();
        if (is_positive)
          column.head<3>() = weight * inverse.col(j).array();
        else
          column[j] = 1 / diagonal[row];
      }
    }
  });
}

}  // namespace heml
