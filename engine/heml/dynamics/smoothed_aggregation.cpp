#include <array>
#include <heml/dynamics/prolongation.hpp>
#include <heml/dynamics/smoothed_aggregation.hpp>
#include <heml/math/rotation.hpp>
#include <numbers>

namespace heml {
namespace {

constexpr std::size_t vector_grain = 512;     // min. rows per thread of loops without products
constexpr double max_coarsening_ratio = 0.7;  // max. ratio of unknowns of a level to those of the finer one
constexpr double smoothed_from = 0.2;  // the smoother damps eigenvalues from here to 1, the coarser levels the rest
/// Weights w of the steps x += w D⁻¹(b − Ax), which together are the Chebyshev polynomial on [smoothed_from, 1].
const std::array<float, 2> weights = [] {
  std::array<float, 2> result{};
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double angle = std::numbers::pi * (2 * static_cast<double>(k) + 1) / (2 * static_cast<double>(result.size()));
    result[k] = static_cast<float>(2 / (1 + smoothed_from + (1 - smoothed_from) * sine_cosine(angle).cosine));
  }
  return result;
}();

void add_coarse_levels(SmoothedAggregation::Hierarchy& hierarchy, std::size_t max_direct_unknowns) {
  auto& levels = hierarchy.levels;
  while (static_cast<std::size_t>(levels.back().L.rows()) > max_direct_unknowns) {
    auto& fine = levels.back();
    const ScalarMatrix P = smoothed_prolongation(fine.L), R = P.transpose();
    if (static_cast<double>(P.cols()) > max_coarsening_ratio * static_cast<double>(P.rows())) break;
    fine.P = SlicedEllMatrix(P);
    fine.R = SlicedEllMatrix(R);
    SmoothedAggregation::Hierarchy::Level coarse;
    coarse.L = R * ScalarMatrix(fine.L * P);
    coarse.M = R * ScalarMatrix(fine.M * P);
    levels.push_back(std::move(coarse));
  }
}

std::shared_ptr<const SmoothedAggregation::Hierarchy> make_hierarchy(const FreeNodes& free, const TetMesh& mesh,
                                                                     const std::vector<double>& modulus,
                                                                     const Vector& mass,
                                                                     std::size_t max_direct_unknowns) {
  auto hierarchy = std::make_shared<SmoothedAggregation::Hierarchy>();
  hierarchy->node = free.node;
  auto& finest = hierarchy->levels.emplace_back();
  finest.L = scalar_stiffness(free, mesh, modulus);
  finest.M = scalar_mass(free, mass);
  for (std::size_t row = 0; row < free.node.size(); ++row) {
    if (mass_of_node(mass, free.node[row]) > 0) continue;
    hierarchy->bare_rows.push_back(row);
    finest.L.coeffRef(static_cast<int>(row), static_cast<int>(row)) += 1;
  }
  add_coarse_levels(*hierarchy, max_direct_unknowns);
  return hierarchy;
}

}  // namespace

SmoothedAggregation::SmoothedAggregation(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus,
                                         const Vector& mass, std::size_t max_direct_unknowns, ThreadTeam& team)
    : SmoothedAggregation(make_hierarchy(free, mesh, modulus, mass, max_direct_unknowns), team) {}

SmoothedAggregation::SmoothedAggregation(std::shared_ptr<const Hierarchy> hierarchy, ThreadTeam& team)
    : hierarchy_(std::move(hierarchy)), excluded_rows_(hierarchy_->bare_rows), team_(team) {
  for (const Hierarchy::Level& matrices : hierarchy_->levels) {
    const auto size = static_cast<std::size_t>(matrices.L.rows());
    levels_.push_back({{}, {}, MultiVector(size), MultiVector(size), MultiVector(size)});
  }
}

bool SmoothedAggregation::set_inertia(double a) {
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    Level& level = levels_[l];
    const Hierarchy::Level& matrices = hierarchy_->levels[l];
    const ScalarMatrix A = a * matrices.M + matrices.L;
    level.inverse_D.clear();
    for (const double sum : absolute_row_sums(A)) level.inverse_D.push_back(static_cast<float>(1 / sum));
    level.A = SlicedEllMatrix(A);
    if (l == 0) {
      const Vector diagonal = A.diagonal();
      diagonal_.assign(diagonal.begin(), diagonal.end());
    }
  }
  const Hierarchy::Level& bottom = hierarchy_->levels.back();
  return bottom_.factor(a * bottom.M + bottom.L);
}

void SmoothedAggregation::smooth(Level& level, float weight, const MultiVector& b, MultiVector& x) const {
  level.A.each_product(
      x, team_,
      [weight, x = x.data(), b = b.data(), inverse_D = level.inverse_D.data(), to = level.scratch.data()](
          std::size_t i, const Eigen::Array4f& Ax) { to[i] = x[i] + weight * inverse_D[i] * (b[i] - Ax); });
  std::swap(x, level.scratch);
}

/// One V-cycle from level l down: x ≈ A⁻¹ b.
void SmoothedAggregation::cycle(std::size_t l, const MultiVector& b, MultiVector& x) {
  if (l + 1 == levels_.size()) {
    x = b;
    return bottom_.solve(x);
  }
  Level &level = levels_[l], &coarse = levels_[l + 1];
  const Hierarchy::Level& transfer = hierarchy_->levels[l];
  team_.parallel_for(x.size(), vector_grain, [&](std::size_t begin, std::size_t end) {
    const float *inverse_D = level.inverse_D.data(), weight = weights[0];
    const Eigen::Array4f* from = b.data();
    Eigen::Array4f* to = x.data();
    for (std::size_t i = begin; i < end; ++i) to[i] = weight * inverse_D[i] * from[i];
  });
  for (std::size_t k = 1; k < weights.size(); ++k) smooth(level, weights[k], b, x);
  level.A.each_product(x, team_, [b = b.data(), to = level.scratch.data()](std::size_t i, const Eigen::Array4f& Ax) {
    to[i] = b[i] - Ax;
  });
  transfer.R.each_product(level.scratch, team_,
                          [to = coarse.b.data()](std::size_t i, const Eigen::Array4f& sum) { to[i] = sum; });
  cycle(l + 1, coarse.b, coarse.x);
  transfer.P.each_product(coarse.x, team_, [to = x.data()](std::size_t i, const Eigen::Array4f& sum) { to[i] += sum; });
  for (const float weight : weights) smooth(level, weight, b, x);
}

void SmoothedAggregation::apply(const MultiVector& r, MultiVector& z) {
  z.resize(r.size());
  cycle(0, r, z);
  for (const std::size_t row : excluded_rows_) z[row].setZero();
}

void SmoothedAggregation::apply(const BlockJacobi& finest, const MultiVector& r, MultiVector& z) {
  const Hierarchy::Level& transfer = hierarchy_->levels[0];
  Level& coarse = levels_[1];
  z.resize(r.size());
  const MultiVector* restricted = &r;
  if (!finest.stiff_rows().empty()) {
    MultiVector& weighted = levels_[0].scratch;
    weighted = r;
    for (const auto& [row, weight] : finest.stiff_rows()) weighted[row] *= weight;
    restricted = &weighted;
  }
  transfer.R.each_product(*restricted, team_,
                          [to = coarse.b.data()](std::size_t i, const Eigen::Array4f& sum) { to[i] = sum; });
  cycle(1, coarse.b, coarse.x);
  transfer.P.each_product(coarse.x, team_,
                          [&finest, r = r.data(), to = z.data()](std::size_t i, const Eigen::Array4f& sum) {
                            to[i] = finest.apply(i, r[i]) + sum;
                          });
  for (const auto& [row, weight] : finest.stiff_rows()) {
    const Eigen::Array4f own = finest.apply(row, r[row]);
    z[row] = own + weight * (z[row] - own);
  }
  for (const std::size_t row : excluded_rows_) z[row].setZero();
}

void SmoothedAggregation::apply(const Vector& r, Vector& z) {
  const double largest = r.cwiseAbs().maxCoeff(), scale = largest > 0 ? largest : 1;  // keeps values in float's range
  Level& top = levels_.front();
  const auto place = [&](std::size_t k) { return 3 * hierarchy_->node[k]; };
  for (std::size_t k = 0; k < top.b.size(); ++k)
    top.b[k] << (r.segment<3>(place(k)) / scale).cast<float>().array(), 0.0f;
  cycle(0, top.b, top.x);
  z.setZero(r.size());
  for (std::size_t k = 0; k < top.x.size(); ++k)
    z.segment<3>(place(k)) = scale * top.x[k].head<3>().cast<double>().matrix();
  for (const std::size_t row : excluded_rows_) z.segment<3>(place(row)).setZero();
}

std::size_t SmoothedAggregation::bytes() const {
  std::size_t sum = bottom_.bytes() + bytes_of(diagonal_, hierarchy_->node, hierarchy_->bare_rows, excluded_rows_);
  for (const Hierarchy::Level& matrices : hierarchy_->levels)
    sum += bytes_of(matrices.L, matrices.M) + matrices.P.bytes() + matrices.R.bytes();
  for (const Level& level : levels_)
    sum += level.A.bytes() + bytes_of(level.inverse_D, level.b, level.x, level.scratch);
  return sum;
}

}  // namespace heml
