// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal.hpp>

#include "active_set_cg.hpp"

namespace salebra {
namespace detail {
namespace {

// The load is a maximum over q, so its error is the square of the error of q: a loose solve is enough for a sharp load.
constexpr double relative_gain = 1e-11;
constexpr int gains_in_a_row = 2;
constexpr int most_iterations = 2000;

}  // namespace

// CG as in solve(), on a set of cells that does not change: minimises ½q·Gq − Σq. The load is then taken from
// 2Σq − q·Gq in double precision, whose error is quadratic in that of q.
template <class Real>
double ActiveSetCg<Real>::punch_load(const double* p, double bound, Field* pressure) {
  reset();
  const auto in_set = [bound](double x) { return x > 0 && x < bound; };
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * tiles_per_row_; k < end * tiles_per_row_; ++k) {
      const Index first = k / tiles_per_row_ * grid_.ny + k % tiles_per_row_ * tile_width;
      const Index width = std::min<Index>(tile_width, grid_.ny - k % tiles_per_row_ * tile_width);
      in_use_[static_cast<std::size_t>(k)] = std::any_of(p + first, p + first + width, in_set);
    }
  });
  list_tiles();
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    const Index first = tiles_[k].row * grid_.ny + tiles_[k].column;
    const Index width = std::min<Index>(tile_width, grid_.ny - tiles_[k].column);
    const std::size_t packed = k * tile_width;
    std::fill_n(p_ + packed, tile_width, 0.0);
    std::fill_n(g_ + packed, tile_width, -1.0);
    std::fill_n(m_ + packed, tile_width, Real(0));
    for (Index i = 0; i < width; ++i)
      if (in_set(p[first + i])) m_[packed + static_cast<std::size_t>(i)] = Real(1);
  }
  const auto a = arrays(std::numeric_limits<double>::infinity());
  const auto tiles = static_cast<Index>(tiles_.size());
  const auto over = [&]<class Sums>(Sums, auto kernel) {
    return parallel::map_slabs<Sums>(tiles, kernel, tiles * tile_width);
  };
  parallel::for_slabs(
      tiles, [&](Index begin, Index end) { kernels_.residual(a, begin, end, 0); },
      tiles * tile_width);
  double curvature = 1, gained = 0;
  int small_gains = 0;
  for (int iteration = 0; iteration < most_iterations && small_gains < gains_in_a_row;
       ++iteration) {
    frame_residual();
    double zw = 0, descent = 0, tw = 0;
    for (const auto& part : over(PreconditionSums{}, [&](Index begin, Index end) {
           return kernels_.precondition(a, begin, end);
         }))
      zw += part.zw;
    const double beta = iteration > 0 ? -zw / curvature : 0;
    for (const double part : over(0.0, [&](Index begin, Index end) {
           return kernels_.direct(a, begin, end, 0, beta, 0);
         }))
      descent += part;
    compliance_.apply(t_.get(), w_.get());
    for (const auto& part : over(CurvatureSums{}, [&](Index begin, Index end) {
           return kernels_.curvature(a, begin, end);
         }))
      tw += part.tw;
    if (!(tw > 0)) break;
    curvature = tw;
    over(StepSums{},
         [&](Index begin, Index end) { return kernels_.step(a, begin, end, descent / tw, 0); });
    const double gain = descent * descent / tw;
    gained += gain;
    small_gains = gain < relative_gain * gained ? small_gains + 1 : 0;
    if (iteration + 1 == most_iterations && small_gains < gains_in_a_row)
      return std::numeric_limits<double>::quiet_NaN();
  }
  Field q = Field::Zero(grid_.nx, grid_.ny), image(grid_.nx, grid_.ny);
  for (std::size_t k = 0; k < tiles_.size(); ++k)
    std::copy_n(p_ + k * tile_width, std::min<Index>(tile_width, grid_.ny - tiles_[k].column),
                q.data() + tiles_[k].row * grid_.ny + tiles_[k].column);
  if (pressure) *pressure = q;
  exact_compliance().apply(q.data(), image.data());
  return sum_rows([&](Index begin, Index end) {
    double part = 0;
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
      part += q.data()[k] * (2 - image.data()[k]);
    return part;
  });
}

template double ActiveSetCg<float>::punch_load(const double*, double, Field*);
template double ActiveSetCg<double>::punch_load(const double*, double, Field*);

}  // namespace detail

double normal_stiffness(const NormalContactState& state, const Grid2D& grid, double contact_modulus,
                        const NormalContactOptions& options, Field* punch_pressure) {
  grid.validate();
  require_positive(contact_modulus, "contact_modulus");
  require(state.pressure.rows() == grid.nx && state.pressure.cols() == grid.ny, "pressure",
          state.pressure.size(), "points do not fill the grid");
  // In full contact the periodic cell approaches no further: its compliance has no mean.
  const auto elastic = state.pressure > 0 && state.pressure < options.hardness;
  if (options.boundary == Boundary::periodic && elastic.all())
    return std::numeric_limits<double>::infinity();
  if (!elastic.any()) return 0;
  const double cell = std::sqrt(grid.cell_area());
  const Grid2D scaled{grid.nx, grid.ny, grid.lx / cell, grid.ly / cell};
  const auto load = [&]<class Real>(Real) {
    return detail::ActiveSetCg<Real>(scaled, 1, options.boundary, {}, 0)
        .punch_load(state.pressure.data(), options.hardness, punch_pressure);
  };
  // With lengths in cells and E* = 1, Σq counts forces in E*·(cell size)² for an approach of one cell size.
  const double stiffness =
      (options.precision == Precision::mixed ? load(0.0f) : load(0.0)) * contact_modulus * cell;
  if (punch_pressure) *punch_pressure *= contact_modulus / cell;
  return stiffness;
}

}  // namespace salebra
