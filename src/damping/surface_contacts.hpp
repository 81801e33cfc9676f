// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/surface/moments.hpp>
#include <span>
#include <utility>
#include <vector>

#include "kriged_stiffness.hpp"

/// Solved contacts of one surface at the indentations that an oscillation about one load passes.
namespace salebra::detail {

// Tolerance of the stick solves. The relative error of K_t is about its square, because K_t is the
// maximum of a functional of the tractions.
inline constexpr double stick_tolerance = 1e-3;
// The stated error of a kriged quantity is this number of standard deviations; 93 % of normally
// distributed errors are smaller.
inline constexpr double stated_deviations = 1.8;

/// hold_of() for a surface under the loads of a curve, so that they can be compared: the mean force
/// if the contact lifts off at one of them. The indentation of a surface is measured from first
/// touch.
inline Hold hold_of(const ForceCurve& curve, double amplitude, Hold wanted) {
  if (wanted != Hold::automatic) return wanted;
  const bool lifts_off = std::ranges::any_of(curve.samples, [&](const ForceSample& load) {
    return load.converged && amplitude > load.indentation;
  });
  return lifts_off ? Hold::force : Hold::indentation;
}

/// The same for a surface whose lowest pressure is known, from one contact.
inline Hold hold_of(const Surface& surface, const Body& body, double lowest_pressure,
                    double amplitude, Hold wanted, const Progress& progress) {
  if (wanted != Hold::automatic) return wanted;
  NormalContactOptions options;
  options.on_progress = progress;
  const NormalContactState state = press(surface, body, at_pressure(lowest_pressure), options);
  if (state.termination == Termination::interrupted) throw Interrupted("damping: interrupted");
  return amplitude > state.indentation ? Hold::force : Hold::indentation;
}

/// Indentation of a periodic surface at full contact, m: the height of its highest point above the
/// mean plane.
inline double full_contact(const Surface& surface) {
  const HeightStatistics heights = height_statistics(surface);
  return heights.maximum - heights.mean;
}

/// Half the range of indentations that an oscillation about a load passes. If the mean force is
/// held, the mean indentation decreases by u_z²F''/(4K), which is about u_z²K/(4F); u_z at most is
/// allowed for.
inline double half_range(const ForceSample& load, double amplitude, bool force_held) {
  if (!force_held) return amplitude;
  return amplitude +
         std::min(amplitude, amplitude * amplitude * load.normal_stiffness / load.force / 2);
}

/// Every second sample, as if the range had been divided into half as many intervals.
inline std::vector<StiffnessSample> every_other(const std::vector<StiffnessSample>& samples) {
  std::vector<StiffnessSample> half;
  for (std::size_t k = 0; k < samples.size(); k += 2) half.push_back(samples[k]);
  return half;
}

/// The stiffness ratio ρ = K_t/((G*/E*)K) about one load, as a parabola in ln F through three
/// contacts with lower, equal and higher force.
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

  /// ρ at a force. Constant below the lowest and above the highest of the three forces. Where the
  /// contact opens, K goes to zero with F, so ρ has no effect there.
  double at(double force) const {
    const double distance = std::clamp(std::log(std::max(force, 0.0) / force_), low_, high_);
    return value_ + distance * (slope_ + distance * bend_);
  }
  double middle() const { return value_; }
  /// d ln ρ/d ln F at the middle point; NaN if ρ is known there alone.
  double exponent() const {
    return low_ < 0 || high_ > 0 ? slope_ / value_ : std::numeric_limits<double>::quiet_NaN();
  }
  double lowest_force() const { return force_ * std::exp(low_); }
  StiffnessRatio scaled(double factor) const {
    StiffnessRatio other = *this;
    other.value_ *= factor;
    other.slope_ *= factor;
    other.bend_ *= factor;
    return other;
  }
  /// A straight line in ln F instead of the parabola: parallel to the chord from the lowest to the
  /// highest point, and fitted to the three points by least squares.
  StiffnessRatio straight() const {
    StiffnessRatio line = *this;
    line.bend_ = 0;
    line.slope_ = slope_ + bend_ * (low_ + high_);
    line.value_ = value_ - 2.0 / 3 * bend_ * low_ * high_;
    return line;
  }

 private:
  static bool known(const Point& point) { return std::isfinite(point.ratio) && point.force > 0; }
  // Ln F of the lowest and highest point, relative to the middle one; F of the middle point.
  double low_, high_, force_;
  double value_, slope_ = 0, bend_ = 0;
};

/// Relative error of a loss with slip from springs of a body that is not a half-space: |m| for K_t/K ∝
/// F^m. Coulomb's law of the springs needs a K_t/K that is the same at all loads; where it is, as on
/// half-spaces and graded bodies, the springs are right. On two layers with |m| from 0.05 to 0.34 and
/// three motions of one surface, direct simulations differ by 1.8 to 4.4 % from the springs.
inline double spring_error(const Body& body, double exponent) {
  return body.half_space_material() ? 0 : std::abs(exponent);
}

/// G*/E* of half-spaces. Any other body has no such constant: 1, so that ρ is K_t/K itself.
inline double modulus_ratio_of(const Body& body) {
  const auto& material = body.half_space_material();
  return material ? material->modulus_ratio() : 1;
}

/// Direction of the tangential motion of a contact, rad: along x if its K_t has no direction.
inline double direction_of(const ForceSample& sample) {
  return std::isnan(sample.direction) ? 0 : sample.direction;
}

inline StiffnessRatio::Point point_of(const ForceSample& sample, double modulus_ratio) {
  const double ratio = sample.tangential_stiffness / (modulus_ratio * sample.normal_stiffness);
  return {sample.force, sample.converged ? ratio : std::numeric_limits<double>::quiet_NaN()};
}

/// ρ about a load of the curve. The lower and the higher point are the nearest loads on either side
/// that converged.
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

/// Force of a contact that the solver's tolerance added, N, by the gaps that it left in cells in
/// contact. With the exact pressures p* and the compliance matrix G, these gaps are u = G(p − p*).
/// The pressures q of a unit indentation of the contact satisfy Gq = 1, hence Σ(p − p*) = Σqu. The
/// remaining error is round-off, so forces of contacts at any distance may be subtracted.
inline double excess_force(const Field& pressure, const Field& gap, const Field& growth,
                           const Surface& surface) {
  const Grid2D& grid = surface.grid;
  return grid.cell_area() * parallel::sum_blocks(
                                surface.partition(),
                                [&](Index begin, Index end) {
                                  double part = 0;
                                  for (Index k = begin * grid.ny; k < end * grid.ny; ++k)
                                    if (pressure.data()[k] > 0)
                                      part += growth.data()[k] * gap.data()[k];
                                  return part;
                                },
                                gap.size());
}

/// A contact of a force curve, kept for the oscillation about its load: 16 bytes per cell in
/// contact.
class KeptContact {
 public:
  KeptContact() = default;
  /// growth: dp/dδ of each cell, Pa/m.
  KeptContact(const NormalContactState& state, double stiffness, const Field& growth,
              const Surface& surface)
      : indentation_(state.indentation),
        force_(state.force),
        stiffness_(stiffness),
        excess_(excess_force(state.contact_pressure, state.gap, growth, surface)) {
    cells_.reserve(static_cast<std::size_t>((state.contact_pressure > 0).count()));
    for (Index k = 0; k < growth.size(); ++k)
      if (const double pressure = state.contact_pressure.data()[k]; pressure > 0)
        cells_.push_back({k, static_cast<float>(pressure), static_cast<float>(growth.data()[k])});
  }

 private:
  friend class SurfaceContacts;
  struct Cell {
    Index index;
    float pressure, growth;
  };
  double indentation_ = 0, force_ = 0, stiffness_ = 0, excess_ = 0;
  std::vector<Cell> cells_;  // of this process
};

/// Contacts of the loads of a force curve; empty for loads without one.
using KeptContacts = std::vector<std::optional<KeptContact>>;

/// The contacts of one surface on one grid, solved when they are needed and then kept.
class SurfaceContacts {
 public:
  /// along_x_only: K_t is needed along x only, which halves the cost of the stick solves.
  SurfaceContacts(const Surface& surface, const Body& body, const NormalContactOptions& options,
                  bool along_x_only = true)
      : surface_(surface), body_(body), options_(options), along_x_only_(along_x_only) {
    // A periodic surface at full contact has no indentation from its mean plane, so indentations
    // must stay below this limit.
    limit_ = std::numeric_limits<double>::infinity();
    peak_ = full_contact(surface);
    if (options.boundary == Boundary::periodic && body.stops_at_full_contact()) limit_ = peak_;
  }

  /// Indentation at full contact, m; infinity for a surface alone on a half-space.
  double limit() const { return limit_; }
  /// Height of the highest point above the mean plane, m, at which the indentation is 0.
  double peak() const { return peak_; }

  bool usable() const { return converged_; }

  /// The indentation, m, at a pressure.
  double indentation_at(double pressure) {
    if (const auto found = indentations_.find(pressure); found != indentations_.end())
      return found->second;
    NormalContactState state = salebra::press(surface_, body_, at_pressure(pressure), options_);
    take(state);
    return indentations_[pressure] = last_.at;
  }

  /// Takes over a contact solved at a pressure.
  void take(double pressure, const KeptContact& kept) {
    NormalContactState state;
    state.indentation = kept.indentation_;
    state.force = kept.force_;
    state.termination = Termination::converged;
    state.contact_pressure = Field::Zero(surface_.heights.rows(), surface_.heights.cols());
    Field growth = state.contact_pressure;
    for (const KeptContact::Cell& cell : kept.cells_) {
      state.contact_pressure.data()[cell.index] = cell.pressure;
      growth.data()[cell.index] = cell.growth;
    }
    take(state);
    last_.growth = std::move(growth);
    indentations_[pressure] = kept.indentation_;
    StiffnessSample& sample = known_[kept.indentation_];
    sample.stiffness = kept.stiffness_;
    set_correction(sample, kept.force_, kept.excess_);
  }

  /// Number of cells that leave while the bodies approach over number of those that enter, between
  /// the contacts solved so far; 0 on half-spaces, whose contact sets are nested. Collective.
  double leaving_share() const {
    if (sets_.size() < 2) return 0;
    // All processes must decide alike whether the loss is refused.
    const std::vector<double> moved = parallel::sum_blocks(
        surface_.partition(), 2, [&](Index begin, Index end, std::span<double> sums) {
          for (auto one = sets_.begin(), next = std::next(one); next != sets_.end(); ++one, ++next)
            for (auto k = static_cast<std::size_t>(begin * surface_.grid.ny);
                 k < static_cast<std::size_t>(end * surface_.grid.ny); ++k) {
              sums[0] += one->second[k] && !next->second[k];
              sums[1] += !one->second[k] && next->second[k];
            }
        });
    return moved[1] > 0 ? moved[0] / moved[1] : 0;
  }

  StiffnessSample at(double indentation) {
    StiffnessSample& sample = contact(indentation);
    if (sample.force > 0 && !(sample.stiffness > 0)) stiffen(sample);
    return sample;
  }

  /// The contacts with their stiffness, by their indentation.
  std::vector<StiffnessSample> samples() const {
    std::vector<StiffnessSample> found;
    for (const auto& [indentation, sample] : known_)
      if (sample.stiffness > 0) found.push_back(sample);
    return found;
  }
  /// Adds samples() of the same surface, solved for other loads.
  void add(const std::vector<StiffnessSample>& others) {
    for (const StiffnessSample& sample : others) known_.try_emplace(sample.indentation, sample);
  }
  /// The indentation of the contact with stiffness that is nearest to `wanted` within the range
  /// from `low` to `high`; `wanted` itself if there is none.
  double known_near(double wanted, double low, double high) const {
    double nearest = wanted, distance = std::numeric_limits<double>::infinity();
    for (auto one = known_.lower_bound(low); one != known_.end() && one->first <= high; ++one) {
      if (!(one->second.stiffness > 0) || std::abs(one->first - wanted) >= distance) continue;
      nearest = one->first;
      distance = std::abs(nearest - wanted);
    }
    return nearest;
  }
  void report_to(const Progress& progress) { options_.on_progress = progress; }
  /// Frees the fields of the last contacts, which only serve as start of the next one.
  void free_fields() {
    last_ = before_ = {};
    last_gap_ = Field();
  }

  /// The force and ρ = K_t/((G*/E*)K) at an indentation, with K_t along a direction from a stick
  /// solve; NaN without contact.
  StiffnessRatio::Point ratio_at(double indentation, double direction) {
    StiffnessSample& sample = contact(indentation);
    if (!(sample.force > 0)) return {};
    if (!sticks_.contains(indentation)) {
      if (last_.at != indentation || !last_.growth) stiffen(sample);
      if (!converged_) return {};
      StickOptions stick;
      stick.tolerance = stick_tolerance;
      stick.boundary = options_.boundary;
      stick.on_progress = options_.on_progress;
      const StickStiffness tangential = stick_stiffness(
          ContactSet(*last_.pressure > 0), surface_.grid, body_, stick, along_x_only_,
          last_.growth ? Field(*last_.growth * modulus_ratio_of(body_)) : Field(),
          surface_.communicator);
      converged_ = converged_ && tangential.converged();
      sticks_[indentation] = tangential;
    }
    return {sample.force,
            sticks_[indentation].along(direction) / (modulus_ratio_of(body_) * sample.stiffness)};
  }

 private:
  /// The contact at an indentation, perhaps without its stiffness. Solves it if it is not stored
  /// yet.
  StiffnessSample& contact(double indentation) {
    if (indentation > 0 && indentation < limit_ && !known_.contains(indentation))
      press(indentation);
    converged_ = converged_ && indentation < limit_;
    StiffnessSample& sample = known_[indentation];
    sample.indentation = indentation;
    return sample;
  }

  /// Mean number of cells that enter together, which is the number of cells in a straight piece of
  /// the perimeter: (1 + s)/2s for a ridge at the slope s to the grid, and the whole length of the
  /// ridge if it lies along the grid.
  double together(const ContactSpots& spots) const {
    const Grid2D& grid = surface_.grid;
    const double along_x = spots.perimeter_along_x / grid.dx();
    const double along_y = (spots.perimeter - spots.perimeter_along_x) / grid.dy();
    const double pieces =
        std::max({2 * std::min(along_x, along_y), 2.0 * double(spots.spots.size()), 1.0});
    return std::max(1.0, (along_x + along_y) / pieces);
  }

  /// Adds K to a sample. K needs the pressures of the contact, which is solved again if it was not
  /// the last one.
  void stiffen(StiffnessSample& sample) {
    if (sample.indentation != last_.at) press(sample.indentation);
    NormalContactState state;
    state.contact_pressure = std::move(*last_.pressure);
    state.communicator = surface_.communicator;
    state.datum = body_.datum();
    Field growth;
    sample.stiffness = normal_stiffness(state, surface_.grid, body_, options_, &growth);
    last_.pressure = std::move(state.contact_pressure);
    converged_ = converged_ && std::isfinite(sample.stiffness);
    if (!converged_ || !(sample.stiffness > 0)) return;
    set_correction(sample, last_force_, excess_force(*last_.pressure, last_gap_, growth, surface_));
    last_.growth = std::move(growth);
  }

  static void set_correction(StiffnessSample& sample, double force, double excess) {
    sample.force = force - excess;
    sample.force_correction = std::abs(excess);
  }

  void press(double indentation) {
    NormalContactOptions options = options_;
    last_gap_ = Field();
    const std::optional<Field> start = extrapolated(indentation);
    if (start) options.initial_pressure = &*start;
    NormalContactState state =
        salebra::press(surface_, body_, at_indentation(indentation), options);
    // known_ finds a contact only by the requested indentation, to the last bit.
    state.indentation = indentation;
    take(state);
  }

  /// Initial guess of the pressures, extrapolated linearly in the indentation from the nearer one
  /// of the last two contacts.
  std::optional<Field> extrapolated(double indentation) const {
    const auto distance = [&](const Pressed& one) { return std::abs(indentation - one.at); };
    const Pressed& base = before_.pressure && distance(before_) < distance(last_) ? before_ : last_;
    if (!base.pressure || !base.growth) return base.pressure;
    return Field((*base.pressure + (indentation - base.at) * *base.growth).max(0.0));
  }

  /// Stores the results of a solve, and moves its pressures into the start of the next solve.
  void take(NormalContactState& state) {
    if (state.termination == Termination::interrupted) throw Interrupted("damping: interrupted");
    converged_ = converged_ && state.converged();
    StiffnessSample& sample = known_[state.indentation];
    const ContactSpots spots = contact_spots(state.contact_pressure, surface_.grid,
                                             options_.boundary, surface_.communicator);
    sample.indentation = state.indentation;
    sample.force = state.force;
    sample.cells =
        std::round(spots.contact_area_fraction * static_cast<double>(surface_.grid.points()));
    sample.spots = static_cast<double>(spots.spots.size());
    // The perimeter along cell sides exceeds that of the smooth curve by the factor 4/π, averaged
    // over directions (Cauchy and Crofton).
    sample.perimeter =
        std::numbers::pi / 4 * spots.perimeter / std::sqrt(surface_.grid.cell_area());
    sample.together = together(spots);
    if (!body_.half_space_material()) {
      const Field& pressures = state.contact_pressure;
      std::vector<bool>& set = sets_[state.indentation];
      set.resize(static_cast<std::size_t>(pressures.size()));
      for (Index k = 0; k < pressures.size(); ++k)
        set[static_cast<std::size_t>(k)] = pressures.data()[k] > 0;
    }
    before_ = std::exchange(last_, {state.indentation, std::move(state.contact_pressure), {}});
    last_gap_ = std::move(state.gap);
    last_force_ = state.force;
  }

  const Surface& surface_;
  Body body_;
  NormalContactOptions options_;
  double limit_, peak_;
  bool along_x_only_;
  // Contacts by their indentation, and indentations by their pressure.
  std::map<double, StiffnessSample> known_;
  std::map<double, StickStiffness> sticks_;
  std::map<double, double> indentations_;
  std::map<double, std::vector<bool>> sets_;  // by indentation; only if they may not be nested
  /// Pressures of a contact and their growth with the indentation, if known; all processes agree on
  /// whether they exist.
  struct Pressed {
    double at = 0;
    std::optional<Field> pressure = {}, growth = {};
  };
  Pressed last_, before_;  // the last two contacts
  Field last_gap_;         // gaps of the last contact, valid until the next solve
  double last_force_ = 0;
  bool converged_ = true;
};

/// surface_damping() with contacts of the curves, solved to `tolerance`, in place of contacts of the
/// surface's own grid.
std::vector<std::vector<SurfaceDamping>> surface_damping(const Surface& surface, const Body& body,
                                                         const Oscillation& motion,
                                                         const std::vector<ForceCurve>& curves,
                                                         const SurfaceDampingOptions& options,
                                                         const KeptContacts& contacts,
                                                         double tolerance);

}  // namespace salebra::detail
