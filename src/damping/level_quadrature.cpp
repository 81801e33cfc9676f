// SPDX-License-Identifier: GPL-3.0-or-later
// The theorem by quadrature over phase nodes, with a contact set and its stiffness at each.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/level_quadrature.hpp>
#include <vector>

#include "phase_quadrature.hpp"
#include "surface/dense_systems.hpp"

namespace salebra {
namespace {

using detail::chebyshev_slope;
using detail::gauss_nodes;
using detail::loss;
using detail::loss_of;
using detail::Node;
using detail::normal_amplitude;
using std::numbers::pi;

// A function of the phase by its Chebyshev coefficients in c = cosθ.
struct Series {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd normal_inverse;  // (XᵀX)⁻¹ of the fit
  double scatter = 0;              // standard deviation of the data about it

  double operator()(double theta) const {
    double sum = 0;
    for (Index l = 0; l < coefficients.size(); ++l)
      sum += coefficients(l) * std::cos(static_cast<double>(l) * theta);
    return sum;
  }
  double slope(double theta) const;
  double second_slope_at_middle() const {  // with respect to c
    double sum = 0;                        // (1 − c²)T'' = cT' − l²T
    for (Index l = 2; l < coefficients.size(); ++l) {
      const double order = static_cast<double>(l);
      sum -= coefficients(l) * order * order * std::cos(order * pi / 2);
    }
    return sum;
  }
};

double Series::slope(double theta) const {
  double sum = 0;
  for (Index l = 1; l < coefficients.size(); ++l)
    sum += coefficients(l) * chebyshev_slope(l, theta);
  return sum;
}

// Data of a fit: values of the function at some phases, values of its slope d/dc at others with a
// weight of their own.
struct FitData {
  std::vector<double> theta, values, slope_theta, slopes;
  double slope_weight = 1;
};

Series fit(const FitData& data, int degree) {
  const Index values = static_cast<Index>(data.theta.size());
  const Index rows = values + static_cast<Index>(data.slopes.size());
  Eigen::MatrixXd basis(rows, degree + 1);
  Eigen::VectorXd right(rows);
  for (Index k = 0; k < rows; ++k) {
    const std::size_t at = static_cast<std::size_t>(k < values ? k : k - values);
    right(k) = k < values ? data.values[at] : data.slope_weight * data.slopes[at];
    for (Index l = 0; l <= degree; ++l)
      basis(k, l) = k < values ? std::cos(static_cast<double>(l) * data.theta[at])
                               : data.slope_weight * chebyshev_slope(l, data.slope_theta[at]);
  }
  Series series;
  const Eigen::MatrixXd inverse = detail::pseudo_inverse(basis);
  series.coefficients = inverse * right;
  series.normal_inverse = inverse * inverse.transpose();
  const double freedom = std::max<double>(1, static_cast<double>(rows - degree - 1));
  series.scatter = (right - basis * series.coefficients).norm() / std::sqrt(freedom);
  return series;
}

// The degree with the least generalised cross-validation error; a higher one only follows the
// noise.
Series best_fit(const FitData& data, int highest_degree) {
  const double rows = static_cast<double>(data.theta.size() + data.slopes.size());
  Series best;
  double least = std::numeric_limits<double>::infinity();
  for (int degree = 0; degree <= highest_degree && degree + 1 < rows; ++degree) {
    Series candidate = fit(data, degree);
    const double error = candidate.scatter / std::sqrt(rows - degree - 1);
    if (error < least) {
      least = error;
      best = std::move(candidate);
    }
  }
  return best;
}

// What independent errors of K_t at the nodes, and of the least one, make of W: the square root of
// the sum of their squares.
double scatter_of_loss(const Oscillation& motion, const std::vector<Node>& nodes,
                       const std::vector<double>& errors, double error_of_least) {
  double sum = std::pow(loss(
                            motion, nodes, [](std::size_t) { return 0.0; }, error_of_least),
                        2);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sum += std::pow(loss(
                        motion, nodes, [&](std::size_t i) { return i == k ? errors[k] : 0.0; }, 0),
                    2);
  return std::sqrt(sum);
}

void validate(const Oscillation& motion, double mean_indentation,
              const LevelQuadratureOptions& options) {
  require(options.levels == 0 || options.levels >= 4, "levels", options.levels,
          "must be >= 4, or 0 for the default of the motion");
  require(std::isfinite(mean_indentation), "indentation", mean_indentation, "must be finite");
  require_positive(normal_amplitude(motion), "normal_amplitude");
  if (const auto* drag = std::get_if<Drag>(&motion))
    require_positive(drag->angular_frequency, "angular_frequency");
  require(options.stick.hold_lateral || options.direction == 0, "direction", options.direction,
          "must be 0 where the lateral displacement is free; turn the surface instead");
}

struct LevelValues {
  ForceSample sample;
  double ratio = ForceSample::unknown;  // K_t/((G*/E*)K)
};

}  // namespace

LevelQuadratureResult level_quadrature(const ContactLevels& levels, const Grid2D& grid,
                                       const Material& material, const Oscillation& motion,
                                       double mean_indentation,
                                       const LevelQuadratureOptions& options) {
  grid.validate();
  validate(motion, mean_indentation, options);
  const bool drag = std::holds_alternative<Drag>(motion);
  const int count = options.levels > 0 ? options.levels : (drag ? 32 : 16);
  const double amplitude = normal_amplitude(motion), modulus_ratio = material.modulus_ratio();
  LevelQuadratureResult result;
  result.converged = true;

  const auto at_level = [&](double theta, bool with_stiffness) {
    LevelValues values;
    values.sample.indentation = mean_indentation + amplitude * std::cos(theta);
    const ContactSetAt level = levels(values.sample.indentation);
    values.sample.force = level.force;
    values.sample.pressure = level.force / grid.area();
    values.sample.contact_area_fraction =
        static_cast<double>(level.contact.count()) / static_cast<double>(grid.points());
    values.sample.converged = level.converged;
    if (with_stiffness) {
      Field pressure;
      const PunchStiffness punch = punch_stiffness(level.contact, grid, material.contact_modulus,
                                                   {.tolerance = options.stick.tolerance,
                                                    .max_iterations = options.stick.max_iterations,
                                                    .boundary = options.stick.boundary,
                                                    .on_progress = options.stick.on_progress},
                                                   &pressure);
      const StickStiffness stick =
          stick_stiffness(level.contact, grid, material, options.stick, options.direction == 0,
                          Field(pressure * modulus_ratio));
      const double c = std::cos(options.direction), s = std::sin(options.direction);
      values.sample.tangential_stiffness =
          options.direction == 0 ? stick.xx
                                 : c * c * stick.xx + 2 * c * s * stick.xy + s * s * stick.yy;
      values.sample.normal_stiffness = punch.normal_stiffness;
      if (punch.normal_stiffness > 0)
        values.ratio =
            values.sample.tangential_stiffness / (modulus_ratio * punch.normal_stiffness);
      values.sample.converged = level.converged && stick.converged && punch.converged;
      result.iterations += stick.iterations + punch.iterations;
      result.fft_count += stick.fft_count + punch.fft_count;
    }
    result.converged = result.converged && values.sample.converged;
    return values;
  };

  // The nodes go from the greatest indentation to the least.
  const std::vector<Node> nodes = gauss_nodes(count);
  std::vector<double> theta{0.0};
  std::vector<LevelValues> values{at_level(0, false)};
  for (const Node& node : nodes) {
    if (options.on_progress &&
        !options.on_progress({"levels", static_cast<double>(theta.size()) / (count + 2),
                              static_cast<int>(theta.size()), 0})) {
      result.interrupted = true;
      result.converged = false;
      return result;
    }
    theta.push_back(node.theta);
    values.push_back(at_level(node.theta, true));
  }
  theta.push_back(pi);
  values.push_back(at_level(pi, drag));

  // F and K = F' are known together. F feels the cells that enter one by one less than K does.
  FitData normal, ratios;
  normal.slope_weight = 0.1;
  for (std::size_t k = 0; k < values.size(); ++k) {
    normal.theta.push_back(theta[k]);
    normal.values.push_back(values[k].sample.force);
    if (!std::isfinite(values[k].sample.normal_stiffness)) continue;
    normal.slope_theta.push_back(theta[k]);
    normal.slopes.push_back(values[k].sample.normal_stiffness * amplitude);
    if (!std::isfinite(values[k].ratio)) continue;
    ratios.theta.push_back(theta[k]);
    ratios.values.push_back(values[k].ratio);
  }
  result.work_by_levels = loss(
      motion, nodes, [&](std::size_t k) { return values[k + 1].sample.tangential_stiffness; },
      drag ? values.back().sample.tangential_stiffness : 0);

  // Eighth degree: what follows the indentation faster is noise of the cells.
  const int highest = std::min(count / 2, 8);
  const Series force = best_fit(normal, highest);
  const auto by_force = [&](const Series& series) {
    return loss_of(motion, [&](double t) { return modulus_ratio * series.slope(t) / amplitude; });
  };
  result.work_by_force = by_force(force);
  result.force = force(pi / 2);
  // The loss is an integral and forgives a fit that follows the cells; a second derivative at a
  // point does not.
  const Series smooth = best_fit(normal, std::min(highest, 5));
  result.force_curvature = smooth.second_slope_at_middle() / (amplitude * amplitude);
  result.small_amplitude_work = std::visit(
      [&](const auto& m) {
        return closed_form::work_per_cycle(modulus_ratio, result.force_curvature, m);
      },
      motion);
  // Two more values of the integral: from the stiffness of the levels as they are, and from a fit
  // of more freedom.
  const double by_stiffness = loss(
      motion, nodes,
      [&](std::size_t k) { return modulus_ratio * values[k + 1].sample.normal_stiffness; },
      drag ? modulus_ratio * values.back().sample.normal_stiffness : 0);
  const int degree = static_cast<int>(force.coefficients.size()) - 1;
  // K of whole cells scatters about F'. Its sum may agree by chance; the scatter tells by how much
  // it could differ.
  const auto deviation = [&](std::size_t at) {
    return modulus_ratio *
           (values[at].sample.normal_stiffness - force.slope(theta[at]) / amplitude);
  };
  std::vector<double> deviations;
  for (std::size_t k = 0; k < nodes.size(); ++k) deviations.push_back(deviation(k + 1));
  const double cells =
      scatter_of_loss(motion, nodes, deviations, drag ? deviation(nodes.size() + 1) : 0);
  const double normal_error =
      std::max({std::abs(by_stiffness - result.work_by_force),
                std::abs(by_force(fit(normal, degree + 1)) - result.work_by_force), 2 * cells});

  if (ratios.theta.size() >= 2) {
    // Four parameters at most: ρ varies slowly, and what varies fast is noise of the cells.
    const Series ratio = best_fit(ratios, std::min(3, static_cast<int>(ratios.theta.size()) / 4));
    Eigen::VectorXd gradient(ratio.coefficients.size());
    for (Index l = 0; l < gradient.size(); ++l)
      gradient(l) = loss_of(motion, [&](double t) {
        return modulus_ratio * std::cos(static_cast<double>(l) * t) * force.slope(t) / amplitude;
      });
    result.work_per_cycle = gradient.dot(ratio.coefficients);
    const double statistical =
        ratio.scatter * std::sqrt(std::max(0.0, gradient.dot(ratio.normal_inverse * gradient)));
    result.error_estimate = 2 * statistical + normal_error;
  }
  result.stiffness_ratio =
      result.work_by_force != 0 ? result.work_per_cycle / result.work_by_force : 0;
  result.curve.model = "bem";
  result.curve.nominal_area = grid.area();
  for (auto level = values.rbegin(); level != values.rend(); ++level)
    result.curve.samples.push_back(level->sample);
  return result;
}

}  // namespace salebra
