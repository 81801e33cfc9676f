// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <salebra/base/enum_names.hpp>
#include <salebra/damping/quantities.hpp>
#include <variant>
#include <vector>

namespace salebra {

/// Case (a): a normal oscillation z = u_z cos ωt (towards contact) and a tangential oscillation x =
/// u_x cos(ωt + φ0) of the same frequency.
struct EqualFrequency {
  double normal_amplitude = 0;      ///< u_z >= 0, m
  double tangential_amplitude = 0;  ///< u_x, m
  double phase = 0;                 ///< φ0, rad
  /// ω > 0, rad/s, or 0 where it is not known: the work per cycle does not depend on it, only power
  /// and damping constant do.
  double angular_frequency = 0;
};

constexpr void describe(auto&& visit, std::type_identity<EqualFrequency>) {
  using S = EqualFrequency;
  visit(&S::normal_amplitude, quantity::normal_amplitude);
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::phase, quantity::phase);
  visit(&S::angular_frequency, quantity::angular_frequency);
}

/// Case (b): a normal oscillation z = u_z cos ωt and a slow tangential motion to and fro with
/// velocity v. To avoid sliding, the distance between its turning points must be far below
/// (μE*/G*)F/K; a motion that never reverses ends in sliding.
struct Drag {
  double normal_amplitude = 0;   ///< u_z >= 0, m
  double drag_velocity = 0;      ///< v, m/s
  double angular_frequency = 0;  ///< ω > 0, rad/s

  /// Tangential distance per normal cycle, w = 2π|v|/ω, m. The motion is slow if the distance
  /// between its turning points is many times w.
  double distance_per_cycle() const {
    return 2 * std::numbers::pi * std::abs(drag_velocity) / angular_frequency;
  }
};

constexpr void describe(auto&& visit, std::type_identity<Drag>) {
  visit(&Drag::normal_amplitude, quantity::normal_amplitude);
  visit(&Drag::drag_velocity, quantity::drag_velocity);
  visit(&Drag::angular_frequency, quantity::angular_frequency);
}

using Oscillation = std::variant<EqualFrequency, Drag>;

/// Two frequencies: z = u_z cos ω_z t, x = u_x cos(ω_x t + φ0). Equal frequencies are case (a),
/// EqualFrequency; for ω_x ≪ ω_z the loss tends to case (b), Drag.
struct TwoFrequencies {
  double normal_amplitude = 0;              ///< u_z >= 0, m
  double tangential_amplitude = 0;          ///< u_x, m
  double phase = 0;                         ///< φ0, rad: phase of x at a maximum of z
  double normal_angular_frequency = 0;      ///< ω_z > 0, rad/s
  double tangential_angular_frequency = 0;  ///< ω_x > 0, rad/s
};

constexpr void describe(auto&& visit, std::type_identity<TwoFrequencies>) {
  using enum Dimension;
  using S = TwoFrequencies;
  visit(&S::normal_amplitude, quantity::normal_amplitude);
  visit(&S::tangential_amplitude, quantity::tangential_amplitude);
  visit(&S::phase, quantity::phase);
  visit(&S::normal_angular_frequency,
        Kept{"normal_angular_frequency", "angular frequency of the normal oscillation",
             angular_frequency});
  visit(&S::tangential_angular_frequency,
        Kept{"tangential_angular_frequency", "angular frequency of the tangential oscillation",
             angular_frequency});
}

/// Any motion given by its parameters.
///
///     Motion motion = EqualFrequency{1e-9, 1e-10, std::numbers::pi / 2, 1e5};
using Motion = std::variant<EqualFrequency, Drag, TwoFrequencies>;

/// Returns the motion as an Oscillation; empty for TwoFrequencies.
std::optional<Oscillation> oscillation_of(const Motion& motion);
/// Converts an Oscillation to a Motion.
Motion motion_of(const Oscillation& motion);

/// Common period of two frequencies, ω_x/ω_z = tangential_cycles/normal_cycles in lowest terms.
/// Both numbers are 0 if no such fraction with at most `max_cycles` normal cycles agrees to 1e-9:
/// the motion then counts as never repeating, and results are means instead of sums over a period.
struct CommonPeriod {
  int normal_cycles = 0;      ///< normal cycles p in the period
  int tangential_cycles = 0;  ///< tangential cycles q in the period
};

constexpr void describe(auto&& visit, std::type_identity<CommonPeriod>) {
  using enum Dimension;
  using S = CommonPeriod;
  visit(&S::normal_cycles,
        Quantity{"normal_cycles", dimensionless, "normal cycles in the common period"});
  visit(&S::tangential_cycles,
        Quantity{"tangential_cycles", dimensionless, "tangential cycles in the common period"});
}
CommonPeriod common_period(const TwoFrequencies& motion, int max_cycles = 1000);

/// One period of any motion, with straight lines between the samples; the last sample is the end of
/// the period. There, δ is back at its first value; x may have advanced by a drift, which repeats
/// in every period (as for a Drag).
struct SampledMotion {
  std::vector<double> time;          ///< s, strictly increasing
  std::vector<double> indentation;   ///< δ, m
  std::vector<double> displacement;  ///< x, m

  double period() const { return time.back() - time.front(); }
  double drift() const { return displacement.back() - displacement.front(); }
  /// Throws InvalidInput unless the columns have equal length >= 3, all values are finite, time
  /// increases, and the last δ equals the first within 1e-9 of the range of δ.
  void validate() const;
};

constexpr void describe(auto&& visit, std::type_identity<SampledMotion>) {
  using enum Dimension;
  using S = SampledMotion;
  visit(&S::time, quantity::time);
  visit(&S::indentation, quantity::indentation);
  visit(&S::displacement, Quantity{"displacement", length, "tangential displacement"});
  visit(&S::period, Kept{"period", "duration of the period", Dimension::time});
  visit(&S::drift, Kept{"drift", "displacement of a period", length});
}

/// Returns one period of a motion about a mean indentation, starting at a minimum of δ, with
/// `steps` straight steps for each normal cycle. An EqualFrequency of unknown ω gets a period of 2π
/// s. Throws InvalidInput for TwoFrequencies without a common period.
SampledMotion sample(const Oscillation& motion, double mean_indentation, int steps);
SampledMotion sample(const TwoFrequencies& motion, double mean_indentation, int steps);

/// The quantity that stays constant when a normal oscillation of finite amplitude starts.
enum class Hold {
  indentation,  ///< the mean indentation
  force,        ///< the mean force, as under a dead weight or in a preloaded machine
  /// The mean force if a force is given and the contact would lift off from the indentation at
  /// rest, otherwise the mean indentation: hold_of().
  automatic
};

template <>
struct EnumNames<Hold> {
  static constexpr auto values = std::to_array<std::pair<Hold, std::string_view>>(
      {{Hold::indentation, "indentation"}, {Hold::force, "force"}, {Hold::automatic, "auto"}});
};

}  // namespace salebra
