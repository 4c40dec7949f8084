// Nonlinear least squares against closed forms and tables.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <heml/math/least_squares.hpp>

namespace heml::least_squares_test {

using Eigen::VectorXd;

TEST_CASE("least squares: a line through points has the value, errors and residuals of linear regression") {
  const VectorXd x = VectorXd::LinSpaced(9, 0, 4);
  const VectorXd y = (1.5 + 0.7 * x.array() + 0.1 * (5 * x.array()).sin()).matrix();
  const LeastSquaresFit fit = minimise_squares(
      {[&](const VectorXd& u) { return (u[0] + u[1] * x.array() - y.array()).matrix().eval(); }}, VectorXd::Zero(2));
  Eigen::MatrixXd A(9, 2);
  A << VectorXd::Ones(9), x;
  const VectorXd exact = (A.transpose() * A).inverse() * A.transpose() * y;
  CHECK(fit.converged);
  CHECK((fit.u - exact).norm() < 1e-9);
  const Eigen::MatrixXd inverse = (A.transpose() * A).inverse();
  const double variance = (A * exact - y).squaredNorm() / 7;
  const Certainty estimated = certainty(fit), given = certainty(fit, 4);
  for (int i = 0; i < 2; ++i) {
    CHECK(estimated.error[i] == doctest::Approx(std::sqrt(variance * inverse(i, i))).epsilon(1e-6));
    CHECK(given.error[i] == doctest::Approx(2 * std::sqrt(inverse(i, i))).epsilon(1e-6));
    CHECK(!given.undetermined[static_cast<std::size_t>(i)]);
  }
}

TEST_CASE("least squares: a curved valley is followed to its end, round where residuals are undefined") {
  const auto valley = [](const VectorXd& u) -> std::optional<VectorXd> {
    if (u[0] < -1.5) return std::nullopt;
    return VectorXd{{10 * (u[1] - u[0] * u[0]), 1 - u[0]}};
  };
  const LeastSquaresFit fit = minimise_squares({valley}, VectorXd{{-1.2, 1.0}});
  CHECK(fit.converged);
  CHECK((fit.u - VectorXd::Ones(2)).norm() < 1e-8);
}

TEST_CASE("least squares: two moduli are found from starts 100 times too small to 100 times too large") {
  const double first = 1000, second = 300;
  // Stretches of nine parts that both moduli resist, the second more from part to part.
  const auto stretches = [](double a, double b) -> VectorXd {
    return (a + b * VectorXd::LinSpaced(9, 0.5, 1.5).array()).pow(-1.0 / 3);
  };
  const VectorXd measured = stretches(first, second);
  const auto misfit = [&](const VectorXd& u) -> std::optional<VectorXd> {
    return VectorXd(stretches(std::exp(u[0]), std::exp(u[1])) - measured);
  };
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) {
      CAPTURE(i);
      CAPTURE(k);
      const VectorXd start{{std::log(first * std::pow(10, 0.5 * i)), std::log(second * std::pow(10, 0.5 * k))}};
      const LeastSquaresFit fit = minimise_squares({misfit}, start);
      CHECK(fit.converged);
      CHECK(fit.iterations < 40);
      CHECK(fit.u[0] == doctest::Approx(std::log(first)).epsilon(1e-4));
      CHECK(fit.u[1] == doctest::Approx(std::log(second)).epsilon(1e-4));
    }
}

TEST_CASE("least squares: a variable that begins at 0 is found far away") {
  const VectorXd x = VectorXd::LinSpaced(9, 0, 1);
  const LeastSquaresFit fit = minimise_squares(
      {[&](const VectorXd& u) { return ((u[0] - 4000) * x.array()).matrix().eval(); }}, VectorXd::Zero(1));
  CHECK(fit.converged);
  CHECK(fit.iterations < 40);
  CHECK(fit.u[0] == doctest::Approx(4000));
}

TEST_CASE("least squares: a search ends where residuals are no numbers, and has not converged there") {
  const auto wall = [](const VectorXd& u) -> std::optional<VectorXd> {
    return VectorXd{{u[0] - 3, std::abs(u[0]) < 0.1 ? 0 : std::nan("")}};
  };
  const LeastSquaresFit fit = minimise_squares({wall}, VectorXd::Zero(1));
  CHECK_FALSE(fit.converged);
  CHECK(fit.u[0] == doctest::Approx(0.1).epsilon(0.01));
}

TEST_CASE("least squares: variables that the data tell only together are undetermined, others are not") {
  const auto product = [](const VectorXd& u) -> std::optional<VectorXd> {
    return VectorXd{{u[0] + u[1] - 3, 2 * (u[0] + u[1]) - 6.1, u[2] - 1}};
  };
  const LeastSquaresFit fit = minimise_squares({product}, VectorXd::Zero(3));
  const Certainty certain = certainty(fit, 1);
  CHECK(certain.undetermined == std::vector<bool>{true, true, false});
  CHECK(certain.error[2] == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("least squares: Student's quantile is that of tables") {
  const std::pair<long, double> table[] = {{1, 12.7062}, {2, 4.3027},  {4, 2.7764},   {5, 2.5706},
                                           {10, 2.2281}, {30, 2.0423}, {100, 1.9840}, {1000000, 1.9600}};
  for (const auto& [freedom, value] : table) CHECK(student_quantile(freedom) == doctest::Approx(value).epsilon(3e-4));
  CHECK(student_quantile(3) == doctest::Approx(3.1824).epsilon(2e-3));
}

}  // namespace heml::least_squares_test
