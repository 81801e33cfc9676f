// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a surface and of small changes of it from a smooth law of its contacts.
#include "law_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/dissipation.hpp>

#include "base/numerics/dense_systems.hpp"
#include "base/special_values.hpp"
#include "damping/phase_quadrature.hpp"

namespace salebra::detail {
namespace {

// Distance of the contacts in ln F. With 0.2 the means of 50 surfaces are the same within a quarter
// of their standard errors.
constexpr double load_step = 0.35;
// Degree of the polynomials where there are contacts enough. With 8 the means of 50 surfaces are the
// same within about one standard error, with 5 within three, over five decay lengths of the force.
constexpr Index max_degree = 6;
// Range of ln F below the loads that springs in slip may reach: down to a hundredth of the force.
constexpr double slip_range = 4.6;

// A polynomial of increasing x, fitted by least squares.
class Polynomial {
 public:
  Polynomial(const std::vector<double>& x, const std::vector<double>& values, Index degree)
      : middle_((x.back() + x.front()) / 2), half_((x.back() - x.front()) / 2) {
    const Eigen::Map<const Eigen::ArrayXd> at(x.data(), std::ssize(x));
    Eigen::MatrixXd powers(at.size(), degree + 1);
    for (Index n = 0; n <= degree; ++n) powers.col(n) = ((at - middle_) / half_).pow(n);
    coefficients_ =
        pseudo_inverse(powers) * Eigen::Map<const Eigen::VectorXd>(values.data(), at.size());
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
                                                      const Change& change, const Fit& fit) const {
  std::vector<double> loads, gaps, areas;
  const auto& contacts = gradient_.contacts();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const bool end = k == 0 || k + 1 == contacts.size();
    if (!end && Index(k) % 4 == fit.omitted) continue;
    const ForceSample& sample = contacts[k].sample;
    loads.push_back(std::log(change.force_factor * sample.force));
    gaps.push_back(change.gap_factor * sample.mean_gap +
                   (change.gap_change.empty() ? 0 : change.gap_change[k]));
    areas.push_back(std::log(sample.contact_area_fraction));
  }
  const Index degree =
      std::max<Index>(1, std::min(max_degree, (std::ssize(loads) - 1) * 3 / 5) - fit.fewer_degrees);
  const Polynomial gap(loads, gaps, degree), area(loads, areas, degree);
  ForceCurve curve;
  constexpr int parts = 100;  // the table between them is exact to far below the error of the fit
  for (int k = 0; k <= parts; ++k) {
    const double load = std::lerp(loads.front(), loads.back(), double(k) / parts);
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
    const double covered = std::exp(area.at(load).value);
    const auto [value, slope] = gap.at(load);
    // There is no law where contacts did not converge, and none near full contact, where K_t/K was
    // not compared with stick solves.
    constexpr double beyond = 1e-2, largest_area = 0.8;
    if (!(load > loads.front() - beyond && load < loads.back() + beyond && covered < largest_area &&
          value > 0 && slope < 0)) {
      for (std::vector<double>& output : numbers) output.push_back(unknown);
      continue;
    }
    DampingResult loss;
    if (law) try {
        loss = relaxation_damping(*law, at_force(force), configuration.motion, options);
        add_slip(loss, *law, motion_of(configuration.motion), configuration.known);
        if (!loss.converged) loss.forget();
      } catch (const InvalidInput&) {
        loss.forget();  // the motion leaves the range of the contacts
      }
    const std::array<double, BoundaryElementNumbers::outputs.size()> values{
        value,
        covered,
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
