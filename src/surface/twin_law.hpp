// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <salebra/surface/twin.hpp>
#include <span>
#include <vector>

namespace salebra::twin_detail {

/// ln C as a function of its parameters: (ln A, H, ln λ_r, ln λ_s), A being C of the power law at
/// the reference, or ln C at the knots of a spline, and ln λ_s. C ends at λ_s; that is for the
/// caller.
struct TwinLaw {
  static constexpr Index hurst = 1, rolloff = 2;

  SpectrumForm form = SpectrumForm::corner;
  double reference = 1;       ///< q0, rad/m
  std::vector<double> knots;  ///< ln(q/q0) of a table

  Index size() const {
    return form == SpectrumForm::table ? static_cast<Index>(knots.size()) + 1 : 4;
  }
  Index cutoff() const { return size() - 1; }
  bool table() const { return form == SpectrumForm::table; }
};

/// Where C is wanted.
struct LawPoints {
  LawPoints(const TwinLaw& law, std::span<const double> wavenumbers);

  std::vector<double> x;       ///< ln(q/q0)
  std::vector<double> square;  ///< (q/q0)²
  Eigen::MatrixXd basis;       ///< of a table: ln C = basis·(ln C at the knots)
};

/// values[k] = ln C at the first values.size() points.
void log_density(const TwinLaw& law, std::span<const double> parameters, const LawPoints& points,
                 std::span<double> values);

/// slopes(k, p) = ∂ln C/∂parameter p at the first `count` points, but for the cut-off's, which is 0.
void log_density_slopes(const TwinLaw& law, std::span<const double> parameters,
                        const LawPoints& points, Index count, Eigen::MatrixXd& slopes);

/// The spectrum with its moments; those of a table from the wave number `lowest` on.
TwinDraw draw_of(const TwinLaw& law, std::span<const double> parameters, double lowest);

}  // namespace salebra::twin_detail
