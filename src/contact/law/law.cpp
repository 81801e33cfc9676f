// SPDX-License-Identifier: GPL-3.0-or-later
// Contact laws F(δ): power law, exponential law, and a law tabulated from a force curve.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/law.hpp>
#include <sstream>
#include <vector>

#include "base/numerics/hermite.hpp"
#include "base/stop_check.hpp"

namespace salebra {

ContactLaw::ContactLaw(double modulus_ratio) : modulus_ratio_(modulus_ratio) {
  if (!std::isnan(modulus_ratio)) require_positive(modulus_ratio, "modulus_ratio");
}

double ContactLaw::tangential_stiffness(double indentation) const {
  return modulus_ratio_ * normal_stiffness(indentation);
}

double ContactLaw::stiffness_ratio(double) const { return modulus_ratio_; }

double ContactLaw::tangential_curvature(double indentation) const {
  return modulus_ratio_ * force_curvature(indentation);
}

double ContactLaw::first_touch() const { return -std::numeric_limits<double>::infinity(); }

double ContactLaw::lowest_indentation() const { return -std::numeric_limits<double>::infinity(); }

double ContactLaw::highest_indentation() const { return std::numeric_limits<double>::infinity(); }

std::vector<double> ContactLaw::break_points() const { return {}; }

std::unique_ptr<const ContactLaw> ContactLaw::coarser(bool) const { return nullptr; }

std::vector<double> PowerLaw::break_points() const { return {0}; }

PowerLaw::PowerLaw(double coefficient, double exponent, double modulus_ratio)
    : ContactLaw(modulus_ratio), coefficient_(coefficient), exponent_(exponent) {
  require_positive(modulus_ratio, "modulus_ratio");
  require_positive(coefficient, "coefficient");
  // An exponent below 1 would mean a contact that softens under load, which no indenter does; 1 is
  // the flat punch.
  require(std::isfinite(exponent) && exponent >= 1, "exponent", exponent,
          "must be finite and >= 1");
}

double PowerLaw::force(double indentation) const {
  detail::stop_if_asked();
  return indentation > 0 ? coefficient_ * std::pow(indentation, exponent_) : 0;
}

double PowerLaw::normal_stiffness(double indentation) const {
  detail::stop_if_asked();
  return indentation > 0 ? coefficient_ * exponent_ * std::pow(indentation, exponent_ - 1) : 0;
}

double PowerLaw::force_curvature(double indentation) const {
  detail::stop_if_asked();
  return indentation > 0
             ? coefficient_ * exponent_ * (exponent_ - 1) * std::pow(indentation, exponent_ - 2)
             : 0;
}

double PowerLaw::indentation_of(double force) const {
  require_positive(force, "force");
  return std::pow(force / coefficient_, 1 / exponent_);
}

ExponentialLaw::ExponentialLaw(double reference_force, double decay_length, double modulus_ratio)
    : ContactLaw(modulus_ratio), reference_force_(reference_force), decay_length_(decay_length) {
  require_positive(modulus_ratio, "modulus_ratio");
  require_positive(reference_force, "reference_force");
  require_positive(decay_length, "decay_length");
}

double ExponentialLaw::force(double indentation) const {
  detail::stop_if_asked();
  return reference_force_ * std::exp(indentation / decay_length_);
}

double ExponentialLaw::normal_stiffness(double indentation) const {
  return force(indentation) / decay_length_;
}

double ExponentialLaw::force_curvature(double indentation) const {
  return force(indentation) / (decay_length_ * decay_length_);
}

double ExponentialLaw::indentation_of(double force) const {
  require_positive(force, "force");
  return decay_length_ * std::log(force / reference_force_);
}

// With y = ln F as a function of the indentation, K = F y' and F'' = F (y'² + y''). One interpolant
// of y gives F, K and F'', so F' = K exactly, and formulas of the damping that integration by parts
// has changed to need only F or K_t agree with the formulas before this change. y is interpolated
// instead of F, because y is nearly straight for a rough surface, however many decades of force lie
// between two nodes. If every sample has its own K, the slopes y' = K/F at the nodes are data
// instead of differences of data. With or without these slopes, the errors of F, K and F'' are of
// order 4, 3 and 2 in the node spacing, and several times smaller with them. F'' jumps at the
// nodes. K_t, if given, is an independent measurement: ln K_t has an interpolant of its own, whose
// derivative gives K_t'.
struct TabulatedLaw::Splines {
  detail::MonotoneHermite log_force;
  std::unique_ptr<const detail::MonotoneHermite> log_tangential_stiffness;  // null: (G*/E*)K
  // At the first sample: F, K and K_t (0 if the law has no K_t of its own).
  double force = 0, stiffness = 0, tangential = 0;
  bool slopes_given = false;  // whether the samples have K

  double first_touch() const { return log_force.front() - 1.5 * force / stiffness; }
  // s = (δ − δ_t)/(δ1 − δ_t) between first touch and the first sample, 0 if the bodies are apart;
  // empty within the samples.
  std::optional<double> share_below(double indentation) const {
    if (!(indentation < log_force.front())) return {};
    if (indentation <= first_touch()) return 0;  // where round-off would leave some
    return std::max(0.0, 1 - (log_force.front() - indentation) * stiffness / (1.5 * force));
  }

  double clamp(double indentation) const {
    detail::stop_if_asked();
    // Round-off in an indentation at the end of an oscillation must not turn a sweep over the whole
    // table into an error.
    const double low = log_force.front(), high = log_force.back(), slack = 1e-12 * (high - low);
    if (!(indentation <= high + slack)) {
      std::ostringstream constraint;
      constraint.precision(12);
      constraint << "lies above the curve's range, which ends at " << high
                 << " m; reduce the amplitude, or give a curve that covers it";
      require(false, "indentation", indentation, constraint.str());
    }
    return std::min(indentation, high);
  }
};

namespace {

struct Column {
  double indentation, force, normal_stiffness, tangential_stiffness;
};

std::vector<Column> usable_samples(const ForceCurve& curve) {
  require_that(!curve.adhesive, "curve",
               "belongs to contacts with adhesion, whose loading and unloading may differ: points "
               "separate in another order than they touched, so the loss does not follow from a "
               "law; compute the curve without adhesion");
  auto force_of = [&](const ForceSample& sample) {
    return std::isnan(sample.force) ? sample.pressure * curve.nominal_area : sample.force;
  };
  std::vector<const ForceSample*> usable;
  for (const ForceSample& sample : curve.samples)
    if (sample.converged && force_of(sample) > 0) usable.push_back(&sample);
  const bool has_indentation = std::ranges::all_of(
      usable, [](const ForceSample* sample) { return std::isfinite(sample->indentation); });
  std::vector<Column> columns;
  for (const ForceSample* sample : usable) {
    const double indentation = has_indentation ? sample->indentation : -sample->mean_gap;
    if (std::isfinite(indentation) && std::isfinite(force_of(*sample)))
      columns.push_back(
          {indentation, force_of(*sample), sample->normal_stiffness, sample->tangential_stiffness});
  }
  require(
      columns.size() >= 4, "curve", columns.size(),
      "usable samples (converged, F > 0, δ or ū known) given; a tabulated law needs at least four");
  std::ranges::sort(columns, {}, &Column::indentation);
  for (std::size_t i = 1; i < columns.size(); ++i) {
    require(columns[i].indentation > columns[i - 1].indentation, "curve.indentation",
            columns[i].indentation, "occurs twice; remove one of the samples");
    require(columns[i].force > columns[i - 1].force, "curve.force", columns[i].force,
            "does not grow with the indentation; remove or smooth the sample");
  }
  return columns;
}

bool known(const std::vector<Column>& columns, double Column::*quantity) {
  return std::ranges::all_of(columns, [&](const Column& column) {
    return std::isfinite(column.*quantity) && column.*quantity > 0;
  });
}

}  // namespace

TabulatedLaw::TabulatedLaw(const ForceCurve& curve, double modulus_ratio)
    : ContactLaw(modulus_ratio) {
  require(curve.body.empty() || std::isnan(modulus_ratio), "modulus_ratio", modulus_ratio,
          "is of half-spaces, and the curve is of another body, whose K_t it has; leave it out");
  const std::vector<Column> columns = usable_samples(curve);
  std::vector<double> indentation, log_force, slope, log_tangential;
  const bool has_normal = known(columns, &Column::normal_stiffness);
  const bool has_tangential = known(columns, &Column::tangential_stiffness);
  require_that(has_tangential || !std::isnan(modulus_ratio), "tangential_stiffness",
               "is not known at all loads of the curve, and its body has no G*/E* to replace it; "
               "compute the curve with it");
  for (const Column& column : columns) {
    indentation.push_back(column.indentation);
    log_force.push_back(std::log(column.force));
    if (has_normal) slope.push_back(column.normal_stiffness / column.force);
    if (has_tangential) log_tangential.push_back(std::log(column.tangential_stiffness));
  }
  auto splines = std::make_unique<Splines>(
      Splines{detail::MonotoneHermite(indentation, std::move(log_force), std::move(slope)), {}});
  const double first = columns.front().indentation;
  splines->slopes_given = has_normal;
  splines->force = columns.front().force;
  splines->stiffness = splines->force * splines->log_force.at(first).slope;
  if (has_tangential) {
    splines->log_tangential_stiffness = std::make_unique<const detail::MonotoneHermite>(
        std::move(indentation), std::move(log_tangential));
    splines->tangential = columns.front().tangential_stiffness;
  }
  splines_ = std::move(splines);
}

TabulatedLaw::~TabulatedLaw() = default;

double TabulatedLaw::force(double indentation) const {
  if (const auto share = splines_->share_below(indentation))
    return splines_->force * std::pow(*share, 1.5);
  return std::exp(splines_->log_force.at(splines_->clamp(indentation)).value);
}

double TabulatedLaw::normal_stiffness(double indentation) const {
  if (const auto share = splines_->share_below(indentation))
    return splines_->stiffness * std::sqrt(*share);
  const auto log_force = splines_->log_force.at(splines_->clamp(indentation));
  return std::exp(log_force.value) * log_force.slope;
}

double TabulatedLaw::force_curvature(double indentation) const {
  if (const auto share = splines_->share_below(indentation))
    return *share > 0 ? splines_->stiffness / std::sqrt(*share) / 2 * splines_->stiffness /
                            (1.5 * splines_->force)
                      : 0;
  const auto log_force = splines_->log_force.at(splines_->clamp(indentation));
  return std::exp(log_force.value) * (log_force.slope * log_force.slope + log_force.curvature);
}

double TabulatedLaw::tangential_stiffness(double indentation) const {
  if (!splines_->log_tangential_stiffness) return ContactLaw::tangential_stiffness(indentation);
  if (const auto share = splines_->share_below(indentation))
    return splines_->tangential * std::sqrt(*share);
  return std::exp(splines_->log_tangential_stiffness->at(splines_->clamp(indentation)).value);
}

double TabulatedLaw::tangential_curvature(double indentation) const {
  if (!splines_->log_tangential_stiffness) return ContactLaw::tangential_curvature(indentation);
  if (splines_->share_below(indentation))
    return stiffness_ratio(indentation) * force_curvature(indentation);
  const auto log_stiffness = splines_->log_tangential_stiffness->at(splines_->clamp(indentation));
  return std::exp(log_stiffness.value) * log_stiffness.slope;
}

double TabulatedLaw::stiffness_ratio(double indentation) const {
  if (!splines_->log_tangential_stiffness) return modulus_ratio();
  const double within = std::clamp(indentation, lowest_indentation(), highest_indentation());
  return tangential_stiffness(within) / normal_stiffness(within);
}

double TabulatedLaw::first_touch() const { return splines_->first_touch(); }

double TabulatedLaw::lowest_indentation() const { return splines_->log_force.front(); }

double TabulatedLaw::highest_indentation() const { return splines_->log_force.back(); }

std::vector<double> TabulatedLaw::break_points() const {
  std::vector<double> points = splines_->log_force.nodes();
  points.insert(points.begin(), first_touch());
  return points;
}

std::unique_ptr<const ContactLaw> TabulatedLaw::coarser(bool odd) const {
  const std::vector<double>& nodes = splines_->log_force.nodes();
  constexpr std::size_t least = 7;  // so that four are left
  if (nodes.size() < least) return nullptr;
  ForceCurve curve;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i % 2 == (odd ? 0 : 1) && i > 0 && i + 1 < nodes.size()) continue;
    ForceSample& sample = curve.samples.emplace_back();
    sample.indentation = nodes[i];
    sample.force = force(nodes[i]);
    if (splines_->slopes_given) sample.normal_stiffness = normal_stiffness(nodes[i]);
    if (splines_->log_tangential_stiffness)
      sample.tangential_stiffness = tangential_stiffness(nodes[i]);
  }
  return std::make_unique<TabulatedLaw>(curve, modulus_ratio());
}

double TabulatedLaw::indentation_of(double force) const {
  require_positive(force, "force");
  const double log_force = std::log(force);
  const double low = splines_->log_force.at(lowest_indentation()).value;
  const double high = splines_->log_force.at(highest_indentation()).value;
  if (log_force < low)
    return first_touch() +
           (lowest_indentation() - first_touch()) * std::pow(force / splines_->force, 2.0 / 3);
  // The same allowance for round-off as for indentations in clamp().
  const double slack = 1e-12 * (high - low);
  if (!(log_force <= high + slack)) {
    std::ostringstream constraint;
    constraint.precision(12);
    constraint << "lies above the curve's range, which ends at " << std::exp(high)
               << " N; choose a force within it, or give a curve that covers it";
    require(false, "force", force, constraint.str());
  }
  return splines_->log_force.where(std::min(log_force, high));
}

}  // namespace salebra
