#include <algorithm>
#include <cmath>
#include <heml/dynamics/single_precision_cg.hpp>

namespace heml {
namespace {
constexpr std::size_t piece = 256;         // rows per partial sum
constexpr std::size_t update_grain = 512;  // min. rows per thread, which outweigh the cost of a fork
}  // namespace

SinglePrecisionCG::SinglePrecisionCG(const FreeNodes& free, BsrMatrix matrix, ThreadTeam& team)
    : free_(free), team_(team), K_(std::move(matrix)) {
  for (MultiVector* list : {&d_, &left_, &p_, &q_, &z_}) list->resize(K_.rows());
  sums_.resize((K_.rows() + piece - 1) / piece);
  for (const int i : free.held) held_rows_.push_back(free.row_of(i));
}

bool SinglePrecisionCG::assemble(Objective& objective, double shift) {
  if (!objective.assemble_single_precision(K_)) return false;
  if (shift > 0)
    for (const int n : free_.node) K_.add_diagonal(n, shift);
  K_.isolate(held_rows_);
  return true;
}

/// Sum of part(row) over all rows; part may also write its row. Rows are summed in float per axis within fixed pieces,
/// and the pieces in double in ascending order, so the bits do not depend on the number of threads.
template <class Part>
double SinglePrecisionCG::sum(const Part& part) {
  team_.parallel_for(sums_.size(), update_grain / piece, [&](std::size_t begin, std::size_t end) {
    const Part of_row = part;  // a copy that no store may change: its pointers stay in registers
    for (std::size_t k = begin; k < end; ++k) {
      Eigen::Array4f all = Eigen::Array4f::Zero();
      const std::size_t last = std::min(K_.rows(), (k + 1) * piece);
      for (std::size_t row = k * piece; row < last; ++row) all += of_row(row);
      sums_[k] = static_cast<double>(all.sum());
    }
  });
  double all = 0;
  for (const double of_piece : sums_) all += of_piece;
  return all;
}

double SinglePrecisionCG::dot(const MultiVector& a, const MultiVector& b) {
  return sum([a = a.data(), b = b.data()](std::size_t row) -> Eigen::Array4f { return a[row] * b[row]; });
}

bool SinglePrecisionCG::solve(SmoothedAggregation& preconditioner, LowRankUpdate& update, const Vector& r,
                              double tolerance, int max_iterations, Vector& d, long& iterations) {
  const double largest = r.cwiseAbs().maxCoeff(), scale = largest > 0 ? largest : 1;  // keeps values in float's range
  const auto place = [&](std::size_t row) { return 3 * free_.node[row]; };
  double square = sum([&](std::size_t row) -> Eigen::Array4f {
    left_[row] << (r.segment<3>(place(row)) / scale).cast<float>().array(), 0.0f;
    d_[row].setZero();
    return left_[row].square();
  });
  // Columns of P⁻¹ that an update keeps are of a P that no step changes.
  const bool has_own_blocks = preconditioner.levels() > 1 && update.empty();
  if (has_own_blocks) finest_.set(K_, preconditioner.diagonal(), team_);
  const double enough = tolerance * tolerance * square;
  bool positive = true;
  double progress = 0;
  for (int k = 0; k < max_iterations && square > enough; ++k) {
    if (has_own_blocks) {
      preconditioner.apply(finest_, left_, z_);
    } else {
      preconditioner.apply(left_, z_);
      update.correct(z_);
    }
    for (const int row : held_rows_) z_[static_cast<std::size_t>(row) / 3][row % 3] = 0;
    const double next = dot(left_, z_);
    const auto turn = static_cast<float>(k > 0 ? next / progress : 0);
    progress = next;
    team_.parallel_for(K_.rows(), update_grain, [&](std::size_t begin, std::size_t end) {
      const Eigen::Array4f* z = z_.data();
      Eigen::Array4f* p = p_.data();
      if (k == 0)
        std::copy(z + begin, z + end, p + begin);
      else
        for (std::size_t row = begin; row < end; ++row) p[row] = z[row] + turn * p[row];
    });
    K_.multiply(p_, q_, team_);
    update.add_product(p_, q_);
    ++iterations;
    const double curvature = dot(p_, q_);
    positive = curvature > 0 && progress > 0;
    if (!positive) {
      if (k == 0) d_ = p_;
      break;
    }
    const auto step = static_cast<float>(progress / curvature);
    square = sum([step, d = d_.data(), left = left_.data(), p = p_.data(), q = q_.data()](std::size_t row) {
      d[row] += step * p[row];
      left[row] -= step * q[row];
      return Eigen::Array4f(left[row].square());
    });
  }
  d.setZero(r.size());
  team_.parallel_for(K_.rows(), update_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      d.segment<3>(place(row)) = scale * d_[row].head<3>().cast<double>().matrix();
  });
  return positive;
}

}  // namespace heml
