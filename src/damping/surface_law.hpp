// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/dissipation.hpp>
#include <utility>
#include <vector>

#include "continued_law.hpp"
#include "surface_contacts.hpp"

namespace salebra::detail {

/// The stiffness ratio ρ = K_t/((G*/E*)K) of a surface over all its loads, linear in ln F between
/// points and constant beyond them.
class RatioOfLoads {
 public:
  RatioOfLoads() = default;
  explicit RatioOfLoads(const std::vector<StiffnessRatio::Point>& points) { add(points); }
  /// Adds points with a known ratio.
  void add(const std::vector<StiffnessRatio::Point>& points) {
    for (const StiffnessRatio::Point& point : points)
      if (point.force > 0 && std::isfinite(point.ratio)) points_.push_back(point);
    std::ranges::sort(points_, {}, &StiffnessRatio::Point::force);
  }

  bool empty() const { return points_.empty(); }
  double at(double force) const {
    const std::size_t above = index_above(force);
    if (above == 0) return points_.front().ratio;
    if (above == points_.size()) return points_.back().ratio;
    const auto& [low, high] = std::pair(points_[above - 1], points_[above]);
    return std::lerp(low.ratio, high.ratio,
                     std::log(force / low.force) / std::log(high.force / low.force));
  }
  /// dρ/d ln F.
  double slope(double force) const {
    const std::size_t above = index_above(force);
    if (above == 0 || above == points_.size()) return 0;
    const auto& [low, high] = std::pair(points_[above - 1], points_[above]);
    return (high.ratio - low.ratio) / std::log(high.force / low.force);
  }
  /// Straight in ln F from the first point to the last.
  RatioOfLoads straight() const {
    RatioOfLoads line = *this;
    if (points_.size() > 2) line.points_ = {points_.front(), points_.back()};
    return line;
  }
  /// Whether a point lies near a force, within a factor of 1.6.
  bool knows(double force) const {
    return std::ranges::any_of(points_, [&](const StiffnessRatio::Point& point) {
      return std::abs(std::log(point.force / force)) < 0.5;
    });
  }

 private:
  std::size_t index_above(double force) const {
    return std::size_t(std::ranges::upper_bound(points_, force, {}, &StiffnessRatio::Point::force) -
                       points_.begin());
  }
  std::vector<StiffnessRatio::Point> points_;
};

/// The law of a surface through solved contacts. F and K come from a TabulatedLaw, and K_t is
/// (G*/E*)ρK. As ρ changes slowly, K_t follows the forces between contacts, which separately
/// interpolated values of K_t would not.
class SurfaceLaw final : public ContactLaw {
 public:
  SurfaceLaw(const std::vector<StiffnessSample>& contacts, RatioOfLoads ratio, double modulus_ratio)
      : ContactLaw(modulus_ratio),
        table_(curve_of(contacts), modulus_ratio),
        ratio_(std::move(ratio)) {}

  double force(double indentation) const override { return table_.force(indentation); }
  double normal_stiffness(double indentation) const override {
    return table_.normal_stiffness(indentation);
  }
  double force_curvature(double indentation) const override {
    return table_.force_curvature(indentation);
  }
  double tangential_stiffness(double indentation) const override {
    return stiffness_ratio(indentation) * normal_stiffness(indentation);
  }
  double tangential_curvature(double indentation) const override {
    const double force = this->force(indentation), stiffness = normal_stiffness(indentation);
    if (!(force > 0)) return 0;
    return stiffness_ratio(indentation) * force_curvature(indentation) +
           modulus_ratio() * ratio_.slope(force) * stiffness * stiffness / force;
  }
  double stiffness_ratio(double indentation) const override {
    return modulus_ratio() * ratio_.at(force(indentation));
  }
  double first_touch() const override { return table_.first_touch(); }
  double lowest_indentation() const override { return table_.lowest_indentation(); }
  double highest_indentation() const override { return table_.highest_indentation(); }
  double indentation_of(double force) const override { return table_.indentation_of(force); }
  std::vector<double> break_points() const override { return table_.break_points(); }

 private:
  static ForceCurve curve_of(const std::vector<StiffnessSample>& contacts) {
    ForceCurve curve;
    for (const StiffnessSample& contact : contacts) {
      ForceSample& sample = curve.samples.emplace_back();
      sample.indentation = contact.indentation;
      sample.force = contact.force;
      sample.normal_stiffness = contact.stiffness;
      sample.converged = true;
    }
    return curve;
  }

  TabulatedLaw table_;
  RatioOfLoads ratio_;
};

/// The mean indentation of an oscillation about a contact that carries `force` at rest. Above its
/// contacts the law continues exponentially, a guess of what further contacts are needed.
inline double mean_indentation(const ContactLaw& law, double force, double amplitude, Hold hold) {
  if (hold != Hold::force) return law.indentation_of(force);
  return indentation_at_mean_force(ContinuedLaw(law), force, amplitude);
}

/// The largest amplitude up to `asked` with which the oscillation stays below the indentation
/// `end`.
inline double possible_amplitude(const ContactLaw& law, double force, double asked, Hold hold,
                                 double end) {
  double possible = 0, beyond = asked;
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = (possible + beyond) / 2;
    (mean_indentation(law, force, middle, hold) + middle < end ? possible : beyond) = middle;
  }
  // The guess of the mean indentation is off by some per mille.
  return 0.99 * possible;
}

/// Throws InvalidInput for an oscillation that presses a surface beyond full contact. possible: the
/// largest amplitude that does not, m.
inline void refuse_full_contact(double amplitude, double pressure, double possible) {
  require(false, "normal_amplitude", amplitude,
          fmt::format("m presses the surface beyond full contact at the pressure {}; at most {} is "
                      "possible there",
                      format_quantity(pressure, Dimension::pressure, 3),
                      format_quantity(possible, Dimension::length, 3)));
}

/// The indentation of a further contact for an oscillation that reaches `needed`, above the law's
/// highest indentation; `limit` is that of full contact. Empty if the surface cannot be pressed as
/// far.
inline std::optional<double> further_indentation(const ContactLaw& law, double needed, double limit,
                                                 Hold hold) {
  const double top = law.highest_indentation();
  const double length = law.force(top) / law.normal_stiffness(top);
  // With a held indentation the motion is known; with a held force the guess of it may be too high.
  if (hold == Hold::force ? limit - top < 0.02 * length : needed >= limit) return {};
  return std::min(needed + 0.05 * length, top + (limit - top) / 2);
}

}  // namespace salebra::detail
