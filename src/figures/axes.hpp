// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/units.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/figures/figure.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {
struct AssumptionVerdict;
struct LawDescription;
}  // namespace salebra

namespace salebra::figures {

/// The axis of a quantity that has this name in JSON and files. label: instead of its meaning.
Axis axis_of(std::string_view quantity, bool logarithmic = false, std::string_view label = {});
/// "slow shear over 1 nm at 1 mm/s under 100 pm at 20 kHz"; without the quantity of that name and
/// unknown numbers. excursion: of a slow shear, m; NaN: not known.
std::string motion_text(const Motion& motion, std::string_view varied = {},
                        double excursion = std::numeric_limits<double>::quiet_NaN());
/// " Motion: 1 nm tangential and …, µ = 0.3, F = 10 N" for the end of a caption.
/// friction_coefficient: NaN or infinite for no slip. force: N; NaN if it is not constant.
std::string setting_text(const std::string& motion, double friction_coefficient, double force);
/// "25.3 nm", in a unit that may get a prefix.
std::string value_text(double value, const std::string& unit);
/// "25.3 nm (24.1 … 26.5)"; without the limits where they are unknown.
std::string interval_text(double value, double low, double high, Dimension dimension);
/// "25.3 nm ± 2 %"; without the error where it is unknown, and without the value where it is no larger
/// than its error.
std::string error_text(double value, double error, Dimension dimension);
/// "not valid: plasticity", the validity that these verdicts give and what decides it, or "validity
/// not checked"; empty if all assumptions hold.
std::string validity_text(std::span<const AssumptionVerdict> verdicts);
/// " (poor law: do not use Eq. (16))" for an exponential law that describes its curve poorly.
std::string poor_law(const LawDescription& law);
/// The title of the contact model of this name; any other name as it is.
std::string title_of(std::string_view name);
/// Whether positive values span more than 1.5 decades.
bool spans_decades(const std::vector<double>& values);
/// Whether the values of a list call for a logarithmic axis: they span decades, or each is the one
/// before times the same factor.
bool grows_by_factors(const std::vector<double>& values);
/// Sets the limits of these axes that have none, so that all curves, bands and named reference lines
/// of the panels lie between them, with a margin; an axis without negative values does not extend
/// below 0. The axes get the same limits, and are linear or logarithmic as the first one.
void set_limits(const std::vector<Panel*>& panels, Axis Panel::*axis);
/// The centres of cells that begin at 0, so that a map ends at the size of the surface.
std::vector<double> cells(Index count, double step);
/// A map of a field over the cells of a grid, in colours.
Panel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                const Axis& scale);
/// Limit of the colour scale: the magnitude of shear stress that 2 % of the points with stress
/// exceed. Otherwise the singularities of the stress would use up the scale.
double colour_limit(const Field& shear);

}  // namespace salebra::figures
