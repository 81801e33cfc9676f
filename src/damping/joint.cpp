// SPDX-License-Identifier: GPL-3.0-or-later
// Loss and stiffness of a contact in partial slip under a tangential oscillation.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/numerics/quadrature.hpp"
#include "base/stop_check.hpp"
#include "joint_loop.hpp"
#include "max_motion.hpp"
#include "surface/refine.hpp"
#include "surface_contacts.hpp"
#include "sweep_breaks.hpp"
#include "table_error.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

void check(const TangentialOscillation& motion, double friction_coefficient) {
  require_positive(friction_coefficient, "friction_coefficient");
  if (const auto* force = std::get_if<TangentialForce>(&motion))
    require_positive(force->amplitude, "tangential_force");
  else
    require_positive(std::get<TangentialAmplitude>(motion).amplitude, "tangential_amplitude");
}

void check_below_sliding(double force, double limit, const char* where) {
  require(force < limit, "tangential_force", format_quantity(force, Dimension::force),
          "must be below " + format_quantity(limit, Dimension::force, 6) +
              ", at which the contact slides" + where + "; beyond it sliding is steady");
}

// Smallest K_t, as a fraction of that of the whole contact, for which springs are counted.
constexpr double negligible_part = 1e-17;
// A spring slips or sticks as far as its share of the normal force, or of the loss, matters: 5 %.
constexpr double share_that_matters = 0.05;

// sweep_breaks() between two depths, also if there are more of them than it returns at once.
constexpr std::size_t most_breaks = 400;

std::vector<double> breaks_between(const ContactLaw& law, double low, double high) {
  std::vector<double> ends{low}, breaks;
  std::size_t count = 0;
  for (const double point : law.break_points())
    if (point > low && point < high && ++count % most_breaks == 0) ends.push_back(point);
  ends.push_back(high);
  for (std::size_t i = 1; i < ends.size(); ++i)
    std::ranges::copy(detail::sweep_breaks(law, ends[i - 1], ends[i]), std::back_inserter(breaks));
  return breaks;
}

// All springs of a contact at one indentation, and the slope μ' of their friction limit.
struct WholeContact {
  WholeContact(const ContactLaw& law, double indentation, double friction_coefficient,
               double tolerance)
      : high(indentation) {
    const double stiffness = law.tangential_stiffness(high), force = law.force(high);
    require(stiffness > 0 && force > 0, "indentation", high, "m is an indentation without contact");
    low = law.first_touch();
    if (!std::isfinite(low))
      for (double depth = force / law.normal_stiffness(high);; depth *= 2)
        if (low = high - depth; !(law.tangential_stiffness(low) > negligible_part * stiffness))
          break;
    const std::vector<double> breaks = breaks_between(law, low, high);
    const auto moment = [&](auto&& weight) {
      const detail::Integral found = detail::integrate(
          [&](double at) { return law.tangential_stiffness(at) * weight(high - at); }, breaks,
          tolerance);
      converged = converged && found.converged;
      return found.value;
    };
    const double held = moment([](double) { return 1; });
    // A law with K_t = ρK has the exact ratio; the quadrature would only add its round-off.
    constexpr double same = 1e-6;
    ratio = law.stiffness_ratio(high);
    if (std::abs(held / (ratio * force) - 1) > same) ratio = held / force;
    limit = friction_coefficient / ratio;
    elastic_displacement = 2 * limit * moment([](double depth) { return depth; }) / held;
    if (std::isfinite(law.first_touch())) knee = limit * (high - low);
  }

  double low, high;  // depths of the lowest and the highest spring, m
  double ratio = 0, limit = 0;
  double elastic_displacement = 0, knee = std::numeric_limits<double>::infinity();
  bool converged = true;
};

// Quadratures over the springs that slip. Their depths reach from the indentation `high` down to
// high − depth, in the parametrisation high − depth · sin²(θ/2).
class SlippingSprings {
 public:
  SlippingSprings(const ContactLaw& law, double high, double depth, double tolerance)
      : law_(law), high_(high), depth_(depth), tolerance_(tolerance) {
    for (const double spring_depth : breaks_between(law, high - depth, high))
      breaks_.push_back(2 * std::atan2(std::sqrt(std::max(high - spring_depth, 0.0)),
                                       std::sqrt(std::max(spring_depth - (high - depth), 0.0))));
    std::ranges::sort(breaks_);
  }

  double stiffness_at(double theta) const {
    return law_.tangential_stiffness(high_ - depth_ * std::pow(std::sin(0.5 * theta), 2));
  }
  // ∫_0^π f(θ, K_t) dθ with K_t at the indentation high − depth · sin²(θ/2).
  double integral(const std::function<double(double, double)>& f) {
    const detail::Integral found =
        detail::integrate([&](double theta) { return f(theta, stiffness_at(theta)); }, breaks_,
                          tolerance_, absolute_);
    converged_ = converged_ && found.converged;
    return found.value;
  }
  // Allows an absolute error that is small against ∫K_t dθ, for integrands in which most of K_t
  // cancels.
  void allow_cancelling() { absolute_ = 1e-15 * pi * stiffness_at(0); }
  bool converged() const { return converged_; }

 private:
  const ContactLaw& law_;
  double high_, depth_, tolerance_, absolute_ = 0;
  std::vector<double> breaks_;
  bool converged_ = true;
};

// The depth of slip c at which the tangential force reaches T: μ' ∫_0^c K_t(δ − u) du = T.
double depth_of_slip(const ContactLaw& law, const WholeContact& whole, double force,
                     double friction_coefficient, double tolerance) {
  const double high = whole.high, target = whole.ratio * force / friction_coefficient;
  const double stiffness = law.tangential_stiffness(high);
  // The integral is a concave function of c. Newton's method from c = 0 therefore approaches the
  // solution from below and never passes it.
  double depth = 0, reached = 0, end = stiffness;
  for (int iteration = 0; iteration < 200 && end > 1e-14 * stiffness; ++iteration) {
    const double step = (target - reached) / end;
    if (!(step > 1e-15 * depth)) return depth;
    const double next = depth + step;
    if (!(high - next > law.first_touch())) break;
    const std::vector<double> breaks = breaks_between(law, high - next, high - depth);
    reached += detail::integrate(
                   [&](double spring_depth) { return law.tangential_stiffness(spring_depth); },
                   breaks, tolerance)
                   .value;
    depth = next;
    end = law.tangential_stiffness(high - depth);
  }
  throw InvalidInput("tangential_force",
                     format_quantity(force, Dimension::force) +
                         " leaves a part that sticks smaller than the rounding of the tangential "
                         "force; reduce the force, or give a displacement");
}

void set_ratios(JointLoss& loss) {
  const double x = loss.tangential_amplitude;
  loss.secant_stiffness = loss.tangential_force / x;
  loss.loss_factor = loss.work_per_cycle / (pi * loss.secant_stiffness * x * x);
  loss.loss_stiffness = loss.work_per_cycle / (pi * x * x);
}

// The loss at the indentation `high` under a constant normal force, for a law as it is.
JointLoss loss_of_springs(const ContactLaw& law, double high, const TangentialOscillation& motion,
                          double friction_coefficient, double tolerance) {
  const WholeContact whole(law, high, friction_coefficient, tolerance);
  const double sliding = friction_coefficient * law.force(high);
  double depth = 0;
  if (const auto* by_force = std::get_if<TangentialForce>(&motion)) {
    check_below_sliding(by_force->amplitude, sliding, "");
    depth = depth_of_slip(law, whole, by_force->amplitude, friction_coefficient, tolerance);
  } else {
    depth = std::get<TangentialAmplitude>(motion).amplitude / whole.limit;
  }
  // Where the motion reaches deeper than the lowest spring, all springs slip.
  const bool all_slip = depth >= high - whole.low;
  SlippingSprings springs(law, high, all_slip ? high - whole.low : depth, tolerance);

  JointLoss loss;
  loss.indentation = high;
  loss.elastic_displacement = whole.elastic_displacement;
  loss.knee = whole.knee;
  const double x = loss.tangential_amplitude = whole.limit * depth;
  // If all springs slip, θ is not the phase of the motion: a spring at the depth u begins to slip at
  // the phase whose squared half sine is u/depth.
  const double share = all_slip ? (high - whole.low) / depth : 1;
  loss.storage_stiffness = 2 / pi * springs.integral([&](double theta, double k) {
    if (!all_slip) return k * std::pow(std::sin(theta), 2);
    const double part = share * std::pow(std::sin(0.5 * theta), 2);
    return k * share * std::sin(theta) * 2 * std::sqrt(part * (1 - part));
  });
  // Subtracts K_t at the depth of slip from the integrand, because a constant K_t has no loss.
  const double deepest = springs.stiffness_at(pi);
  const auto beyond = [&] {
    return x / 2 * springs.integral([&](double theta, double k) {
      return (k - deepest) * std::sin(theta);
    });
  };
  if (all_slip) {
    loss.tangential_force = sliding;
    loss.work_per_cycle = 4 * sliding * (x - whole.elastic_displacement);
  } else {
    loss.tangential_force =
        x / 2 * springs.integral([](double theta, double k) { return k * std::sin(theta); });
    springs.allow_cancelling();
    loss.work_per_cycle = x * x * springs.integral([&](double theta, double k) {
      return (k - deepest) * std::sin(2 * theta);
    });
  }
  loss.slip_work = loss.work_per_cycle;
  loss.relaxation_work = 0;
  const bool slides = !(law.force(high - depth) >= share_that_matters * law.force(high));
  if (!slides) loss.exponent = loss.tangential_force / loss.work_per_cycle * 4 * beyond() / deepest;
  loss.regime = slides ? Regime::sliding
                : loss.work_per_cycle < share_that_matters * x * loss.tangential_force
                    ? Regime::no_slip
                    : Regime::partial_slip;
  loss.converged = springs.converged() && (whole.converged || !all_slip);
  set_ratios(loss);
  return loss;
}

// Steady state of a joint under an oscillating normal force.
struct Followed {
  // Half the range of the tangential force and of the displacement.
  double force = 0, displacement = 0;
  double work = 0, slip_work = 0, storage_stiffness = 0;
  double limit = 0;  // slope μ' of the friction limit
  detail::JointLoop loop = {};
};

// One period of the motion of a joint, from the smallest indentation on. The last sample repeats
// the first.
struct JointPath {
  double lowest = 0, highest = 0;  // smallest and largest indentation, m
  // The tangential force is given; false: the displacement.
  bool by_force = false;
  double amplitude = 0;  // of the given quantity
  // Indentation, and the given force or displacement.
  std::vector<double> spring_depth = {}, target = {};
};

JointPath path_of(double mean, const JointMotion& motion, int steps) {
  JointPath path{.lowest = mean - motion.normal_amplitude,
                 .highest = mean + motion.normal_amplitude};
  path.by_force = std::holds_alternative<TangentialForce>(motion.tangential);
  std::visit([&](const auto& one) { path.amplitude = one.amplitude; }, motion.tangential);
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi + 2 * pi * double(i % steps) / steps;
    path.spring_depth.push_back(mean + motion.normal_amplitude * std::cos(angle));
    path.target.push_back(path.amplitude * std::cos(angle + motion.phase));
  }
  return path;
}

double half_range_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return 0.5 * (high - low);
}

// Slope of the line of regression of the tangential force on the displacement x. The last sample of
// the period repeats the first and is left out.
double slope_of(const std::vector<double>& force, const std::vector<double>& x) {
  const std::size_t steps = x.size() - 1;
  double middle = 0;
  for (std::size_t i = 0; i < steps; ++i) middle += x[i] / double(steps);
  double product = 0, square = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double out = x[i] - middle;
    product += force[i] * out;
    square += out * out;
  }
  return product / square;
}

// Follows the motion until a period repeats. first: displacement at which all springs are free of
// stress at the start. Springs that never slip stay anchored there; this shifts the force, and does
// not change the loss.
Followed follow(const ContactLaw& law, const JointPath& path, double friction_coefficient,
                const Progress& on_progress, double first) {
  const auto& [lowest, highest, by_force, amplitude, spring_depth, target] = path;
  if (by_force)
    for (std::size_t i = 0; i < spring_depth.size(); ++i)
      check_below_sliding(std::abs(target[i]), friction_coefficient * law.force(spring_depth[i]),
                          " during the normal oscillation");
  // With a given force the range of the displacement is unknown, so all springs may reach their
  // stretch limit.
  const double range = by_force ? std::numeric_limits<double>::infinity() : 2 * amplitude;
  const double ratio = WholeContact(law, highest, friction_coefficient, 1e-9).ratio;
  TangentialContact contact(law, lowest, highest,
                            {.friction_coefficient = friction_coefficient,
                             .tangential_range = range,
                             .stiffness_ratio = ratio});
  contact.start(spring_depth[0], first);
  std::vector<double> x(spring_depth.size()), force(spring_depth.size());
  Followed result{.limit = friction_coefficient / ratio};
  constexpr int max_periods = 200;
  for (int period = 0; period < max_periods; ++period) {
    const double lost = contact.dissipated(), slipped = contact.dissipated_in_permanent_contact();
    for (std::size_t i = 0; i < spring_depth.size(); ++i) {
      detail::stop_if_asked();
      constexpr std::size_t interval = 1 << 8;
      if (i % interval == interval - 1 && on_progress &&
          !on_progress(
              {"joint",
               (period + static_cast<double>(i) / static_cast<double>(spring_depth.size())) /
                   max_periods,
               period, 0}))
        throw Interrupted("joint: interrupted");
      if (by_force)
        contact.move_to_force(spring_depth[i], target[i]);
      else
        contact.move_to(spring_depth[i], target[i]);
      x[i] = contact.displacement();
      force[i] = contact.tangential_force();
    }
    const double work = contact.dissipated() - lost;
    const bool steady = by_force ? std::abs(work - result.work) <= 1e-9 * work : period == 1;
    result.work = work;
    result.slip_work = contact.dissipated_in_permanent_contact() - slipped;
    if (steady && period > 0) {
      // The maximum of the given force or displacement may lie between two steps, so its amplitude
      // is returned.
      result.force = by_force ? amplitude : half_range_of(force);
      result.displacement = by_force ? half_range_of(x) : amplitude;
      result.storage_stiffness = slope_of(force, x);
      result.loop = {std::move(x), std::move(force)};
      return result;
    }
  }
  throw NotConverged(
      "joint: the losses of two periods still differ by more than 1e-9 after 200 periods of this "
      "tangential force; reduce it, or give a displacement");
}

// Regime under a normal oscillation. A spring slips in both halves of the cycle if the displacement
// exceeds its largest stretch limit, that at the largest indentation. limit: slope μ'.
Regime regime_of(const ContactLaw& law, const JointMotion& motion, const JointLoss& loss,
                 double limit) {
  const double amplitude = motion.normal_amplitude;
  const double stuck = loss.indentation + amplitude - loss.tangential_amplitude / limit;
  if (!(law.force(stuck) >= share_that_matters * loss.mean_force)) return Regime::sliding;
  if (loss.contact_time < 1) return Regime::lifts_off;
  const double without_slip =
      amplitude > 0 ? detail::damping_about(
                          law, loss.indentation,
                          EqualFrequency{amplitude, loss.tangential_amplitude, motion.phase}, 1e-6)
                          .work_per_cycle
                    : 0;
  const double matters = share_that_matters * loss.tangential_amplitude * loss.tangential_force;
  return std::abs(loss.work_per_cycle - without_slip) < matters ? Regime::no_slip
                                                                : Regime::partial_slip;
}

// Returns the state of a contact; throws if its solve was interrupted or did not converge.
NormalContactState solved(NormalContactState state) {
  if (state.termination == Termination::interrupted) throw Interrupted("joint: interrupted");
  if (!state.converged()) throw NotConverged("joint: a contact of the surface did not converge");
  return state;
}

// Force curve with one load, with its tangential stiffness in full stick.
ForceCurve stuck_at(double pressure, const Surface& surface, const Body& body, double direction,
                    const Progress& on_progress) {
  SweepOptions sweep;
  sweep.stick = true;
  sweep.direction = direction;
  sweep.contact.on_progress = on_progress;
  ForceCurve curve = sweep_pressures(surface, body, {pressure}, sweep);
  if (curve.samples.empty()) throw Interrupted("joint: interrupted");
  if (!curve.samples.front().converged)
    throw NotConverged("joint: a contact of the surface did not converge");
  return curve;
}

// Loss without slip under a normal oscillation about the indentation at a pressure.
SurfaceDamping damping_about(double pressure, const EqualFrequency& motion, const Surface& surface,
                             const Body& body, double direction, const Progress& on_progress) {
  const ForceCurve curve = stuck_at(pressure, surface, body, direction, on_progress);
  SurfaceDampingOptions options;
  options.hold = Hold::indentation;
  options.on_progress = on_progress;
  SurfaceDamping damping = surface_damping(surface, body, motion, curve, options).front();
  if (!damping.converged) throw NotConverged("joint: a contact of the surface did not converge");
  return damping;
}

// Values of one quantity at the steps of a simulated cycle, as deviations from their mean.
struct Swing {
  Swing(const CycleResult& cycle, double CycleSample::*quantity)
      : values(static_cast<Index>(cycle.samples.size()) - 1) {
    for (Index i = 0; i < values.size(); ++i)
      values[i] = cycle.samples[static_cast<std::size_t>(i) + 1].*quantity;
    out = values - values.mean();
    half_range = (values.maxCoeff() - values.minCoeff()) / 2;
  }
  Eigen::ArrayXd values, out;
  double half_range = 0;
};

}  // namespace

namespace {

// Sets the error of a loss that comes from a table, and removes a loss that is no larger. swing:
// range of depths in which the loss arises. lowest: lowest depth of the springs that slip.
void state_error(JointLoss& loss, const ContactLaw& law, std::pair<double, double> swing,
                 double lowest, const std::function<double(const ContactLaw&)>& work_of) {
  loss.work_error =
      detail::error_of_table(law, swing, lowest, loss.work_per_cycle, loss.work_per_cycle, work_of)
          .total();
  if (!(loss.work_error >= std::abs(loss.work_per_cycle))) return;
  loss.work_per_cycle = loss.relaxation_work = loss.slip_work = loss.work_error = loss.exponent =
      JointLoss::unknown;
  set_ratios(loss);
}

}  // namespace

JointLoss joint_loss(const ContactLaw& law, const OperatingPoint& point,
                     const TangentialOscillation& motion, double friction_coefficient,
                     const DampingOptions& options) {
  check(motion, friction_coefficient);
  const double high = indentation_of(law, point);
  detail::require_possible(law, high, 0, [&](double) { return high; });
  JointLoss loss = loss_of_springs(law, high, motion, friction_coefficient, options.tolerance);
  const double depth = (high - law.first_touch()) * (loss.tangential_amplitude / loss.knee);
  state_error(loss, law, {high - depth, high}, high - depth, [&](const ContactLaw& other) {
    // The load stays, and with it the friction force.
    const double there = point.load_given() ? other.indentation_of(law.force(high)) : high;
    return loss_of_springs(other, there, motion, friction_coefficient, options.tolerance)
        .work_per_cycle;
  });
  return loss;
}

std::vector<JointLoss> surface_joint_loss(const Surface& surface, const Body& body,
                                          const ContactLaw& law, const OperatingPoint& point,
                                          const std::vector<TangentialOscillation>& motions,
                                          double friction_coefficient, const Progress& on_progress,
                                          double direction) {
  std::vector<JointLoss> losses;
  for (const TangentialOscillation& motion : motions)
    losses.push_back(joint_loss(law, point, motion, friction_coefficient));
  if (losses.empty()) return losses;
  const Surface fine = refined(surface, 2);
  const double area = surface.grid.area();
  NormalContactOptions contact;
  contact.on_progress = on_progress;
  // The depth of slip is the difference of two indentations and may be a hundredth of them, so the
  // contacts need this tolerance.
  contact.tolerance = 1e-10;
  const auto under = [&](double force) {
    return solved(press(fine, body, at_pressure(force / area), contact));
  };
  const auto pressed_to = [&](double spring_depth) {
    return solved(press(fine, body, at_indentation(spring_depth), contact));
  };
  const double spring_depth = losses.front().indentation;
  const NormalContactState high = under(law.force(spring_depth));
  // Uses K_t/K of one solved contact for all motions: the ratio hardly changes over the depth of
  // slip. The law would only interpolate K and K_t between loads.
  const ForceSample stuck =
      stuck_at(high.force / area, surface, body, direction, on_progress).samples.front();
  const double limit = friction_coefficient * stuck.normal_stiffness / stuck.tangential_stiffness;
  const double spring_error =
      detail::spring_error(body, detail::stiffness_ratio_exponent(law, spring_depth));
  // The work of pressing the bodies together, ∫F dδ, is the elastic energy.
  const double elastic_displacement = 2 * limit * high.elastic_energy / high.force;
  contact.initial_pressure = &high.contact_pressure;
  for (std::size_t k = 0; k < losses.size(); ++k) {
    JointLoss& loss = losses[k];
    double depth = loss.tangential_amplitude / limit, change = 0;
    const double by_springs = std::exchange(loss.elastic_displacement, elastic_displacement);
    loss.knee = limit * high.indentation;
    if (loss.tangential_amplitude >= loss.knee) {
      const double elastic = 4 * friction_coefficient * high.force * elastic_displacement;
      loss.tangential_force = friction_coefficient * high.force;
      loss.work_per_cycle = loss.slip_work =
          4 * loss.tangential_force * loss.tangential_amplitude - elastic;
      // The springs of the law are those of contacts on the given cells.
      loss.work_error = elastic * std::hypot(by_springs / elastic_displacement - 1, spring_error);
      loss.exponent = JointLoss::unknown;
      loss.regime = Regime::sliding;
      set_ratios(loss);
      continue;
    }
    if (std::holds_alternative<TangentialForce>(motions[k])) {
      const double force = high.force - loss.tangential_force / friction_coefficient;
      check_below_sliding(loss.tangential_force, friction_coefficient * high.force, "");
      const double by_law = std::exchange(depth, high.indentation - under(force).indentation);
      change = (depth / by_law - 1) / 3;
      loss.tangential_amplitude = limit * depth;
    } else {
      loss.tangential_force =
          friction_coefficient * (high.force - pressed_to(high.indentation - depth).force);
    }
    const double pressure = pressed_to(high.indentation - depth / 2).force / area;
    const EqualFrequency as_normal{.normal_amplitude = depth / 2,
                                   .tangential_amplitude = loss.tangential_amplitude,
                                   .phase = pi / 2};
    const SurfaceDamping found =
        damping_about(pressure, as_normal, surface, body, direction, on_progress);
    loss.work_per_cycle = found.work_per_cycle / 2;
    loss.work_error =
        std::hypot(found.work_per_cycle_error() / 2, loss.exponent * loss.work_per_cycle * change,
                   spring_error * loss.work_per_cycle);
    if (!(loss.work_error < std::abs(loss.work_per_cycle)))
      loss.work_per_cycle = loss.work_error = JointLoss::unknown;
    loss.slip_work = loss.work_per_cycle;
    set_ratios(loss);
  }
  return losses;
}

JointLoss joint_loss(const ContactLaw& law, const OperatingPoint& point, const JointMotion& motion,
                     double friction_coefficient, int steps, const Progress& on_progress) {
  check(motion.tangential, friction_coefficient);
  require(std::isfinite(motion.normal_amplitude) && motion.normal_amplitude >= 0,
          "normal_amplitude", motion.normal_amplitude, "must be >= 0");
  require(std::isfinite(motion.phase), "phase", motion.phase, "must be finite");
  require(steps >= 16, "steps", steps, "must be >= 16");
  const double rest = indentation_of(law, point), amplitude = motion.normal_amplitude;
  const Hold hold = hold_of(law, point, amplitude, motion.hold);
  const double force = point.load_given() ? point.value : law.force(rest);
  const auto middle_of = [&](const ContactLaw& one, double normal_amplitude) {
    return hold == Hold::force ? indentation_at_mean_force(one, force, normal_amplitude) : rest;
  };
  detail::require_possible(
      law, rest, amplitude, [&](double one) { return middle_of(law, one); }, hold);
  const double mean = middle_of(law, amplitude);
  const double mean_force = hold == Hold::force ? force : mean_force_of_cycle(law, mean, amplitude);
  if (const auto* by_force = std::get_if<TangentialForce>(&motion.tangential))
    require(contact_time(law, mean, amplitude) == 1, "tangential_force", by_force->amplitude,
            "N cannot be kept while the normal oscillation lifts the bodies apart; give a "
            "displacement, or reduce the normal amplitude");
  const auto at = [&](const ContactLaw& one, double middle, double factor) {
    JointMotion scaled = motion;
    std::visit([&](auto& part) { part.amplitude *= factor; }, scaled.tangential);
    const JointPath path = path_of(middle, scaled, steps);
    return follow(one, path, friction_coefficient, on_progress,
                  path.by_force ? 0 : path.target.front());
  };
  const Followed one = at(law, mean, 1);
  JointLoss loss;
  loss.indentation = mean;
  loss.hold = hold;
  loss.tangential_force = one.force;
  loss.tangential_amplitude = one.displacement;
  loss.work_per_cycle = one.work;
  loss.slip_work = one.slip_work;
  loss.relaxation_work = one.work - one.slip_work;
  loss.storage_stiffness = one.storage_stiffness;
  loss.mean_force = mean_force;
  loss.max_force = law.force(mean + amplitude);
  loss.contact_time = contact_time(law, mean, amplitude);
  loss.regime = regime_of(law, motion, loss, one.limit);
  // A loss below this fraction of x T is round-off, as where nothing slips in phase.
  constexpr double no_loss = 1e-12;
  if (loss.regime != Regime::sliding && one.work > no_loss * one.displacement * one.force) {
    // The exponent of the loss follows from a second motion that is 1 % smaller. If the force
    // differs by less than 1e-6, the contact slides within the accuracy of the steps, and the
    // exponent is unknown.
    const Followed less = at(law, mean, 0.99);
    if (const double change = std::log(one.force / less.force); change > 1e-6)
      loss.exponent = std::log(one.work / less.work) / change;
  }
  const double deepest = mean - amplitude - loss.tangential_amplitude / one.limit;
  state_error(loss, law, {deepest, mean + amplitude}, deepest, [&](const ContactLaw& other) {
    return at(other, middle_of(other, amplitude), 1).work;
  });
  loss.converged = true;
  set_ratios(loss);
  return loss;
}

double detail::stiffness_ratio_of_whole(const ContactLaw& law, double indentation) {
  return WholeContact(law, indentation, 1, 1e-12).ratio;
}

detail::JointLoop detail::joint_loop(const ContactLaw& law, double indentation,
                                     const JointMotion& motion, double friction_coefficient,
                                     int steps, const Progress& on_progress) {
  return follow(law, path_of(indentation, motion, steps), friction_coefficient, on_progress, 0)
      .loop;
}

JointLoss simulated_joint_loss(const PressureFields& contact_sets, const Grid2D& grid,
                               const Body& body, double indentation, const JointMotion& motion,
                               const CycleOptions& options) {
  check(motion.tangential, options.friction_coefficient);
  require(std::isfinite(options.friction_coefficient), "friction_coefficient",
          options.friction_coefficient, "must be finite");
  const bool by_force = std::holds_alternative<TangentialForce>(motion.tangential);
  const double amplitude =
      std::visit([](const auto& one) { return one.amplitude; }, motion.tangential);
  // Without a normal oscillation the phase has no effect; it is set to 0, so that the turning
  // points of the tangential motion coincide with steps.
  Trajectory path = trajectory_of(EqualFrequency{motion.normal_amplitude, amplitude,
                                                 motion.normal_amplitude > 0 ? motion.phase : 0},
                                  indentation);
  if (by_force) std::swap(path.tangential, path.tangential_force);
  const CycleResult cycle = simulate_frictional_cycle(contact_sets, grid, body, path, options);

  JointLoss loss;
  loss.indentation = indentation;
  const Swing force(cycle, &CycleSample::tangential_force), x(cycle, &CycleSample::tangential);
  loss.tangential_force = by_force ? amplitude : force.half_range;
  loss.tangential_amplitude = by_force ? x.half_range : amplitude;
  loss.work_per_cycle = cycle.work_per_cycle;
  loss.slip_work = cycle.slip_work;
  loss.relaxation_work = cycle.relaxation_work;
  loss.storage_stiffness = (force.values * x.out).sum() / x.out.square().sum();
  loss.converged = cycle.converged() && cycle.steady;
  set_ratios(loss);
  return loss;
}

}  // namespace salebra
