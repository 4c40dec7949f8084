#include <doctest/doctest.h>

#include <array>
#include <heml/elastic/four.hpp>

namespace heml::four_test {

TEST_CASE_TEMPLATE("four rows transposed are their columns", Real, float, double) {
  std::array<Real, 16> numbers{}, turned{};
  for (std::size_t k = 0; k < 16; ++k) numbers[k] = static_cast<Real>(k);
  Four<Real> rows[4];
  for (std::size_t i = 0; i < 4; ++i) rows[i] = read_four(&numbers[4 * i]);
  transpose(rows);
  for (std::size_t i = 0; i < 4; ++i) write_four(rows[i], &turned[4 * i]);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) CHECK(turned[4 * i + j] == numbers[4 * j + i]);
}

TEST_CASE_TEMPLATE("three coordinates are read without what is behind them", Real, float, double) {
  const std::array<Real, 4> numbers = {1, 2, 3, 4};
  const Four<Real> value = read_three(numbers.data());
  for (int i = 0; i < 3; ++i) CHECK(value[i] == numbers[static_cast<std::size_t>(i)]);
  CHECK(value[3] == 0);
}

}  // namespace heml::four_test
