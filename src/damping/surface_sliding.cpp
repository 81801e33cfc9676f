// SPDX-License-Identifier: GPL-3.0-or-later
// Steady sliding of a surface from contacts solved inside the oscillation, with errors.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <span>
#include <utility>

#include "surface/refine.hpp"
#include "surface_contacts.hpp"
#include "wide_oscillation.hpp"

namespace salebra {
namespace {

using detail::direction_of;
using detail::KrigedStiffness;
using detail::StiffnessRatio;
using detail::StiffnessSample;
using detail::SurfaceContacts;
using detail::VarianceScales;
using Eigen::ArrayXd;
using Eigen::VectorXd;
using std::numbers::pi;

// Number of intervals between the contacts on the given cells; on smaller cells half as many are
// used.
constexpr int own_intervals = 8;
// K is taken as linear between the ends of this many intervals of the indentation, which are equal
// in the phase angle. Each contact lies at an end of one of these intervals.
constexpr int linear_parts = 32;

/// A contact law with K linear between given indentations. `force` is F at the indentation in the
/// middle of the list.
class StiffnessLaw final : public ContactLaw {
 public:
  StiffnessLaw(VectorXd positions, VectorXd stiffness, double force, const StiffnessRatio& ratio,
               double modulus_ratio)
      : ContactLaw(modulus_ratio),
        positions_(std::move(positions)),
        stiffness_(stiffness.cwiseMax(0)),
        force_(VectorXd::Zero(positions_.size())),
        ratio_(ratio) {
    for (Index i = 0; i + 1 < positions_.size(); ++i)
      force_(i + 1) =
          force_(i) - (positions_(i) - positions_(i + 1)) * (stiffness_(i) + stiffness_(i + 1)) / 2;
    force_.array() += force - force_(positions_.size() / 2);
  }

  double force(double indentation) const override {
    const Index i = interval_of(indentation);
    const double below = positions_(i) - indentation;
    return std::max(0.0, force_(i) - below * (stiffness_(i) + normal_stiffness(indentation)) / 2);
  }
  double normal_stiffness(double indentation) const override {
    const Index i = interval_of(indentation);
    return std::max(0.0, stiffness_(i) - (positions_(i) - indentation) * slope(i));
  }
  double force_curvature(double indentation) const override {
    return slope(interval_of(indentation));
  }
  double tangential_stiffness(double indentation) const override {
    return modulus_ratio() * ratio_.at(force(indentation)) * normal_stiffness(indentation);
  }
  double tangential_curvature(double indentation) const override {
    return modulus_ratio() * ratio_.at(force(indentation)) * force_curvature(indentation);
  }
  double stiffness_ratio(double indentation) const override {
    return modulus_ratio() * ratio_.at(force(indentation));
  }
  double indentation_of(double force) const override {
    double low = positions_(positions_.size() - 1), high = positions_(0);
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (low + high) / 2;
      (this->force(middle) < force ? low : high) = middle;
    }
    return (low + high) / 2;
  }
  std::vector<double> break_points() const override {
    return {positions_.reverse().begin(), positions_.reverse().end()};
  }

 private:
  Index interval_of(double indentation) const {
    const auto after =
        std::upper_bound(positions_.begin(), positions_.end(), indentation, std::greater());
    return std::clamp<Index>(after - positions_.begin() - 1, 0, positions_.size() - 2);
  }
  double slope(Index i) const {
    return (stiffness_(i) - stiffness_(i + 1)) / (positions_(i) - positions_(i + 1));
  }

  VectorXd positions_, stiffness_, force_;
  StiffnessRatio ratio_;
};

// The numbers of SteadySliding whose errors are computed here. The last entry of sliding_errors is
// left out: relaxation_damping and its error come from surface_damping().
constexpr auto numbers = std::span(sliding_errors).first(std::size(sliding_errors) - 1);

/// These numbers for all velocities, in one list.
ArrayXd numbers_of(const std::vector<SteadySliding>& states) {
  std::vector<double> all;
  for (const SteadySliding& state : states)
    for (const auto& [number, error] : numbers) all.push_back(state.*number);
  return Eigen::Map<const ArrayXd>(all.data(), static_cast<Index>(all.size()));
}

/// Results of one grid. numbers: as numbers_of() lists them; squares: squares of their errors.
struct OnGrid {
  std::vector<SteadySliding> states;
  ArrayXd numbers, squares;
};

class SurfaceSlidingRun {
 public:
  SurfaceSlidingRun(const Body& body, const ForceSample& load, const StiffnessRatio& ratio,
                    const SurfaceSlidingMotion& motion, Hold hold)
      : body_(body),
        load_(load),
        ratio_(ratio),
        motion_(motion),
        hold_(hold),
        oscillation_(Drag{motion.normal.normal_amplitude, 1e-6, motion.normal.angular_frequency}),
        wide_(body, oscillation_, options_, hold, direction_of(load), {{load.pressure, load.force}},
              detail::RatioOfLoads({detail::point_of(load, detail::modulus_ratio_of(body))})) {
    half_ = detail::half_range(load, motion.normal.normal_amplitude, hold_ == Hold::force);
  }

  OnGrid on(const Surface& surface, int count, bool first, const Progress& progress) {
    if (is_wide()) return wide_on(surface, progress);
    NormalContactOptions contact;
    contact.on_progress = progress;
    // The force changes by about F(KH/F) over half the range H of the contacts, and its second
    // difference is smaller by the same factor.
    contact.tolerance =
        std::clamp(1e-4 * std::pow(half_ * load_.normal_stiffness / load_.force, 2), 1e-12, 1e-7);
    const double direction = direction_of(load_);
    SurfaceContacts contacts_at(surface, body_, contact, direction == 0);
    const double center = contacts_at.indentation_at(load_.pressure);
    const StiffnessRatio ratio =
        first ? ratio_
              : ratio_.scaled(contacts_at.ratio_at(center, direction).ratio / ratio_.middle());
    std::vector<StiffnessSample> contacts;
    for (int k = 0; k <= count; ++k)
      contacts.push_back(contacts_at.at(center + half_ * std::cos(pi * k / count)));
    if (!contacts_at.usable())
      throw NotConverged("sliding: a contact of the surface did not converge");
    const VectorXd positions = center + half_ * ArrayXd::LinSpaced(linear_parts + 1, 0, pi).cos();
    const KrigedStiffness kriged(contacts, positions);
    scales_.add(kriged.log_likelihood());

    const VectorXd stiffness = stiffness_at(kriged, positions);
    OnGrid grid;
    grid.states = states_of(positions, stiffness, ratio);
    grid.numbers = numbers_of(grid.states);
    const auto change = [&](const VectorXd& other, const StiffnessRatio& by) -> ArrayXd {
      return numbers_of(states_of(positions, other, by)) - grid.numbers;
    };
    grid.squares =
        change(stiffness, ratio.straight()).square() +
        change(stiffness_at(KrigedStiffness(detail::every_other(contacts), positions), positions),
               ratio)
            .square();
    // The numbers are nearly linear in K, so their variance follows from the covariance of K that
    // the kriging gives.
    const double step = 1e-3 * stiffness.maxCoeff();
    Eigen::MatrixXd weights(grid.numbers.size(), positions.size());
    for (Index i = 0; i < positions.size(); ++i) {
      VectorXd other = stiffness;
      other(i) += step;
      weights.col(i) = change(other, ratio) / step;
    }
    for (Index k = 0; k < weights.rows(); ++k) {
      const VectorXd row = weights.row(k);
      grid.squares(k) +=
          std::pow(detail::stated_deviations * kriged.estimate(row, scales_).deviation, 2);
    }
    return grid;
  }

 private:
  /// Nine contacts with kriging describe wider oscillations than the five of surface_damping() do.
  bool is_wide() const {
    const double amplitude = motion_.normal.normal_amplitude;
    return amplitude > load_.indentation || amplitude > 3 * load_.force / load_.normal_stiffness;
  }

  /// A wide oscillation uses the law of the surface from first touch to the largest force.
  OnGrid wide_on(const Surface& surface, const Progress& progress) {
    const std::vector<StiffnessSample> contacts = wide_.contacts(surface, progress);
    if (const double possible = wide_.possible_amplitude(); !std::isnan(possible))
      detail::refuse_full_contact(motion_.normal.normal_amplitude, load_.pressure, possible);
    if (contacts.empty()) throw NotConverged("sliding: a contact of the surface did not converge");
    const auto states = [&](const std::vector<StiffnessSample>& some,
                            const detail::RatioOfLoads& ratio, detail::BelowTable below) {
      const detail::SurfaceLaw law(some, ratio, detail::modulus_ratio_of(body_));
      const detail::ContinuedLaw continued(law, below);
      return states_of(continued, at_force(load_.force));
    };
    using enum detail::BelowTable;
    OnGrid grid;
    grid.states = states(contacts, wide_.ratio(), opens);
    grid.numbers = numbers_of(grid.states);
    const auto square = [&](const std::vector<SteadySliding>& other) -> ArrayXd {
      return (numbers_of(other) - grid.numbers).square();
    };
    // The numbers depend most on K at the smallest indentation, where springs begin to slide.
    const detail::SurfaceLaw law(contacts, wide_.ratio(), detail::modulus_ratio_of(body_));
    const double least =
        detail::mean_indentation(law, load_.force, motion_.normal.normal_amplitude, hold_) -
        motion_.normal.normal_amplitude;
    constexpr double share = 0.01;
    std::vector<StiffnessSample> stiffer = contacts;
    const auto nearest = std::ranges::min_element(
        stiffer, {}, [&](const StiffnessSample& one) { return std::abs(one.indentation - least); });
    nearest->stiffness *= 1 + share;
    const double deviations =
        detail::stated_deviations * detail::WideOscillation::scatter(contacts, least) / share;
    grid.squares = deviations * deviations * square(states(stiffer, wide_.ratio(), opens)) +
                   square(states(detail::every_other(contacts), wide_.ratio(), opens)) +
                   square(states(contacts, wide_.ratio().straight(), opens)) +
                   square(states(contacts, wide_.ratio(), exponential));
    return grid;
  }

  static VectorXd stiffness_at(const KrigedStiffness& kriged, const VectorXd& positions) {
    return positions.unaryExpr([&](double position) { return kriged.stiffness(position); });
  }

  std::vector<SteadySliding> states_of(const VectorXd& positions, const VectorXd& stiffness,
                                       const StiffnessRatio& ratio) const {
    const StiffnessLaw law(positions, stiffness, load_.force, ratio,
                           detail::modulus_ratio_of(body_));
    const OperatingPoint point = hold_ == Hold::indentation
                                     ? at_indentation(positions(positions.size() / 2))
                                     : at_force(load_.force);
    return states_of(law, point);
  }

  std::vector<SteadySliding> states_of(const ContactLaw& law, const OperatingPoint& point) const {
    return steady_sliding(law, point, motion_.normal, motion_.velocities,
                          motion_.friction_coefficient, {.hold = hold_, .tolerance = 1e-7});
  }

  const Body& body_;
  const ForceSample& load_;
  StiffnessRatio ratio_;
  const SurfaceSlidingMotion& motion_;
  Hold hold_;
  Oscillation oscillation_;
  SurfaceDampingOptions options_ = {};
  detail::WideOscillation wide_;
  double half_ = 0;  // half the range of indentations of the contacts, m
  VarianceScales scales_;
};

}  // namespace

std::vector<std::pair<SteadySliding, SlidingErrors>> surface_sliding(
    const Surface& surface, const Body& body, const ForceCurve& curve, std::size_t load,
    const SurfaceSlidingMotion& motion, const Progress& on_progress) {
  require(load < curve.samples.size(), "load", load, "is not in the curve");
  require_positive(motion.normal.normal_amplitude, "normal_amplitude");
  const ForceSample& sample = curve.samples[load];
  const StiffnessRatio ratio = detail::ratio_on(curve, load, detail::modulus_ratio_of(body));
  ForceCurve about = curve;
  about.samples = {sample};
  const Hold hold = detail::hold_of(about, motion.normal.normal_amplitude, motion.hold);
  SurfaceSlidingRun run(body, sample, ratio, motion, hold);
  const OnGrid own = run.on(surface, own_intervals, true, on_progress);
  OnGrid fine = run.on(refined(surface, 2), own_intervals / 2, false, on_progress);
  // The error by the cells is of second order: a third of the change remains on the finer cells.
  const double springs = detail::spring_error(body, ratio.exponent());
  const ArrayXd errors =
      ((fine.squares + ((fine.numbers - own.numbers) / 3).square()).max(own.squares / 16) +
       (springs * fine.numbers).square())
          .sqrt();

  SurfaceDampingOptions options{.hold = hold, .on_progress = on_progress};
  // The ratio K_t/K of this curve comes from contacts inside the oscillation.
  const Drag drag{motion.normal.normal_amplitude, 1e-6, motion.normal.angular_frequency};
  const SurfaceDamping stuck = surface_damping(surface, body, drag, about, options)[0];

  std::vector<std::pair<SteadySliding, SlidingErrors>> all;
  Index at = 0;
  for (SteadySliding& state : fine.states) {
    SlidingErrors stated;
    const auto give = [&](double& number, double& error, double found) {
      error = found;
      if (!(error <= std::abs(number))) number = error = SteadySliding::unknown;
    };
    for (const auto& [number, error] : numbers) give(state.*number, stated.*error, errors(at++));
    state.error_estimate = stated.mean_tangential_force_error;
    state.relaxation_damping = stuck.damping_constant;
    give(state.relaxation_damping, stated.relaxation_damping_error, stuck.damping_constant_error());
    all.emplace_back(state, stated);
  }
  return all;
}

}  // namespace salebra
