// SPDX-License-Identifier: GPL-3.0-or-later
// contact_adhesion — adhesive contacts of a self-affine surface from 256² on, on one thread.
//
// usage: contact_adhesion [N_MAX [SEED]], or contact_adhesion --sphere [N_MAX]
// H = 0.8, rms slope 1, cut-off 16 cells, roll-off a quarter of the side; w = 0.32 E*·cell,
// ρ = 1.33 cells (2.66 of van der Waals: the same largest tension), P = 0.01 E* and 0.05 E*. Prints a row for each potential and size: contacts,
// exact pairs of transforms, applications of the multilevel kernel, CPU seconds.
// --sphere: a paraboloid that is drawn off, by the potential of Maugis, against the formula of Maugis and Dugdale: for each Tabor number and
// grid the largest error of the force and of the contact radius at four indentations.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/mdr/adhesive_indenter.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <string>

#include "process_cost.hpp"

namespace {

using namespace salebra;

void draw_sphere_off(double tabor, Index points) {
  using std::numbers::pi;
  constexpr double side = 128, work = 0.1;
  const double cell = side / static_cast<double>(points), radius = tabor > 1 ? 250 : 100;
  const double range = std::cbrt(radius * work * work) / tabor;
  Surface sphere;
  sphere.grid = {points, points, side, side};
  sphere.heights = Field(points, points);
  for (Index i = 0; i < points; ++i)
    for (Index j = 0; j < points; ++j) {
      const double middle = 0.5 * static_cast<double>(points - 1);
      const double x = (static_cast<double>(i) - middle) * cell,
                   y = (static_cast<double>(j) - middle) * cell;
      sphere.heights(i, j) = -(x * x + y * y) / (2 * radius);
    }
  const Adhesion adhesion{AdhesionPotential::maugis, work, range};
  const MaugisDugdale model(radius, 1, work, range);
  const AdhesivePoint off = model.pull_off();
  AdhesiveContactOptions options{.force_coarse = true};
  options.contact.boundary = Boundary::free;
  Field tension;
  double force_error = 0, radius_error = 0, least = 0;
  const double before = bench::cpu_seconds();
  for (const double a : {1.6, 1.3, 1.15, 1.0}) {
    const AdhesivePoint expected = model.contact(a * off.contact_radius);
    const AdhesiveContactState state =
        press_adhesive(sphere, 1, at_indentation(expected.indentation), adhesion, options);
    if (!state.converged()) force_error = NAN;
    const double found = std::sqrt(state.contact_area_fraction * side * side / pi);
    force_error = std::max(force_error, std::abs(state.force - expected.force));
    radius_error = std::max(radius_error, std::abs(found - expected.contact_radius));
    least = std::min(least, state.force);
    tension = state.tension;
    options.start_tension = &tension;
  }
  const double unit = pi * work * radius;
  std::printf("%g,%ld,%.2f,%.4f,%.4f,%.4f,%.4f,%.1f\n", tabor, static_cast<long>(points),
              work * cell / (range * range), off.force / unit, least / unit, force_error / unit,
              radius_error / off.contact_radius, bench::cpu_seconds() - before);
  std::fflush(stdout);
}

int draw_spheres_off(Index largest) {
  parallel::set_threads(1);
  std::puts(
      "tabor,points,cells in the process zone,pull-off by the formula over pi w R,least force "
      "found,"
      "error of the force over pi w R,error of the radius,cpu s");
  for (const double tabor : {0.1, 0.5, 1.0, 2.0, 5.0})
    for (Index points = 64; points <= largest; points *= 2) draw_sphere_off(tabor, points);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "--sphere") == 0)
    return draw_spheres_off(argc > 2 ? std::atol(argv[2]) : 256);
  const Index largest = argc > 1 ? std::atol(argv[1]) : 1024;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  parallel::set_threads(1);
  std::puts("points,potential,pressure,area,contacts,pairs,multilevel,cpu s,termination");
  for (Index n = 256; n <= largest; n *= 2) {
    const auto side = static_cast<double>(n);
    const SelfAffineSpectrum spectrum(
        {.hurst = 0.8, .rolloff = side / 4, .short_cutoff = 16, .rms_slope = 1});
    const Surface surface = filtered_noise({n, n, side, side}, spectrum, seed);
    for (const double pressure : {0.01, 0.05})
      for (const auto& [potential, name] : EnumNames<AdhesionPotential>::values) {
        const double range = potential == AdhesionPotential::van_der_waals ? 2.66 : 1.33;
        const double before = bench::cpu_seconds();
        const AdhesiveContactState state =
            press_adhesive(surface, 1, at_pressure(pressure), {potential, 0.32, range});
        const double spent = bench::cpu_seconds() - before;
        std::printf("%ld²,%s,%g,%.4f,%d,%d,%d,%.2f,%s\n", static_cast<long>(n),
                    std::string(name).c_str(), pressure, state.contact_area_fraction,
                    state.outer_iterations, state.fft_count, state.multilevel_count, spent,
                    std::string(name_of(state.termination)).c_str());
        std::fflush(stdout);
      }
  }
}
