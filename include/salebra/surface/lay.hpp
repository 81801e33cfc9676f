// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace salebra {

/// The lay of a surface, i.e. the direction of the grooves of grinding, turning or rolling, from
/// the matrix of the mean products ⟨∂ᵢh ∂ⱼh⟩ of the gradient. The slope along a direction is least
/// along the lay and greatest across it, and the eigenvalues λ of the matrix are the squares of
/// these two rms slopes. A surface made from an isotropic one by a stretch s along the lay has the
/// ratio √(λ_across/λ_along) = s, which is also the ratio of its correlation lengths. Values are NaN
/// if unknown.
struct SurfaceLay {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  /// rms slopes along and across the lay; the sum of their squares is the square of the rms slope
  /// of surface_moments(). The slope along the lay is 0, and the ratio infinite, if it is not above
  /// the slope of the window.
  double rms_slope_along = unknown, rms_slope_across = unknown;
  double ratio = unknown;      ///< rms slope across the lay over that along it, >= 1
  double ratio_low = unknown;  ///< lower 95 % limit of `ratio`, >= 1
  /// Upper 95 % limit of `ratio`; infinite if the slope along the lay is not above its own error,
  /// as for grooves longer than the surface.
  double ratio_high = unknown;
  /// From the x axis to the lay, rad, in [0, π). The texture direction Std of ISO 25178-2 is at
  /// right angles to the lay of a surface with parallel grooves.
  double angle = unknown;
  double angle_error = unknown;  ///< standard error of `angle`, rad; at most π/√12
  /// Whether the surface is not isotropic: the difference of the two slopes is beyond the 99 % limit
  /// for isotropic surfaces of as many hills
  bool significant = false;

  /// Whether the surface has a lay: the difference of slopes is significant, and the ratio is above
  /// 1.5.
  bool found() const;
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceLay>) {
  using enum Dimension;
  using S = SurfaceLay;
  visit(&S::rms_slope_along,
        Quantity{"rms_slope_along", dimensionless, "root mean square slope along the lay"});
  visit(&S::rms_slope_across,
        Quantity{"rms_slope_across", dimensionless, "root mean square slope across the lay"});
  visit(&S::ratio,
        Quantity{"lay_ratio", dimensionless, "slope across the lay over slope along the lay"});
  visit(&S::ratio_low,
        Quantity{"lay_ratio_low", dimensionless, "lower 95 % limit of the ratio of slopes"});
  visit(&S::ratio_high,
        Quantity{"lay_ratio_high", dimensionless, "upper 95 % limit of the ratio of slopes"});
  visit(&S::angle, Quantity{"lay_angle", Dimension::angle, "direction of the lay against x"});
  visit(&S::angle_error,
        Quantity{"lay_angle_error", Dimension::angle, "standard error of the angle of the lay"});
  visit(&S::significant, Kept{"significant", "whether the surface is not isotropic"});
  visit(&S::found, Quantity{"has_lay", dimensionless, "whether the surface has a lay"});
}

/// Finds the lay of a surface:
///     const SurfaceLay lay = surface_lay(detrended(surface, Detrend::plane));
/// The matrix is ∫ qᵢqⱼ C d²q over the waves longer than four cells of the coarser axis, an equal
/// limit for all directions. A surface that is not periodic has Welch's window w, whose own slope,
/// ⟨h²⟩⟨w'²⟩/⟨w²⟩ along each axis, is subtracted. Standard errors combine the scatter of the modes,
/// whose powers are exponential variables of the mean C, and the scatter between 36 parts of the
/// surface. The difference of slopes is significant only if it exceeds what modes, parts, and 18
/// strips along the lay have by chance, so that neither a few hills nor single grooves or elongated
/// particles are a lay. Two lays that cross at right angles
/// have equal slopes and are not seen. Throws InvalidInput for fewer than 3 × 3 points, and unless
/// the surface is complete. Values are NaN if the surface is flat or has fewer than 16 points along
/// an axis. Collective. Cost: one FFT, two passes over the modes and two over the heights.
SurfaceLay surface_lay(const Surface& surface);

/// Describes a lay in words, such as "ground-like: lay 12° from x, 6 to 1"; empty unless
/// lay.found(). The ratio is "above 20 to 1", with its lower limit, if it has no upper limit.
std::string lay_in_words(const SurfaceLay& lay);

/// Directions of tangential motion that are named after the lay of the surface.
enum class LayDirection {
  automatic,  ///< across and along the lay if the surface has one, otherwise along x
  across,
  along,
  both  ///< across, then along
};

template <>
struct EnumNames<LayDirection> {
  static constexpr auto values =
      std::to_array<std::pair<LayDirection, std::string_view>>({{LayDirection::automatic, "auto"},
                                                                {LayDirection::across, "across"},
                                                                {LayDirection::along, "along"},
                                                                {LayDirection::both, "both"}});
};

/// A direction of tangential motion as a user chooses it: by the lay, or as an angle from the x
/// axis, rad.
using DirectionChoice = std::variant<LayDirection, double>;

/// Reads such a choice: auto, across, along, both, or an angle with a unit, such as "30deg". field:
/// name of the option or key in errors. Throws InvalidInput for anything else.
///     const DirectionChoice choice = direction_choice("30deg", "direction");
DirectionChoice direction_choice(std::string_view text, std::string_view field);

/// Returns the chosen directions on a surface with this lay, as angles from the x axis, rad, in
/// [0, π); `across` comes first.
///     const std::vector<double> directions = directions_of(choice, surface_lay(surface));
/// A K_t, and what depends on it, is the same in opposite directions. Throws InvalidInput for
/// `across`, `along` and `both` unless lay.found(), and for an angle that is not finite.
std::vector<double> directions_of(const DirectionChoice& choice, const SurfaceLay& lay);
/// The same for a surface, whose lay is computed only if the choice depends on it; the cost of
/// surface_lay(). Collective.
std::vector<double> directions_of(const DirectionChoice& choice, const Surface& surface);

/// Words for a direction of motion: "along x", "along y", or "at 30° to x".
std::string direction_in_words(double direction);

/// Returns the skewness of the heights if a Gaussian surface with the same correlation function
/// would rarely have it, otherwise 0. The sample skewness of a Gaussian surface of N points has the
/// variance 6 Σ_r ρ(r)³ n(r)/N², with the correlation ρ and the number n of pairs at the lag r; the
/// limit is three standard deviations. Each quarter of the map must have a skewness of the same sign
/// above 0.25. A surface that is spread over processes gives 0.
///     double skewness = significant_skewness(surface);
double significant_skewness(const Surface& surface);

/// Returns warnings for results that assume an isotropic surface or Gaussian heights: one if the
/// surface has a lay, and one if |skewness| > 0.5:
///     warnings_of_lay(surface_lay(surface), 0, "the tangential stiffness is that along x", "");
/// by_lay, by_skewness  what the lay and the skewness mean for the results, as clauses; empty if
///                      the results do not depend on them
std::vector<std::string> warnings_of_lay(const SurfaceLay& lay, double skewness,
                                         const std::string& by_lay, const std::string& by_skewness);

}  // namespace salebra
