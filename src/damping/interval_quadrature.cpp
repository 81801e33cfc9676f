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
#include <salebra/damping/interval_quadrature.hpp>
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
                       const std::vector<double>& errors, double error_of_min) {
  double sum = std::pow(loss(motion, nodes, [](std::size_t) { return 0.0; }, error_of_min), 2);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sum += std::pow(
        loss(motion, nodes, [&](std::size_t i) { return i == k ? errors[k] : 0.0; }, 0), 2);
  return std::sqrt(sum);
}

void validate(const Oscillation& motion, double mean_indentation,
              const IntervalQuadratureOptions& options) {
  require(options.intervals == 0 || options.intervals >= 4, "intervals", options.intervals,
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

// The problem, and the contacts that are solved for it.
class LevelSolver {
 public:
  LevelSolver(const ContactSets& contact_sets, const Grid2D& grid, const Material& material,
              const IntervalQuadratureOptions& options, IntervalQuadratureResult& result)
      : intervals_(intervals), grid_(grid), material_(material), options_(options), result_(result) {}

  LevelValues at(double indentation, bool with_stiffness) {
    LevelValues values;
    values.sample.indentation = indentation;
    const ContactSetAt level = intervals_(indentation);
    values.sample.force = level.force;
    values.sample.pressure = level.force / grid_.area();
    values.sample.contact_area_fraction =
        static_cast<double>(level.contact.count()) / static_cast<double>(grid_.points());
    values.sample.converged = level.converged;
    if (with_stiffness) add_stiffness(level, values);
    if (!level.converged)
      result_.termination = std::max(result_.termination, Termination::iteration_limit);
    return values;
  }

 private:
  void add_stiffness(const ContactSetAt& level, LevelValues& values) {
    const double modulus_ratio = material_.modulus_ratio();
    Field pressure;
    const PunchStiffness punch = punch_stiffness(level.contact, grid_, material_.contact_modulus,
                                                 {.tolerance = options_.stick.tolerance,
                                                  .max_iterations = options_.stick.max_iterations,
                                                  .boundary = options_.stick.boundary,
                                                  .on_progress = options_.stick.on_progress},
                                                 &pressure);
    const StickStiffness stick =
        stick_stiffness(level.contact, grid_, material_, options_.stick, options_.direction == 0,
                        Field(pressure * modulus_ratio));
    const double c = std::cos(options_.direction), s = std::sin(options_.direction);
    values.sample.tangential_stiffness =
        options_.direction == 0 ? stick.xx
                                : c * c * stick.xx + 2 * c * s * stick.xy + s * s * stick.yy;
    values.sample.normal_stiffness = punch.normal_stiffness;
    if (punch.normal_stiffness > 0)
      values.ratio = values.sample.tangential_stiffness / (modulus_ratio * punch.normal_stiffness);
    values.sample.converged = level.converged && stick.converged() && punch.converged();
    result_.termination = std::max({result_.termination, stick.termination, punch.termination});
    result_.iterations += stick.iterations + punch.iterations;
    result_.fft_count += stick.fft_count + punch.fft_count;
  }

  const ContactSets& intervals_;
  const Grid2D& grid_;
  const Material& material_;
  const IntervalQuadratureOptions& options_;
  IntervalQuadratureResult& result_;
};

// Levels from the greatest indentation to the least, the nodes between the two ends.
struct SolvedLevels {
  std::vector<Node> nodes;
  std::vector<double> theta;
  std::vector<LevelValues> values;
};

// What the levels say of W. In a drag the stiffness at the least of them counts too.
class LossOfLevels {
 public:
  LossOfLevels(const SolvedLevels& intervals, const Oscillation& motion, double modulus_ratio)
      : intervals_(intervals),
        motion_(motion),
        drag_(std::holds_alternative<Drag>(motion)),
        amplitude_(normal_amplitude(motion)),
        modulus_ratio_(modulus_ratio) {
    // F and K = F' are known together. F feels the cells that enter one by one less than K does.
    normal_.slope_weight = 0.1;
    for (std::size_t k = 0; k < intervals.values.size(); ++k) {
      const auto& [sample, ratio] = intervals.values[k];
      normal_.theta.push_back(intervals.theta[k]);
      normal_.values.push_back(sample.force);
      if (!std::isfinite(sample.normal_stiffness)) continue;
      normal_.slope_theta.push_back(intervals.theta[k]);
      normal_.slopes.push_back(sample.normal_stiffness * amplitude_);
      if (!std::isfinite(ratio)) continue;
      ratios_.theta.push_back(intervals.theta[k]);
      ratios_.values.push_back(ratio);
    }
    // Eighth degree: what follows the indentation faster is noise of the cells.
    highest_degree_ = std::min(static_cast<int>(intervals.nodes.size()) / 2, 8);
    force_ = best_fit(normal_, highest_degree_);
  }

  void fill(IntervalQuadratureResult& result) const {
    result.work_by_intervals = of_levels(&ForceSample::tangential_stiffness, 1);
    result.work_by_force = by_force(force_);
    result.force = force_(pi / 2);
    // The loss is an integral and forgives a fit that follows the cells; a second derivative at a
    // point does not.
    const Series smooth = best_fit(normal_, std::min(highest_degree_, 5));
    result.force_curvature = smooth.second_slope_at_middle() / (amplitude_ * amplitude_);
    result.small_amplitude_work = std::visit(
        [&](const auto& m) {
          return closed_form::work_per_cycle(modulus_ratio_, result.force_curvature, m);
        },
        motion_);
    if (ratios_.theta.size() >= 2) add_ratio(result);
    result.stiffness_ratio =
        result.work_by_force != 0 ? result.work_per_cycle / result.work_by_force : 0;
  }

 private:
  double by_force(const Series& series) const {
    return loss_of(motion_,
                   [&](double t) { return modulus_ratio_ * series.slope(t) / amplitude_; });
  }
  double of_levels(double ForceSample::*stiffness, double factor) const {
    const auto at = [&](const LevelValues& level) { return factor * (level.sample.*stiffness); };
    return loss(
        motion_, intervals_.nodes, [&](std::size_t k) { return at(intervals_.values[k + 1]); },
        drag_ ? at(intervals_.values.back()) : 0);
  }

  void add_ratio(IntervalQuadratureResult& result) const {
    // Four parameters at most: ρ varies slowly, and what varies fast is noise of the cells.
    const Series ratio = best_fit(ratios_, std::min(3, static_cast<int>(ratios_.theta.size()) / 4));
    Eigen::VectorXd gradient(ratio.coefficients.size());
    for (Index l = 0; l < gradient.size(); ++l)
      gradient(l) = loss_of(motion_, [&](double t) {
        return modulus_ratio_ * std::cos(static_cast<double>(l) * t) * force_.slope(t) / amplitude_;
      });
    result.work_per_cycle = gradient.dot(ratio.coefficients);
    const double statistical =
        ratio.scatter * std::sqrt(std::max(0.0, gradient.dot(ratio.normal_inverse * gradient)));
    result.error_estimate = 2 * statistical + normal_error(result.work_by_force);
  }

  // Two more values of the integral: from the stiffness of the levels as they are, and from a fit
  // of more freedom.
  double normal_error(double work_by_force) const {
    const double by_stiffness = of_levels(&ForceSample::normal_stiffness, modulus_ratio_);
    const int degree = static_cast<int>(force_.coefficients.size()) - 1;
    // K of whole cells scatters about F'. Its sum may agree by chance; the scatter tells by how
    // much it could differ.
    const auto deviation = [&](std::size_t at) {
      return modulus_ratio_ * (intervals_.values[at].sample.normal_stiffness -
                               force_.slope(intervals_.theta[at]) / amplitude_);
    };
    std::vector<double> deviations;
    for (std::size_t k = 0; k < intervals_.nodes.size(); ++k) deviations.push_back(deviation(k + 1));
    const double cells = scatter_of_loss(motion_, intervals_.nodes, deviations,
                                         drag_ ? deviation(intervals_.nodes.size() + 1) : 0);
    return std::max({std::abs(by_stiffness - work_by_force),
                     std::abs(by_force(fit(normal_, degree + 1)) - work_by_force), 2 * cells});
  }

  const SolvedLevels& intervals_;
  const Oscillation& motion_;
  const bool drag_;
  const double amplitude_, modulus_ratio_;
  FitData normal_, ratios_;
  int highest_degree_ = 0;
  Series force_;
};

}  // namespace

IntervalQuadratureResult interval_quadrature(const ContactSets& contact_sets, const Grid2D& grid,
                                       const Material& material, const Oscillation& motion,
                                       double mean_indentation,
                                       const IntervalQuadratureOptions& options) {
  grid.validate();
  validate(motion, mean_indentation, options);
  const bool drag = std::holds_alternative<Drag>(motion);
  const int count = options.intervals > 0 ? options.intervals : (drag ? 32 : 16);
  IntervalQuadratureResult result;
  result.termination = Termination::converged;
  LevelSolver solver(intervals, grid, material, options, result);
  SolvedLevels solved{gauss_nodes(count), {}, {}};
  const auto solve = [&](double theta, bool with_stiffness) {
    solved.theta.push_back(theta);
    solved.values.push_back(
        solver.at(mean_indentation + normal_amplitude(motion) * std::cos(theta), with_stiffness));
  };
  solve(0, false);
  for (const Node& node : solved.nodes) {
    const auto done = static_cast<int>(solved.theta.size());
    if (options.on_progress &&
        !options.on_progress({"intervals", static_cast<double>(done) / (count + 2), done, 0})) {
      result.termination = Termination::interrupted;
      return result;
    }
    solve(node.theta, true);
  }
  solve(pi, drag);

  LossOfLevels(solved, motion, material.modulus_ratio()).fill(result);
  result.curve.model = "bem";
  result.curve.nominal_area = grid.area();
  for (auto level = solved.values.rbegin(); level != solved.values.rend(); ++level)
    result.curve.samples.push_back(level->sample);
  return result;
}

}  // namespace salebra
