// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of one surface from contacts inside the oscillation, with the errors of levels, cells and
// solver.
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/share.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/refine.hpp>

#include "contact/normal/contact_memory.hpp"
#include "phase_quadrature.hpp"
#include "surface/dense_systems.hpp"

namespace salebra {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr int most_levels = 32;
// The finest grid has at least so many: the scatter of W is then a tenth.
constexpr double enough_cells = 100;
constexpr double widest_window = 0.25;  // of F/K
// In standard deviations: 90 % of normal deviates are smaller.
constexpr double coverage = 1.645;

/// ρ = K_t/((G*/E*)K) about one load of the curve, linear in ln F.
struct StiffnessRatio {
  double value = 1, slope = 0, force = 0;
  double error = 0;  // of the relative size of W

  double at(double other_force) const {
    // Where the contact opens, F' goes to zero with F, and ρ does not matter.
    return value + slope * std::clamp(std::log(std::max(other_force, 0.0) / force), -1.0, 1.0);
  }
};

StiffnessRatio ratio_at(const ForceCurve& curve, std::size_t load, double modulus_ratio) {
  const auto ratio = [&](const ForceSample& sample) {
    return sample.tangential_stiffness / (modulus_ratio * sample.normal_stiffness);
  };
  const ForceSample& here = curve.samples[load];
  StiffnessRatio result{.force = here.force};
  result.value = ratio(here);
  std::vector<double> slopes;
  for (const int side : {-1, 1}) {
    for (auto k = static_cast<std::ptrdiff_t>(load) + side;
         k >= 0 && k < static_cast<std::ptrdiff_t>(curve.samples.size()); k += side) {
      const ForceSample& other = curve.samples[static_cast<std::size_t>(k)];
      if (!other.converged || !std::isfinite(ratio(other))) continue;
      slopes.push_back((ratio(other) - result.value) / std::log(other.force / here.force));
      break;
    }
  }
  // K_t' = ρ(G*/E*)F''(1 + d lnρ/d lnK): the slope enters W with its full size.
  if (slopes.size() == 2) {
    result.slope = (slopes[0] + slopes[1]) / 2;
    result.error = std::abs(slopes[0] - slopes[1]) / 2 / result.value;
  } else if (slopes.size() == 1) {
    result.slope = slopes[0];
    result.error = std::abs(slopes[0]) / result.value;
  }
  return result;
}

/// Least squares over Chebyshev–Lobatto points of [−1, 1], from 1 to −1.
struct Rule {
  VectorXd points;
  MatrixXd basis, inverse;  // T_l at the points; coefficients = inverse · values

  Rule(int levels, int degree) : points(levels + 1), basis(levels + 1, degree + 1) {
    for (int k = 0; k <= levels; ++k) {
      points(k) = std::cos(pi * k / levels);
      for (int l = 0; l <= degree; ++l) basis(k, l) = std::cos(pi * k * l / levels);
    }
    inverse = detail::pseudo_inverse(basis);
  }
  explicit Rule(int levels) : Rule(levels, levels == 4 ? 3 : levels / 2) {}
};

double value_of(const VectorXd& coefficients, double x) {
  const double angle = std::acos(std::clamp(x, -1.0, 1.0));
  double sum = 0;
  for (Index l = 0; l < coefficients.size(); ++l)
    sum += coefficients(l) * std::cos(static_cast<double>(l) * angle);
  return sum;
}

double slope_of(const VectorXd& coefficients, double x) {
  const double angle = std::acos(std::clamp(x, -1.0, 1.0));
  double sum = 0;
  for (Index l = 1; l < coefficients.size(); ++l)
    sum += coefficients(l) * detail::chebyshev_slope(l, angle);
  return sum;
}

/// The value below which 95 % of all χ² of `freedom` degrees over their mean are (Wilson and
/// Hilferty).
double usual_residual(double freedom) {
  const double variance = 2 / (9 * freedom);
  return std::pow(1 - variance + 1.645 * std::sqrt(variance), 3);
}

/// The contacts of one load on one grid.
class Levels {
 public:
  Levels(const Surface& surface, double contact_modulus, const NormalContactOptions& options)
      : surface_(surface), contact_modulus_(contact_modulus), options_(options) {
    // Where a periodic contact is full the indentation has no meaning.
    limit_ = std::numeric_limits<double>::infinity();
    if (options.boundary == Boundary::free) return;
    const HeightStatistics heights = height_statistics(surface);
    limit_ = heights.maximum - heights.mean;
  }

  struct Contact {
    double force = 0;
    double cells = 0, perimeter = 0, spots = 0;  // perimeter in widths of a cell
  };

  bool usable() const { return converged_; }

  /// The indentation under a pressure.
  double indentation_at(double pressure) {
    NormalContactState state = press_to_pressure(surface_, contact_modulus_, pressure, options_);
    known_[state.indentation] = contact_of(state);
    return take(state);
  }

  Contact at(double indentation) {
    if (indentation <= 0) return {};
    if (const auto found = known_.find(indentation); found != known_.end()) return found->second;
    if (indentation >= limit_) {
      converged_ = false;
      return {};
    }
    NormalContactOptions options = options_;
    const std::optional<Field> start = extrapolated(indentation);
    if (start) options.initial_pressure = &*start;
    NormalContactState state =
        press_to_indentation(surface_, contact_modulus_, indentation, options);
    known_[indentation] = contact_of(state);
    take(state);
    return known_[indentation];
  }

 private:
  /// Pressures are nearly linear over the short way from two contacts to a third.
  std::optional<Field> extrapolated(double indentation) const {
    if (!before_) return last_;
    const double share = (indentation - last_at_) / (last_at_ - before_at_);
    if (std::abs(share) > 3) return last_;
    return Field((*last_ + share * (*last_ - *before_)).max(0.0));
  }
  Contact contact_of(const NormalContactState& state) const {
    const ContactSpots spots =
        contact_spots(state.contact_pressure, surface_.grid, options_.boundary, surface_.ranks);
    return {
        .force = state.force,
        .cells =
            std::round(state.contact_area_fraction * static_cast<double>(surface_.grid.points())),
        // Along the sides of cells a curve is longer by 4/π in the mean over its directions (Cauchy
        // and Crofton).
        .perimeter = pi / 4 * spots.perimeter / std::sqrt(surface_.grid.cell_area()),
        .spots = static_cast<double>(spots.spots.size())};
  }
  /// The state becomes the start of the next; its pressure is moved away.
  double take(NormalContactState& state) {
    if (state.interrupted) throw Interrupted("damping: interrupted");
    converged_ = converged_ && state.converged;
    before_ = std::move(last_);
    before_at_ = last_at_;
    last_ = std::move(state.contact_pressure);
    return last_at_ = state.indentation;
  }

  const Surface& surface_;
  double contact_modulus_;
  NormalContactOptions options_;
  double limit_;
  std::map<double, Contact> known_;
  std::optional<Field> last_, before_;  // whether there are any is the same in all processes
  double last_at_ = 0, before_at_ = 0;
  bool converged_ = true;
};

/// What one grid says of one load.
struct GridValue {
  double work = SurfaceDamping::unknown;
  double scatter = std::numeric_limits<double>::infinity();  // one standard deviation of `work`, J
  double level_error = 0, solver_error = 0;                  // J
  int levels = 0;
  Index points = 0;
  bool converged = false;
};

/// A change of W that two scatters do not explain.
double beyond_scatter(double change, double one, double other) {
  return std::sqrt(std::max(0.0, change * change - one * one - other * other));
}

class Load {
 public:
  Load(const Material& material, const Oscillation& motion, const SurfaceDampingOptions& options,
       const ForceCurve& curve, std::size_t k)
      : material_(material),
        motion_(motion),
        options_(options),
        sample_(curve.samples[k]),
        ratio_(ratio_at(curve, k, material.modulus_ratio())),
        amplitude_(detail::normal_amplitude(motion)) {
    levels_ = options.levels;
    half_ = amplitude_;
    if (options.hold == Hold::force && options.amplitude == Amplitude::finite)
      // The weight sinks back by u_z²F''/(4K), about u_z²K/(4F).
      half_ += std::min(amplitude_,
                        amplitude_ * amplitude_ * sample_.normal_stiffness / sample_.force / 2);
    half_ = moved_ = std::min(half_, 2 * amplitude_);
  }

  const std::vector<GridValue>& values() const { return values_; }
  const StiffnessRatio& ratio() const { return ratio_; }
  double window() const { return half_; }
  /// Relative standard deviation of W by the chance at which spots touch within the window and
  /// outside the oscillation. With n spots of an exponential law, F'' is a sum of their δᵢ^{−1/2};
  /// the Poisson variance of what a polynomial of degree d makes of it is I/(πn), I = ½ ln(1 +
  /// 1.6((H/u_z)² − 1)/d²) to a tenth, by quadrature over the place of a spot for H/u_z of 1.5 to
  /// 40.
  double spot_chance() const {
    const double wider = half_ / moved_, degree = Rule(levels_).inverse.rows() - 1.0;
    const double missed = std::log1p(1.6 * (wider * wider - 1) / (degree * degree)) / 2;
    return std::sqrt(missed / (pi * spots_));
  }
  bool usable() const {
    return sample_.converged && sample_.force > 0 && std::isfinite(ratio_.value) &&
           (values_.empty() || values_.back().converged);
  }

  void solve(const Surface& surface, const Progress& progress) {
    NormalContactOptions contact;
    contact.boundary = options_.boundary;
    contact.on_progress = progress;
    contact.tolerance = tolerance();
    const bool first = values_.empty();
    Levels levels(surface, material_.contact_modulus, contact);
    const double center = levels.indentation_at(sample_.pressure);
    if (first) widen(levels, center);
    spots_ = levels.at(center).spots;
    values_.push_back(integrate(levels, center));
    values_.back().points = surface.grid.nx;
    values_.back().converged = values_.back().converged && levels.usable();
  }

 private:
  /// The second difference of F over the window is about F(KH/F)², and its tenth of a thousandth is
  /// lost in nothing else.
  double tolerance() const {
    const double strain = half_ * sample_.normal_stiffness / sample_.force;
    return std::clamp(1e-4 * strain * strain, 1e-13, 1e-6);
  }

  void widen(Levels& levels, double center) {
    const double widest = widest_window * sample_.force / sample_.normal_stiffness;
    const double wanted =
        enough_cells / std::pow(4.0, options_.coarsen ? 1 : std::min(options_.refinements, 1));
    while (half_ < widest && levels.usable()) {
      const double cells = levels.at(center + half_).cells - levels.at(center - half_).cells;
      if (cells >= wanted) break;
      half_ = std::min(widest, half_ * std::clamp(1.2 * wanted / std::max(cells, 1.0), 2.0, 8.0));
    }
  }

  GridValue integrate(Levels& levels, double center) {
    GridValue value;
    std::vector<Levels::Contact> contacts;
    for (int n = levels_;; n *= 2) {
      std::vector<Levels::Contact> finer(static_cast<std::size_t>(n + 1));
      const bool nested = !contacts.empty();
      for (int k = 0; k <= n; ++k)
        finer[static_cast<std::size_t>(k)] = nested && k % 2 == 0
                                                 ? contacts[static_cast<std::size_t>(k / 2)]
                                                 : levels.at(center + half_ * std::cos(pi * k / n));
      contacts = std::move(finer);
      if (!levels.usable()) return value;
      value = evaluate(contacts, n);
      levels_ = n;
      double change = 0;
      if (n > 4) {
        std::vector<Levels::Contact> half;
        for (std::size_t k = 0; k < contacts.size(); k += 2) half.push_back(contacts[k]);
        change = beyond_scatter(value.work - evaluate(half, n / 2).work, value.scatter, 0);
        value.level_error = change / 3;  // of second order at the least
      }
      if (!options_.choose_levels || n >= most_levels || !(change > 2 * value.scatter))
        return value;
    }
  }

  GridValue evaluate(const std::vector<Levels::Contact>& contacts, int n) const {
    const Rule rule(n);
    VectorXd force(n + 1);
    for (int k = 0; k <= n; ++k) force(k) = contacts[static_cast<std::size_t>(k)].force;
    const VectorXd series = rule.inverse * force;
    GridValue value;
    value.levels = n;
    const double mean = mean_position(series);
    if (!std::isfinite(mean)) return value;
    VectorXd weights(series.size());  // of the coefficients in W
    for (Index l = 0; l < weights.size(); ++l)
      weights(l) = work_of(VectorXd::Unit(weights.size(), l), series, mean);
    const VectorXd node_weights = rule.inverse.transpose() * weights;
    value.work = weights.dot(series);
    value.converged = true;
    value.solver_error = tolerance() * sample_.force * node_weights.lpNorm<1>();
    value.scatter = scatter(contacts, rule, force, series, node_weights);
    return value;
  }

  /// x = (δ − centre)/half of the mean indentation.
  double mean_position(const VectorXd& series) const {
    if (options_.hold == Hold::indentation || options_.amplitude == Amplitude::small) return 0;
    constexpr int phases = 64;
    double x = 0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double mean = 0, slope = 0;
      for (int k = 0; k < phases; ++k) {
        const double there = x + amplitude_ / half_ * std::cos(pi * (k + 0.5) / phases);
        mean += value_of(series, there) / phases;
        slope += slope_of(series, there) / phases;
      }
      const double step = (sample_.force - mean) / slope;
      x += step;
      if (std::abs(step) < 1e-12) break;
    }
    return std::abs(x) + amplitude_ / half_ <= 1 + 1e-9 ? x : SurfaceDamping::unknown;
  }

  /// W of a term of the series of F, with ρ at the forces of the whole series.
  double work_of(const VectorXd& term, const VectorXd& series, double mean) const {
    const double modulus_ratio = material_.modulus_ratio();
    const auto stiffness = [&](double x) {
      return ratio_.at(value_of(series, x)) * modulus_ratio * slope_of(term, x) / half_;
    };
    if (options_.amplitude == Amplitude::small) {
      constexpr double step = 1e-3;
      const double curvature =
          (stiffness(mean + step) - stiffness(mean - step)) / (2 * step * half_);
      return std::visit(
          [&](const auto& m) { return closed_form::work_per_cycle(1.0, curvature, m); }, motion_);
    }
    return detail::loss_of(motion_, [&](double theta) {
      return stiffness(mean + amplitude_ / half_ * std::cos(theta));
    });
  }

  /// Standard deviation of W from the chance at which whole cells enter, each of which raises K
  /// alike.
  double scatter(const std::vector<Levels::Contact>& contacts, const Rule& rule,
                 const VectorXd& force, const VectorXd& series, const VectorXd& weights) const {
    const double curvature = 4 * (Rule(rule.points.size() - 1, 2).inverse.row(2).dot(force));
    const Index intervals = rule.points.size() - 1;
    constexpr Index parts = 8;
    // These say after each part how many entered, and what a step of K there adds to the forces.
    VectorXd entered = VectorXd::Zero(intervals * parts + 1);
    MatrixXd excess = MatrixXd::Zero(rule.points.size(), entered.size());
    double edge = contacts.back().perimeter;
    for (Index j = 0; j < intervals; ++j) {
      const auto at = static_cast<std::size_t>(j);
      edge += contacts[at].perimeter;
      for (Index part = 0; part < parts; ++part) {
        const Index k = j * parts + part;
        const double x =
            rule.points(j) + (rule.points(j + 1) - rule.points(j)) * (double(part) + 0.5) / parts;
        entered(k + 1) =
            entered(k) + std::max(0.0, contacts[at].cells - contacts[at + 1].cells) / parts;
        const VectorXd step = (rule.points.array() - x).max(0.0).matrix();
        excess.col(k) -= step;
        excess.col(k + 1) += step;
      }
    }
    const double cells = entered(intervals * parts);
    if (!(cells > 0) || !(curvature > 0)) return std::numeric_limits<double>::infinity();
    const double variance = lattice_variance * edge / static_cast<double>(contacts.size());
    const MatrixXd covariance =
        MatrixXd::NullaryExpr(entered.size(), entered.size(), [&](Index i, Index k) {
          return variance * std::exp(-std::abs(entered(i) - entered(k)) / (2 * variance));
        });
    const double step = 2 * curvature / cells;  // F'' has the same over the window in the mean
    const MatrixXd of_forces = step * step * excess * covariance * excess.transpose();
    const MatrixXd residual_of =
        MatrixXd::Identity(force.size(), force.size()) - rule.basis * rule.inverse;
    const double expected = (residual_of * of_forces * residual_of.transpose()).trace();
    const double found = (force - rule.basis * series).squaredNorm();
    const auto freedom = static_cast<double>(force.size() - series.size());
    const double more = std::max(1.0, found / expected / usual_residual(freedom));
    return std::sqrt(more * weights.dot(of_forces * weights));
  }

  // Variance of the number of lattice points inside a smooth curve at a random place, for each unit
  // of its length: Σ|k|⁻³/(4π³) over the reciprocal lattice (D. G. Kendall, Quart. J. Math. 19
  // (1948) 1, for ovals).
  static constexpr double lattice_variance = 0.0728;

  const Material& material_;
  const Oscillation& motion_;
  const SurfaceDampingOptions& options_;
  const ForceSample sample_;
  const StiffnessRatio ratio_;
  const double amplitude_;
  double half_ = 0, moved_ = 0;  // the window, and what the oscillation needs of it
  double spots_ = 0;
  int levels_ = 8;
  std::vector<GridValue> values_;
};

void add_up(SurfaceDamping& result) {
  double sum = 0;
  for (const double part : {result.cell_error, result.scatter, result.level_error,
                            result.ratio_error, result.seam_error, result.solver_error})
    sum += part * part;
  result.error = std::sqrt(sum);
}

SurfaceDamping result_of(const Load& load, const Oscillation& motion,
                         const SurfaceDampingOptions& options) {
  SurfaceDamping result;
  const auto& values = load.values();
  if (values.empty() || !load.usable()) return result;
  const std::size_t own = options.coarsen ? 1 : 0;  // place of the cells as they are
  const std::size_t at = options.keep_cells ? std::min(own, values.size() - 1) : values.size() - 1;
  const GridValue& value = values[at];
  result.converged = true;
  result.work_per_cycle = value.work;
  result.damping_constant = closed_form::damping_constant(value.work, motion);
  result.level_error = value.level_error;
  result.solver_error = value.solver_error;
  result.scatter = coverage * std::hypot(value.scatter, value.work * load.spot_chance());
  result.ratio_error = std::abs(value.work) * load.ratio().error;
  result.stiffness_ratio = load.ratio().value;
  result.window = load.window();
  result.levels = value.levels;
  result.points = value.points;
  if (values.size() < 2) return result;
  const GridValue& other = values[at > 0 ? at - 1 : values.size() - 1];
  // Forces converge at second order: of a halving a third remains on the finer cells.
  const double change = beyond_scatter(value.work - other.work, value.scatter, other.scatter);
  result.cell_error = value.points < other.points ? 4 * change / 3 : change / 3;
  add_up(result);
  return result;
}

Surface every_second(const Surface& surface) {
  Surface coarse{surface.grid, {}, surface.periodic, surface.origin, surface.ranks};
  coarse.grid.nx /= 2;
  coarse.grid.ny /= 2;
  // Each process refines its own rows, which are not those that it has of the coarse grid.
  const Share fine = surface.share(), rows = coarse.share();
  std::vector<Index> begins;
  for (int rank = 0; rank < surface.ranks.ranks(); ++rank)
    begins.push_back((fine.begin_of(rank) + 1) / 2);
  begins.push_back(coarse.grid.nx);
  const Share found(surface.ranks, begins);
  const Field mine =
      surface.heights(Eigen::seqN(2 * found.begin() - fine.begin(), found.count(), 2),
                      Eigen::seqN(0, coarse.grid.ny, 2));
  coarse.heights = Field(rows.count(), coarse.grid.ny);
  const auto row_bytes = static_cast<std::size_t>(coarse.grid.ny) * sizeof(double);
  RowExchange(
      found,
      [&](int rank) {
        return RowExchange::Window{rows.begin_of(rank), rows.end_of(rank) - rows.begin_of(rank)};
      },
      RowExchange::Edge::none)(mine.data(), row_bytes, coarse.heights.data(), row_bytes, row_bytes);
  return coarse;
}

/// 1 inside, from 0 to 1 over a sixteenth at either end.
Eigen::ArrayXd taper(Index count) {
  const double width = static_cast<double>(count) / 16;
  return Eigen::ArrayXd::NullaryExpr(count, [&](Index k) {
    const double from_edge = std::min(static_cast<double>(k), static_cast<double>(count - 1 - k));
    return from_edge >= width ? 1.0 : 0.5 - 0.5 * std::cos(pi * from_edge / width);
  });
}

Surface windowed(Surface surface) {
  const double mean = height_statistics(surface).mean;
  const Share rows = surface.share();
  const Eigen::ArrayXd x = taper(surface.grid.nx).segment(rows.begin(), rows.count()),
                       y = taper(surface.grid.ny);
  surface.heights = mean + (surface.heights - mean) * (x.matrix() * y.matrix().transpose()).array();
  return surface;
}

void validate(const Surface& surface, const ForceCurve& curve,
              const SurfaceDampingOptions& options) {
  require(!curve.samples.empty(), "curve", 0, "loads; compute at least one");
  require(allowed_levels(options.levels), "levels", options.levels, "must be 4, 8, 16 or 32");
  require(options.refinements >= 0 && options.refinements <= 4, "refinements", options.refinements,
          "must lie in 0 … 4");
  require(!options.coarsen || (surface.grid.nx % 2 == 0 && surface.grid.ny % 2 == 0), "coarsen",
          surface.grid.nx, "points cannot be halved; use an even number");
  require(options.relative_error >= 0 && options.relative_error < 1, "relative_error",
          options.relative_error, "must lie between 0 and 1");
}

}  // namespace

std::vector<SurfaceDamping> surface_damping(const Surface& surface, const Material& material,
                                            const Oscillation& motion, const ForceCurve& curve,
                                            const SurfaceDampingOptions& options) {
  const Communicator& ranks = surface.ranks;
  collectively(ranks, [&] { surface.require_complete_rows("a contact calculation"); });
  validate(surface, curve, options);
  std::vector<Load> loads;
  for (std::size_t k = 0; k < curve.samples.size(); ++k)
    loads.emplace_back(material, motion, options, curve, k);

  const int halvings = options.relative_error > 0 ? 30 : options.refinements;
  for (int halving = options.coarsen ? -1 : 0; halving <= halvings; ++halving) {
    std::vector<Load*> open;
    for (Load& load : loads) {
      if (!load.usable()) continue;
      const SurfaceDamping result = result_of(load, motion, options);
      if (halving <= options.refinements ||
          !(result.error <= options.relative_error * std::abs(result.work_per_cycle)))
        open.push_back(&load);
    }
    const Index factor = halving > 0 ? Index(1) << halving : 1;
    if (open.empty() || (halving > options.refinements && factor > options.most_refined)) break;
    const Surface fine = halving < 0 ? every_second(surface) : refined(surface, factor);
    // Two loads of a surface that is spread would send through each other.
    const int wanted =
        ranks.alone() ? std::min(static_cast<int>(open.size()), parallel::threads()) : 1;
    require_memory(fine.grid, wanted * detail::contact_memory(fine, {.boundary = options.boundary}),
                   wanted > 1 ? "contacts on all threads (fewer `threads` need less)" : "a contact",
                   ranks);
    std::atomic<bool> stop = false, failed = false;
    std::atomic<int> finished = 0;
    std::exception_ptr failure;
    std::mutex failure_guard;
    const Progress progress = [&](const ProgressReport& report) {
      // Only the calling thread may talk to its caller.
      if (options.on_progress && omp_get_thread_num() == 0 &&
          !options.on_progress(
              {"damping", double(finished) / double(open.size()), finished, report.residual}))
        stop = true;
      return !stop.load();
    };
    // The highest loads take longest and go first.
#pragma omp parallel for schedule(dynamic, 1) num_threads(wanted) if (wanted > 1)
    for (int back = 0; back < static_cast<int>(open.size()); ++back) {
      // One process may have been told to stop where the others were not. One that failed calls
      // them no more.
      if (failed || !ranks.all_agree(!stop)) stop = true;
      if (stop) continue;
      try {
        open[open.size() - 1 - static_cast<std::size_t>(back)]->solve(fine, progress);
        ++finished;
      } catch (...) {
        failed = stop = true;
        const std::scoped_lock lock(failure_guard);
        if (!failure) failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
    if (!ranks.all_agree(!stop)) throw Interrupted("damping: interrupted");
  }
  std::vector<SurfaceDamping> results;
  for (const Load& load : loads) results.push_back(result_of(load, motion, options));
  if (!options.seam) return results;
  SurfaceDampingOptions without = options;
  without.seam = {};
  without.refinements = 0;
  without.relative_error = 0;
  without.coarsen = false;
  const bool free = *options.seam == SeamCheck::free;
  if (free) without.boundary = Boundary::free;
  const auto unseamed =
      surface_damping(free ? surface : windowed(surface), material, motion, curve, without);
  for (std::size_t k = 0; k < results.size(); ++k) {
    SurfaceDamping& result = results[k];
    const auto& values = loads[k].values();
    if (!result.converged || !unseamed[k].converged) continue;
    const GridValue& own =
        values[std::min<std::size_t>(options.coarsen ? 1 : 0, values.size() - 1)];
    result.seam_error =
        beyond_scatter(unseamed[k].work_per_cycle - own.work, own.scatter, own.scatter);
    add_up(result);
  }
  return results;
}

}  // namespace salebra
