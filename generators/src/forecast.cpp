// SPDX-License-Identifier: GPL-3.0-or-later
// Expected roughness of a surface, its scatter between seeds, and the memory that generating it needs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/forecast.hpp>
#include <sstream>

#include "base/column_fft.hpp"
#include "base/loop_progress.hpp"
#include "modes.hpp"

namespace salebra {
namespace {

// Relative standard deviation of the rms height, ½√(2ΣP²)/ΣP over the mean powers P of all modes,
// counting a conjugate pair as two modes. For a Gaussian amplitude a, the variance of |a|² is P²
// for one of a conjugate pair and 2P² for a real mode.
double scatter_of(const Grid2D& grid, const Spectrum& spectrum, const Progress& progress) {
  const detail::CarriedModes carried(grid, spectrum);
  const auto sum_of_powers = [&](int exponent) {
    LoopProgress loop(progress, "scatter", carried.j_max() + 1, exponent == 1 ? 0.5 : 0,
                      exponent == 1 ? 1 : 0.5);
    const double sum_of_all = parallel::sum_blocks(carried.j_max() + 1, [&](Index begin,
                                                                            Index end) {
      double sum = 0;
      for (Index j = begin; j < end && loop.advance(); ++j)
        detail::for_each_mode_of_column(carried, j, [&](double, double, double power, bool pair) {
          sum += (pair ? 2 : 1) * (exponent == 1 ? power : power * power);
        });
      return sum;
    });
    loop.finish();
    return sum_of_all;
  };
  const double squares = sum_of_powers(2);
  return std::sqrt(2 * squares) / (2 * sum_of_powers(1));
}

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(3);
  (text << ... << parts);
  return text.str();
}

}  // namespace

std::size_t generation_memory(const Grid2D& grid, const Communicator& communicator) {
  return column_fft_memory(grid.nx, grid.ny, RowPartition(communicator, grid.nx));
}

Forecast forecast(const Grid2D& grid, const Spectrum& spectrum, const Progress& progress) {
  Forecast result;
  result.lattice = spectrum.lattice_moments(grid, progress);
  result.target = spectrum.moments();
  result.memory = generation_memory(grid);

  result.rms_height_scatter = scatter_of(grid, spectrum, progress);

  const double shortest = 2 * std::numbers::pi / spectrum.highest_wavenumber();
  const double cells = shortest / std::max(grid.dx(), grid.dy());
  if (cells < 8 * (1 - 1e-9))
    result.warnings.push_back(sentence("the shortest wavelength has ", cells,
                                       " cells; accurate contact areas need at least 8 (with 4 "
                                       "they are 13 to 27 % too large, most at light loads)"));
  const double ratio = result.lattice.rms_height() / result.target.rms_height();
  if (std::abs(ratio - 1) > 0.05)
    result.warnings.push_back(sentence(
        "the modes of this period have ", ratio,
        " times the requested rms height; a side of many roll-off wavelengths comes closer"));
  if (result.rms_height_scatter > 0.05)
    result.warnings.push_back(sentence(
        "the rms height of filtered noise scatters by ", 100 * result.rms_height_scatter,
        " % from seed to seed; take a roll-off below an eighth of the side, or random phase"));
  return result;
}

}  // namespace salebra
