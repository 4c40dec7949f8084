#include <algorithm>
#include <cstring>
#include <heml/dynamics/low_rank_update.hpp>
#include <heml/elastic/avx2_dispatch.hpp>

namespace heml {
namespace {
constexpr std::size_t max_column_values = std::size_t(1) << 24;  // 64 MiB
constexpr double weakest_term = 0.3;                             // of the stiffness of P: less costs more than it saves
constexpr double column_round_off = 1e-6;                        // of P⁻¹, which is computed in float
constexpr std::size_t update_grain = 24576;  // min. products per thread, which outweigh the cost of a fork
constexpr std::size_t lanes = 4;             // columns at a time: of a MultiVector when they are computed, and to push

typedef float Four __attribute__((vector_size(16)));

struct Pushed {
  const float* column;
  Four force;
};

/// Subtracts from rows of z their column times force, sums in the order of `pushed`, whose size is a multiple of lanes.
[[gnu::always_inline]] inline void subtract(const std::vector<Pushed>& pushed, MultiVector& z, std::size_t begin,
                                            std::size_t end) {
  for (std::size_t k = 0; k < pushed.size(); k += lanes) {
    const Pushed a = pushed[k], b = pushed[k + 1], c = pushed[k + 2], d = pushed[k + 3];
    for (std::size_t row = begin; row < end; ++row) {
      Four sum;
      std::memcpy(&sum, z[row].data(), sizeof sum);
      sum -= a.column[row] * a.force;
      sum -= b.column[row] * b.force;
      sum -= c.column[row] * c.force;
      sum -= d.column[row] * d.force;
      std::memcpy(z[row].data(), &sum, sizeof sum);
    }
  }
}

HEML_WIDE void subtract_wide(const std::vector<Pushed>& pushed, MultiVector& z, std::size_t begin, std::size_t end) {
  subtract(pushed, z, begin, end);
}
}  // namespace

void LowRankUpdate::reset() {
  columns_.clear();
  terms_.clear();
  strong_.clear();
}

void LowRankUpdate::set(SmoothedAggregation& P, const std::vector<RankOneTerm>& terms) {
  terms_.clear();
  strong_.clear();
  rows_.clear();
  if (terms.empty()) return;
  const auto row_of = [&](int node) { return free_.number[static_cast<std::size_t>(node)]; };
  for (const RankOneTerm& term : terms)
    for (std::size_t k = 0; k < static_cast<std::size_t>(term.count); ++k)
      if (const int row = row_of(term.nodes[k]); row >= 0) rows_.push_back(static_cast<std::size_t>(row));
  std::sort(rows_.begin(), rows_.end());
  rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
  for (const RankOneTerm& term : terms) {
    Term& own = terms_.emplace_back(Term{});
    own.sign = term.sign;
    for (std::size_t k = 0; k < static_cast<std::size_t>(term.count); ++k) {
      const int row = row_of(term.nodes[k]);
      if (row < 0) continue;
      const auto at = std::lower_bound(rows_.begin(), rows_.end(), static_cast<std::size_t>(row)) - rows_.begin();
      const auto place = static_cast<std::size_t>(own.count++);
      own.at[place] = static_cast<std::size_t>(at);
      for (int i = 0; i < 3; ++i) own.g[place][i] = is_held(3 * term.nodes[k] + i) ? 0 : term.g[k][i];
    }
  }
  if (rows_.size() * free_.node.size() <= max_column_values) find_correction(P);
}

bool LowRankUpdate::is_held(int coordinate) const {
  return std::binary_search(free_.held.begin(), free_.held.end(), coordinate);
}

void LowRankUpdate::find_correction(SmoothedAggregation& P) {
  find_columns(P);
  for (const Term& term : terms_)
    if (term.sign > 0 && coupling(term, term) > weakest_term) strong_.push_back(term);
  keep_strongest();
  const auto size = static_cast<Eigen::Index>(strong_.size());
  Eigen::MatrixXd S(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = j; i < size; ++i)
      S(i, j) = coupling(strong_[static_cast<std::size_t>(i)], strong_[static_cast<std::size_t>(j)]);
    S(j, j) = 1 + (1 + column_round_off) * S(j, j);
  }
  S_.compute(S);
  if (S_.info() != Eigen::Success || !S_.matrixLLT().diagonal().allFinite()) strong_.clear();
}

void LowRankUpdate::keep_strongest() {
  if (strong_.size() <= max_terms) return;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < strong_.size(); ++t) order.emplace_back(-coupling(strong_[t], strong_[t]), t);
  std::sort(order.begin(), order.end());
  std::vector<Term> kept;
  for (std::size_t k = 0; k < max_terms; ++k) kept.push_back(strong_[order[k].second]);
  strong_ = std::move(kept);
}

void LowRankUpdate::find_columns(SmoothedAggregation& P) {
  columns_.resize(free_.node.size());
  std::vector<std::size_t> missing;
  for (const std::size_t row : rows_)
    if (columns_[row].empty()) missing.push_back(row);
  MultiVector unit(free_.node.size()), column;
  for (std::size_t first = 0; first < missing.size(); first += lanes) {
    const std::size_t count = std::min(lanes, missing.size() - first);
    for (auto& values : unit) values.setZero();
    for (std::size_t k = 0; k < count; ++k) unit[missing[first + k]][static_cast<Eigen::Index>(k)] = 1;
    P.apply(unit, column);
    for (std::size_t k = 0; k < count; ++k)
      for (const auto& values : column) columns_[missing[first + k]].push_back(values[static_cast<Eigen::Index>(k)]);
  }
  const auto size = static_cast<Eigen::Index>(rows_.size());
  inverse_.resize(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const std::size_t a = rows_[static_cast<std::size_t>(i)], b = rows_[static_cast<std::size_t>(j)];
      inverse_(i, j) = inverse_(j, i) = (static_cast<double>(columns_[a][b]) + static_cast<double>(columns_[b][a])) / 2;
    }
}

/// aᵀ P⁻¹ b.
double LowRankUpdate::coupling(const Term& a, const Term& b) const {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i)
    for (std::size_t j = 0; j < static_cast<std::size_t>(b.count); ++j)
      sum += inverse_(static_cast<Eigen::Index>(a.at[i]), static_cast<Eigen::Index>(b.at[j])) * a.g[i].dot(b.g[j]);
  return sum;
}

void LowRankUpdate::add_product(const MultiVector& p, MultiVector& q) const {
  for (const Term& term : terms_) {
    double along = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(term.count); ++k)
      along += term.g[k].dot(p[rows_[term.at[k]]].head<3>().cast<double>().matrix());
    for (std::size_t k = 0; k < static_cast<std::size_t>(term.count); ++k)
      q[rows_[term.at[k]]].head<3>() += (term.sign * along * term.g[k]).cast<float>().array();
  }
}

/// part(row): z there.
template <class Part>
void LowRankUpdate::find_forces(const Part& part) {
  Eigen::VectorXd y(static_cast<Eigen::Index>(strong_.size()));
  for (std::size_t t = 0; t < strong_.size(); ++t) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(strong_[t].count); ++k)
      sum += strong_[t].g[k].dot(part(rows_[strong_[t].at[k]]));
    y[static_cast<Eigen::Index>(t)] = sum;
  }
  S_.solveInPlace(y);
  forces_.assign(rows_.size(), Vec3::Zero());
  for (std::size_t t = 0; t < strong_.size(); ++t)
    for (std::size_t k = 0; k < static_cast<std::size_t>(strong_[t].count); ++k)
      forces_[strong_[t].at[k]] += y[static_cast<Eigen::Index>(t)] * strong_[t].g[k];
}

void LowRankUpdate::correct(MultiVector& z) {
  if (strong_.empty()) return;
  find_forces([&](std::size_t row) -> Vec3 { return z[row].head<3>().cast<double>().matrix(); });
  std::vector<Pushed> pushed;
  pushed.reserve(rows_.size() + lanes);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (forces_[k].isZero(0)) continue;  // weak terms alone push there
    const Eigen::Vector3f force = forces_[k].cast<float>();
    pushed.push_back({columns_[rows_[k]].data(), Four{force.x(), force.y(), force.z(), 0}});
  }
  if (pushed.empty()) return;
  while (pushed.size() % lanes != 0) pushed.push_back({pushed[0].column, Four{}});
  team_.parallel_for(z.size(), 1 + update_grain / pushed.size(), [&](std::size_t begin, std::size_t end) {
    if (has_avx2())
      subtract_wide(pushed, z, begin, end);
    else
      subtract(pushed, z, begin, end);
  });
}

void LowRankUpdate::correct(Vector& z) {
  if (strong_.empty()) return;
  const auto place = [&](std::size_t row) { return 3 * free_.node[row]; };
  find_forces([&](std::size_t row) -> Vec3 { return z.segment<3>(place(row)); });
  for (std::size_t k = 0; k < rows_.size(); ++k)
    for (std::size_t row = 0; row < free_.node.size(); ++row)
      z.segment<3>(place(row)) -= static_cast<double>(columns_[rows_[k]][row]) * forces_[k];
}

std::size_t LowRankUpdate::bytes() const {
  std::size_t sum = bytes_of(rows_, forces_) + bytes_of(terms_, strong_) +
                    sizeof(double) * static_cast<std::size_t>(inverse_.size() + S_.rows() * S_.cols());
  for (const auto& column : columns_) sum += bytes_of(column);
  return sum;
}

}  // namespace heml
