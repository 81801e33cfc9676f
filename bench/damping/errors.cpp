// SPDX-License-Identifier: GPL-3.0-or-later
// Stated errors of the damping of generated surfaces against what they converge to on cells of a
// quarter of the size.
//   damping_errors [surfaces [points [first seed]]]
// One line per load: Hurst exponent, cells in the shortest wave, amplitude over rms height,
// pressure over E*h', W, its error and the parts of it (cells, scatter, levels, ratio, solver), all
// over W; then W converged, less W, over W; levels, window over u_z, and the scatter of W
// converged. The last lines are the table of docs/surface_damping.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/refine.hpp>
#include <string>
#include <vector>

using namespace salebra;

namespace {

constexpr std::array hurst{0.3, 0.5, 0.8}, shortest{4.0, 6.0, 8.0};
constexpr std::array amplitudes{0.003, 0.01, 0.03, 0.1, 0.3};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

struct Cases {
  int all = 0, held = 0;
  std::vector<double> over_actual, stated;

  void add(double error, double actual) {
    ++all;
    if (!(error < 1)) return;  // n/a
    held += std::abs(actual) <= error;
    over_actual.push_back(error / std::abs(actual));
    stated.push_back(error);
  }
  void print(const std::string& name) const {
    std::printf("| %s | %d | %d | %.0f %% | %.1f | %.0f %% |\n", name.c_str(), all,
                all - static_cast<int>(stated.size()),
                100.0 * held / std::max<double>(1, static_cast<double>(stated.size())),
                median(over_actual), 100 * median(stated));
  }
};

/// Every `factor`-th point, from the one at `first` along both sides.
Surface every(const Surface& surface, Index factor, Index first) {
  Surface coarse = surface;
  coarse.grid.nx /= factor;
  coarse.grid.ny /= factor;
  coarse.heights = surface.heights(Eigen::seqN(first, coarse.grid.nx, factor),
                                   Eigen::seqN(first, coarse.grid.ny, factor));
  return coarse;
}

}  // namespace

int main(int count, char** words) {
  const int surfaces = count > 1 ? std::atoi(words[1]) : 200;
  const Index points = count > 2 ? std::atoi(words[2]) : 64;
  const auto seed = static_cast<std::uint64_t>(count > 3 ? std::atoi(words[3]) : 1);
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const Grid2D grid{points, points, 1e-6, 1e-6};
  constexpr double slope = 0.1;
  std::vector<double> pressures;
  for (int k = 0; k < 6; ++k)
    pressures.push_back(2e-3 * std::pow(75, k / 5.0) * slope * material.contact_modulus);

  Cases all;
  std::array<Cases, amplitudes.size()> by_amplitude;
  for (std::uint64_t i = seed; i < seed + static_cast<std::uint64_t>(surfaces); ++i) {
    const double h = hurst[i % 3];
    const double cells = shortest[i / 3 % 3];
    const std::size_t which = i % 5;
    const double amplitude = amplitudes[which];
    const SelfAffineSpectrum spectrum({.hurst = h,
                                       .rolloff = i % 2 == 0 ? 0.25e-6 : 0.5e-6,
                                       .short_cutoff = cells * grid.dx(),
                                       .rms_slope = slope});
    const Surface surface = filtered_noise(grid, spectrum, i);
    const double rms = height_statistics(surface).rms_height;
    const Drag motion{amplitude * rms, 1e-3, 2 * std::numbers::pi * 20e3};
    const auto curve_of = [&](const Surface& s) {
      SweepOptions sweep;
      sweep.contact.tolerance = 1e-8;
      sweep.stick = true;
      return sweep_pressures(s, material, pressures, sweep);
    };
    const auto results = surface_damping(surface, material, motion, curve_of(surface));
    // Cells enter by chance on these cells too: the mean of two grids half a cell apart scatters
    // less than one.
    const Surface finest = refined(surface, 8);
    SurfaceDampingOptions many;
    many.refinements = 0;
    const ForceCurve curve = curve_of(every(finest, 2, 0));
    std::array<std::vector<SurfaceDamping>, 2> converged;
    for (Index first : {0, 1})
      converged[static_cast<std::size_t>(first)] =
          surface_damping(every(finest, 2, first), material, motion, curve, many);
    for (std::size_t k = 0; k < results.size(); ++k) {
      const SurfaceDamping &r = results[k], &one = converged[0][k], &other = converged[1][k];
      if (!r.converged || !one.converged || !other.converged) continue;
      const double w = r.work_per_cycle;
      const double actual = (one.work_per_cycle + other.work_per_cycle) / 2 - w;
      std::printf("%.1f %.0f %.3f %.4f %.5g %.4f %.4f %.4f %.4f %.4f %.2g %+.4f %d %.3g %.4f\n", h,
                  cells, amplitude, pressures[k] / slope / material.contact_modulus, w,
                  r.error / std::abs(w), r.cell_error / std::abs(w), r.scatter / std::abs(w),
                  r.level_error / std::abs(w), r.ratio_error / std::abs(w),
                  r.solver_error / std::abs(w), actual / std::abs(w), r.levels,
                  r.window / motion.normal_amplitude,
                  std::hypot(one.scatter, other.scatter) / 2 / std::abs(w));
      all.add(r.error / std::abs(w), actual / w);
      by_amplitude[which].add(r.error / std::abs(w), actual / w);
    }
    std::fflush(stdout);
  }
  std::puts(
      "| amplitude over h_rms | cases | n/a | error holds | stated over actual, median | stated, "
      "median |");
  all.print("all");
  for (std::size_t i = 0; i < amplitudes.size(); ++i)
    by_amplitude[i].print(std::to_string(amplitudes[i]).substr(0, 5));
}
