// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <salebra/surface/twin.hpp>
#include <span>
#include <vector>

namespace salebra::twin_detail {

/// ln of the power spectral density C as a function of its parameters. Self-affine forms have the
/// parameters ln A, Hurst exponent, ln of the roll-off wavelength λ_r and ln of the cut-off
/// wavelength λ_s, where A is the C of the power law at the wave number `reference`; a table has ln
/// C at the knots of a spline, and ln λ_s. The caller must set C to 0 at wavelengths below λ_s.
struct TwinLaw {
  static constexpr Index hurst = 1, rolloff = 2;

  SpectrumForm form = SpectrumForm::corner;
  double reference = 1;       ///< q0, rad/m
  std::vector<double> knots;  ///< ln(q/reference) of the knots of a table

  Index size() const {
    return form == SpectrumForm::table ? static_cast<Index>(knots.size()) + 1 : 4;
  }
  Index cutoff() const { return size() - 1; }
  bool table() const { return form == SpectrumForm::table; }
};

/// Wave numbers q at which C is evaluated, with powers of q and spline bases computed in advance.
struct LawPoints {
  LawPoints(const TwinLaw& law, std::span<const double> wavenumbers);

  std::vector<double> x;       ///< ln(q/reference)
  std::vector<double> square;  ///< (q/reference)²
  Eigen::MatrixXd basis;       ///< for a table: ln C = basis·(ln C at the knots)
};

/// values[k] = ln of the power spectral density at points k = 0 … values.size() − 1.
void log_density(const TwinLaw& law, std::span<const double> parameters, const LawPoints& points,
                 std::span<double> values);

/// slopes(k, p) = ∂ln C/∂(parameter p) at the points k < count, with the power spectral density C;
/// 0 for the cut-off.
void log_density_slopes(const TwinLaw& law, std::span<const double> parameters,
                        const LawPoints& points, Index count, Eigen::MatrixXd& slopes);

/// The spectrum with these parameters, and its moments; the moments of a table begin at the wave
/// number `lowest`.
TwinDraw draw_of(const TwinLaw& law, std::span<const double> parameters, double lowest);

}  // namespace salebra::twin_detail
