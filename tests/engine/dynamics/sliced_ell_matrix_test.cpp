#include <doctest/doctest.h>

#include <heml/dynamics/sliced_ell_matrix.hpp>

#include "support.hpp"

namespace heml::sliced_ell_matrix_test {

namespace {

/// Rows of 0 to 29 entries of both signs, in ascending columns.
ScalarMatrix random_matrix(int rows, int columns, std::mt19937_64& random) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < rows; ++row) {
    const int count = row % 7 == 3 ? 0 : row % 30;
    for (int k = 0; k < count; ++k)
      entries.emplace_back(row, static_cast<int>(random() % static_cast<std::uint64_t>(columns)),
                           test::uniform(random, -1, 1));
  }
  ScalarMatrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

MultiVector row_by_row(const ScalarMatrix& A, const MultiVector& x) {
  MultiVector y(static_cast<std::size_t>(A.rows()));
  for (int row = 0; row < A.rows(); ++row) {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (ScalarMatrix::InnerIterator entry(A, row); entry; ++entry)
      sum += static_cast<float>(entry.value()) * x[static_cast<std::size_t>(entry.col())];
    y[static_cast<std::size_t>(row)] = sum;
  }
  return y;
}

}  // namespace

TEST_CASE("products have the bits of row-by-row sums, for any number of rows and threads") {
  std::mt19937_64 random(81);
  for (const int rows : {0, 1, 3, 4, 5, 9000})
    for (const int threads : {1, 2, 3, 5}) {
      CAPTURE(rows);
      CAPTURE(threads);
      const ScalarMatrix A = random_matrix(rows, 700, random);
      const SlicedEllMatrix sliced(A);
      REQUIRE(sliced.rows() == static_cast<std::size_t>(rows));
      MultiVector x(700), y(sliced.rows());
      for (auto& triple : x) triple << test::random_vector(random, 1).cast<float>().array(), 0.0f;
      ThreadTeam team(threads);
      std::vector<int> writes(sliced.rows(), 0);
      sliced.each_product(x, team, [&](std::size_t row, const Eigen::Array4f& sum) {
        y[row] = sum;
        ++writes[row];
      });
      const MultiVector expected = row_by_row(A, x);
      for (std::size_t row = 0; row < y.size(); ++row) {
        CHECK(writes[row] == 1);
        CHECK((y[row] == expected[row]).all());
      }
    }
}

}  // namespace heml::sliced_ell_matrix_test
