// SPDX-License-Identifier: GPL-3.0-or-later
// A surface from its Fourier coefficients.
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/generators/fourier_modes.hpp>

#include "base/fft.hpp"
#include "base/memory.hpp"

namespace salebra {

Surface surface_of_modes(const Grid2D& grid, const std::vector<FourierMode>& modes) {
  grid.validate();
  require_memory(grid, 3.0 * sizeof(double) * double(grid.points()), "a surface");
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> spectrum(std::size_t(grid.nx * fft.modes_y()));
  std::vector<bool> given(spectrum.size());
  for (const FourierMode& mode : modes) {
    for (const auto& [wave, points] : {std::pair(mode.i, grid.nx), {mode.j, grid.ny}})
      require(2 * std::abs(wave) < points, "modes", wave,
              "periods need more than twice as many points; use a finer grid");
    // A wave with j < 0 is stored as its conjugate (−i, −j); a wave with j = 0 is stored at (i, 0)
    // and (−i, 0).
    const auto put = [&](Index i, Index j, std::complex<double> amplitude) {
      if (j < 0) return;
      const auto position = std::size_t((i < 0 ? i + grid.nx : i) * fft.modes_y() + j);
      require(!given[position] ||
                  std::abs(spectrum[position] - amplitude) <= 1e-6 * std::abs(amplitude),
              "modes", i, "periods along x have two amplitudes that contradict each other");
      spectrum[position] = amplitude;
      given[position] = true;
    };
    put(mode.i, mode.j, mode.amplitude);
    put(-mode.i, -mode.j, std::conj(mode.amplitude));
  }
  Surface surface{grid, Field(grid.nx, grid.ny), true, "Fourier coefficients"};
  fft.backward(spectrum.data(), surface.heights.data());
  return surface;
}

}  // namespace salebra
