// SPDX-License-Identifier: GPL-3.0-or-later
// The theorem W = ½∮s² dK_t (s: stretch of a spring where it separates) by quadrature over the
// phase θ, with a contact set and its stiffness at each node.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <vector>

#include "base/numerics/dense_systems.hpp"
#include "phase_quadrature.hpp"
#include "surface_contacts.hpp"

namespace salebra {
namespace {

using detail::chebyshev_slope;
using detail::gauss_nodes;
using detail::loss;
using detail::loss_of;
using detail::Node;
using detail::normal_amplitude;
using std::numbers::pi;

// A function of the phase θ, given by its Chebyshev coefficients as a polynomial in c = cosθ.
struct Series {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd normal_inverse;  // (XᵀX)⁻¹ with the design matrix X of the least-squares fit
  double scatter = 0;              // standard deviation of the data about the fit

  double operator()(double theta) const {
    double sum = 0;
    for (Index l = 0; l < coefficients.size(); ++l)
      sum += coefficients(l) * std::cos(static_cast<double>(l) * theta);
    return sum;
  }
  double slope(double theta) const;
  double second_slope_at_middle() const {  // d²/dc² at c = 0 (θ = π/2)
    // Uses (1 − c²)T'' = cT' − l²T for the Chebyshev polynomial T of degree l.
    double sum = 0;
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

// Data of a fit: values of the function at the phases `theta`, and derivatives d/dc with c = cosθ
// at the phases `slope_theta`, weighted by slope_weight.
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

// Fits polynomials of all degrees up to the highest one and returns that with the smallest
// generalised cross-validation error; polynomials of higher degree only follow the noise.
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

// Error of W that follows from independent errors of K_t, `errors` at the nodes and `error_of_min`
// at the smallest indentation: the square root of the sum of the squared contributions to W.
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

struct ContactValues {
  ForceSample sample;
  double ratio = ForceSample::unknown;  // K_t/((G*/E*)K)
};

// Solves the contacts at the phases of one quadrature.
class IntervalSolver {
 public:
  IntervalSolver(const ContactSets& contact_sets, const Grid2D& grid, const Body& body,
                 const IntervalQuadratureOptions& options, IntervalQuadratureResult& result)
      : contact_sets_(contact_sets),
        grid_(grid),
        body_(body),
        modulus_ratio_(detail::modulus_ratio_of(body)),
        options_(options),
        result_(result) {}

  ContactValues at(double indentation, bool with_stiffness) {
    ContactValues values;
    values.sample.indentation = indentation;
    const ContactSetAt reached = contact_sets_(indentation);
    values.sample.force = reached.force;
    values.sample.pressure = reached.force / grid_.area();
    values.sample.contact_area_fraction =
        static_cast<double>(reached.contact.count()) / static_cast<double>(grid_.points());
    values.sample.converged = reached.converged;
    if (with_stiffness) add_stiffness(reached, values);
    if (!reached.converged)
      result_.termination = std::max(result_.termination, Termination::iteration_limit);
    return values;
  }

 private:
  void add_stiffness(const ContactSetAt& reached, ContactValues& values) {
    Field pressure;
    const PunchStiffness punch = punch_stiffness(reached.contact, grid_, body_,
                                                 {.tolerance = options_.stick.tolerance,
                                                  .max_iterations = options_.stick.max_iterations,
                                                  .boundary = options_.stick.boundary,
                                                  .on_progress = options_.stick.on_progress},
                                                 &pressure);
    const StickStiffness stick =
        stick_stiffness(reached.contact, grid_, body_, options_.stick, options_.direction == 0,
                        Field(pressure * modulus_ratio_));
    values.sample.tangential_stiffness = stick.along(options_.direction);
    values.sample.direction = options_.direction;
    values.sample.normal_stiffness = punch.normal_stiffness;
    if (punch.normal_stiffness > 0)
      values.ratio = values.sample.tangential_stiffness / (modulus_ratio_ * punch.normal_stiffness);
    values.sample.converged = reached.converged && stick.converged() && punch.converged();
    result_.termination = std::max({result_.termination, stick.termination, punch.termination});
    result_.iterations += stick.iterations + punch.iterations;
    result_.fft_count += stick.fft_count + punch.fft_count;
  }

  const ContactSets& contact_sets_;
  const Grid2D& grid_;
  const Body& body_;
  double modulus_ratio_;  // G*/E* on half-spaces, otherwise 1
  const IntervalQuadratureOptions& options_;
  IntervalQuadratureResult& result_;
};

// Contacts in order of falling indentation: at the largest one, at the nodes, at the smallest one.
struct SolvedContacts {
  std::vector<Node> nodes;
  std::vector<double> theta;
  std::vector<ContactValues> values;
};

// Estimates of W from the contacts. Under a drag, W also depends on the stiffness at the smallest
// indentation.
class LossOfContacts {
 public:
  LossOfContacts(const SolvedContacts& contacts, const Oscillation& motion, double modulus_ratio)
      : contacts_(contacts),
        motion_(motion),
        drag_(std::holds_alternative<Drag>(motion)),
        amplitude_(normal_amplitude(motion)),
        modulus_ratio_(modulus_ratio) {
    // The force F and the stiffness K = F' are fitted together. F gets more weight, because it
    // scatters less than K when cells enter one by one.
    normal_.slope_weight = 0.1;
    for (std::size_t k = 0; k < contacts.values.size(); ++k) {
      const auto& [sample, ratio] = contacts.values[k];
      normal_.theta.push_back(contacts.theta[k]);
      normal_.values.push_back(sample.force);
      if (!std::isfinite(sample.normal_stiffness)) continue;
      normal_.slope_theta.push_back(contacts.theta[k]);
      normal_.slopes.push_back(sample.normal_stiffness * amplitude_);
      if (!std::isfinite(ratio)) continue;
      ratios_.theta.push_back(contacts.theta[k]);
      ratios_.values.push_back(ratio);
    }
    // The degree is at most 8: faster variations with the indentation are noise of the cells.
    highest_degree_ = std::min(static_cast<int>(contacts.nodes.size()) / 2, 8);
    force_ = best_fit(normal_, highest_degree_);
  }

  void fill(IntervalQuadratureResult& result) const {
    result.work_by_intervals = of_levels(&ForceSample::tangential_stiffness, 1);
    result.work_by_force = by_force(force_);
    result.force = force_(pi / 2);
    // The second derivative F'' needs a smoother fit, of degree 5 at most. The loss is an integral
    // and tolerates a fit that follows the noise of the cells.
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
    const auto at = [&](const ContactValues& level) { return factor * (level.sample.*stiffness); };
    return loss(
        motion_, contacts_.nodes, [&](std::size_t k) { return at(contacts_.values[k + 1]); },
        drag_ ? at(contacts_.values.back()) : 0);
  }

  void add_ratio(IntervalQuadratureResult& result) const {
    // Fits the stiffness ratio ρ = K_t/((G*/E*)K) by four coefficients at most, since ρ varies
    // slowly and fast variations are noise of the cells.
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

  // Error of W from the normal stiffness. Compares W with its values from the unfitted stiffnesses
  // K and from a fit of one degree more.
  double normal_error(double work_by_force) const {
    const double by_stiffness = of_levels(&ForceSample::normal_stiffness, modulus_ratio_);
    const int degree = static_cast<int>(force_.coefficients.size()) - 1;
    // K, computed from whole cells, scatters about F'. W from these K may agree with W from the fit
    // by chance; the scatter shows by how much the two could differ.
    const auto deviation = [&](std::size_t at) {
      return modulus_ratio_ * (contacts_.values[at].sample.normal_stiffness -
                               force_.slope(contacts_.theta[at]) / amplitude_);
    };
    std::vector<double> deviations;
    for (std::size_t k = 0; k < contacts_.nodes.size(); ++k) deviations.push_back(deviation(k + 1));
    const double cells = scatter_of_loss(motion_, contacts_.nodes, deviations,
                                         drag_ ? deviation(contacts_.nodes.size() + 1) : 0);
    return std::max({std::abs(by_stiffness - work_by_force),
                     std::abs(by_force(fit(normal_, degree + 1)) - work_by_force), 2 * cells});
  }

  const SolvedContacts& contacts_;
  const Oscillation& motion_;
  const bool drag_;
  const double amplitude_, modulus_ratio_;
  FitData normal_, ratios_;
  int highest_degree_ = 0;
  Series force_;
};

}  // namespace

IntervalQuadratureResult interval_quadrature(const ContactSets& contact_sets, const Grid2D& grid,
                                             const Body& body, const Oscillation& motion,
                                             double mean_indentation,
                                             const IntervalQuadratureOptions& options) {
  grid.validate();
  validate(motion, mean_indentation, options);
  const bool drag = std::holds_alternative<Drag>(motion);
  const int count = options.intervals > 0 ? options.intervals : (drag ? 32 : 16);
  IntervalQuadratureResult result;
  result.direction = options.direction;
  result.termination = Termination::converged;
  IntervalSolver solver(contact_sets, grid, body, options, result);
  SolvedContacts solved{gauss_nodes(count), {}, {}};
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

  LossOfContacts(solved, motion, detail::modulus_ratio_of(body)).fill(result);
  // These need the ratio of moduli that only half-spaces have.
  if (!body.half_space_material())
    result.work_by_force = result.small_amplitude_work = result.stiffness_ratio =
        std::numeric_limits<double>::quiet_NaN();
  result.curve.model = "bem";
  result.curve.body = body.fingerprint();
  result.curve.nominal_area = grid.area();
  for (auto level = solved.values.rbegin(); level != solved.values.rend(); ++level)
    result.curve.samples.push_back(level->sample);
  return result;
}

}  // namespace salebra
