#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/bsr_matrix.hpp>
#include <heml/elastic/element_blocks.hpp>
#include <heml/mesh/edit.hpp>

namespace heml {
namespace {

constexpr std::size_t row_grain = 512;  // min. rows per thread, which outweigh the cost of waking it

using Row = Four<float>;

template <class Real>
[[gnu::always_inline]] inline void read_outer_product(const OuterProduct<Real>& outer, float (&g)[10][4], float& k) {
  k = static_cast<float>(outer.k);
  for (std::size_t a = 0; a < 10; ++a)
    for (std::size_t i = 0; i < 3; ++i) g[a][i] = static_cast<float>(outer.g[3 * a + i]);
}

}  // namespace

template <std::size_t nodes>
BsrMatrix::BsrMatrix(const std::vector<int>& number, const std::vector<std::array<int, nodes>>& elements)
    : number_(number), pairs_(nodes * (nodes - 1) / 2) {
  const auto row_of = [&](int node) { return number[static_cast<std::size_t>(node)]; };
  const auto count =
      static_cast<std::size_t>(std::count_if(number.begin(), number.end(), [](int n) { return n >= 0; }));
  std::vector<std::vector<int>> neighbours(count);
  for (const int n : number)
    if (n >= 0) neighbours[static_cast<std::size_t>(n)].push_back(n);
  for (const auto& element : elements)
    for (const int a : element)
      for (const int b : element)
        if (a != b && row_of(a) >= 0 && row_of(b) >= 0)
          neighbours[static_cast<std::size_t>(row_of(a))].push_back(row_of(b));
  start_.assign(1, 0);
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    column_.insert(column_.end(), list.begin(), list.end());
    start_.push_back(static_cast<int>(column_.size()));
  }
  sum_.resize(column_.size());
  entry_.resize(9 * column_.size() + 3);
  for (std::size_t row = 0; row < count; ++row) {
    diagonal_.push_back(find(static_cast<int>(row), static_cast<int>(row)));
    for (auto k = static_cast<std::size_t>(start_[row]); k < static_cast<std::size_t>(start_[row + 1]); ++k)
      mirror_.push_back(find(column_[k], static_cast<int>(row)));
  }
  for (const auto& element : elements)
    for (std::size_t b = 1; b < nodes; ++b)
      for (std::size_t a = 0; a < b; ++a)
        block_indices_.push_back(place_of_pair(row_of(element[a]), row_of(element[b])));
  find_sections(elements);
  set_zero();
}

template <std::size_t nodes>
void BsrMatrix::find_sections(const std::vector<std::array<int, nodes>>& elements) {
  std::vector<SectionMask> section_of(rows());
  for (std::size_t section = 0; section < sections; ++section)
    for (std::size_t row = first_row(section); row < first_row(section + 1); ++row)
      section_of[row] = SectionMask{1} << section;
  for (const auto& element : elements) {
    SectionMask& mask = sections_.emplace_back(0);
    for (const int node : element) {
      const int row = number_[static_cast<std::size_t>(node)];
      mask |= row < 0 ? no_row : section_of[static_cast<std::size_t>(row)];
    }
  }
}

int BsrMatrix::find(int row, int column) const {
  if (row < 0 || column < 0) return -1;
  const auto begin = column_.begin() + start_[static_cast<std::size_t>(row)];
  const auto end = column_.begin() + start_[static_cast<std::size_t>(row) + 1];
  return static_cast<int>(std::lower_bound(begin, end, column) - column_.begin());
}

int BsrMatrix::place_of_pair(int row_a, int row_b) const {
  if (row_a < 0 || row_b < 0)
    return row_a < 0 && row_b < 0 ? -1 : diagonal_[static_cast<std::size_t>(std::max(row_a, row_b))];
  return find(row_a, row_b);
}

void BsrMatrix::keep_elements(const std::vector<int>& elements) {
  block_indices_ = with_elements(block_indices_, elements, pairs_);
  sections_ = with_elements(sections_, elements);
}

void BsrMatrix::set_zero() { std::fill(entry_.begin(), entry_.end(), 0.0f); }

void BsrMatrix::add(int row, int column, const Mat3& B) {
  const int place = find(row, column);
  if (place < 0) return;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) entries(place)[3 * j + i] += static_cast<float>(B(i, j));
}

void BsrMatrix::add_edge(int a, int b, const Mat3& B) {
  const int row = number_[static_cast<std::size_t>(a)], column = number_[static_cast<std::size_t>(b)];
  add(row, row, B);
  add(column, column, B);
  add(row, column, -B);
  add(column, row, -B);
}

void BsrMatrix::add_pair(int a, int b, const Mat3& B) {
  const int row = number_[static_cast<std::size_t>(a)], column = number_[static_cast<std::size_t>(b)];
  add(row, column, B);
  add(column, row, B.transpose());
}

void BsrMatrix::add_node(int node, const Mat3& B) {
  const int row = number_[static_cast<std::size_t>(node)];
  add(row, row, B);
}

void BsrMatrix::add_diagonal(int node, double k) {
  const int row = number_[static_cast<std::size_t>(node)];
  const int place = row < 0 ? -1 : diagonal_[static_cast<std::size_t>(row)];
  for (int i = 0; place >= 0 && i < 3; ++i) entries(place)[4 * i] += static_cast<float>(k);
}

void BsrMatrix::isolate(const std::vector<int>& held) {
  if (held.empty()) return;
  std::vector<std::array<bool, 3>> is_held(rows(), {false, false, false});
  for (const int r : held) is_held[static_cast<std::size_t>(r) / 3][static_cast<std::size_t>(r) % 3] = true;
  for (std::size_t row = 0; row < rows(); ++row)
    for (auto k = static_cast<std::size_t>(start_[row]); k < static_cast<std::size_t>(start_[row + 1]); ++k) {
      const auto column = static_cast<std::size_t>(column_[k]);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          if (!is_held[row][i] && !is_held[column][j]) continue;
          float& entry = entry_[9 * k + 3 * j + i];
          entry = row != column || i != j ? 0 : entry != 0 ? std::abs(entry) : 1;
        }
    }
}

void BsrMatrix::begin_elements(ThreadTeam& team) {
  team.parallel_for(rows(), row_grain, [&](std::size_t begin, std::size_t end) {
    std::fill(sum_.begin() + start_[begin], sum_.begin() + start_[end], Sum{});
  });
}

template <class Real>
[[gnu::always_inline]] inline void BsrMatrix::add_linear(std::size_t begin, std::size_t end, const Real* K,
                                                         const ElementGroup<Real>& group) {
  constexpr std::size_t packet = ElementGroup<Real>::lanes;
  static constexpr int nowhere[6] = {-1, -1, -1, -1, -1, -1};
  const SectionMask mine = (SectionMask{1} << end) - (SectionMask{1} << begin);
  const auto first = static_cast<std::size_t>(start_[first_row(begin)]);
  const auto last = static_cast<std::size_t>(start_[first_row(end)]);
  for (std::size_t s = 0; s < group.size(); s += side_by_side) {
    const int* places[side_by_side];
    SectionMask touched = 0;
    for (std::size_t l = 0; l < side_by_side; ++l) {
      const bool exists = s + l < group.size();
      const auto element = exists ? static_cast<std::size_t>(group.element[s + l]) : 0;
      places[l] = exists ? &block_indices_[6 * element] : nowhere;
      touched |= exists ? sections_[element] : no_row;
    }
    if (!(touched & mine)) continue;
    const Real* const k = K + edge_entries * packet * (s / packet) + s % packet;
    const auto block_of = [&](std::size_t l, std::size_t pair) {
      return static_cast<std::size_t>(static_cast<unsigned>(places[l][pair]));  // −1 becomes the largest
    };
    if (!(touched & ~mine))
      each_column(k, [&](std::size_t pair, int j, const Row(&column)[side_by_side]) {
        for (std::size_t l = 0; l < side_by_side; ++l) sum_[block_of(l, pair)].column[j] += column[l];
      });
    else
      each_column(k, [&](std::size_t pair, int j, const Row(&column)[side_by_side]) {
        for (std::size_t l = 0; l < side_by_side; ++l) {
          const std::size_t block = block_of(l, pair);
          if (block - first < last - first) sum_[block].column[j] += column[l];
        }
      });
  }
}

/// An element at a time.
template <class Real>
[[gnu::always_inline]] inline void BsrMatrix::add_quadratic(std::size_t begin, std::size_t end, const Real* K,
                                                            const ElementGroup<Real>& group,
                                                            const OuterProduct<Real>* outer) {
  constexpr std::size_t packet = ElementGroup<Real>::lanes;
  const SectionMask mine = (SectionMask{1} << end) - (SectionMask{1} << begin);
  const auto first = static_cast<std::size_t>(start_[first_row(begin)]);
  const auto last = static_cast<std::size_t>(start_[first_row(end)]);
  for (std::size_t s = 0; s < group.size(); s += element_points) {
    const auto element = static_cast<std::size_t>(group.element[s]) / element_points;
    if (!(sections_[element] & mine)) continue;
    float g[10][4] = {}, k = 0;
    if (outer) read_outer_product(outer[s / element_points], g, k);
    Row of_corners[4][4][3][3];  // columns
    expand_corners(K + edge_entries * packet * (s / packet) + s % packet, of_corners);
    const int* place = &block_indices_[pairs_ * element];
    for (std::size_t b = 1; b < 10; ++b)
      for (std::size_t a = 0; a < b; ++a, ++place) {
        const std::size_t block = static_cast<unsigned>(*place);  // −1 becomes the largest
        if (!(block - first < last - first)) continue;
        Row columns[3];
        find_quadratic_block(of_corners, a, b, columns);
        if (outer)
          for (int j = 0; j < 3; ++j) columns[j] += read_four(g[a]) * (k * g[b][j]);
        for (int j = 0; j < 3; ++j) sum_[block].column[j] += columns[j];
      }
  }
}

/// Adds the stiffness of a group to the sums of sections [begin, end).
template <class Real>
[[gnu::always_inline]] inline void BsrMatrix::add_to(std::size_t begin, std::size_t end, const Real* K,
                                                     const ElementGroup<Real>& group, const OuterProduct<Real>* outer) {
  if (pairs_ == 6)
    add_linear(begin, end, K, group);
  else
    add_quadratic(begin, end, K, group, outer);
}

template <class Real>
HEML_WIDE void BsrMatrix::add_wide(std::size_t begin, std::size_t end, const Real* K, const ElementGroup<Real>& group,
                                   const OuterProduct<Real>* outer) {
  add_to(begin, end, K, group, outer);
}

template <class Real>
void BsrMatrix::add_elements(const Real* K, const ElementGroup<Real>& group, ThreadTeam& team,
                             const OuterProduct<Real>* outer) {
  assert(!outer || pairs_ == 45);
  // One part a thread: more have longer borders, whose elements two threads compute.
  const std::size_t threads = std::min<std::size_t>(rows() / row_grain, static_cast<std::size_t>(team.limit()));
  const std::size_t parts = std::clamp<std::size_t>(threads, 1, sections);
  team.parallel_for(parts, 1, [&](std::size_t begin, std::size_t end) {
    const std::size_t first = sections * begin / parts, last = sections * end / parts;
    if (has_avx2())
      add_wide(first, last, K, group, outer);
    else
      add_to(first, last, K, group, outer);
  });
}

[[gnu::always_inline]] inline void BsrMatrix::end_rows(std::size_t begin, std::size_t end) {
  for (std::size_t row = begin; row < end; ++row) {
    const auto diagonal = static_cast<std::size_t>(diagonal_[row]);
    Column all[3] = {sum_[diagonal].column[0], sum_[diagonal].column[1], sum_[diagonal].column[2]};
    const auto write = [&](std::size_t block, const Column(&column)[3]) {
      for (std::size_t j = 0; j < 2; ++j) write_four(column[j], &entry_[9 * block + 3 * j]);
      std::memcpy(&entry_[9 * block + 6], &column[2], 3 * sizeof(float));  // what follows may be another thread's
    };
    for (auto k = static_cast<std::size_t>(start_[row]); k < static_cast<std::size_t>(start_[row + 1]); ++k) {
      if (k == diagonal) continue;
      const Sum &here = sum_[k], &there = sum_[static_cast<std::size_t>(mirror_[k])];
      Column turned[4] = {there.column[0], there.column[1], there.column[2], {}}, block[3];
      transpose(turned);
      for (int j = 0; j < 3; ++j) {
        block[j] = here.column[j] + turned[j];
        all[j] += block[j];
      }
      write(k, block);
    }
    Column turned[4] = {all[0], all[1], all[2], {}};
    transpose(turned);
    for (int j = 0; j < 3; ++j) all[j] = -0.5f * (all[j] + turned[j]);
    write(diagonal, all);
  }
}

HEML_WIDE void BsrMatrix::end_wide(std::size_t begin, std::size_t end) { end_rows(begin, end); }

void BsrMatrix::end_elements(ThreadTeam& team) {
  team.parallel_for(rows(), row_grain, [&](std::size_t begin, std::size_t end) {
    if (has_avx2())
      end_wide(begin, end);
    else
      end_rows(begin, end);
  });
}

[[gnu::always_inline]] inline void BsrMatrix::multiply_rows(const MultiVector& x, MultiVector& y, std::size_t begin,
                                                            std::size_t end) const {
  for (std::size_t row = begin; row < end; ++row) {
    Column sum[3] = {};
    for (auto k = static_cast<std::size_t>(start_[row]); k < static_cast<std::size_t>(start_[row + 1]); ++k) {
      const float* block = &entry_[9 * k];  // of each column the last number is another's
      const Column at = read_four(x[static_cast<std::size_t>(column_[k])].data());
      sum[0] += read_four(block) * __builtin_shufflevector(at, at, 0, 0, 0, 0);
      sum[1] += read_four(block + 3) * __builtin_shufflevector(at, at, 1, 1, 1, 1);
      sum[2] += read_four(block + 6) * __builtin_shufflevector(at, at, 2, 2, 2, 2);
    }
    Column all = sum[0] + sum[1] + sum[2];
    all[3] = 0;
    std::memcpy(y[row].data(), &all, sizeof all);
  }
}

HEML_WIDE void BsrMatrix::multiply_wide(const MultiVector& x, MultiVector& y, std::size_t begin,
                                        std::size_t end) const {
  multiply_rows(x, y, begin, end);
}

void BsrMatrix::multiply(const MultiVector& x, MultiVector& y, ThreadTeam& team) const {
  team.parallel_for(rows(), row_grain, [&](std::size_t begin, std::size_t end) {
    if (has_avx2())
      multiply_wide(x, y, begin, end);
    else
      multiply_rows(x, y, begin, end);
  });
}

template BsrMatrix::BsrMatrix(const std::vector<int>&, const std::vector<std::array<int, 4>>&);
template BsrMatrix::BsrMatrix(const std::vector<int>&, const std::vector<std::array<int, 10>>&);
template void BsrMatrix::add_elements(const float*, const ElementGroup<float>&, ThreadTeam&,
                                      const OuterProduct<float>*);
template void BsrMatrix::add_elements(const double*, const ElementGroup<double>&, ThreadTeam&,
                                      const OuterProduct<double>*);

}  // namespace heml
