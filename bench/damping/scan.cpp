// SPDX-License-Identifier: GPL-3.0-or-later
// Reference damping constants of a scan: `oscillate --boundary periodic --method levels` on finer
// cells, load by load.
//   damping_scan SURFACE FACTOR LEVELS PRESSURE... (Pa)
// A paragraph of measured.toml's material and motion: E* = 115 GPa, nu = 0.3, 1 nm at 20 kHz. One
// line per load: pressure, γ and the error that the levels state, N s/m, F'', γ of K_t = (G*/E*)F',
// cells that enter, seconds. Each contact starts from the last two, in place of coarser grids.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/surface/detrend.hpp>

#include "surface/refine.hpp"

using namespace salebra;

namespace {

/// Levels of a surface, each from the two before it.
class WarmLevels {
 public:
  WarmLevels(const Surface& surface, double contact_modulus)
      : surface_(surface), contact_modulus_(contact_modulus) {}

  ContactSetAt at(double indentation) {
    Field start = last_;
    if (before_.size() > 0 && last_at_ != before_at_)
      start =
          (last_ + (indentation - last_at_) / (last_at_ - before_at_) * (last_ - before_)).max(0.0);
    NormalContactOptions options;
    if (start.size() > 0) options.initial_pressure = &start;
    return take(press(surface_, contact_modulus_, at_indentation(indentation), options));
  }
  double indentation_at(double pressure) {
    NormalContactOptions options;
    if (last_.size() > 0) options.initial_pressure = &last_;
    take(press(surface_, contact_modulus_, at_pressure(pressure), options));
    return last_at_;
  }

 private:
  ContactSetAt take(NormalContactState state) {
    ContactSetAt level{contact_set(state), state.force, state.converged()};
    before_ = std::move(last_);
    before_at_ = last_at_;
    last_ = std::move(state.contact_pressure);
    last_at_ = state.indentation;
    return level;
  }
  const Surface& surface_;
  double contact_modulus_;
  Field last_, before_;
  double last_at_ = 0, before_at_ = 0;
};

}  // namespace

int main(int count, char** words) {
  if (count < 5) return 2;
  const Surface surface =
      refined(detrended(read_surface(words[1]), Detrend::plane), std::atoi(words[2]));
  const Material material = Material::of_contact_modulus(115e9, 0.3);
  const Drag motion{1e-9, 1e-6, 2 * std::numbers::pi * 20e3};
  IntervalQuadratureOptions options;
  options.intervals = std::atoi(words[3]);
  WarmLevels warm(surface, material.contact_modulus);
  for (int k = 4; k < count; ++k) {
    const double pressure = std::atof(words[k]);
    const auto start = std::chrono::steady_clock::now();
    const double indentation = warm.indentation_at(pressure);
    const IntervalQuadratureResult result =
        interval_quadrature([&](double at) { return warm.at(at); }, surface.grid, material, motion,
                            indentation, options);
    const auto constant = [&](double work) { return closed_form::damping_constant(work, motion); };
    std::printf("%.5g %.6g %.3g %.5g %.6g %.0f %.0f%s\n", pressure, constant(result.work_per_cycle),
                constant(result.error_estimate), result.force_curvature,
                constant(result.work_by_force),
                (result.curve.samples.back().contact_area_fraction -
                 result.curve.samples.front().contact_area_fraction) *
                    double(surface.grid.points()),
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                result.converged() ? "" : " not converged");
    std::fflush(stdout);
  }
}
