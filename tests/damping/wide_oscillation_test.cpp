// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/surface/moments.hpp>

#include "surface/refine.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

const Material material = Material::of_contact_modulus(1e9, 0.3);
constexpr double angular_frequency = 2 * pi * 20e3, slope = 0.1;

Surface rough(Index points, std::uint64_t seed) {
  const Grid2D grid{points, points, 1e-6, 1e-6};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.7, .rolloff = 0.3e-6, .short_cutoff = 8 * grid.dx(), .rms_slope = slope});
  return filtered_noise(grid, spectrum, seed);
}

/// Springs of a surface from the forces of contacts at equal steps of the indentation, without
/// stiffnesses and without interpolation: between two contacts K is the mean, and a spring with the
/// jump of K touches at each contact. K_t = (G*/E*)K.
class SpringsOfForces {
 public:
  SpringsOfForces(const Surface& surface, double highest, int count)
      : step_(highest / count), force_{0}, area_(surface.grid.area()) {
    NormalContactOptions options;
    options.tolerance = 1e-9;
    Field start;
    for (int k = 1; k <= count; ++k) {
      const NormalContactState state =
          press(surface, material.contact_modulus, at_indentation(k * step_), options);
      force_.push_back(state.force);
      start = state.contact_pressure;
      options.initial_pressure = &start;
    }
  }
  double force(double indentation) const {
    if (!(indentation > 0)) return 0;
    const auto below = std::min(std::size_t(indentation / step_), force_.size() - 2);
    return std::lerp(force_[below], force_[below + 1], indentation / step_ - double(below));
  }
  double highest() const { return step_ * double(force_.size() - 1); }
  double mean_force(double mean, double amplitude) const {
    constexpr int phases = 2000;
    double sum = 0;
    for (int k = 0; k < phases; ++k)
      sum += force(mean + amplitude * std::cos(pi * (k + 0.5) / phases)) / phases;
    return sum;
  }
  double indentation_of(double force) const {
    return bisected([&](double at) { return this->force(at) - force; });
  }
  double at_mean_force(double force, double amplitude) const {
    return bisected([&](double at) { return mean_force(at, amplitude) - force; });
  }
  /// Loss of a spring without slip: half its stiffness times the square of the distance over which
  /// it is closed.
  double work(double mean, const Drag& motion) const {
    const double speed = motion.drag_velocity / motion.angular_frequency;
    double sum = 0;
    for (std::size_t k = 0; k + 1 < force_.size(); ++k) {
      const double cosine = (double(k) * step_ - mean) / motion.normal_amplitude;
      if (cosine < -1 || cosine > 1) continue;
      sum += stiffness(k) * std::pow(2 * speed * std::acos(cosine), 2) / 2;
    }
    return material.modulus_ratio() * sum;
  }

 private:
  double stiffness(std::size_t k) const {
    const double above = force_[k + 1] - force_[k], below = k > 0 ? force_[k] - force_[k - 1] : 0;
    return (above - below) / step_;
  }
  double bisected(const auto& excess) const {
    double low = -100 * highest(), high = highest();
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (low + high) / 2;
      (excess(middle) > 0 ? high : low) = middle;
    }
    return low;
  }
  double step_;
  std::vector<double> force_;
  double area_;
};

}  // namespace

TEST_CASE("scan", "[.]") {
  for (const Index points : {64})
    for (const int seed : {1, 2, 3}) {
      const Surface surface = rough(points, std::uint64_t(seed));
      const Surface fine = refined(surface, 4);
      const double full = height_statistics(fine).maximum - height_statistics(fine).mean;
      const SpringsOfForces springs(fine, 0.98 * full, 400);
      for (const double load : {0.005, 0.03}) {
        SweepOptions sweep;
        const ForceCurve curve =
            sweep_pressures(surface, material, {load * slope * material.contact_modulus}, sweep);
        const ForceSample& s = curve.samples[0];
        const double length = s.force / s.normal_stiffness;
        for (const double ratio : {0.3, 0.74, 0.76, 1.0, 1.5, 2.0, 3.0, 30.0})
          for (const Hold hold : {Hold::indentation, Hold::force}) {
            const Drag motion{ratio * length, 1e-6, angular_frequency};
            SurfaceDampingOptions options;
            options.hold = hold;
            const SurfaceDamping r = surface_damping(surface, material, motion, curve, options)[0];
            const double mean = hold == Hold::force
                                    ? springs.at_mean_force(s.force, motion.normal_amplitude)
                                    : springs.indentation_of(s.force);
            const double w = springs.work(mean, motion);
            std::printf(
                "%d %d p %.3f u/l %4.1f %s W %.4g brute %.4g dev %+.1f%% err %.1f%% (cells %.1f noise %.1f int "
                "%.1f ratio %.1f touch %.2f) n %d Fmax/F %.2f ct %.2f poss %.2g d/l %.1f top/full %.2f\n",
                int(points), seed, load, ratio, hold == Hold::force ? "F" : "d", r.work_per_cycle, w,
                100 * (r.work_per_cycle / w - 1), 100 * r.work_per_cycle_error() / w,
                100 * r.error.cells / w, 100 * r.error.noise / w, 100 * r.error.intervals / w,
                100 * r.error.stiffness_ratio / w, 100 * r.error.first_touch / w, r.intervals,
                r.max_force / s.force, r.contact_time, r.possible_amplitude / length,
                s.indentation / length, (mean + motion.normal_amplitude) / full);
            std::fflush(stdout);
          }
      }
    }
}
