// SPDX-License-Identifier: GPL-3.0-or-later
// Aggregation multigrid for flow through a gap, whose conductances span many decades.
#include "flow_multigrid.hpp"

#include <algorithm>
#include <array>
#include <salebra/base/parallel.hpp>
#include <utility>

namespace salebra::detail {
namespace {

// Two unknowns are joined if the conductance between them is at least this fraction of the total
// conductance, to all neighbours, of the one that conducts less. Between two cells with gaps g_1
// and g_2 the fraction is a quarter or more: the face conducts 2 g_1³ g_2³/(g_1³ + g_2³) >= min g³,
// and no face of a cell with gap g conducts more than 2 g³.
constexpr double min_part = 0.1;
constexpr Index max_members = 4;
// A block with more unknowns than this is split into pieces of this size, because all pairs of
// unknowns in a piece are compared.
constexpr std::size_t block_piece = 64;
// A grid level with at most this many unknowns is solved directly.
constexpr Index few_unknowns = 200;
// Relative amount added to the diagonal of the coarsest matrix: without it the pressure of each
// connected part of the fluid is undetermined.
constexpr double diagonal_shift = 1e-6;
// A grid level is solved by at most two steps of conjugate gradients. The second is skipped if the
// first reduces the squared residual to this fraction.
constexpr double first_is_enough = 0.2 * 0.2;
constexpr Index max_slabs = 32;

// Visits rows of unknowns in slabs of two alternating colours. Slabs of one colour do not touch, so
// threads may work on them at the same time. The number of slabs does not depend on the number of
// threads.
template <bool forward, class Body>
void visit_by_colours(Index rows, Index unknowns, const Body& body) {
  const auto visit = [&](Index begin, Index end) {
    if constexpr (forward)
      for (Index row = begin; row < end; ++row) body(row);
    else
      for (Index row = end; row-- > begin;) body(row);
  };
  const Index slabs = std::min(max_slabs, rows / 4 * 2);
  if (slabs < 2) return visit(0, rows);
  for (const Index colour : {forward ? 0 : 1, forward ? 1 : 0})
    parallel::for_slabs(
        slabs / 2,
        [&](Index begin, Index end) {
          for (Index slab = 2 * begin + colour; slab < 2 * end; slab += 2)
            visit(rows * slab / slabs, rows * (slab + 1) / slabs);
        },
        unknowns / 2);
}

// Calls body(left, right, k) for each cell k of a row of a periodic grid, with its neighbours in
// the row, forwards or backwards.
template <bool forward, class Body>
void visit_row(Index first, Index columns, const Body& body) {
  const Index last = first + columns - 1;
  if (columns == 1) return body(first, first, first);
  if constexpr (forward) {
    body(last, first + 1, first);
    for (Index k = first + 1; k < last; ++k) body(k - 1, k + 1, k);
    body(last - 1, first, last);
  } else {
    body(last - 1, first, last);
    for (Index k = last - 1; k > first; --k) body(k - 1, k + 1, k);
    body(last, first + 1, first);
  }
}

struct RowsAround {
  Index here, above, below;  // first cells of this row and its two neighbours
};
RowsAround rows_around(Index row, Index rows, Index columns) {
  return {row * columns, (row == 0 ? rows - 1 : row - 1) * columns,
          (row == rows - 1 ? 0 : row + 1) * columns};
}

// Returns the sums Σab and Σcd over `count` numbers.
std::array<double, 2> two_products(Index count, const double* a, const double* b, const double* c,
                                   const double* d) {
  std::array<double, 2> total{};
  for (const auto& part : parallel::map_blocks<std::array<double, 2>>(
           count,
           [&](Index begin, Index end) {
             std::array<double, 2> sums{};
             for (Index k = begin; k < end; ++k) {
               sums[0] += a[k] * b[k];
               sums[1] += c[k] * d[k];
             }
             return sums;
           },
           count)) {
    total[0] += part[0];
    total[1] += part[1];
  }
  return total;
}

// Joins the unknowns of a block to groups, pair by pair, the pair with the largest conductance
// first.
class BlockGroups {
 public:
  void start() {
    count_ = 0;
    unknowns_.clear();
  }
  void add(std::int32_t unknown, double leaves) {
    unknowns_.push_back(unknown);
    leaves_[count_] = leaves;
    members_[count_] = 1;
    group_[count_] = count_;
    for (std::size_t other = 0; other <= count_; ++other)
      between_[count_][other] = between_[other][count_] = 0;
    ++count_;
  }
  std::span<const std::int32_t> unknowns() const { return unknowns_; }
  std::size_t group(std::size_t index) const { return group_[index]; }
  void connect(std::size_t index, std::int32_t neighbour, double conductance) {
    const auto found = std::ranges::find(unknowns_, neighbour);
    if (found != unknowns_.end())
      between_[index][static_cast<std::size_t>(found - unknowns_.begin())] += conductance;
  }

  void join() {
    for (;;) {
      double best = min_part;
      std::size_t first = count_, second = count_;
      for (std::size_t a = 0; a < count_; ++a)
        for (std::size_t b = 0; group_[a] == a && b < a; ++b) {
          if (group_[b] != b || members_[a] + members_[b] > max_members) continue;
          const double part = between_[a][b] / std::min(leaves_[a], leaves_[b]);
          if (part > best) {
            best = part;
            first = b;
            second = a;
          }
        }
      if (first == count_) return;
      leaves_[first] = std::max(0.0, leaves_[first] - between_[first][second]) +
                       std::max(0.0, leaves_[second] - between_[first][second]);
      members_[first] += members_[second];
      for (std::size_t other = 0; other < count_; ++other) {
        between_[first][other] += between_[second][other];
        between_[other][first] = between_[first][other];
        if (group_[other] == second) group_[other] = first;
      }
    }
  }

 private:
  std::size_t count_ = 0;
  std::vector<std::int32_t> unknowns_;
  std::array<std::size_t, block_piece> group_;  // index of the first member of each group
  std::array<double, block_piece> leaves_;      // conductance to unknowns of other groups
  std::array<Index, block_piece> members_;
  std::array<std::array<double, block_piece>, block_piece> between_;
};

}  // namespace

// Calls body(neighbour, conductance) for each neighbour of unknown k.
template <class Body>
void FlowMultigrid::for_neighbours(const Level& level, Index k, const Body& body) {
  const auto at = [](Index index) { return static_cast<std::size_t>(index); };
  if (level.is_finest()) {
    const Index row = k / level.columns, column = k % level.columns;
    const auto [here, above, below] = rows_around(row, level.rows(), level.columns);
    const Index left = here + (column == 0 ? level.columns : column) - 1;
    const Index right = here + (column == level.columns - 1 ? 0 : column + 1);
    const auto face = [&](Index neighbour, double conductance) {
      if (neighbour != k && conductance > 0) body(neighbour, conductance);
    };
    face(above + column, level.to_next_x[above + column]);
    face(left, level.to_next_y[left]);
    face(right, level.to_next_y[k]);
    face(below + column, level.to_next_x[k]);
    return;
  }
  for (Node e = level.begins[at(k)]; e < level.begins[at(k + 1)]; ++e)
    body(Index{level.neighbours[at(e)]}, level.conductances[at(e)]);
}

void FlowMultigrid::allocate(Level& level) {
  const auto count = static_cast<std::size_t>(level.unknowns());
  level.r.resize(count);
  if (!level.is_finest())
    for (Vector* vector : {&level.x, &level.b, &level.c1, &level.c2, &level.v1, &level.v2})
      vector->resize(count);
  level.inverse_diagonal.resize(count);
  parallel::for_slabs(
      level.unknowns(),
      [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
          double sum = 0;
          for_neighbours(level, k, [&](Index, double conductance) { sum += conductance; });
          level.inverse_diagonal[static_cast<std::size_t>(k)] = sum > 0 ? 1 / sum : 0;
        }
      },
      level.unknowns());
}

FlowMultigrid::Level FlowMultigrid::finest_level(const FaceConductances& faces) {
  Level level;
  level.columns = faces.x.cols();
  const Index rows = faces.x.rows();
  for (Index row = 0; row <= rows; ++row)
    level.row_begins.push_back(static_cast<Node>(row * level.columns));
  level.to_next_x = faces.x.data();
  level.to_next_y = faces.y.data();
  allocate(level);
  return level;
}

FlowMultigrid::Level FlowMultigrid::coarser(Level& fine) {
  Level level;
  connect(fine, group(fine, level), level);
  allocate(level);
  return level;
}

std::vector<FlowMultigrid::Node> FlowMultigrid::group(Level& fine, Level& level) {
  const auto at = [](Index index) { return static_cast<std::size_t>(index); };
  const auto column_of = [&](Index k) {
    return fine.is_finest() ? static_cast<Node>(k % fine.columns) : fine.block_column[at(k)];
  };
  std::vector<Node> coarse_of(at(fine.unknowns()), -1);
  BlockGroups groups;
  const auto close = [&](Node block) {
    for (std::size_t index = 0; index < groups.unknowns().size(); ++index)
      for_neighbours(fine, groups.unknowns()[index], [&](Index neighbour, double conductance) {
        groups.connect(index, static_cast<Node>(neighbour), conductance);
      });
    groups.join();
    for (std::size_t first = 0; first < groups.unknowns().size(); ++first) {
      if (groups.group(first) != first) continue;
      const auto coarse = static_cast<Node>(level.block_column.size());
      level.block_column.push_back(block);
      fine.member_begins.push_back(static_cast<Node>(fine.members.size()));
      for (std::size_t index = first; index < groups.unknowns().size(); ++index) {
        if (groups.group(index) != first) continue;
        fine.members.push_back(groups.unknowns()[index]);
        coarse_of[at(groups.unknowns()[index])] = coarse;
      }
    }
    groups.start();
  };
  for (Index row = 0; row < fine.rows(); row += 2) {
    level.row_begins.push_back(static_cast<Node>(level.block_column.size()));
    const Index middle = fine.row_begins[at(row + 1)];
    const Index end = fine.row_begins[at(std::min(row + 2, fine.rows()))];
    for (Index upper = fine.row_begins[at(row)], lower = middle; upper < middle || lower < end;) {
      Node block = upper < middle ? column_of(upper) / 2 : column_of(lower) / 2;
      if (lower < end) block = std::min(block, static_cast<Node>(column_of(lower) / 2));
      const auto take = [&](Index& next, Index stop) {
        for (; next < stop && column_of(next) / 2 == block; ++next) {
          const double inverse = fine.inverse_diagonal[at(next)];
          if (inverse == 0) continue;
          if (groups.unknowns().size() == block_piece) close(block);
          groups.add(static_cast<Node>(next), 1 / inverse);
        }
      };
      take(upper, middle);
      take(lower, end);
      close(block);
    }
  }
  level.row_begins.push_back(static_cast<Node>(level.block_column.size()));
  fine.member_begins.push_back(static_cast<Node>(fine.members.size()));
  return coarse_of;
}

void FlowMultigrid::connect(const Level& fine, const std::vector<Node>& coarse_of, Level& level) {
  const auto at = [](Index index) { return static_cast<std::size_t>(index); };
  level.begins.push_back(0);
  std::vector<Node> place_of(level.block_column.size(), -1);
  for (Index k = 0; k < level.unknowns(); ++k) {
    const auto first = static_cast<Node>(level.neighbours.size());
    for (Node m = fine.member_begins[at(k)]; m < fine.member_begins[at(k + 1)]; ++m)
      for_neighbours(fine, fine.members[at(m)], [&](Index neighbour, double conductance) {
        const Node coarse = coarse_of[at(neighbour)];
        if (coarse == k) return;
        Node& index = place_of[at(coarse)];
        if (index < first) {
          index = static_cast<Node>(level.neighbours.size());
          level.neighbours.push_back(coarse);
          level.conductances.push_back(0);
        }
        level.conductances[at(index)] += conductance;
      });
    level.begins.push_back(static_cast<Node>(level.neighbours.size()));
  }
}

FlowMultigrid::FlowMultigrid(const FaceConductances& faces) {
  levels_.push_back(finest_level(faces));
  for (;;) {
    Level next = coarser(levels_.back());
    const bool last =
        next.unknowns() <= few_unknowns || 10 * next.unknowns() > 9 * levels_.back().unknowns();
    levels_.push_back(std::move(next));
    if (last) break;
  }
  factorise(levels_.back());
}

void FlowMultigrid::factorise(const Level& level) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(level.unknowns(), level.unknowns());
  for (Index k = 0; k < level.unknowns(); ++k)
    for_neighbours(level, k, [&](Index neighbour, double conductance) {
      matrix(k, neighbour) -= conductance;
      matrix(k, k) += (1 + diagonal_shift) * conductance;
    });
  coarsest_.compute(matrix);
}

template <bool forward>
void FlowMultigrid::smooth(const Level& level, const double* b, double* x) {
  const double* inverse = level.inverse_diagonal.data();
  visit_by_colours<forward>(level.rows(), level.unknowns(), [&](Index row) {
    if (level.is_finest()) {
      const auto [here, above, below] = rows_around(row, level.rows(), level.columns);
      const double *along_x = level.to_next_x, *along_y = level.to_next_y;
      const Index up = above - here, down = below - here;
      // The cell visited last stays in a register: storing and reloading it would take longer than
      // a step.
      double last = x[forward ? here + level.columns - 1 : here];
      visit_row<forward>(here, level.columns, [&](Index left, Index right, Index k) {
        const double across = b[k] + along_x[k + up] * x[k + up] + along_x[k] * x[k + down];
        last = inverse[k] * (forward ? (across + along_y[k] * x[right]) + along_y[left] * last
                                     : (across + along_y[left] * x[left]) + along_y[k] * last);
        x[k] = last;
      });
      return;
    }
    const Index begin = level.row_begins[static_cast<std::size_t>(row)];
    const Index end = level.row_begins[static_cast<std::size_t>(row) + 1];
    for (Index step = 0; step < end - begin; ++step) {
      const Index k = forward ? begin + step : end - 1 - step;
      double sum = b[k];
      for_neighbours(level, k, [&](Index n, double conductance) { sum += conductance * x[n]; });
      x[k] = inverse[k] * sum;
    }
  });
}

void FlowMultigrid::multiply(const Level& level, const double* x, double* y) {
  parallel::for_slabs(
      level.rows(),
      [&](Index first, Index last) {
        for (Index row = first; row < last; ++row) {
          if (level.is_finest()) {
            const auto [here, above, below] = rows_around(row, level.rows(), level.columns);
            const double *along_x = level.to_next_x, *along_y = level.to_next_y;
            const Index up = above - here, down = below - here;
            visit_row<true>(here, level.columns, [&](Index left, Index right, Index k) {
              y[k] = along_y[k] * (x[k] - x[right]) + along_y[left] * (x[k] - x[left]) +
                     along_x[k + up] * (x[k] - x[k + up]) + along_x[k] * (x[k] - x[k + down]);
            });
            continue;
          }
          for (Index k = level.row_begins[static_cast<std::size_t>(row)];
               k < level.row_begins[static_cast<std::size_t>(row) + 1]; ++k) {
            double sum = 0;
            for_neighbours(
                level, k, [&](Index n, double conductance) { sum += conductance * (x[k] - x[n]); });
            y[k] = sum;
          }
        }
      },
      level.unknowns());
}

void FlowMultigrid::restrict_residual(const Level& level, const double* b, const double* image,
                                      double* coarse) {
  const auto unknowns = static_cast<Index>(level.member_begins.size()) - 1;
  const Node *begins = level.member_begins.data(), *members = level.members.data();
  parallel::for_slabs(
      unknowns,
      [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
          double sum = 0;
          for (Node m = begins[k]; m < begins[k + 1]; ++m) sum += b[members[m]] - image[members[m]];
          coarse[k] = sum;
        }
      },
      level.unknowns());
}

void FlowMultigrid::add_coarse(const Level& level, const double* coarse, double* x) {
  const auto unknowns = static_cast<Index>(level.member_begins.size()) - 1;
  const Node *begins = level.member_begins.data(), *members = level.members.data();
  parallel::for_slabs(
      unknowns,
      [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k)
          for (Node m = begins[k]; m < begins[k + 1]; ++m) x[members[m]] += coarse[k];
      },
      level.unknowns());
}

// x ≈ A⁻¹b, with the matrix A of the level, by a forward Gauss–Seidel sweep, a correction from the
// coarser level, and a backward sweep.
void FlowMultigrid::cycle(std::size_t depth, const double* b, double* x) {
  Level& level = levels_[depth];
  Level& next = levels_[depth + 1];
  std::fill_n(x, level.unknowns(), 0.0);
  smooth<true>(level, b, x);
  multiply(level, x, level.r.data());
  restrict_residual(level, b, level.r.data(), next.b.data());
  solve(depth + 1, next.b.data(), next.x.data());
  add_coarse(level, next.x.data(), x);
  smooth<false>(level, b, x);
}

// x ≈ A⁻¹b, with the matrix A of the level, by at most two steps of flexible conjugate gradients,
// or directly on the coarsest level.
void FlowMultigrid::solve(std::size_t depth, const double* b, double* x) {
  Level& level = levels_[depth];
  const Index count = level.unknowns();
  if (depth + 1 == levels_.size()) {
    Eigen::Map<Eigen::VectorXd>(x, count) =
        coarsest_.solve(Eigen::Map<const Eigen::VectorXd>(b, count));
    return;
  }
  double *c1 = level.c1.data(), *v1 = level.v1.data(), *c2 = level.c2.data(), *v2 = level.v2.data();
  cycle(depth, b, c1);
  multiply(level, c1, v1);
  const auto [curvature_1, descent_1] = two_products(count, c1, v1, c1, b);
  if (!(curvature_1 > 0)) {
    std::fill_n(x, count, 0.0);
    return;
  }
  const double step_1 = descent_1 / curvature_1;
  for (Index k = 0; k < count; ++k) x[k] = b[k] - step_1 * v1[k];
  const auto [left, all] = two_products(count, x, x, b, b);
  double along_1 = step_1, along_2 = 0;
  if (left > first_is_enough * all) {
    cycle(depth, x, c2);
    multiply(level, c2, v2);
    const auto [mixed, curvature_2] = two_products(count, c2, v1, c2, v2);
    const auto [descent_2, unused] = two_products(count, c2, x, c2, c2);
    const double own = curvature_2 - mixed * mixed / curvature_1;
    if (own > 0) {
      along_2 = descent_2 / own;
      along_1 -= mixed / curvature_1 * along_2;
    }
  }
  if (along_2 == 0) {
    for (Index k = 0; k < count; ++k) x[k] = along_1 * c1[k];
  } else {
    for (Index k = 0; k < count; ++k) x[k] = along_1 * c1[k] + along_2 * c2[k];
  }
}

void FlowMultigrid::apply(const Field& residual, Field& z) { cycle(0, residual.data(), z.data()); }

}  // namespace salebra::detail
