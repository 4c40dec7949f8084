#include <algorithm>
#include <atomic>
#include <cmath>
#include <heml/dynamics/nested_dissection.hpp>
#include <heml/dynamics/supernodal_ldlt.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr std::size_t min_dissected_nodes = 4000;  // below, minimum degree alone has less work
constexpr double min_parallel_work = 2e6;          // multiplications of a factor that is worth more than one thread
constexpr std::size_t max_subtrees = 16;
constexpr double min_subtree = 1.0 / 48;         // of all multiplications: a smaller subtree is not divided
constexpr std::size_t min_parallel_strips = 16;  // per thread, of a front
constexpr std::size_t block_strips = 8;          // of pivots that are reduced together
constexpr double min_parallel_front = 1e6;       // size of its panel times its strips

NodeGraph graph_of(const BlockMatrix& matrix) {
  const std::size_t count = matrix.free().node.size();
  NodeGraph graph;
  graph.start.assign(count + 1, 0);
  for (std::size_t c = 0; c < count; ++c)
    for (const int r : matrix.later_neighbours(c)) {
      ++graph.start[c + 1];
      ++graph.start[static_cast<std::size_t>(r) + 1];
    }
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
  graph.neighbour.resize(static_cast<std::size_t>(graph.start.back()));
  std::vector<int> next(graph.start.begin(), graph.start.end() - 1);
  const auto add = [&](std::size_t from, std::size_t to) {
    graph.neighbour[static_cast<std::size_t>(next[from]++)] = static_cast<int>(to);
  };
  for (std::size_t c = 0; c < count; ++c)
    for (const int r : matrix.later_neighbours(c)) {
      add(c, static_cast<std::size_t>(r));
      add(static_cast<std::size_t>(r), c);
    }
  return graph;
}

/// Of two orders, the one with less work. Nested dissection wins in large bodies that are not long.
Supernodes supernodes_of(const BlockMatrix& pattern, const std::vector<Vec3>& position) {
  const NodeGraph graph = graph_of(pattern);
  Supernodes by_degree(graph, minimum_degree(graph));
  if (graph.size() < min_dissected_nodes) return by_degree;
  Supernodes dissected(graph, nested_dissection(graph, position));
  return dissected.work() < by_degree.work() ? dissected : by_degree;
}

/// Row of a front with padding after the pivots. node: place in the front.
std::size_t padded_row(std::size_t node, std::size_t axis, std::size_t pivots, std::size_t pivot_strips) {
  const std::size_t row = 3 * node + axis;
  return row < pivots ? row : strip_rows * pivot_strips + row - pivots;
}

}  // namespace

SupernodalLdlt::SupernodalLdlt(const BlockMatrix& pattern, const std::vector<Vec3>& position, InstructionSet isa,
                               ThreadTeam& team)
    : supernodes_(supernodes_of(pattern, position)),
      kernels_(front_kernels(resolve(isa))),
      team_(team),
      multiplications_(supernodes_.work()),
      children_(supernodes_.size()),
      pivots_(3 * static_cast<Eigen::Index>(supernodes_.order.size())) {
  for (std::size_t s = 0; s < supernodes_.size(); ++s)
    if (supernodes_.parent[s] >= 0) children_[static_cast<std::size_t>(supernodes_.parent[s])].push_back(s);
  find_entries(pattern);
  find_relative_rows();
  find_tasks();
  find_places();
}

void SupernodalLdlt::find_entries(const BlockMatrix& pattern) {
  const std::size_t count = supernodes_.order.size();
  std::vector<int> place(count), supernode_of(count);
  for (std::size_t s = 0; s < supernodes_.size(); ++s)
    for (int k = supernodes_.first[s]; k < supernodes_.first[s + 1]; ++k) {
      supernode_of[static_cast<std::size_t>(k)] = static_cast<int>(s);
      place[static_cast<std::size_t>(supernodes_.order[static_cast<std::size_t>(k)])] = k;
    }
  std::vector<std::vector<Entry>> of(supernodes_.size());
  const auto add = [&](std::size_t column, int neighbour, int nth) {
    const int at_row = place[static_cast<std::size_t>(neighbour)], at_column = place[column];
    const int early = std::min(at_row, at_column), late = std::max(at_row, at_column);
    const auto s = static_cast<std::size_t>(supernode_of[static_cast<std::size_t>(early)]);
    const int first = supernodes_.first[s], last = supernodes_.first[s + 1];
    const auto rows = supernodes_.rows(s);
    const auto below = static_cast<int>(std::lower_bound(rows.begin(), rows.end(), late) - rows.begin());
    const int row = late < last ? late - first : last - first + below;
    of[s].push_back({row, early - first, static_cast<int>(column), nth, at_row < at_column});
  };
  for (std::size_t c = 0; c < count; ++c) {
    add(c, static_cast<int>(c), -1);
    const auto neighbours = pattern.later_neighbours(c);
    for (std::size_t n = 0; n < neighbours.size(); ++n) add(c, neighbours[n], static_cast<int>(n));
  }
  for (const auto& list : of) {
    entries_.insert(entries_.end(), list.begin(), list.end());
    entry_start_.push_back(entries_.size());
  }
}

void SupernodalLdlt::find_relative_rows() {
  relative_.resize(supernodes_.row.size());
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    if (supernodes_.parent[s] < 0) continue;
    const auto parent = static_cast<std::size_t>(supernodes_.parent[s]);
    const int first = supernodes_.first[parent], last = supernodes_.first[parent + 1];
    const auto above = supernodes_.rows(parent);
    auto found = above.begin();
    for (int r = supernodes_.row_start[s]; r < supernodes_.row_start[s + 1]; ++r) {
      const int k = supernodes_.row[static_cast<std::size_t>(r)];
      found = std::lower_bound(found, above.end(), k);
      relative_[static_cast<std::size_t>(r)] =
          k < last ? k - first : last - first + static_cast<int>(found - above.begin());
    }
  }
}

/// Divides the heaviest subtree until there are enough; those divided are above.
void SupernodalLdlt::find_tasks() {
  const std::size_t count = supernodes_.size();
  std::vector<double> work(count);
  std::vector<std::size_t> begin(count), roots;
  for (std::size_t s = 0; s < count; ++s) {
    work[s] = supernodes_.work(s);
    begin[s] = children_[s].empty() ? s : begin[children_[s].front()];
    for (const std::size_t child : children_[s]) work[s] += work[child];
    if (supernodes_.parent[s] < 0) roots.push_back(s);
  }
  if (multiplications_ < min_parallel_work) {
    top_.supernodes.resize(count);
    std::iota(top_.supernodes.begin(), top_.supernodes.end(), std::size_t{0});
    return;
  }
  while (!roots.empty() && roots.size() < max_subtrees) {
    const auto heaviest =
        std::max_element(roots.begin(), roots.end(), [&](std::size_t a, std::size_t b) { return work[a] < work[b]; });
    const std::size_t s = *heaviest;
    if (work[s] < min_subtree * multiplications_) break;
    top_.supernodes.push_back(s);
    roots.erase(heaviest);
    roots.insert(roots.end(), children_[s].begin(), children_[s].end());
  }
  std::sort(top_.supernodes.begin(), top_.supernodes.end());
  std::sort(roots.begin(), roots.end());
  for (const std::size_t root : roots) {
    subtrees_.emplace_back();
    for (std::size_t s = begin[root]; s <= root; ++s) subtrees_.back().supernodes.push_back(s);
  }
}

/// Update matrices of a task lie on two stacks, those of even and of odd depth in the tree: when a front is processed,
/// the update matrices of its children are on top of one stack, and its own goes on the other.
void SupernodalLdlt::find_places() {
  const std::size_t count = supernodes_.size();
  update_start_.resize(count);
  std::vector<std::size_t> depth(count, 0), size(count), panel(count);
  for (std::size_t s = count; s-- > 0;)
    if (supernodes_.parent[s] >= 0) depth[s] = depth[static_cast<std::size_t>(supernodes_.parent[s])] + 1;
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t pivots = strips_of(3 * supernodes_.columns(s)),
                      updates = strips_of(3 * supernodes_.rows(s).size());
    size[s] = triangle_size(updates);
    panel[s] = (pivots + updates) * pivots * strip_rows * strip_rows;
    panel_start_.push_back(panel_start_.back() + panel[s]);
  }
  std::size_t updates = 0, scaled = 0;
  std::vector<char> in_task(count, 0);
  const auto place = [&](Task& task) {
    std::array<std::size_t, 2> top{}, peak{};
    std::size_t largest = 0;
    for (const std::size_t s : task.supernodes) {
      in_task[s] = 1;
      const std::size_t own = depth[s] % 2;
      update_start_[s] = top[own];
      top[own] += size[s];
      peak[own] = std::max(peak[own], top[own]);
      for (const std::size_t child : children_[s])
        if (in_task[child]) top[1 - own] -= size[child];
      largest = std::max(largest, panel[s]);
    }
    for (const std::size_t s : task.supernodes) {
      update_start_[s] += updates + (depth[s] % 2 ? peak[0] : 0);
      in_task[s] = 0;
    }
    updates += peak[0] + peak[1];
    task.scaled = scaled;
    scaled += largest;
  };
  for (Task& task : subtrees_) place(task);
  place(top_);
  panels_.resize(panel_start_.back());
  updates_.resize(updates);
  scaled_.resize(scaled);
}

Front SupernodalLdlt::front(std::size_t s, const Task& task) {
  Front f;
  f.pivots = 3 * supernodes_.columns(s);
  f.pivot_strips = strips_of(f.pivots);
  f.update_strips = strips_of(3 * supernodes_.rows(s).size());
  f.panel = panels_.data() + panel_start_[s];
  f.update = updates_.data() + update_start_[s];
  f.pivot = pivots_.data() + 3 * supernodes_.first[s];
  f.scaled = scaled_.data() + task.scaled;
  return f;
}

void SupernodalLdlt::assemble(std::size_t s, const Front& f, const BlockMatrix& matrix) const {
  std::fill_n(f.panel, f.panel_size(), 0.0);
  std::fill_n(f.update, triangle_size(f.update_strips), 0.0);
  const auto place = [&](int node, std::size_t axis) {
    const std::size_t row = padded_row(static_cast<std::size_t>(node), axis, f.pivots, f.pivot_strips);
    return f.panel + row / strip_rows * f.strip_size() + row % strip_rows;
  };
  for (std::size_t e = entry_start_[s]; e < entry_start_[s + 1]; ++e) {
    const Entry& entry = entries_[e];
    for (std::size_t j = 0; j < 3; ++j) {
      const double* from = matrix.block_column(static_cast<std::size_t>(entry.matrix_column), entry.place, j);
      for (std::size_t i = entry.place < 0 ? j : 0; i < 3; ++i) {
        const std::size_t row = entry.transposed ? j : i, column = entry.transposed ? i : j;
        place(entry.row, row)[strip_rows * (3 * static_cast<std::size_t>(entry.column) + column)] += from[i];
      }
    }
  }
}

/// Adds the update matrix of a child to a front.
void SupernodalLdlt::add_update(std::size_t child, std::size_t s, const Front& to, Task& task) const {
  const auto begin = static_cast<std::size_t>(supernodes_.row_start[child]);
  const std::size_t nodes = supernodes_.rows(child).size(), count = 3 * nodes;
  const auto columns = static_cast<int>(supernodes_.columns(s));
  task.row_offset.resize(3 * count);
  std::size_t* const column_offset = task.row_offset.data();
  std::size_t *const in_panel = column_offset + count, *const in_update = in_panel + count;
  std::size_t among_pivots = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    const int node = relative_[begin + n];
    among_pivots += node < columns ? 3 : 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t row = padded_row(static_cast<std::size_t>(node), i, to.pivots, to.pivot_strips);
      in_panel[3 * n + i] = row / strip_rows * to.strip_size() + row % strip_rows;
      column_offset[3 * n + i] = strip_rows * row;
      if (node < columns) continue;
      const std::size_t update = row - strip_rows * to.pivot_strips;
      in_update[3 * n + i] = triangle_size(update / strip_rows) + update % strip_rows;
      column_offset[3 * n + i] = strip_rows * update;
    }
  }
  for (std::size_t t = 0; t < strips_of(count); ++t) {
    const std::size_t first = strip_rows * t, last = std::min(first + strip_rows, count);
    const double* from = updates_.data() + update_start_[child] + triangle_size(t);
    const auto add_columns = [&](std::size_t j, std::size_t end, double* target, const std::size_t* offset) {
      if (last == first + strip_rows)
        for (; j < std::min(end, first); ++j)
          for (std::size_t r = 0; r < strip_rows; ++r)
            target[column_offset[j] + offset[first + r]] += from[strip_rows * j + r];
      for (; j < end; ++j)
        for (std::size_t r = std::max(first, j); r < last; ++r)
          target[column_offset[j] + offset[r]] += from[strip_rows * j + r - first];
    };
    add_columns(0, std::min(among_pivots, last), to.panel, in_panel);
    add_columns(among_pivots, last, to.update, in_update);
  }
}

/// alone: no other thread works on the factor, so all may work on this front.
void SupernodalLdlt::eliminate(const Front& f, bool alone) const {
  const bool parallel =
      alone && static_cast<double>(f.panel_size()) * static_cast<double>(f.strips()) >= min_parallel_front;
  const auto each = [&](std::size_t first, std::size_t last, const auto& body) {
    if (!parallel) return body(StripRange{first, last});
    team_.parallel_for(last - first, min_parallel_strips, [&](std::size_t from, std::size_t to) {
      body(StripRange{first + from, first + to});
    });
  };
  for (std::size_t from = 0; from < f.pivot_strips; from += block_strips) {
    const StripRange block{from, std::min(from + block_strips, f.pivot_strips)};
    if (from > 0) each(from, f.strips(), [&](StripRange rows) { kernels_.reduce(f, block, rows); });
    for (std::size_t strip = block.first; strip < block.last; ++strip) {
      kernels_.factor_diagonal(f, from, strip);
      each(strip + 1, f.strips(), [&](StripRange rows) { kernels_.factor_below(f, from, strip, rows); });
    }
  }
  each(0, f.update_strips, [&](StripRange rows) { kernels_.subtract(f, rows); });
}

bool SupernodalLdlt::process(std::size_t s, Task& task, const BlockMatrix& matrix, bool alone) {
  const Front f = front(s, task);
  assemble(s, f, matrix);
  for (const std::size_t child : children_[s]) add_update(child, s, f, task);
  eliminate(f, alone);
  return std::all_of(f.pivot, f.pivot + f.pivots, [](double d) { return std::isfinite(d) && d != 0; });
}

bool SupernodalLdlt::factor(const BlockMatrix& matrix) {
  std::atomic<bool> done = true;
  const auto run = [&](Task& task, bool alone) {
    for (const std::size_t s : task.supernodes)
      if (!done || !process(s, task, matrix, alone)) return done.store(false);
  };
  team_.parallel_for(subtrees_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) run(subtrees_[t], false);
  });
  run(top_, true);
  return done;
}

void SupernodalLdlt::solve(Eigen::VectorXd& b, const Eigen::VectorXd& divisors) const {
  const auto& order = supernodes_.order;
  auto* self = const_cast<SupernodalLdlt*>(this);
  Eigen::VectorXd& x = ordered_;
  x.resize(b.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    x.segment<3>(3 * static_cast<Eigen::Index>(k)) = b.segment<3>(3 * order[k]);
  const auto visit = [&](std::size_t s, bool down) {
    const Front f = self->front(s, top_);
    const auto rows = supernodes_.rows(s);
    front_vector_.assign(strip_rows * f.strips(), 0.0);
    double* z = front_vector_.data();
    double* updates = z + strip_rows * f.pivot_strips;
    double* own = x.data() + 3 * supernodes_.first[s];
    std::copy_n(own, f.pivots, z);
    if (down) {
      kernels_.forward(f, z);
      for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t i = 0; i < 3; ++i) x[3 * rows[r] + static_cast<int>(i)] += updates[3 * r + i];
    } else {
      for (std::size_t r = 0; r < rows.size(); ++r) std::copy_n(x.data() + 3 * rows[r], 3, updates + 3 * r);
      kernels_.backward(f, z);
    }
    std::copy_n(z, f.pivots, own);
  };
  for (std::size_t s = 0; s < supernodes_.size(); ++s) visit(s, true);
  x.array() /= divisors.array();
  for (std::size_t s = supernodes_.size(); s-- > 0;) visit(s, false);
  for (std::size_t k = 0; k < order.size(); ++k)
    b.segment<3>(3 * order[k]) = x.segment<3>(3 * static_cast<Eigen::Index>(k));
}

std::size_t SupernodalLdlt::bytes() const {
  return bytes_of(supernodes_.order, supernodes_.row, relative_, entries_, panels_, updates_, scaled_) +
         bytes_of(pivots_) + bytes_of(ordered_);
}

}  // namespace heml
