// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>

#include "answers.hpp"
#include "io/plot.hpp"

/// The pictures of contacts and of their force curves.
namespace salebra::cli {

/// Pressure over mean gap, with the fitted law and its window; what else the curve knows: area,
/// stiffness. Throws InvalidInput for a curve without a sample that converged.
Figure curve_figure(const ForceCurve& curve, const std::optional<ExponentialFit>& fit = {});

/// Pressure over indentation of loading and unloading, whose pressures may pull.
Figure cycle_figure(const ForceCurve& loading, const ForceCurve& unloading);

/// Maps of pressure and gap.
Figure pressure_figure(const Grid2D& grid, const NormalContactState& state);

}  // namespace salebra::cli
