// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of one surface from contacts solved inside the oscillation, with the errors by the number
// of intervals, the cells and the solver.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/surface/moments.hpp>

#include "base/memory.hpp"
#include "base/stage_time.hpp"
#include "base/task_pool.hpp"
#include "contact/normal/contact_memory.hpp"
#include "kriged_stiffness.hpp"
#include "phase_quadrature.hpp"
#include "spring_loss.hpp"
#include "surface/refine.hpp"
#include "surface_contacts.hpp"
#include "wide_oscillation.hpp"

namespace salebra {
namespace {

using detail::every_other;
using detail::KrigedStiffness;
using detail::LossOfSpring;
using detail::modulus_ratio_of;
using detail::ratio_on;
using detail::stated_deviations;
using detail::StiffnessRatio;
using detail::StiffnessSample;
using detail::SurfaceContacts;
using detail::VarianceScales;
using detail::WideLoss;
using detail::WideOscillation;
using std::numbers::pi;

constexpr int max_intervals = 32;
constexpr Index piece_parts = 64;
// On the finest grid at least this many cells must enter during the oscillation. The loss W then
// scatters by about a tenth.
constexpr double enough_cells = 100;
// Largest half width of the range of solved contacts, in F/K.
constexpr double widest_window = 0.25;
// Largest range of indentations below the oscillation, in F/K, in which one parabola plus a random
// function describes K.
constexpr double widest_piece = 1.5;
// Springs below the deepest solved contact may contribute this fraction of the loss with slip.
constexpr double min_rest = 3e-3;

/// A loss per cycle with errors, J, predicted by kriging or from the law of the surface.
struct KrigedWork {
  double work = Loss::unknown;
  double deviation = std::numeric_limits<double>::infinity();  // standard deviation, J
  double ratio_error = 0, solver_error = 0, first_touch_error = 0;
};

KrigedWork work_of(const WideLoss::Part& part) {
  return {part.work, part.deviation, part.by_ratio, part.by_solver, part.below};
}

/// Results of one load on one grid; the loss of the base class is that without slip.
struct GridValue : KrigedWork {
  KrigedWork with_slip;
  double relaxation_work = Loss::unknown;  // part of the loss with slip, J
  double indentation = Loss::unknown, mean_force = Loss::unknown, max_force = Loss::unknown,
         contact_time = Loss::unknown;
  Index points = 0;
  double leaving_share = 0;
  bool converged = false;
};

/// Part of the change of W between two grids that the standard deviations `one` and `other` of the
/// two values do not explain.
double beyond_scatter(double change, double one, double other) {
  return std::sqrt(std::max(0.0, change * change - one * one - other * other));
}

class Load {
 public:
  Load(const Body& body, const Oscillation& motion, const SurfaceDampingOptions& options, Hold hold,
       const ForceCurve& curve, std::size_t k)
      : modulus_ratio_(modulus_ratio_of(body)),
        motion_(motion),
        options_(options),
        sample_(curve.samples[k]),
        index_(k),
        ratio_(ratio_on(curve, k, modulus_ratio_of(body))),
        spring_error_(detail::spring_error(body, ratio_.exponent())),
        amplitude_(detail::normal_amplitude(motion)),
        hold_(hold),
        wide_(options.amplitude == Amplitude::finite && detail::is_wide(sample_, amplitude_)) {
    intervals_ = options.intervals;
    // The loss with slip under a drag depends on the distance between its turning points.
    if (!std::isnan(options.friction_coefficient) &&
        (std::holds_alternative<EqualFrequency>(motion) || !std::isnan(options.excursion)))
      // With this stretch limit a spring that carries the normal force dF slips at μ dF, whatever
      // its stiffness is.
      slip_.emplace(motion,
                    options.friction_coefficient / (modulus_ratio_of(body) * ratio_.middle()),
                    options.excursion);
    for (const ForceSample& sample : curve.samples) {
      const auto point = detail::point_of(sample, modulus_ratio_of(body));
      if (slip_ && point.force > 0 && std::isfinite(point.ratio)) of_curve_.push_back(point);
    }
    std::ranges::sort(of_curve_, {}, &StiffnessRatio::Point::force);
    half_ = detail::half_range(sample_, amplitude_,
                               hold_ == Hold::force && options.amplitude == Amplitude::finite);
  }

  const std::vector<GridValue>& values() const { return values_; }
  double stiffness_ratio() const { return ratio_.middle(); }
  double spring_error() const { return spring_error_; }
  double window() const { return half_; }
  int intervals() const { return intervals_; }
  double interval_error() const { return interval_error_; }
  double interval_error_with_slip() const { return interval_error_with_slip_; }
  bool follows_slip() const { return slip_.has_value(); }
  Hold hold() const { return hold_; }
  bool is_wide() const { return wide_; }
  std::size_t index() const { return index_; }
  double direction() const { return detail::direction_of(sample_); }
  WideOscillation::Load load() const { return {sample_.pressure, sample_.force}; }
  double possible_amplitude() const { return possible_amplitude_; }
  bool usable() const {
    return sample_.converged && sample_.force > 0 && std::isfinite(ratio_.middle()) &&
           (values_.empty() || values_.back().converged);
  }

  /// Takes the result of a wide oscillation on one grid.
  void take(const WideLoss& loss, const WideOscillation& oscillation, Index points,
            double leaving_share) {
    GridValue& value = values_.emplace_back();
    static_cast<KrigedWork&>(value) = work_of(loss.without_slip);
    value.with_slip = work_of(loss.with_slip);
    value.relaxation_work = loss.relaxation_work;
    value.indentation = loss.indentation;
    value.mean_force = loss.mean_force;
    value.max_force = loss.max_force;
    value.contact_time = loss.contact_time;
    value.points = points;
    value.leaving_share = leaving_share;
    value.converged = loss.converged;
    possible_amplitude_ = loss.possible_amplitude;
    half_ = oscillation.window();
    intervals_ = oscillation.intervals();
    interval_error_ = loss.without_slip.by_intervals;
    interval_error_with_slip_ = loss.with_slip.by_intervals;
  }

  NormalContactOptions contact_options(const Progress& progress) const {
    NormalContactOptions contact;
    contact.boundary = options_.boundary;
    contact.on_progress = progress;
    contact.tolerance = tolerance();
    return contact;
  }

  /// Finds the loss without slip on one grid of nx points along x, with contacts by
  /// contact_options() of a load on this grid; loads in other directions use the same contacts.
  void solve(SurfaceContacts& contacts_at, Index nx) {
    const bool first = values_.empty();
    const double center = contacts_at.indentation_at(sample_.pressure);
    // While the contact is the last one, its stiffness needs no second solve.
    contacts_at.at(center);
    if (first) {
      widen(contacts_at, center);
      // K_t/K is computed on the first grid only: both stiffnesses see the same cells, so it hardly
      // depends on the grid. A curve whose K_t is (G*/E*)K, without a stick solve, keeps this
      // ratio.
      if (states_error() && std::abs(ratio_.middle() - 1) > 1e-9) {
        const auto at = [&](double indentation) {
          return contacts_at.ratio_at(indentation, direction());
        };
        const auto high = at(center + half_), middle = at(center);
        ratio_ = {at(center - half_), middle, high};
      }
    }
    values_.push_back(integrate(contacts_at, center));
    values_.back().points = nx;
    check(contacts_at);
    // Only where slip reaches deep, contacts of other loads lie there.
    constexpr double deep = 0.25;
    if (solved_ && center - half_ - (solved_->mean - amplitude_ - slip_->depth()) <=
                       std::max(half_, deep * sample_.force / sample_.normal_stiffness))
      add_slip(contacts_at);
  }

  /// Adds the loss with slip on the grid of the last solve(), where slip reaches so deep that
  /// contacts of other loads serve it.
  void add_slip(SurfaceContacts& contacts_at) {
    if (!solved_) return;
    add_slip(values_.back(), contacts_at, *solved_);
    solved_.reset();
    check(contacts_at);
  }

 private:
  /// Contacts of the range of the oscillation on the last grid, for the loss with slip.
  struct Solved {
    std::vector<StiffnessSample> contacts;
    KrigedStiffness kriged;
    double mean, center;
    int intervals;
  };

  void check(const SurfaceContacts& contacts_at) {
    values_.back().converged = values_.back().converged && contacts_at.usable();
    values_.back().leaving_share = contacts_at.leaving_share();
  }

  /// Tolerance of the contact solver. The second difference of F over the range of contacts is
  /// about F(KH/F)², with half the range H. A thousandth of this is smaller than the scatter by
  /// cells.
  double tolerance() const {
    const double strain = half_ * sample_.normal_stiffness / sample_.force;
    return std::clamp(1e-3 * strain * strain, 1e-12, 1e-6);
  }

  void widen(SurfaceContacts& contacts_at, double center) {
    const double widest = widest_window * sample_.force / sample_.normal_stiffness;
    const double wanted =
        enough_cells / std::pow(4.0, options_.coarsen ? 1 : std::min(options_.refinements, 1));
    while (half_ < widest && contacts_at.usable()) {
      const StiffnessSample high = contacts_at.at(center + half_),
                            low = contacts_at.at(center - half_);
      // Cells that enter at the same time count as one.
      const double cells = (high.cells - low.cells) / std::max(high.together, low.together);
      if (cells >= wanted) break;
      half_ = std::min(widest, half_ * std::clamp(1.2 * wanted / std::max(cells, 1.0), 2.0, 8.0));
    }
  }

  bool states_error() const { return options_.coarsen || options_.refinements > 0; }

  /// Loss W on one grid. The number of intervals between contacts is chosen on the first grid,
  /// since the error it causes depends on the surface and not on the cells. As K is known at each
  /// contact, half as many intervals are almost as good; they are used on the other grids, and if
  /// no error is stated.
  GridValue integrate(SurfaceContacts& contacts_at, double center) {
    const bool first = values_.empty();
    std::vector<StiffnessSample> contacts;
    const bool chooses = first && (options_.choose_intervals || states_error());
    for (int n = chooses ? intervals_ : intervals_ / 2;; n *= 2) {
      std::vector<StiffnessSample> finer(static_cast<std::size_t>(n + 1));
      const bool nested = !contacts.empty();
      for (int k = 0; k <= n; ++k)
        finer[static_cast<std::size_t>(k)] =
            nested && k % 2 == 0 ? contacts[static_cast<std::size_t>(k / 2)]
                                 : contacts_at.at(center + half_ * std::cos(pi * k / n));
      contacts = std::move(finer);
      if (!contacts_at.usable()) return {};
      // The factors of the variances (scales_), estimated on one grid, serve as prior on the next.
      KrigedStiffness kriged(contacts, indices(center));
      VarianceScales scales = scales_;
      scales.add(kriged.log_likelihood());
      GridValue value = evaluate(kriged, center, scales);
      if (chooses) {
        intervals_ = n;
        const GridValue by_half =
            evaluate(KrigedStiffness(every_other(contacts), indices(center)), center, scales);
        interval_error_ = std::abs(value.work - by_half.work);
        if (options_.choose_intervals && n < max_intervals && interval_error_ > value.deviation)
          continue;
      }
      scales_ = scales;
      const double mean = mean_position(kriged, center);
      if (slip_ && std::isfinite(mean))
        solved_.emplace(std::move(contacts), std::move(kriged), mean, center, n);
      return value;
    }
  }

  /// Adds W with friction, −∫K_t w' dζ (w: loss of one spring, spring_loss.hpp). The range of the
  /// oscillation uses its own contacts. Below it are pieces of at most 1.5 F/K, with contacts of
  /// other loads where these lie, and further contacts elsewhere: over a wider piece no parabola with
  /// a random function of one variance describes K, since K and its variance fall with the load. Adjacent pieces share a contact and w is
  /// continuous, so K at their border cancels. Springs below the last piece carry the force F and
  /// add less than F times the largest |w'|. Pieces are added until this bound is 0.3 % of W, and
  /// the bound counts as an error by the number of intervals. No piece is needed if springs slip so
  /// little below the oscillation that K_t does not change over their depth.
  void add_slip(GridValue& value, SurfaceContacts& contacts_at, const Solved& solved) {
    const auto& [contacts, kriged, mean, center, intervals] = solved;
    const bool first = values_.size() == 1, chooses = intervals == intervals_;
    const double least = mean - amplitude_;
    KrigedWork sum{0, 0, 0, 0, 0};
    double by_half = 0, rest = 0;
    // The same springs are asked for with and without the first piece below the oscillation.
    std::map<double, double> losses;
    const auto loss_at = [&](double indentation) {
      const auto [found, is_new] = losses.try_emplace(indentation);
      if (is_new) found->second = (*slip_)(indentation - mean);
      return found->second;
    };
    const auto add = [&](const std::vector<StiffnessSample>& samples, const Eigen::VectorXd& at,
                         const KrigedStiffness& between, const VarianceScales& scales) {
      Eigen::VectorXd of_spring = weights_of_springs(at, least, loss_at);
      // K_t is constant below the oscillation, so w may be set to 0 at the lower end of its range.
      if (shallow_) of_spring(at.size() - 1) -= (*slip_)(at(at.size() - 1) - mean);
      const Eigen::VectorXd weights = tangential(of_spring, at, between, ratio_);
      const auto [work, deviation] = between.estimate(weights, scales);
      const Eigen::VectorXd straight = tangential(of_spring, at, between, ratio_.straight(), false);
      sum.work += work;
      sum.deviation = std::hypot(sum.deviation, deviation);
      sum.ratio_error += std::abs(work - between.estimate(straight, scales).value);
      sum.solver_error += between.solver_error(weights);
      if (!chooses) return;
      const KrigedStiffness half(every_other(samples), at);
      by_half += half.estimate(tangential(of_spring, at, half, ratio_), scales).value;
    };
    const double lowest = (*slip_)(-amplitude_);
    const auto add_window = [&](const std::vector<StiffnessSample>& samples,
                                const Eigen::VectorXd& at, const KrigedStiffness& between) {
      add(samples, at, between, scales_);
      const Eigen::VectorXd opening = weights_of_springs(
          at, least, [&](double index) { return loss_at(std::max(index, least)); });
      value.relaxation_work = between
                                  .estimate(tangential(opening - lowest * between.weights_at(least),
                                                       at, between, ratio_),
                                            scales_)
                                  .value;
    };
    // Lowest indentation at which springs slip. There are no springs below first touch.
    const double bottom = std::max(0.0, least - slip_->depth());
    double top = center - half_;
    if (first && top > bottom) {
      // Bound of dK/dδ below the oscillation: it is K²/F for an exponential contact, and up to
      // three times as much for a few contact patches.
      const StiffnessSample& lowest_contact = contacts.back();
      const double bend =
          3 * lowest_contact.stiffness * lowest_contact.stiffness / lowest_contact.force;
      rest = modulus_ratio_ * ratio_.middle() * (*slip_)(top - mean) * bend * (top - bottom);
      shallow_ = rest <= min_rest * std::abs(value.work);
    }
    const Eigen::VectorXd window = indices(center);
    add_window(contacts, window, kriged);
    for (std::size_t piece = 0; top > bottom && !shallow_; ++piece) {
      if (first) {
        const StiffnessSample highest = contacts_at.at(top);
        rest = modulus_ratio_ * ratio_.middle() * highest.force * slip_->steepest();
        if (!contacts_at.usable() || rest <= min_rest * std::abs(sum.work)) break;
        const double width = widest_piece * highest.force / highest.stiffness;
        // A narrower piece would need more digits of the forces than the range of the oscillation
        // does, and perhaps no cell would enter in it.
        const double end = std::min(bottom, top - half_);
        pieces_.push_back(mean - (top - end < 1.2 * width ? end : top - width));
        rest = 0;
      } else if (piece == pieces_.size()) {
        break;
      }
      const double lowest_end = std::max(0.0, mean - pieces_[piece]);
      if (!(top - lowest_end > 2e-9 * amplitude_)) break;
      if (first && piece == 0)
        joined_ =
            center + half_ - lowest_end < widest_piece * sample_.force / sample_.normal_stiffness;
      const bool joined = joined_ && piece == 0;
      const Eigen::VectorXd nodes =
          nodes_of_piece(contacts_at, top, lowest_end, lowest_end <= bottom, intervals);
      std::vector<StiffnessSample> inside;
      for (const double node : nodes) inside.push_back(contacts_at.at(node));
      if (!contacts_at.usable()) break;
      const Eigen::VectorXd at = positions_between(nodes);
      if (joined) {
        std::vector<StiffnessSample> samples = contacts;
        samples.insert(samples.end(), inside.begin() + 1, inside.end());
        Eigen::VectorXd all(window.size() + piece_parts);
        all << window, at.tail(piece_parts);
        sum = {0, 0, 0, 0, 0};
        by_half = 0;
        add_window(samples, all, KrigedStiffness(samples, all));
      } else {
        const KrigedStiffness between(inside, at);
        VarianceScales scales = scales_;
        scales.add(between.log_likelihood());
        add(inside, at, between, scales);
      }
      top = nodes(nodes.size() - 1);
    }
    if (chooses) interval_error_with_slip_ = std::hypot(sum.work - by_half, rest);
    value.with_slip = sum;
  }

  /// Indentations of the contacts of a piece from `top` down to `end`, at equal angles; contacts of
  /// other loads take their place where they are nearer than a third of the way to the next one.
  /// deepest: whether the piece must reach `end`.
  static Eigen::VectorXd nodes_of_piece(const SurfaceContacts& contacts_at, double top, double end,
                                        bool deepest, int intervals) {
    const double half = (top - end) / 2, middle = (top + end) / 2;
    const auto node = [&](Index k) {
      return k == 0           ? top
             : k == intervals ? end
                              : middle + half * std::cos(pi * double(k) / intervals);
    };
    return Eigen::VectorXd::NullaryExpr(intervals + 1, [&](Index k) {
      if (k == 0 || !(node(k) > 0)) return node(k);
      const double above = node(k - 1) - node(k),
                   below = k < intervals ? node(k) - node(k + 1) : above;
      const double reach = std::min(above, below) / 3;
      return contacts_at.known_near(node(k), node(k) - reach,
                                    node(k) + (deepest && k == intervals ? 0 : reach));
    });
  }

  /// Indentations of a piece at which K is predicted: at equal angles, and stretched between the
  /// contacts at `nodes`.
  static Eigen::VectorXd positions_between(const Eigen::VectorXd& nodes) {
    const Index intervals = nodes.size() - 1, parts = piece_parts / intervals;
    return Eigen::VectorXd::NullaryExpr(piece_parts + 1, [&](Index k) {
      const Index above = k / parts;
      if (k % parts == 0) return nodes(above);
      const auto cosine = [](Index part) { return std::cos(pi * double(part) / piece_parts); };
      const double from = cosine(above * parts), to = cosine((above + 1) * parts);
      return std::lerp(nodes(above), nodes(above + 1), (from - cosine(k)) / (from - to));
    });
  }

  /// Weights in −∫K w' dζ = Σ weights × K(positions), for K linear between the positions. w has
  /// kinks at the smallest indentation and at the deepest spring that slips; their distance may be
  /// much smaller than that of two positions.
  Eigen::VectorXd weights_of_springs(const Eigen::VectorXd& indices, double least,
                                     const auto& loss) const {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(indices.size());
    double loss_above = loss(indices(0));
    for (Index i = 0; i + 1 < indices.size(); ++i) {
      double sum = 0, from = indices(i), loss_from = loss_above;
      for (const double bend : {least, least - slip_->depth(), indices(i + 1)}) {
        if (bend >= from || bend < indices(i + 1)) continue;
        const double loss_to = loss(bend);
        sum += (bend - from) * (loss_from + 4 * loss((from + bend) / 2) + loss_to) / 6;
        from = bend;
        loss_from = loss_to;
      }
      const double mean = sum / (indices(i + 1) - indices(i));
      weights(i) += mean - loss_above;
      weights(i + 1) += loss_from - mean;
      loss_above = loss_from;
    }
    return weights;
  }

  /// Converts weights of K_t to weights of K by the ratio ρ = K_t/((G*/E*)K). Below the forces of
  /// `ratio`, ρ changes as on the curve, or stays constant if follow_curve is false.
  Eigen::VectorXd tangential(const Eigen::VectorXd& weights, const Eigen::VectorXd& indices,
                             const KrigedStiffness& kriged, const StiffnessRatio& ratio,
                             bool follow_curve = true) const {
    return Eigen::VectorXd::NullaryExpr(weights.size(), [&](Index i) {
      const double force = kriged.force(indices(i)), lowest = ratio.lowest_force();
      double value = ratio.at(force);
      if (follow_curve && force < lowest) value += ratio_of_curve(force) - ratio_of_curve(lowest);
      return modulus_ratio_ * value * weights(i);
    });
  }

  /// ρ of the curve at a force, linear in ln F between loads.
  double ratio_of_curve(double force) const {
    if (of_curve_.empty()) return 0;
    const auto above =
        std::ranges::upper_bound(of_curve_, force, {}, &StiffnessRatio::Point::force);
    if (above == of_curve_.begin()) return above->ratio;
    const auto below = std::prev(above);
    if (above == of_curve_.end()) return below->ratio;
    return std::lerp(below->ratio, above->ratio,
                     std::log(force / below->force) / std::log(above->force / below->force));
  }

  /// Indentations at which K is predicted, at equal angles of the range of contacts and of the
  /// oscillation. They are dense at the ends of the oscillation, where K is most uncertain.
  Eigen::VectorXd indices(double center) const {
    constexpr int parts = 64;
    std::vector<double> all;
    for (int k = 0; k <= parts; ++k) {
      all.push_back(half_ * std::cos(pi * k / parts));
      all.push_back(amplitude_ * std::cos(pi * k / parts));
    }
    std::ranges::sort(all, std::greater());
    const auto same = [&](double one, double other) { return one - other < 1e-9 * amplitude_; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    return center + Eigen::Map<const Eigen::ArrayXd>(all.data(), static_cast<Index>(all.size()));
  }

  GridValue evaluate(const KrigedStiffness& kriged, double center,
                     const VarianceScales& scales) const {
    GridValue value;
    const double mean = mean_position(kriged, center);
    if (!std::isfinite(mean)) return value;
    const Eigen::VectorXd weights = weights_of_work(kriged, ratio_, mean);
    const auto [work, deviation] = kriged.estimate(weights, scales);
    value.work = work;
    value.deviation = deviation;
    value.converged = std::isfinite(work);
    const Eigen::VectorXd straight = weights_of_work(kriged, ratio_.straight(), mean);
    value.ratio_error = std::abs(work - kriged.estimate(straight, scales).value);
    value.solver_error = kriged.solver_error(weights);
    value.indentation = mean;
    value.mean_force = mean_force(kriged, mean);
    value.max_force = kriged.force(mean + amplitude_);
    value.contact_time = std::acos(std::clamp(-mean / amplitude_, -1.0, 1.0)) / pi;
    return value;
  }

  /// Mean of F over the phases of the oscillation about a mean indentation.
  double mean_force(const KrigedStiffness& kriged, double mean) const {
    constexpr int phases = 64;
    double sum = 0;
    for (int k = 0; k < phases; ++k)
      sum += kriged.force(mean + amplitude_ * std::cos(pi * (k + 0.5) / phases)) / phases;
    return sum;
  }

  /// The mean indentation of the oscillation, m. NaN if the contacts do not cover the oscillation.
  double mean_position(const KrigedStiffness& kriged, double center) const {
    if (hold_ == Hold::indentation || options_.amplitude == Amplitude::small) return center;
    constexpr int phases = 64;
    double position = center;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double mean = 0, slope = 0;
      for (int k = 0; k < phases; ++k) {
        const double there = position + amplitude_ * std::cos(pi * (k + 0.5) / phases);
        mean += kriged.force(there) / phases;
        slope += kriged.stiffness(there) / phases;
      }
      const double step = (sample_.force - mean) / slope;
      position += step;
      if (std::abs(step) < 1e-9 * half_) break;
    }
    return std::abs(position - center) + amplitude_ <= (1 + 1e-9) * half_ ? position
                                                                          : Loss::unknown;
  }

  /// Weights for which W = Σ weights × K(positions).
  Eigen::VectorXd weights_of_work(const KrigedStiffness& kriged, const StiffnessRatio& ratio,
                                  double mean) const {
    const auto tangential = [&](double indentation) -> Eigen::VectorXd {
      return modulus_ratio_ * ratio.at(kriged.force(indentation)) * kriged.weights_at(indentation);
    };
    if (options_.amplitude == Amplitude::small) {
      // The small-amplitude loss needs the slope F'' of K. Each contact patch gives F'' a pole
      // where it touches, so the mean slope over a quarter of the oscillation is used.
      const double part = amplitude_ / 4;
      const double of_curvature = std::visit(
          [](const auto& m) { return closed_form::work_per_cycle(1.0, 1.0, m); }, motion_);
      return of_curvature / (2 * part) * (tangential(mean + part) - tangential(mean - part));
    }
    static const std::vector<detail::Node> nodes = detail::gauss_nodes(96);
    // W is a linear functional of K_t at the nodes of the phase and at the smallest indentation.
    Eigen::VectorXd weights = detail::loss(
                                  motion_, nodes, [](std::size_t) { return 0.0; }, 1.0) *
                              tangential(mean - amplitude_);
    for (const detail::Node& node : nodes)
      weights += detail::loss(
                     motion_, {node}, [](std::size_t) { return 1.0; }, 0.0) *
                 tangential(mean + amplitude_ * std::cos(node.theta));
    return weights;
  }

  double modulus_ratio_;  // G*/E* on half-spaces, otherwise 1
  const Oscillation& motion_;
  const SurfaceDampingOptions& options_;
  const ForceSample sample_;
  const std::size_t index_;  // in the curve
  StiffnessRatio ratio_;
  const double spring_error_;
  const double amplitude_;
  const Hold hold_;
  const bool wide_;
  double half_ = 0;  // half the range of indentations of the contacts, m
  int intervals_ = 4;
  // Errors of the loss by the number of intervals, J.
  double interval_error_ = 0, interval_error_with_slip_ = 0;
  double possible_amplitude_ = Loss::unknown;
  std::optional<LossOfSpring> slip_ = {};
  std::vector<StiffnessRatio::Point> of_curve_ = {};
  // Lower end of each piece below the oscillation, as depth below the mean indentation.
  std::vector<double> pieces_ = {};
  // Springs slip so little below the oscillation that no piece is needed.
  bool shallow_ = false;
  // The first piece is kriged together with the range of the oscillation.
  bool joined_ = false;
  VarianceScales scales_;
  std::vector<GridValue> values_;
  std::optional<Solved> solved_ = {};
};

ErrorBudget budget_of(const KrigedWork& own, double by_intervals) {
  return {.noise = stated_deviations * own.deviation,
          .intervals = by_intervals,
          .stiffness_ratio = own.ratio_error,
          .solver = own.solver_error,
          .first_touch = own.first_touch_error};
}

/// The integral ½∮ s² dK_t is the loss of contact sets that grow as the bodies approach. Cells that
/// leave meanwhile change it by up to their share, which must stay below the error.
SurfaceDamping refused_unless_nested(SurfaceDamping result) {
  const double relative = result.error_without_slip.total() / result.work_per_cycle_without_slip;
  // Without a stated error, a fiftieth is allowed.
  if (!(result.leaving_share > (std::isfinite(relative) ? relative : 0.02))) return result;
  SurfaceDamping refused;
  refused.hold = result.hold;
  refused.direction = result.direction;
  refused.leaving_share = result.leaving_share;
  return refused;
}

/// edges: whether the surface has plateaus, beside whose edges the interpolation of the heights
/// between the cells decides.
SurfaceDamping result_of(const Load& load, const Oscillation& motion,
                         const SurfaceDampingOptions& options, bool edges) {
  SurfaceDamping result;
  result.hold = load.hold();
  result.direction = load.direction();
  result.possible_amplitude = load.possible_amplitude();
  const auto& values = load.values();
  if (values.empty() || !load.usable()) return result;
  // Index in `values` of the grid with the given cells.
  const std::size_t own = options.coarsen ? 1 : 0;
  const std::size_t at = options.keep_cells ? std::min(own, values.size() - 1) : values.size() - 1;
  const GridValue& value = values[at];
  // K_t grows with the indentation, so W cannot be negative; if it is, the contacts did not resolve
  // the cycle. (A loss with slip that was not requested is NaN and passes.)
  if (value.work < 0 || value.with_slip.work < 0) return result;
  result.converged = true;
  result.stiffness_ratio = load.stiffness_ratio();
  result.window = load.window();
  result.intervals = load.intervals();
  result.points = value.points;
  result.indentation = value.indentation;
  result.mean_force = value.mean_force;
  result.max_force = value.max_force;
  result.contact_time = value.contact_time;
  const bool no_slip = std::isnan(options.friction_coefficient);
  const KrigedWork& described = no_slip ? value : value.with_slip;
  result.work_per_cycle = described.work;
  result.work_per_cycle_without_slip = value.work;
  result.relaxation_work = value.relaxation_work;
  result.slip_work = value.with_slip.work - value.relaxation_work;
  result.set_damping_constants(motion);
  result.error_without_slip = budget_of(value, load.interval_error());
  if (no_slip)
    result.error = result.error_without_slip;
  else if (load.follows_slip())
    result.error = budget_of(described, load.interval_error_with_slip());
  if (!no_slip)
    result.error.stiffness_ratio =
        std::hypot(result.error.stiffness_ratio, load.spring_error() * described.work);
  result.leaving_share = value.leaving_share;
  if (values.size() < 2) return refused_unless_nested(result);
  const GridValue& other = values[at > 0 ? at - 1 : values.size() - 1];
  // The error by the cells is of second order: after halving the cells, a third of the change
  // remains on the finer grid and 4/3 on the coarser one. The loss of a wide oscillation changes so
  // little that the interpolation of the heights between the cells decides: all of the change. It does
  // so, and not regularly, beside the edges of plateaus, as on honed surfaces: a third more.
  const double part = value.points < other.points ? 4.0 / 3
                      : edges                     ? 4.0 / 3
                      : load.is_wide()            ? 1
                                                  : 1.0 / 3;
  result.error_without_slip.cells = part * std::abs(value.work - other.work);
  const KrigedWork& other_described = no_slip ? other : other.with_slip;
  result.error.cells = part * std::abs(described.work - other_described.work);
  return refused_unless_nested(result);
}

/// A surface of every second point in both directions. If a side has an odd number n of points, (n
/// + 1)/2 points share its length; the slopes are then wrong by 1/n, which counts as an error by
/// the cells.
Surface every_second(const Surface& surface) {
  Surface coarse{surface.grid, {}, surface.periodic, surface.origin, surface.communicator};
  coarse.grid.nx = (surface.grid.nx + 1) / 2;
  coarse.grid.ny = (surface.grid.ny + 1) / 2;
  // Each process takes every second of its own rows; then the rows move to the processes to which
  // the coarse grid assigns them.
  const RowPartition fine = surface.partition(), rows = coarse.partition();
  std::vector<Index> begins;
  for (int rank = 0; rank < surface.communicator.size(); ++rank)
    begins.push_back((fine.begin_of(rank) + 1) / 2);
  begins.push_back(coarse.grid.nx);
  const RowPartition found(surface.communicator, begins);
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

/// Window function along one side: 1 inside, falling to 0 over a sixteenth of the side at both
/// ends.
Eigen::ArrayXd taper(Index count) {
  const double width = static_cast<double>(count) / 16;
  return Eigen::ArrayXd::NullaryExpr(count, [&](Index k) {
    const double from_edge = std::min(static_cast<double>(k), static_cast<double>(count - 1 - k));
    return from_edge >= width ? 1.0 : 0.5 - 0.5 * std::cos(pi * from_edge / width);
  });
}

Surface windowed(Surface surface) {
  const double mean = height_statistics(surface).mean;
  const RowPartition rows = surface.partition();
  const Eigen::ArrayXd x = taper(surface.grid.nx).segment(rows.begin(), rows.count()),
                       y = taper(surface.grid.ny);
  surface.heights = mean + (surface.heights - mean) * (x.matrix() * y.matrix().transpose()).array();
  return surface;
}

void validate(const std::vector<ForceCurve>& curves, const SurfaceDampingOptions& options) {
  require_that(!curves.empty(), "curves", "not given; give at least one");
  const ForceCurve& curve = curves.front();
  require(!curve.samples.empty(), "curve", 0, "loads given; compute at least one");
  for (const ForceCurve& other : curves)
    require_that(
        curves.size() == 1 || std::ranges::equal(other.samples, curve.samples, {},
                                                 &ForceSample::pressure, &ForceSample::pressure),
        "curves", "have different loads; compute them together by sweep_directions()");
  for (const auto& [column, name] : {std::pair{&ForceSample::force, "force"},
                                     {&ForceSample::normal_stiffness, "normal_stiffness"}})
    require_that(std::ranges::any_of(
                     curve.samples, [&](double value) { return std::isfinite(value); }, column),
                 "curve",
                 std::string("has no ") + name +
                     ", from which the range of the oscillation follows; compute the curve with "
                     "`stiffness`");
  require(allowed_intervals(options.intervals), "intervals", options.intervals,
          "must be 4, 8, 16 or 32");
  require(options.refinements >= 0 && options.refinements <= 4, "refinements", options.refinements,
          "must lie in 0 … 4");
  for (const auto& [value, field] :
       {std::pair{options.friction_coefficient, "friction_coefficient"},
        {options.excursion, "excursion"}})
    if (!std::isnan(value)) require_positive(value, field);
  require(options.relative_error >= 0 && options.relative_error < 1, "relative_error",
          options.relative_error, "must lie between 0 and 1");
}

/// The wide oscillations of one direction, whose loads share their contacts.
struct WideLoads {
  std::vector<Load*> loads = {};
  std::optional<WideOscillation> oscillation = {};
};

/// Solves the contacts of several loads on one grid, in parallel if the surface is not spread over
/// processes. open: for each load, the loads of all directions, which share their contacts.
void solve_on(const Surface& fine, const Body& body, const std::vector<std::vector<Load*>>& all,
              std::vector<WideLoads>& wide, bool along_x_only, const SurfaceDampingOptions& options,
              const detail::KeptContacts& kept, double kept_tolerance) {
  const Communicator& communicator = fine.communicator;
  // The wide loads share their contacts and are one task, the last one.
  std::vector<std::vector<Load*>> open = all;
  std::erase_if(open, [](const std::vector<Load*>& one) { return one.front()->is_wide(); });
  const std::size_t narrow = open.size();
  if (narrow < all.size()) open.emplace_back();
  // On a surface spread over processes, the messages of two simultaneous loads would be confused.
  const int wanted =
      communicator.alone() ? std::min(static_cast<int>(open.size()), parallel::threads()) : 1;
  require_memory(fine.grid, wanted * detail::contact_memory(fine, {.boundary = options.boundary}),
                 wanted > 1 ? "contacts on all threads (fewer `threads` need less)" : "a contact",
                 communicator);
  std::atomic<double> residual = 0;  // residual of the contact that last reported its progress
  std::vector<std::optional<SurfaceContacts>> contacts(open.size());
  // First every load without slip, and then slip, which uses the contacts of all loads.
  const int all_tasks = static_cast<int>(open.size() + narrow);
  int begun = 0;
  const auto for_loads = [&](std::size_t count, const auto& task) {
    detail::TaskLoop loop({.at_once = wanted, .communicator = communicator, .talk = [&] {
                             const int done = begun + loop.finished();
                             return !options.on_progress ||
                                    options.on_progress(
                                        {"damping", double(done) / all_tasks, done, residual});
                           }});
    const Progress progress = [&](const ProgressReport& report) {
      residual = report.residual;
      return loop.going_on();
    };
    // The highest loads take longest, so they are solved first.
    loop.run(static_cast<Index>(count),
             [&](Index turn) { task(count - 1 - static_cast<std::size_t>(turn), progress); });
    if (!communicator.all_agree(!loop.stopped())) throw Interrupted("damping: interrupted");
    begun += static_cast<int>(count);
  };
  for_loads(open.size(), [&](std::size_t at, const Progress& progress) {
    const NormalContactOptions contact = at < narrow
                                             ? open[at].front()->contact_options(progress)
                                             : wide.front().oscillation->contact_options(progress);
    SurfaceContacts& contacts_at = contacts[at].emplace(fine, body, contact, along_x_only);
    if (at < narrow) {
      const Load& load = *open[at].front();
      if (load.index() < kept.size() && kept[load.index()] && kept_tolerance <= contact.tolerance)
        contacts_at.take(load.load().pressure, *kept[load.index()]);
      for (Load* load : open[at]) load->solve(contacts_at, fine.grid.nx);
    } else {
      for (WideLoads& one : wide) {
        const std::vector<WideLoss> losses = one.oscillation->on(contacts_at);
        for (std::size_t k = 0; k < one.loads.size(); ++k)
          one.loads[k]->take(losses[k], *one.oscillation, fine.grid.nx,
                             contacts_at.leaving_share());
      }
    }
    contacts_at.free_fields();
  });
  std::vector<StiffnessSample> samples;
  for (const auto& contacts_at : contacts)
    if (contacts_at->usable())
      std::ranges::copy(contacts_at->samples(), std::back_inserter(samples));
  for_loads(narrow, [&](std::size_t at, const Progress& progress) {
    SurfaceContacts& contacts_at = *contacts[at];
    contacts_at.add(samples);
    contacts_at.report_to(progress);
    for (Load* load : open[at]) load->add_slip(contacts_at);
    contacts_at.free_fields();
  });
}

/// ρ at the loads of a curve whose K_t comes from stick solves; empty for a curve with K_t =
/// (G*/E*)K.
detail::RatioOfLoads ratios_of(const ForceCurve& curve, double modulus_ratio) {
  std::vector<StiffnessRatio::Point> points;
  bool solved = false;
  for (const ForceSample& sample : curve.samples) {
    points.push_back(detail::point_of(sample, modulus_ratio));
    solved = solved || std::abs(points.back().ratio - 1) > 1e-9;
  }
  return solved ? detail::RatioOfLoads(points) : detail::RatioOfLoads();
}

/// Adds the error by the seam of a scan, from the loss `unseamed` without it. values: the losses on
/// all grids.
void add_seam(SurfaceDamping& result, const SurfaceDamping& unseamed,
              const std::vector<GridValue>& values, const SurfaceDampingOptions& options) {
  if (!result.converged || !unseamed.converged) return;
  const GridValue& own = values[std::min<std::size_t>(options.coarsen ? 1 : 0, values.size() - 1)];
  const auto seam = [&](double without_seam, const KrigedWork& with_seam) {
    return beyond_scatter(without_seam - with_seam.work, with_seam.deviation, with_seam.deviation);
  };
  result.error_without_slip.seam = seam(unseamed.work_per_cycle_without_slip, own);
  result.error.seam = std::isnan(options.friction_coefficient)
                          ? result.error_without_slip.seam
                          : seam(unseamed.work_per_cycle, own.with_slip);
}

}  // namespace

std::vector<SurfaceDamping> surface_damping(const Surface& surface, const Body& body,
                                            const Oscillation& motion, const ForceCurve& curve,
                                            const SurfaceDampingOptions& options) {
  return surface_damping(surface, body, motion, std::vector{curve}, options).front();
}

std::vector<std::vector<SurfaceDamping>> surface_damping(const Surface& surface, const Body& body,
                                                         const Oscillation& motion,
                                                         const std::vector<ForceCurve>& curves,
                                                         const SurfaceDampingOptions& options) {
  return detail::surface_damping(surface, body, motion, curves, options, {}, 0);
}

std::vector<std::vector<SurfaceDamping>> detail::surface_damping(
    const Surface& surface, const Body& body, const Oscillation& motion,
    const std::vector<ForceCurve>& curves, const SurfaceDampingOptions& options,
    const KeptContacts& contacts, double tolerance) {
  const detail::StageTime time(detail::Stage::oscillation);
  const Communicator& communicator = surface.communicator;
  collectively(communicator, [&] { surface.require_complete_rows("a contact calculation"); });
  validate(curves, options);
  require_positive(detail::normal_amplitude(motion), "normal_amplitude");
  const std::string fingerprint = body.fingerprint();
  for (const ForceCurve& curve : curves)
    require_that(curve.body == fingerprint, "curve",
                 "is that of another body, or of another datum; compute it with this one");
  const Hold hold = detail::hold_of(curves.front(), detail::normal_amplitude(motion), options.hold);
  // The loads of each curve.
  std::vector<std::vector<Load>> loads(curves.size());
  std::vector<WideLoads> wide(curves.size());
  bool along_x_only = true;
  for (std::size_t d = 0; d < curves.size(); ++d) {
    std::vector<WideOscillation::Load> wide_loads;
    loads[d].reserve(curves[d].samples.size());
    for (std::size_t k = 0; k < curves[d].samples.size(); ++k) {
      Load& load = loads[d].emplace_back(body, motion, options, hold, curves[d], k);
      along_x_only = along_x_only && load.direction() == 0;
      if (!load.is_wide() || !load.usable()) continue;
      wide[d].loads.push_back(&load);
      wide_loads.push_back(load.load());
    }
    if (!wide_loads.empty())
      wide[d].oscillation.emplace(body, motion, options, hold,
                                  detail::direction_of(curves[d].samples.front()), wide_loads,
                                  ratios_of(curves[d], modulus_ratio_of(body)));
  }

  constexpr double skew = 0.5;
  const bool edges = std::abs(height_statistics(surface).skewness) > skew;
  const int halvings = options.relative_error > 0 ? 30 : options.refinements;
  const auto is_open = [&](const Load& load, int halving) {
    const SurfaceDamping result = result_of(load, motion, options, edges);
    const bool known = !std::isnan(result.work_per_cycle);
    const double work = known ? result.work_per_cycle : result.work_per_cycle_without_slip;
    const ErrorBudget& error = known ? result.error : result.error_without_slip;
    return halving <= options.refinements || !(error.total() <= options.relative_error * work);
  };
  for (int halving = options.coarsen ? -1 : 0; halving <= halvings; ++halving) {
    std::vector<std::vector<Load*>> open;
    for (std::size_t k = 0; k < curves.front().samples.size(); ++k) {
      std::vector<Load*> same;
      bool any = false;
      for (std::vector<Load>& of_direction : loads)
        if (Load& load = of_direction[k]; load.usable()) {
          same.push_back(&load);
          any = any || is_open(load, halving);
        }
      if (any) open.push_back(std::move(same));
    }
    const Index factor = halving > 0 ? Index(1) << halving : 1;
    if (open.empty() || (halving > options.refinements && factor > options.max_refined)) break;
    const Surface fine = halving < 0 ? every_second(surface) : refined(surface, factor);
    solve_on(fine, body, open, wide, along_x_only, options,
             halving == 0 ? contacts : detail::KeptContacts(), tolerance);
  }
  std::vector<std::vector<SurfaceDamping>> results(curves.size());
  for (std::size_t d = 0; d < curves.size(); ++d)
    for (const Load& load : loads[d]) results[d].push_back(result_of(load, motion, options, edges));
  if (!options.seam) return results;
  SurfaceDampingOptions without = options;
  without.hold = hold;
  without.seam = {};
  without.refinements = 0;
  without.relative_error = 0;
  without.coarsen = false;
  const bool free = *options.seam == SeamCheck::free;
  if (free) without.boundary = Boundary::free;
  const auto unseamed =
      salebra::surface_damping(free ? surface : windowed(surface), body, motion, curves, without);
  for (std::size_t d = 0; d < curves.size(); ++d)
    for (std::size_t k = 0; k < results[d].size(); ++k)
      add_seam(results[d][k], unseamed[d][k], loads[d][k].values(), options);
  return results;
}

}  // namespace salebra
