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

/// Columns of weight D⁻¹, by cofactors; returns false where D is not positive definite.
bool invert(const Eigen::Matrix3f& D, float weight, std::array<Eigen::Array4f, 3>& inverse) {
  const float size = D.trace() / 3, scale = 1 / size;  // of which no product overflows
  const float a = scale * D(0, 0), b = scale * D(1, 1), c = scale * D(2, 2);
  const float d = scale * D(1, 0), e = scale * D(2, 0), f = scale * D(2, 1);
  const float A = b * c - f * f, B = a * c - e * e, C = a * b - d * d;
  const float F = d * e - a * f, E = d * f - b * e, G = e * f - c * d;
  const float determinant = a * A + d * G + e * E;
  if (!(size > 0 && a > min_pivot && C > min_pivot && determinant > min_pivot)) return false;
  const float factor = weight * scale / determinant;
  if (!std::isfinite(factor)) return false;
  inverse[0] = factor * Eigen::Array4f(A, G, E, 0);
  inverse[1] = factor * Eigen::Array4f(G, B, F, 0);
  inverse[2] = factor * Eigen::Array4f(E, F, C, 0);
  return true;
}

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
    for (std::size_t row = begin; row < end; ++row)
      if (!invert(K.diagonal_block(row), weight, inverse_[row]))
        for (int j = 0; j < 3; ++j)
          inverse_[row][static_cast<std::size_t>(j)] = Eigen::Vector4f::Unit(j).array() / diagonal[row];
  });
}

}  // namespace heml
