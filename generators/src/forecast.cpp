// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/column_fft.hpp>
#include <salebra/generators/forecast.hpp>
#include <sstream>

namespace salebra {

std::size_t generation_memory(const Grid2D& grid) { return column_fft_memory(grid.nx, grid.ny); }

Forecast forecast(const Grid2D& grid, const Spectrum& spectrum) {
  Forecast result;
  result.lattice = spectrum.lattice_moments(grid);
  result.target = spectrum.moments();
  result.memory = generation_memory(grid);

  const double shortest = 2 * std::numbers::pi / spectrum.highest_wavenumber();
  const double cells = shortest / std::max(grid.dx(), grid.dy());
  if (cells < 8 * (1 - 1e-9)) {
    std::ostringstream text;
    text.precision(3);
    text << "the short cut-off has " << cells
         << " cells; contact areas need at least 8 (at 4 cells they are about 15 % too large)";
    result.warnings.push_back(text.str());
  }
  const double ratio = result.lattice.rms_height() / result.target.rms_height();
  if (std::abs(ratio - 1) > 0.05) {
    std::ostringstream text;
    text.precision(3);
    text << "the modes of this cell have " << ratio
         << " times the rms height asked; a cell of many roll-off wavelengths comes closer";
    result.warnings.push_back(text.str());
  }
  return result;
}

}  // namespace salebra
