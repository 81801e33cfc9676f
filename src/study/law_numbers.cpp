// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a surface and of small changes of it from a smooth law of its contacts.
#include "law_numbers.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/dissipation.hpp>

#include "base/special_values.hpp"
#include "damping/phase_quadrature.hpp"

namespace salebra::detail {
namespace {

// Distance of the contacts in ln F. Half of it changes no mean over 50 surfaces by more than a
// tenth of its standard error.
constexpr double load_step = 0.35;
// Degree of the polynomials where there are contacts enough: 5 and 8 agree with it within the
// standard errors of 50 surfaces over five decay lengths of the force.
constexpr Index max_degree = 6;
// Range of ln F below the loads that springs in slip may reach: down to a hundredth of the force.
constexpr double slip_range = 4.6;

// A polynomial of x, fitted by least squares.
class Polynomial {
 public:
  Polynomial(const Eigen::ArrayXd& x, const Eigen::VectorXd& values, Index degree)
      : middle_((x.maxCoeff() + x.minCoeff()) / 2), half_((x.maxCoeff() - x.minCoeff()) / 2) {
    Eigen::MatrixXd powers(x.size(), degree + 1);
    for (Index n = 0; n <= degree; ++n) powers.col(n) = ((x - middle_) / half_).pow(n);
    coefficients_ = powers.householderQr().solve(values);
  }
  struct Point {
    double value = 0, slope = 0;
  };
  Point at(double x) const {
    Point point;
    for (Index n = coefficients_.size(); n-- > 0;) {
      point.slope = point.slope * (x - middle_) / half_ + point.value / half_;
      point.value = point.value * (x - middle_) / half_ + coefficients_(n);
    }
    return point;
  }

 private:
  double middle_, half_;
  Eigen::VectorXd coefficients_;
};

// The pressures at which further contacts are needed beside those at the pressures of the study.
std::vector<double> further_pressures(const std::vector<GapGradient::Contact>& contacts,
                                      const StudyConfiguration& configuration) {
  // An oscillation changes ln F by about its amplitude over the decay length F/K.
  const double amplitude = normal_amplitude(configuration.motion);
  const auto reach = [&](const ForceSample& sample) {
    return std::min(0.3 + 1.2 * amplitude * sample.normal_stiffness / sample.force, slip_range);
  };
  const ForceSample& lowest = contacts.front().sample;
  const bool slips = !std::isnan(configuration.known.friction_coefficient);
  std::vector<double> marks = configuration.pressures;
  double last = marks.back();
  // A motion that closes the gap has no loss.
  for (const auto& [sample, weights] : contacts)
    if (sample.mean_gap > amplitude)
      last = std::max(last, sample.pressure * std::exp(reach(sample)));
  marks.insert(marks.begin(), lowest.pressure * std::exp(slips ? -slip_range : -reach(lowest)));
  marks.push_back(last);
  std::vector<double> further{marks.front()};
  for (std::size_t k = 0; k + 1 < marks.size(); ++k) {
    const double range = std::log(marks[k + 1] / marks[k]);
    const double parts = std::ceil(range / load_step - 1e-9);
    for (int part = 1; part < parts; ++part)
      further.push_back(marks[k] * std::exp(part / parts * range));
  }
  if (last > configuration.pressures.back()) further.push_back(last);
  return further;
}

}  // namespace

bool LawNumbers::possible(const StudyConfiguration& configuration) {
  return configuration.pressed().half_space_material() && std::isnan(configuration.known.hardness);
}

LawNumbers::LawNumbers(const Surface& surface, const StudyConfiguration& configuration,
                       const Progress& progress)
    : modulus_ratio_(configuration.pressed().modulus_ratio()), area_(surface.grid.area()) {
  const NormalContactOptions options{.tolerance = configuration.tolerance, .on_progress = progress};
  const Body body = configuration.pressed();
  gradient_.solve(surface, body, configuration.pressures, options);
  if (!gradient_.contacts().empty())
    gradient_.solve(surface, body, further_pressures(gradient_.contacts(), configuration), options);
  if (gradient_.contacts().size() < 4)
    throw NotConverged(
        "contact: fewer than 4 pressures converged below full contact; allow a larger tolerance");
}

BoundaryElementNumbers::OfSurface LawNumbers::numbers(const StudyConfiguration& configuration,
                                                      const Change& change, bool coarser) const {
  const auto& contacts = gradient_.contacts();
  const auto count = Index(contacts.size());
  Eigen::ArrayXd loads(count);
  Eigen::VectorXd gaps(count), areas(count);
  for (Index k = 0; k < count; ++k) {
    const ForceSample& sample = contacts[std::size_t(k)].sample;
    loads(k) = std::log(change.force_factor * sample.force);
    gaps(k) = change.gap_factor * sample.mean_gap;
    if (!change.gap_change.empty()) gaps(k) += change.gap_change[std::size_t(k)];
    areas(k) = std::log(sample.contact_area_fraction);
  }
  const Index degree = std::min(max_degree, (count - 1) * 3 / 5) - (coarser ? 2 : 0);
  const Polynomial gap(loads, gaps, std::max<Index>(degree, 1)),
      area(loads, areas, std::max<Index>(degree, 1));

  ForceCurve curve;
  constexpr int parts = 100;  // the table between them is exact to far below the error of the fit
  for (int k = 0; k <= parts; ++k) {
    const double load = std::lerp(loads(0), loads(count - 1), double(k) / parts);
    const auto [value, slope] = gap.at(load);
    curve.samples.push_back({.indentation = -value,
                             .force = std::exp(load),
                             .normal_stiffness = -std::exp(load) / slope,
                             .converged = slope < 0});
  }
  std::optional<TabulatedLaw> law;
  try {
    law.emplace(curve, modulus_ratio_);
  } catch (const InvalidInput&) {
    // The polynomial does not fall everywhere, so there is no loss.
  }
  DampingOptions options = configuration.damping;
  options.hold = configuration.hold();
  BoundaryElementNumbers::OfSurface numbers;
  for (const double pressure : configuration.pressures) {
    const double force = pressure * area_, load = std::log(force);
    // In full contact there is no law.
    const bool known = load < loads(count - 1) + 1e-2;
    const auto [value, slope] = gap.at(known ? load : unknown);
    DampingResult loss;
    if (law && known) try {
        loss = relaxation_damping(*law, at_force(force), configuration.motion, options);
        add_slip(loss, *law, motion_of(configuration.motion), configuration.known);
        if (!loss.converged) loss.forget();
      } catch (const InvalidInput&) {
        loss.forget();  // the motion leaves the range of the contacts
      }
    const std::array<double, BoundaryElementNumbers::outputs.size()> values{
        value,
        std::exp(area.at(known ? load : unknown).value),
        -force / slope,
        -modulus_ratio_ * force / slope,
        loss.work_per_cycle,
        loss.damping_constant};
    for (std::size_t output = 0; output < values.size(); ++output)
      numbers[output].push_back(values[output]);
  }
  return numbers;
}

}  // namespace salebra::detail
