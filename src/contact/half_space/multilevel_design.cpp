// SPDX-License-Identifier: GPL-3.0-or-later
// Fits the stencils of the multilevel kernel to the symbol of the normal compliance, and computes
// the symbol that each stencil leaves for the next coarser grid.
#include "multilevel_design.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <salebra/base/parallel.hpp>
#include <utility>

#include "base/numerics/dense_systems.hpp"
#include "tile.hpp"

namespace salebra::detail {
namespace {

using std::numbers::pi;

constexpr Index design_period = 512;
constexpr int widest_radius = 3, usual_radius = 2;
constexpr int fitting_rounds = 20;
// Numbers of frequencies along each axis: those that a fit uses, and those at which its error is
// measured.
constexpr Index fitted_frequencies = 8, measured_frequencies = 24;

// The stencils of square cells, which most grids have, as the fit below finds them: it takes as long
// as ten transforms of 512² cells. Levels from the finest on, of radius 3, 2, 2 and 2; weights of
// (i, j) with 0 <= i <= j, row by row.
struct SquareRung {
  double error;
  std::array<double, 10> weights;
};
constexpr std::array<SquareRung, 4> periodic_squares = {{
    {0.03240288,
     {1.021025564, 0.2522820013, 0.05430469936, 0.02633575242, 0.1374892423, 0.0479303169,
      0.01524847299, 0.02441998164, 0.006238123477, 0.002221249887}},
    {0.01089739,
     {0.0489903419, 0.02263533147, 0.03231492397, 0.04338343811, 0.01591866986, 0.00153665334}},
    {0.005138464,
     {0.05154220906, 0.02747465662, 0.01178752989, 0.02737328434, 0.003324054004, 0.001558368192}},
    {0.004847218,
     {0.02313522075, 0.01813800931, 0.004718471708, 0.01137655051, 0.001775967375,
      0.0006759280946}},
}};
constexpr std::array<SquareRung, 4> free_squares = {{
    {0.008280972,
     {0.993483907, 0.2058203968, 0.04740610682, 0.008904624393, 0.1099882, 0.03388661898,
      0.007071382442, 0.01330291437, 0.002627174272, 0.0003119579035}},
    {0.005857141,
     {0.07194868808, 0.06312388246, 0.0215257761, 0.04314591027, 0.01061827604, 0.002621598709}},
    {0.00936416,
     {0.05027176375, 0.03412994611, 0.008867996077, 0.02304399202, 0.003400368806, 0.00126218176}},
    {0.01376572,
     {0.02747545677, 0.01708742398, 0.003585366355, 0.0107186496, 0.001514259476, 0.0005978658805}},
}};

MultilevelRung rung_of(const SquareRung& square, int radius) {
  MultilevelRung level{
      {radius, std::vector<double>(static_cast<std::size_t>((radius + 1) * (radius + 1)))},
      square.error};
  const int width = radius + 1;
  std::size_t k = 0;
  for (int i = 0; i < width; ++i)
    for (int j = i; j < width; ++j, ++k)
      for (const int index : {i * width + j, j * width + i})
        level.stencil.weights[static_cast<std::size_t>(index)] = square.weights[k];
  return level;
}

struct Sample {
  double value, metric;
};

Sample sample(const QuarterSymbol& symbol, Index i, Index j) {
  const std::size_t k = symbol.index(i, j);
  return {symbol.value[k], symbol.metric[k]};
}
// If displacements count from their mean, a constant pressure causes no displacement: the symbol is
// 0 at frequency 0, and this frequency does not count in the error.
Sample sample(const NormalSymbol& symbol, Index i, Index j) {
  const double value = symbol.value(i, j);
  return {value, value != 0 ? 1 / std::abs(value) : 0};
}

// cos(kθ) for k <= radius, and cos⁸(θ/2), the squared transform of the B-spline, at the frequencies
// θ of an axis.
struct AxisWaves {
  int radius;
  std::vector<double> cosine, spline;  // (period/2 + 1, radius + 1), (period/2 + 1)

  AxisWaves(Index period, int radius_of) : radius(radius_of) {
    for (Index i = 0; i <= period / 2; ++i) {
      const double theta = 2 * pi * static_cast<double>(i) / static_cast<double>(period);
      for (int k = 0; k <= radius; ++k) cosine.push_back(std::cos(k * theta));
      spline.push_back(std::pow(std::cos(theta / 2), 8));
    }
  }
  const double* at(Index i) const { return cosine.data() + i * (radius + 1); }
};

// Coefficients of cos(jθ_y) in the transform T(θ_x, θ_y) of a stencil, for one frequency θ_x, whose
// cosines are given.
std::array<double, halo + 1> row_of(const MultilevelStencil& stencil, const double* cosine) {
  std::array<double, halo + 1> factors{};
  const int width = stencil.radius + 1;
  for (int j = 0; j < width; ++j)
    for (int i = 0; i < width; ++i)
      factors[static_cast<std::size_t>(j)] +=
          (i > 0 ? 2 : 1) * (j > 0 ? 2 : 1) *
          stencil.weights[static_cast<std::size_t>(i * width + j)] * cosine[i];
  return factors;
}

// The columns k and period_y/2 − k of a symbol, which coincide as column k on the coarser grid.
struct FoldedSymbol {
  Index period_x, period_y;
  Index first;   // first column of this process on the coarser grid
  Field values;  // [column k, then period_y/2 − k][i]
};
Sample sample(const FoldedSymbol& symbol, Index i, Index j) {
  const Index half = symbol.period_y / 2;
  const Index position = 2 * j <= half ? 2 * j : 2 * (half - j) + 1;
  const double value = symbol.values(position - 2 * symbol.first, i);
  return {value, value != 0 ? 1 / std::abs(value) : 0};
}

// Computes the coarser symbol in the columns of this process; its other columns are zero.
template <class Fine>
QuarterSymbol coarsened(const Fine& fine, const MultilevelStencil& stencil,
                        const RowPartition& columns) {
  QuarterSymbol coarse{fine.period_x / 2, fine.period_y / 2, {}, {}};
  const AxisWaves x(fine.period_x, stencil.radius), y(fine.period_y, stencil.radius);
  const Index rows = coarse.period_x / 2 + 1;
  coarse.value.resize(static_cast<std::size_t>(rows * coarse.columns()));
  coarse.metric.resize(coarse.value.size());
  parallel::for_slabs(
      rows,
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          const std::array<Index, 2> along_x = {i, coarse.period_x - i};
          const std::array factors = {row_of(stencil, x.at(along_x[0])),
                                      row_of(stencil, x.at(along_x[1]))};
          for (Index j = columns.begin(); j < columns.end(); ++j) {
            double moved = 0, squares = 0;
            for (std::size_t a = 0; a < 2; ++a)
              for (const Index b : {j, coarse.period_y - j}) {
                const double* cosine = y.at(b);
                double near = 0;
                for (int k = 0; k <= stencil.radius; ++k)
                  near += factors[a][static_cast<std::size_t>(k)] * cosine[k];
                const auto [value, metric] = sample(fine, along_x[a], b);
                if (i == 0 && j == 0 && a == 0 && b == 0) coarse.value.front() = (value - near) / 4;
                const double weight = metric * x.spline[static_cast<std::size_t>(along_x[a])] *
                                      y.spline[static_cast<std::size_t>(b)];
                squares += weight;
                moved += weight * metric * (value - near);
              }
            coarse.metric[coarse.index(i, j)] = 4 * squares;
            if (i > 0 || j > 0) coarse.value[coarse.index(i, j)] = moved / (4 * squares * squares);
          }
        }
      },
      fine.period_x * fine.period_y / 4);
  return coarse;
}

template <class Fine>
QuarterSymbol coarsened(const Fine& fine, const MultilevelStencil& stencil) {
  return coarsened(fine, stencil, RowPartition(fine.period_y / 4 + 1));
}

// Four frequencies that coincide as one frequency of the coarser grid, and the error that a stencil
// leaves at these frequencies with the best possible symbol C of the coarser grid.
struct Aliases {
  Eigen::Matrix<double, 4, Eigen::Dynamic> basis;  // basis functions of the weights, divided by W
  Eigen::Vector4d wanted, square;                  // g/W, u²
  // Frobenius norm of the quadratic form that remains of the misfit `d` of the stencil, with the C
  // of coarse_symbol(), which minimises this norm. The norm is at most twice the largest eigenvalue
  // of the form.
  double norm(const Eigen::Vector4d& d) const {
    const double taken = square.dot(d) / square.sum();
    return std::sqrt(std::max(0.0, d.squaredNorm() - taken * taken));
  }
};

std::vector<Aliases> aliases_of(const QuarterSymbol& fine, int radius, Index step) {
  const AxisWaves x(fine.period_x, radius), y(fine.period_y, radius);
  const Index coarse_x = fine.period_x / 2, coarse_y = fine.period_y / 2;
  std::vector<Aliases> classes;
  for (Index i = 0; i <= coarse_x / 2; i += step)
    for (Index j = 0; j <= coarse_y / 2; j += step) {
      if (i == 0 && j == 0) continue;
      Aliases found;
      found.basis.resize(4, (radius + 1) * (radius + 1));
      Eigen::Index row = 0;
      for (const Index a : {i, coarse_x - i})
        for (const Index b : {j, coarse_y - j}) {
          const auto [value, metric] = sample(fine, a, b);
          for (int k = 0; k <= radius; ++k)
            for (int l = 0; l <= radius; ++l)
              found.basis(row, k * (radius + 1) + l) =
                  (k > 0 ? 2 : 1) * (l > 0 ? 2 : 1) * x.at(a)[k] * y.at(b)[l] * metric;
          found.wanted(row) = value * metric;
          found.square(row) = metric * x.spline[static_cast<std::size_t>(a)] *
                              y.spline[static_cast<std::size_t>(b)];
          ++row;
        }
      classes.push_back(std::move(found));
    }
  return classes;
}

double max_error(const std::vector<Aliases>& classes, const Eigen::VectorXd& weights) {
  double largest = 0;
  for (const Aliases& at : classes) {
    const Eigen::Vector4d d = at.wanted - at.basis * weights;
    const double sum = at.square.sum();
    const Eigen::Vector4d u = at.square.cwiseSqrt();
    Eigen::MatrixXd form = -at.square.dot(d) / (sum * sum) * u * u.transpose();
    form.diagonal() += d;
    const Eigen::VectorXd values = symmetric_modes(form).values;
    largest = std::max({largest, -values.minCoeff(), values.maxCoeff()});
  }
  return largest;
}

MultilevelRung fitted_rung(const QuarterSymbol& fine, int radius) {
  const Index half = std::min(fine.period_x, fine.period_y) / 4;
  const auto every = [&](Index frequencies) { return std::max<Index>(1, half / frequencies); };
  const auto classes = aliases_of(fine, radius, every(fitted_frequencies));
  const Eigen::Index unknowns = (radius + 1) * (radius + 1);
  std::vector<double> emphasis(classes.size(), 1.0);
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < fitting_rounds; ++round) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    for (std::size_t k = 0; k < classes.size(); ++k) {
      const Aliases& at = classes[k];
      const Eigen::VectorXd taken = at.basis.transpose() * at.square / at.square.sum();
      normal += emphasis[k] * (at.basis.transpose() * at.basis - taken * taken.transpose());
      right += emphasis[k] * (at.basis.transpose() * at.wanted -
                              taken * (at.square.dot(at.wanted) / at.square.sum()));
    }
    const Eigen::VectorXd weights = least_squares(normal, right);
    std::vector<double> errors;
    for (const Aliases& at : classes) errors.push_back(at.norm(at.wanted - at.basis * weights));
    const double largest = *std::max_element(errors.begin(), errors.end());
    if (largest < least) {
      least = largest;
      best = weights;
    }
    double mean = 0;
    for (std::size_t k = 0; k < classes.size(); ++k) {
      emphasis[k] = emphasis[k] * errors[k] / largest + 1e-12;
      mean += emphasis[k] / static_cast<double>(classes.size());
    }
    for (double& value : emphasis) value /= mean;
  }
  MultilevelRung level{{radius, {best.data(), best.data() + best.size()}}, 0};
  level.error = max_error(aliases_of(fine, radius, every(measured_frequencies)), best);
  return level;
}

// Levels of the kernel designed so far, and the symbol that remains for the next level.
struct Design {
  std::vector<MultilevelRung> levels;
  QuarterSymbol left;
};

Design begun(double dx_over_dy, Boundary boundary) {
  // The period of a grid with a free boundary is twice its size.
  const Index cells = boundary == Boundary::periodic ? design_period : design_period / 2;
  const auto length = static_cast<double>(cells);
  const double stretch = std::sqrt(dx_over_dy);
  const NormalSymbol exact = normal_symbol({cells, cells, length * stretch, length / stretch}, 1,
                                           boundary, RowPartition(cells));
  QuarterSymbol symbol{exact.period_x, exact.period_y, {}, {}};
  for (Index i = 0; i <= symbol.period_x / 2; ++i)
    for (Index j = 0; j <= symbol.period_y / 2; ++j) {
      const auto [value, metric] = sample(exact, i, j);
      symbol.value.push_back(value);
      symbol.metric.push_back(metric);
    }
  return {{}, std::move(symbol)};
}

}  // namespace

double MultilevelStencil::weight(int i, int j) const {
  return weights[static_cast<std::size_t>(std::abs(i) * (radius + 1) + std::abs(j))];
}

std::vector<MultilevelRung> multilevel_design(double dx_over_dy, Boundary boundary, int depth) {
  const auto& squares = boundary == Boundary::periodic ? periodic_squares : free_squares;
  if (dx_over_dy == 1 && depth <= static_cast<int>(squares.size())) {
    std::vector<MultilevelRung> levels;
    for (int k = 0; k < depth; ++k)
      levels.push_back(
          rung_of(squares[static_cast<std::size_t>(k)], k == 0 ? widest_radius : usual_radius));
    return levels;
  }
  static std::mutex mutex;
  static std::map<std::pair<double, Boundary>, Design> designs;
  const std::lock_guard lock(mutex);
  const auto [position, is_new] = designs.try_emplace({dx_over_dy, boundary});
  Design& design = position->second;
  if (is_new) design = begun(dx_over_dy, boundary);
  while (static_cast<int>(design.levels.size()) < depth) {
    design.levels.push_back(
        fitted_rung(design.left, design.levels.empty() ? widest_radius : usual_radius));
    design.left = coarsened(design.left, design.levels.back().stencil);
  }
  return {design.levels.begin(), design.levels.begin() + depth};
}

QuarterSymbol coarse_symbol(const NormalSymbol& fine, const MultilevelStencil& stencil,
                            const Communicator& communicator) {
  const RowPartition columns(communicator, fine.period_y / 4 + 1);
  std::vector<Index> begins;
  for (int rank = 0; rank <= communicator.size(); ++rank)
    begins.push_back(2 * (rank < communicator.size() ? columns.begin_of(rank) : columns.rows()));
  QuarterSymbol coarse;
  if (fine.columns) {
    const Index half = fine.period_y / 2;
    const FoldedSymbol folded{
        fine.period_x, fine.period_y, columns.begin(),
        fine.columns(RowPartition(communicator, begins), [half](Index position) {
          return position % 2 == 0 ? position / 2 : half - position / 2;
        })};
    coarse = coarsened(folded, stencil, columns);
  } else {
    coarse = coarsened(fine, stencil, columns);
  }
  if (communicator.alone()) return coarse;
  // Gathers the columns of all processes into the whole symbol.
  const Index rows = coarse.period_x / 2 + 1;
  std::vector<std::size_t> bytes;
  for (int rank = 0; rank < communicator.size(); ++rank)
    bytes.push_back(
        static_cast<std::size_t>((columns.end_of(rank) - columns.begin_of(rank)) * rows) *
        sizeof(double));
  Field mine(columns.count(), rows), all(columns.rows(), rows);
  for (auto* numbers : {&coarse.value, &coarse.metric}) {
    Eigen::Map<Field> whole(numbers->data(), rows, coarse.columns());
    mine = whole.middleCols(columns.begin(), columns.count()).transpose();
    communicator.gather_all(mine.data(), bytes, all.data());
    whole = all.transpose();
  }
  return coarse;
}
QuarterSymbol coarse_symbol(const QuarterSymbol& fine, const MultilevelStencil& stencil) {
  return coarsened(fine, stencil);
}

}  // namespace salebra::detail
