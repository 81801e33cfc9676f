// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>

#include "answers.hpp"
#include "io/plot.hpp"

/// The pictures of contacts and of their force curves.
namespace salebra::cli {

/// Pressure over mean gap with the fitted law and the window of the fit. Area and stiffness too, if
/// the curve has them. Throws InvalidInput for a curve without a converged sample.
Figure curve_figure(const ForceCurve& curve, const std::optional<ExponentialFit>& fit = {});

/// Pressure over indentation of loading and unloading; pressures may be tensile.
Figure cycle_figure(const ForceCurve& loading, const ForceCurve& unloading);

/// Maps of pressure and gap.
Figure pressure_figure(const Grid2D& grid, const NormalContactState& state);

}  // namespace salebra::cli
