// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/surface/moments.hpp>
#include <utility>
#include <vector>

#include "kriged_stiffness.hpp"

/// Contacts of a surface inside an oscillation about one load.
namespace salebra::detail {

// K_t is a maximum over the tractions: its error is about the square of this.
inline constexpr double stick_tolerance = 1e-3;
// Stated error of a kriged number, in standard deviations: 93 % of normal deviates are smaller.
inline constexpr double stated_deviations = 1.8;

/// Half the range of indentations of an oscillation about a load: with the force held the weight
/// sinks back by u_z²F''/(4K), about u_z²K/(4F), and by u_z at most.
inline double half_range(const ForceSample& load, double amplitude, bool force_held) {
  if (!force_held) return amplitude;
  return amplitude +
         std::min(amplitude, amplitude * amplitude * load.normal_stiffness / load.force / 2);
}

/// Those of half as many intervals.
inline std::vector<StiffnessSample> every_other(const std::vector<StiffnessSample>& samples) {
  std::vector<StiffnessSample> half;
  for (std::size_t k = 0; k < samples.size(); k += 2) half.push_back(samples[k]);
  return half;
}

/// ρ = K_t/((G*/E*)K) about one load, a parabola in ln F through three contacts.
class StiffnessRatio {
 public:
  struct Point {
    double force = 0, ratio = std::numeric_limits<double>::quiet_NaN();
  };

  StiffnessRatio(const Point& low, const Point& middle, const Point& high)
      : low_(known(low) ? std::log(low.force / middle.force) : 0),
        high_(known(high) ? std::log(high.force / middle.force) : 0),
        force_(middle.force),
        value_(middle.ratio) {
    if (low_ < 0) slope_ = (low.ratio - value_) / low_;
    if (high_ > 0) {
      const double other = (high.ratio - value_) / high_;
      if (low_ < 0) {
        bend_ = (other - slope_) / (high_ - low_);
        slope_ -= bend_ * low_;
      } else {
        slope_ = other;
      }
    }
  }

  /// As at the lowest or the highest of the three beyond them: where the contact opens F' goes to
  /// zero with F, and ρ does not matter.
  double at(double force) const {
    const double distance = std::clamp(std::log(std::max(force, 0.0) / force_), low_, high_);
    return value_ + distance * (slope_ + distance * bend_);
  }
  double middle() const { return value_; }
  double lowest_force() const { return force_ * std::exp(low_); }
  StiffnessRatio scaled(double factor) const {
    StiffnessRatio other = *this;
    other.value_ *= factor;
    other.slope_ *= factor;
    other.bend_ *= factor;
    return other;
  }
  /// The line parallel to the chord from the lowest to the highest, at their distance of least
  /// squares.
  StiffnessRatio straight() const {
    StiffnessRatio line = *this;
    line.bend_ = 0;
    line.slope_ = slope_ + bend_ * (low_ + high_);
    line.value_ = value_ - 2.0 / 3 * bend_ * low_ * high_;
    return line;
  }

 private:
  static bool known(const Point& point) { return std::isfinite(point.ratio) && point.force > 0; }
  double low_, high_, force_;  // ln F, from that of the middle
  double value_, slope_ = 0, bend_ = 0;
};

inline StiffnessRatio::Point point_of(const ForceSample& sample, double modulus_ratio) {
  const double ratio = sample.tangential_stiffness / (modulus_ratio * sample.normal_stiffness);
  return {sample.force, sample.converged ? ratio : std::numeric_limits<double>::quiet_NaN()};
}

/// By the neighbouring loads of the curve that converged.
inline StiffnessRatio ratio_on(const ForceCurve& curve, std::size_t load, double modulus_ratio) {
  StiffnessRatio::Point sides[2];
  for (const int side : {-1, 1})
    for (auto k = static_cast<std::ptrdiff_t>(load) + side;
         k >= 0 && k < static_cast<std::ptrdiff_t>(curve.samples.size()); k += side) {
      const auto point = point_of(curve.samples[static_cast<std::size_t>(k)], modulus_ratio);
      if (!std::isfinite(point.ratio)) continue;
      sides[side > 0] = point;
      break;
    }
  return {sides[0], point_of(curve.samples[load], modulus_ratio), sides[1]};
}

/// The contacts of one load on one grid.
class SurfaceContacts {
 public:
  SurfaceContacts(const Surface& surface, double contact_modulus, const NormalContactOptions& options)
      : surface_(surface), contact_modulus_(contact_modulus), options_(options) {
    // Where a periodic contact is full the indentation has no meaning.
    limit_ = std::numeric_limits<double>::infinity();
    if (options.boundary == Boundary::free) return;
    const HeightStatistics heights = height_statistics(surface);
    limit_ = heights.maximum - heights.mean;
  }

  bool usable() const { return converged_; }

  /// The indentation under a pressure.
  double indentation_at(double pressure) {
    NormalContactState state =
        salebra::press(surface_, contact_modulus_, at_pressure(pressure), options_);
    take(state);
    return last_at_;
  }

  StiffnessSample without_stiffness_at(double indentation) { return contact(indentation); }

  StiffnessSample at(double indentation) {
    StiffnessSample& sample = contact(indentation);
    if (sample.force > 0 && !(sample.stiffness > 0)) stiffen(sample);
    return sample;
  }

  /// K_t/((G*/E*)K) by a stick solve; NaN where nothing touches.
  StiffnessRatio::Point ratio_at(double indentation, const Material& material) {
    StiffnessSample& sample = contact(indentation);
    if (!(sample.force > 0)) return {};
    Field punch_pressure;
    const NormalContactState state = stiffen(sample, &punch_pressure);
    if (!converged_) return {};
    StickOptions stick;
    stick.tolerance = stick_tolerance;
    stick.boundary = options_.boundary;
    stick.on_progress = options_.on_progress;
    const StickStiffness tangential =
        stick_stiffness(contact_set(state), surface_.grid, material, stick, true,
                        punch_pressure * material.modulus_ratio(), surface_.communicator);
    converged_ = converged_ && tangential.converged();
    return {sample.force, tangential.xx / (material.modulus_ratio() * sample.stiffness)};
  }

 private:
  /// The contact without its stiffness, solved where it is not known.
  StiffnessSample& contact(double indentation) {
    if (indentation > 0 && indentation < limit_ && !known_.contains(indentation))
      press(indentation);
    converged_ = converged_ && indentation < limit_;
    StiffnessSample& sample = known_[indentation];
    sample.indentation = indentation;
    return sample;
  }

  /// How many cells a straight piece of the perimeter has: (1 + s)/2s of a ridge at the slope s to
  /// the grid, and all of its length where it is along the grid.
  double together(const ContactSpots& spots) const {
    const Grid2D& grid = surface_.grid;
    const double along_x = spots.perimeter_along_x / grid.dx();
    const double along_y = (spots.perimeter - spots.perimeter_along_x) / grid.dy();
    const double pieces =
        std::max({2 * std::min(along_x, along_y), 2.0 * double(spots.spots.size()), 1.0});
    return std::max(1.0, (along_x + along_y) / pieces);
  }

  /// Adds the stiffness; returns the contact, of which it needs the pressure.
  NormalContactState stiffen(StiffnessSample& sample, Field* punch_pressure = nullptr) {
    if (sample.indentation != last_at_) press(sample.indentation);
    NormalContactState state;
    state.contact_pressure = *last_;
    state.communicator = surface_.communicator;
    Field own;
    if (!punch_pressure) punch_pressure = &own;
    sample.stiffness =
        normal_stiffness(state, surface_.grid, contact_modulus_, options_, punch_pressure);
    converged_ = converged_ && std::isfinite(sample.stiffness);
    if (converged_) correct_force(sample, *punch_pressure);
    return state;
  }

  /// Corrects the force of a contact for the gaps that the solver's tolerance left in it. With the
  /// exact pressures p*, the gap is u = G(p − p*), and Gq = 1 gives Σ(p − p*) = Σqu. The error that
  /// remains is round-off, so that forces of contacts at any distance may be subtracted.
  void correct_force(StiffnessSample& sample, const Field& punch_pressure) {
    const double sum = parallel::sum_blocks(
        surface_.partition(),
        [&](Index begin, Index end) {
          double part = 0;
          for (Index k = begin * surface_.grid.ny; k < end * surface_.grid.ny; ++k)
            if (last_->data()[k] > 0) part += punch_pressure.data()[k] * last_gap_.data()[k];
          return part;
        },
        last_gap_.size());
    const double correction = sum * surface_.grid.cell_area();
    sample.force = last_force_ - correction;
    sample.force_correction = std::abs(correction);
  }

  void press(double indentation) {
    NormalContactOptions options = options_;
    last_gap_ = Field();
    const std::optional<Field> start = extrapolated(indentation);
    if (start) options.initial_pressure = &*start;
    NormalContactState state =
        salebra::press(surface_, contact_modulus_, at_indentation(indentation), options);
    // The key is what was asked for, to the last bit.
    state.indentation = indentation;
    take(state);
  }

  /// Pressures are nearly linear over the short way from two contacts to a third.
  std::optional<Field> extrapolated(double indentation) const {
    if (!before_) return last_;
    const double share = (indentation - last_at_) / (last_at_ - before_at_);
    if (std::abs(share) > 3) return last_;
    return Field((*last_ + share * (*last_ - *before_)).max(0.0));
  }

  /// The state becomes the start of the next; its pressure is moved away.
  void take(NormalContactState& state) {
    if (state.termination == Termination::interrupted) throw Interrupted("damping: interrupted");
    converged_ = converged_ && state.converged();
    StiffnessSample& sample = known_[state.indentation];
    const ContactSpots spots =
        contact_spots(state.contact_pressure, surface_.grid, options_.boundary, surface_.communicator);
    sample.indentation = state.indentation;
    sample.force = state.force;
    sample.cells =
        std::round(state.contact_area_fraction * static_cast<double>(surface_.grid.points()));
    sample.spots = static_cast<double>(spots.spots.size());
    // Along the sides of cells a curve is longer by 4/π in the mean over its directions (Cauchy and
    // Crofton).
    sample.perimeter =
        std::numbers::pi / 4 * spots.perimeter / std::sqrt(surface_.grid.cell_area());
    sample.together = together(spots);
    before_ = std::move(last_);
    before_at_ = last_at_;
    last_ = std::move(state.contact_pressure);
    last_gap_ = std::move(state.gap);
    last_force_ = state.force;
    last_at_ = state.indentation;
  }

  const Surface& surface_;
  double contact_modulus_;
  NormalContactOptions options_;
  double limit_;
  std::map<double, StiffnessSample> known_;
  std::optional<Field> last_, before_;  // whether there are any is the same in all processes
  Field last_gap_;                      // until the next is solved
  double last_at_ = 0, before_at_ = 0, last_force_ = 0;
  bool converged_ = true;
};

}  // namespace salebra::detail
