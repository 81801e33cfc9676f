// SPDX-License-Identifier: GPL-3.0-or-later
// Greatest relative error of the power of a mode of random-phase surfaces, as the Markdown table of
// generators/README.md. The lines of modes that are their own mirror images stand apart: there a
// generator that forgets the Hermitian symmetry has half the power.
//   mode_power [seeds]
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/generators/random_phase.hpp>
#include <vector>

#include "base/fft.hpp"

namespace {

using namespace salebra;

constexpr std::array lines{"bulk", "k_y = 0", "k_x = 0", "Nyquist", "corners"};

std::size_t line_of(const Grid2D& grid, Index i, Index j) {
  const bool own_x = i == 0 || 2 * i == grid.nx, own_y = j == 0 || 2 * j == grid.ny;
  if (own_x && own_y) return 4;
  if (j == 0) return 1;
  if (i == 0) return 2;
  return own_x || own_y ? 3 : 0;
}

struct Line {
  int modes = 0;
  double error = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 5;
  std::printf("| points, sides |");
  for (const char* line : lines) std::printf(" %s |", line);
  std::printf("\n|---|---|---|---|---|---|\n");
  for (const Grid2D& grid :
       {Grid2D{64, 64, 1, 1}, Grid2D{63, 63, 1, 1}, Grid2D{64, 63, 1, 1}, Grid2D{63, 64, 1, 1},
        Grid2D{96, 40, 2.4, 1}, Grid2D{96, 40, 1, 1}, Grid2D{45, 128, 1, 2}}) {
    const SelfAffineSpectrum spectrum({.hurst = 0.8,
                                       .rolloff = std::min(grid.lx, grid.ly) / 4,
                                       .short_cutoff = 2 * std::max(grid.dx(), grid.dy()),
                                       .rms_height = 1});
    std::array<Line, lines.size()> table{};
    RealFft2D<double> fft(grid.nx, grid.ny);
    std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
    for (int seed = 0; seed < seeds; ++seed) {
      const Surface surface = random_phase(grid, spectrum, static_cast<std::uint64_t>(seed));
      fft.forward(surface.heights.data(), modes.data());
      for (Index i = 0; i < grid.nx; ++i) {
        for (Index j = 0; j < fft.modes_y(); ++j) {
          const Index wave = 2 * i > grid.nx ? i - grid.nx : i;
          const double step_x = 2 * std::numbers::pi / grid.lx;
          const double step_y = 2 * std::numbers::pi / grid.ly;
          const double density =
              i == 0 && j == 0 ? 0 : spectrum.density(step_x * double(wave), step_y * double(j));
          if (density == 0) continue;
          const double target = density * step_x * step_y;
          const double power = std::norm(modes[static_cast<std::size_t>(i * fft.modes_y() + j)] /
                                         double(grid.points()));
          Line& line = table[line_of(grid, i, j)];
          ++line.modes;
          line.error = std::max(line.error, std::abs(power / target - 1));
        }
      }
    }
    std::printf("| %ld × %ld, %g × %g |", long(grid.nx), long(grid.ny), grid.lx, grid.ly);
    for (const Line& line : table) {
      if (line.modes == 0)
        std::printf(" none |");
      else
        std::printf(" %.0e (%d) |", line.error, line.modes / seeds);
    }
    std::printf("\n");
  }
}
