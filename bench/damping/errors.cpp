// SPDX-License-Identifier: GPL-3.0-or-later
// Stated errors of the damping of diverse surfaces against what contacts on cells of a quarter of
// the size give: the mean of two such grids that lie half a cell apart.
//   damping_errors [surfaces [points [first seed [slip] [coarsen]]]]
// One line per surface: kind, pressure over E*h', amplitude over rms height, W, its error and the
// parts of it (cells, scatter, levels, ratio, solver), all over W; then W by contacts, less W, over
// W; levels, window over u_z. The last lines are results/errors.csv.
// With slip: the loss with friction, at excursions of 0.1 to 100 mu u_z, against forces of contacts
// on cells of a quarter of the size, with K_t = (G*/E*)K. One line per surface: kind, mu, excursion
// over mu u_z, W, its error over W, part by slip, what the reference is off, over W.
// With coarsen: W on the cells as they are, whose error is by cells of twice the size, as of a lone
// surface of more than 256 points a side.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/moments.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "damping/slip_by_contacts.hpp"
#include "damping/work_by_contacts.hpp"
#include "surface/refine.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double slope = 0.1;
const Material material = Material::of_contact_modulus(1e9, 0.3);

constexpr std::array kinds{"self-affine",     "self-affine, 3 to 4 cells in a wave",
                           "turned ridges",   "lognormal, peaks",
                           "lognormal, pits", "plateaux",
                           "smooth hills"};

// 0 to 1, of the number `which` of a seed: a multiple of an irrational number.
double chance(int seed, int which) {
  const double value = std::numbers::sqrt2 * seed + std::numbers::sqrt3 * which;
  return value - std::floor(value);
}
double between(double low, double high, double share) { return low * std::pow(high / low, share); }

// Sums of 40 waves of rms height 1.
Field waves(Index points, int seed, double highest, double direction, double spread) {
  Field sum = Field::Zero(points, points);
  for (int i = 41 * seed + 1; i <= 41 * seed + 40; ++i) {
    const double number = between(2, highest, chance(i, 0));
    const double angle = direction + spread * (chance(0, i) - 0.5);
    const double along_x = std::round(number * std::cos(angle)),
                 along_y = std::round(number * std::sin(angle));
    const double phase = std::numbers::phi * i;
    for (Index x = 0; x < points; ++x)
      for (Index y = 0; y < points; ++y)
        sum(x, y) +=
            std::pow(number, -1.5) *
            std::cos(2 * pi *
                     ((along_x * double(x) + along_y * double(y)) / double(points) + phase));
  }
  return (sum - sum.mean()) / std::sqrt((sum - sum.mean()).square().mean());
}

Surface surface_of(std::size_t kind, int seed, Index points) {
  const Grid2D grid{points, points, 1e-6, 1e-6};
  if (kind < 2) {
    const double cells = kind == 0 ? between(4, 12, chance(seed, 3)) : 3 + chance(seed, 3);
    return filtered_noise(grid,
                          SelfAffineSpectrum({.hurst = 0.2 + 0.7 * chance(seed, 4),
                                              .rolloff = seed % 2 == 0 ? 0.25e-6 : 0.5e-6,
                                              .short_cutoff = cells * grid.dx(),
                                              .rms_slope = slope}),
                          static_cast<std::uint64_t>(seed));
  }
  const auto hills = [&](double cells, int other = 0) {
    return waves(points, seed + other, double(points) / cells, 0, 2 * pi);
  };
  Surface surface{grid, {}, true, {}};
  if (kind == 2)
    surface.heights = waves(points, seed, double(points) / 6, pi * chance(seed, 5), 0.5);
  if (kind == 3) surface.heights = (between(0.3, 1, chance(seed, 5)) * hills(8)).exp();
  if (kind == 4) surface.heights = -(between(0.3, 1, chance(seed, 5)) * hills(8)).exp();
  if (kind == 5) surface.heights = hills(6).min(chance(seed, 5)) + 0.1 * hills(6, 7);
  if (kind == 6) surface.heights = hills(20);
  const auto square_of_steps = [&](const Field& steps) {
    return (steps / grid.dx()).square().mean();
  };
  const Field& h = surface.heights;
  surface.heights *=
      slope / std::sqrt(square_of_steps(h.bottomRows(points - 1) - h.topRows(points - 1)) +
                        square_of_steps(h.rightCols(points - 1) - h.leftCols(points - 1)));
  return surface;
}

// Every second point along both sides, from the one at `first` on.
Surface every_second(const Surface& surface, Index first) {
  Surface coarse = surface;
  coarse.grid.nx /= 2;
  coarse.grid.ny /= 2;
  coarse.heights =
      surface.heights(Eigen::seqN(first, coarse.grid.nx, 2), Eigen::seqN(first, coarse.grid.ny, 2));
  return coarse;
}

struct Cases {
  int all = 0, held = 0, far = 0;
  double largest = 0;
  std::vector<double> stated;

  void add(double error, double actual) {
    ++all;
    if (!(error < 1)) return;  // n/a
    const double ratio = std::abs(actual) / error;
    held += ratio <= 1;
    far += ratio > 1.6;
    largest = std::max(largest, ratio);
    stated.push_back(error);
  }
  void print(const std::string& name) {
    if (stated.empty()) return;
    std::ranges::sort(stated);
    std::printf("| %s | %d | %d | %.0f %% | %d | %.2f | %.1f %% |\n", name.c_str(), all,
                all - static_cast<int>(stated.size()), 100.0 * held / double(stated.size()), far,
                largest, 100 * stated[stated.size() / 2]);
  }
};

}  // namespace

int main(int count, char** words) {
  const int surfaces = count > 1 ? std::atoi(words[1]) : 210;
  const Index points = count > 2 ? std::atoi(words[2]) : 64;
  const int seed = count > 3 ? std::atoi(words[3]) : 1;
  const auto asked = [&](std::string_view word) {
    return std::ranges::count(words + std::min(count, 4), words + count, word) > 0;
  };
  const bool slip = asked("slip");
  SurfaceDampingOptions options;
  options.coarsen = asked("coarsen");
  options.refinements = options.coarsen ? 0 : 1;
  Cases all;
  std::array<Cases, kinds.size()> by_kind;
  constexpr std::array amplitudes{0.003, 0.01, 0.03, 0.1, 0.3};
  std::array<Cases, amplitudes.size() - 1> by_amplitude;
  for (int i = seed; i < seed + surfaces; ++i) {
    const auto kind = static_cast<std::size_t>(i) % kinds.size();
    const Surface surface = surface_of(kind, i, points);
    const double load = between(2e-3, 0.15, chance(i, 1)),
                 pressure = load * slope * material.contact_modulus,
                 amplitude = between(amplitudes.front(), amplitudes.back(), chance(i, 2));
    const Drag motion{amplitude * height_statistics(surface).rms_height, 1e-3, 2 * pi * 20e3};
    const auto count_case = [&](double error, double actual) {
      all.add(error, actual);
      by_kind[kind].add(error, actual);
      const auto above = std::ranges::upper_bound(amplitudes, amplitude) - amplitudes.begin();
      by_amplitude[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
                       above - 1, 0, static_cast<std::ptrdiff_t>(by_amplitude.size()) - 1))]
          .add(error, actual);
    };
    SweepOptions sweep;
    sweep.contact.tolerance = 1e-8;
    if (slip) {
      options.friction_coefficient = between(0.1, 0.5, chance(i, 6));
      const double steps = between(0.1, 100, chance(i, 7));
      options.excursion = steps * options.friction_coefficient * motion.normal_amplitude;
      const Drag slow{motion.normal_amplitude,
                      options.excursion / 20 * motion.angular_frequency / (2 * pi),
                      motion.angular_frequency};
      const SurfaceDamping r =
          surface_damping(surface, material, slow,
                          sweep_pressures(surface, material, {pressure}, sweep), options)[0];
      const double w = r.work_per_cycle;
      const double converged = work_with_slip_by_contacts(
          dense_forces(refined(surface, 4), material, pressure, slow.normal_amplitude, 24),
          material, slow, options.friction_coefficient, options.excursion);
      const double actual = (converged - w) / w;
      std::printf("%zu %.2f %.3g %.5g %.4f %.3f %+.4f\n", kind, options.friction_coefficient, steps,
                  w, r.work_per_cycle_error() / w, r.slip_work / w, actual);
      std::fflush(stdout);
      if (r.converged) count_case(r.work_per_cycle_error() / w, actual);
      continue;
    }
    sweep.stick = true;
    const SurfaceDamping r =
        surface_damping(surface, material, motion,
                        sweep_pressures(surface, material, {pressure}, sweep), options)[0];
    const Surface finest = refined(surface, 8);
    const double converged =
        (work_by_contacts(every_second(finest, 0), material, pressure, motion, 32, true) +
         work_by_contacts(every_second(finest, 1), material, pressure, motion, 32, true)) /
        2;
    const double w = std::abs(r.work_per_cycle), actual = (converged - r.work_per_cycle) / w;
    std::printf("%zu %.4f %.4f %.5g %.4f %.4f %.4f %.4f %.4f %.2g %+.4f %d %.3g\n", kind, load,
                amplitude, r.work_per_cycle, r.work_per_cycle_error() / w, r.error.cells / w,
                r.error.noise / w, r.error.intervals / w, r.error.stiffness_ratio / w,
                r.error.solver / w, actual, r.intervals, r.window / motion.normal_amplitude);
    std::fflush(stdout);
    if (!r.converged || !std::isfinite(converged)) continue;
    count_case(r.work_per_cycle_error() / w, actual);
  }
  std::puts(
      "| surfaces | cases | n/a | error holds | missed by over 1.6 times | largest ratio | "
      "stated, median |\n|---|---|---|---|---|---|---|");
  all.print("all");
  for (std::size_t i = 0; i < kinds.size(); ++i) by_kind[i].print(kinds[i]);
  for (std::size_t i = 0; i < by_amplitude.size(); ++i)
    by_amplitude[i].print("amplitude " + std::to_string(amplitudes[i]).substr(0, 5) + " to " +
                          std::to_string(amplitudes[i + 1]).substr(0, 5) + " h_rms");
}
