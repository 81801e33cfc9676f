// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/twin.hpp>
#include <string>

#include "surface/rough_patches.hpp"

/// Known surfaces and scans of them by three instruments: 3 optical maps of 200 µm (FWHM 1.5 µm,
/// noise 3 nm), 4 scans of 40 µm with a tip of 0.3 µm, 4 of 10 µm with one of 50 nm (noise 0.3 nm,
/// lines that drift), each a place of its own of an infinite surface, with tilt, 5 % of gain for
/// each instrument and 2 % for each scan.
namespace synthetic {

using namespace salebra;

struct Truth {
  TwinDraw spectrum;
  double bend = 0;  ///< s of bent(): 0 for Gaussian heights, 0.3143 for a skewness of −1
  double rms_slope = 0;

  /// h_rms(1 − e^{−su − s²/2})/√(e^{s²} − 1), u of a Gaussian height over h_rms.
  double bent(double height) const {
    const double u = height / spectrum.rms_height;
    return spectrum.rms_height * (1 - std::exp(-bend * u - bend * bend / 2)) /
           std::sqrt(std::expm1(bend * bend));
  }
};

/// Sets amplitude and rms height of a spectrum by its slope, by Simpson's rule over ln q from far
/// below the roll-off.
inline void set_slope(Truth& truth, double slope) {
  using std::numbers::pi;
  TwinDraw& spectrum = truth.spectrum;
  double height_square = 0, slope_square = 0;
  constexpr int steps = 4000;
  const double low = std::log(2 * pi / spectrum.rolloff * 1e-3),
               step = (std::log(2 * pi / spectrum.short_cutoff) - low) / steps;
  for (int k = 0; k <= steps; ++k) {
    const double q = std::exp(low + step * k);
    const double weight = k == 0 || k == steps ? 1 : k % 2 ? 4 : 2;
    const double part = weight * step / 3 * 2 * pi * q * q * spectrum.density(q * (1 - 1e-13));
    height_square += part;
    slope_square += part * q * q;
  }
  spectrum.amplitude = 2 * std::log(slope / std::sqrt(slope_square));
  spectrum.rms_height = std::sqrt(height_square / slope_square) * slope;
  const double s2 = truth.bend * truth.bend;
  truth.rms_slope = slope * (s2 > 0 ? std::sqrt(s2 / -std::expm1(-s2)) : 1);
}

/// visit(heights, grid, instrument) of each scan in turn, n points a side.
template <class Visitor>
void for_each_scan(const Truth& truth, Index n, RoughPatches& patches, Visitor&& visit) {
  struct Kind {
    Instrument kind;
    double side;
    int count;
    double tip, noise;
    const char* name;
  };
  for (const Kind& kind : {Kind{Instrument::optical, 200e-6, 3, 0, 3e-9, "optical"},
                           Kind{Instrument::afm, 40e-6, 4, 0.3e-6, 0.3e-9, "afm 40"},
                           Kind{Instrument::afm, 10e-6, 4, 50e-9, 0.3e-9, "afm 10"}}) {
    const double gain = std::exp(0.05 * patches.normal());
    for (int scan = 0; scan < kind.count; ++scan) {
      const double sigma = 1.5e-6 / 2.355;
      const auto density = [&](double q) { return truth.spectrum.density(q); };
      Field heights;
      if (kind.kind == Instrument::optical) {
        heights = patches.patch(n, kind.side, [&](double q) {
          return density(q) * std::exp(-(q * sigma) * (q * sigma));
        });
        if (truth.bend > 0) heights = heights.unaryExpr([&](double h) { return truth.bent(h); });
      } else {
        Field fine = patches.patch(2 * n, kind.side, density);
        if (truth.bend > 0) fine = fine.unaryExpr([&](double h) { return truth.bent(h); });
        heights = every_second(
            dilated(std::move(fine), kind.side / static_cast<double>(2 * n), kind.tip));
      }
      const double slope_x = 0.3 * patches.normal(), slope_y = 0.3 * patches.normal(),
                   factor = gain * (1 + 0.02 * patches.normal());
      std::vector<double> drift(static_cast<std::size_t>(n));
      for (std::size_t line = 1; line < drift.size() && kind.tip > 0; ++line)
        drift[line] = drift[line - 1] + 0.6e-9 * patches.normal();
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
          heights(i, j) =
              factor *
              (heights(i, j) + kind.noise * patches.normal() +
               1e-6 * (slope_x * static_cast<double>(i) + slope_y * static_cast<double>(j)) /
                   static_cast<double>(n) +
               drift[static_cast<std::size_t>(j)]);
      ScanInstrument instrument;
      instrument.kind = kind.kind;
      instrument.noise = kind.noise;
      instrument.resolution = kind.kind == Instrument::optical ? 1.5e-6 : 0;
      instrument.tip_radius = kind.tip;
      instrument.name = kind.name;
      visit(std::move(heights), Grid2D{n, n, kind.side, kind.side}, instrument);
    }
  }
}

inline double log_uniform(RoughPatches& patches, double low, double high) {
  return std::exp(patches.uniform(std::log(low), std::log(high)));
}

}  // namespace synthetic
