// SPDX-License-Identifier: GPL-3.0-or-later
// Assumptions of a damping constant without slip, and the loss with slip, computed from the springs
// of a contact law.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <type_traits>

#include "base/special_values.hpp"
#include "continued_law.hpp"
#include "judge.hpp"
#include "max_motion.hpp"
#include "spring_loss.hpp"

namespace salebra {
namespace {

using detail::ContinuedLaw;
using detail::infinity;
using detail::judge;
using detail::unknown;
using std::numbers::pi;

// Losses below this fraction of K_t x² (x: tangential displacement) count as 0: the tabulated
// stiffness gives a loss of this size even to a contact that loses nothing.
constexpr double no_loss = 1e-7;
// Samples per period: the ratio of two losses on one path is then accurate to 1e-4.
constexpr int steps = 360;

// The contact law of only those springs of `law` that touch at an indentation above `bottom`, and
// so open in each cycle. Only F, K_t, K_t/K and the range of indentations of this law are used.
class OpeningLevels final : public ContactLaw {
 public:
  OpeningLevels(const ContactLaw& law, double bottom)
      : ContactLaw(law.modulus_ratio()),
        law_(law),
        bottom_(bottom),
        force_(law.force(bottom)),
        stiffness_(law.tangential_stiffness(bottom)) {}
  double force(double indentation) const override { return law_.force(indentation) - force_; }
  double normal_stiffness(double indentation) const override {
    return law_.normal_stiffness(indentation);
  }
  double force_curvature(double indentation) const override {
    return law_.force_curvature(indentation);
  }
  double tangential_stiffness(double indentation) const override {
    return law_.tangential_stiffness(indentation) - stiffness_;
  }
  double tangential_curvature(double indentation) const override {
    return law_.tangential_curvature(indentation);
  }
  double stiffness_ratio(double indentation) const override {
    return law_.stiffness_ratio(indentation);
  }
  double lowest_indentation() const override { return bottom_; }
  double highest_indentation() const override { return law_.highest_indentation(); }
  double indentation_of(double force) const override { return law_.indentation_of(force); }
  std::vector<double> break_points() const override { return law_.break_points(); }

 private:
  const ContactLaw& law_;
  double bottom_, force_, stiffness_;
};

// A motion with the numbers that the assumptions need.
struct JudgedMotion {
  double mean = 0, amplitude = 0;  // δ0 and u_z
  // Tangential displacement in the Mindlin number M: u_x, or v/ω for a drag.
  double displacement = 0;
  bool drag = false;
  double angular_frequency = 0;  // ω of the normal oscillation
  double fastest = 0;            // the higher of the normal and the tangential angular frequency
  std::optional<SampledMotion> path =
      {};  // one period that begins at the minimum of δ, for a tangential displacement of 1 m
  // Loss as a function of the normal amplitude, for a tangential displacement of 1 m; empty if the
  // motion has no small-amplitude formula.
  std::function<double(double)> loss = {};
};

// Loss of the same motion as a function of its normal amplitude. A motion with two frequencies and
// no common period has no loss per cycle; the function then returns the mean power.
template <class Motion>
std::function<double(double)> loss_at(const ContactLaw& law, double mean, Motion motion) {
  return [&law, mean, motion](double amplitude) mutable {
    motion.normal_amplitude = amplitude;
    const DampingResult result = detail::damping_about(law, mean, motion, 1e-7);
    return std::isnan(result.work_per_cycle) ? result.power : result.work_per_cycle;
  };
}

JudgedMotion case_of(const ContactLaw& law, double mean, EqualFrequency motion) {
  JudgedMotion one{.mean = mean,
                   .amplitude = motion.normal_amplitude,
                   .displacement = motion.tangential_amplitude,
                   .angular_frequency = motion.angular_frequency,
                   .fastest = motion.angular_frequency};
  motion.tangential_amplitude = 1;
  one.path = sample(motion, mean, steps);
  one.loss = loss_at(law, mean, motion);
  return one;
}

JudgedMotion case_of(const ContactLaw& law, double mean, Drag motion) {
  JudgedMotion one{.mean = mean,
                   .amplitude = motion.normal_amplitude,
                   .displacement = motion.drag_velocity / motion.angular_frequency,
                   .drag = true,
                   .angular_frequency = motion.angular_frequency,
                   .fastest = motion.angular_frequency};
  motion.drag_velocity = motion.angular_frequency;
  one.path = sample(motion, mean, steps);
  one.loss = loss_at(law, mean, motion);
  return one;
}

JudgedMotion case_of(const ContactLaw& law, double mean, const Oscillation& motion) {
  return std::visit([&](const auto& kind) { return case_of(law, mean, kind); }, motion);
}

JudgedMotion case_of(const ContactLaw& law, double mean, TwoFrequencies motion) {
  JudgedMotion one{
      .mean = mean,
      .amplitude = motion.normal_amplitude,
      .displacement = motion.tangential_amplitude,
      .angular_frequency = motion.normal_angular_frequency,
      .fastest = std::max(motion.normal_angular_frequency, motion.tangential_angular_frequency)};
  motion.tangential_amplitude = 1;
  if (common_period(motion).normal_cycles > 0) one.path = sample(motion, mean, steps);
  one.loss = loss_at(law, mean, motion);
  return one;
}

JudgedMotion case_of(const SampledMotion& path) {
  path.validate();
  const auto [low, high] = std::ranges::minmax(path.indentation);
  const auto [back, ahead] = std::ranges::minmax(path.displacement);
  const double drift = path.drift();
  JudgedMotion one{.mean = 0.5 * (low + high),
                   .amplitude = 0.5 * (high - low),
                   .displacement = 0.5 * (ahead - back),
                   .drag = std::abs(drift) > 1e-9 * (ahead - back),
                   .angular_frequency = 2 * pi / path.period()};
  if (one.drag) one.displacement = drift / (2 * pi);
  one.fastest = one.angular_frequency;
  const std::size_t count = path.time.size() - 1;
  const auto bottom = std::ranges::min_element(path.indentation) - path.indentation.begin();
  const std::size_t first = static_cast<std::size_t>(bottom) % count;
  const double unit = one.displacement != 0 ? std::abs(one.displacement) : 1;
  SampledMotion turned;
  for (std::size_t i = 0; i <= count; ++i) {
    const std::size_t at = (first + i) % count;
    const double laps = static_cast<double>((first + i) / count);
    turned.time.push_back(path.time[at] + laps * path.period());
    turned.indentation.push_back(path.indentation[at]);
    turned.displacement.push_back((path.displacement[at] + laps * drift) / unit);
  }
  one.path = std::move(turned);
  return one;
}

struct SpringLoss {
  double total = 0, permanent = 0;
};

// The springs of a contact law driven along a path. Lengths are in units of μ/g with g = K_t/K of
// the law: a spring of depth ζ touches at the indentation ζ and may be stretched by δ − ζ,
// displacements are in (μ/g) m and losses in (μ/g)² J.
class Springs {
 public:
  // closed_levels: whether to include the springs that never open. furthest: largest displacement
  // from the beginning of the path.
  Springs(const ContactLaw& law, SampledMotion path, bool closed_levels, double furthest)
      : path_(std::move(path)), closed_levels_(closed_levels) {
    const auto [low, high] = std::ranges::minmax(path_.indentation);
    const OpeningLevels opening(law, low);
    scale_ = law.tangential_stiffness(high);
    const double change = opening.tangential_stiffness(high);
    // With this coefficient of friction the stretch limit of a spring is its depth δ − ζ.
    const double friction = law.stiffness_ratio(0.5 * (low + high));
    if (closed_levels) {
      contact_.emplace(law, low, high,
                       TangentialContactOptions{.friction_coefficient = friction,
                                                .table_tolerance = tolerance,
                                                .tangential_range = furthest});
    } else if (change > no_loss * scale_) {
      contact_.emplace(opening, low, high,
                       TangentialContactOptions{.friction_coefficient = friction,
                                                .table_tolerance = above_noise(change),
                                                .tangential_range = furthest});
    }
    if (!(change > no_loss * scale_)) return;
    TangentialContact stuck(opening, low, high, {.table_tolerance = above_noise(change)});
    stick_ = follow(stuck, 1, 1, 0).total;
  }

  // Loss without slip for a tangential displacement of 1.
  double stick() const { return stick_ > no_loss * scale_ ? stick_ : 0; }
  // Loss per period of the steady state for a tangential displacement. ahead: tangential distance
  // by which the contact is dragged at the smallest indentation before the path begins.
  SpringLoss at(double displacement, double ahead = 0) {
    if (!contact_) return {};
    // Springs that open in each cycle forget the past, so one period is steady.
    const int periods = closed_levels_ && ahead == 0 ? 2 : 1;
    return follow(*contact_, displacement, periods, ahead);
  }
  // |W/W0 − 1| with the loss W at this displacement and the loss W0 without slip.
  double change(double displacement) {
    const double loss = at(displacement).total, without = stick() * displacement * displacement;
    if (without > 0) return std::abs(loss / without - 1);
    return loss > no_loss * scale_ * displacement * displacement ? infinity : 0;
  }

 private:
  static constexpr double tolerance = 1e-9;
  // Tolerance of the table for K_t of the springs that open. This K_t is the small difference of
  // two stiffnesses, so its relative round-off error is large, and a table cannot be more accurate.
  double above_noise(double change) const {
    return std::clamp(1e-13 * scale_ / change, tolerance, 1e-3);
  }
  SpringLoss follow(TangentialContact& contact, double displacement, int periods,
                    double ahead) const {
    // sample() begins at the smallest indentation.
    double x = displacement * path_.displacement.front();
    contact.start(path_.indentation.front(), x);
    const double before = x;
    if (ahead > 0) contact.move_to(path_.indentation.front(), x += ahead);
    const double offset = x - before;
    SpringLoss begun;
    for (int period = 0; period < periods; ++period) {
      begun = {contact.dissipated(), contact.dissipated_in_permanent_contact()};
      for (std::size_t i = 1; i < path_.time.size(); ++i)
        contact.move_to(path_.indentation[i], offset + displacement * path_.displacement[i]);
    }
    return {contact.dissipated() - begun.total,
            contact.dissipated_in_permanent_contact() - begun.permanent};
  }

  SampledMotion path_;
  bool closed_levels_;
  std::optional<TangentialContact> contact_;
  double stick_ = 0, scale_ = 0;
};

struct Limits {
  double five = unknown, twenty = unknown;
};

// Smallest arguments in [low, high] at which change() exceeds 5 % and 20 %. `low` must be so small
// that change(low) is far below 5 %.
Limits first_crossings(const std::function<double(double)>& change, double low, double high) {
  constexpr double step = 1.2;
  constexpr int halvings = 18, max_steps = 400;  // 400 steps cover 32 decades
  Limits limits;
  double below = low;
  int taken = 0;
  for (double* limit : {&limits.five, &limits.twenty}) {
    const double percent = limit == &limits.five ? 0.05 : 0.2;
    double above = below;
    while (change(above) <= percent) {
      below = above;
      // There is no crossing in the range, or none that floating-point numbers can resolve.
      if (!(above < high) || ++taken > max_steps) return limits;
      above = std::min(above * step, high);
    }
    for (int i = 0; i < halvings && above > below; ++i) {
      const double middle = std::sqrt(below * above);
      (change(middle) > percent ? above : below) = middle;
    }
    *limit = above;
  }
  return limits;
}

// Distance below the indentation `bottom` at which the force has fallen to the fraction `share` of
// the force at `bottom`; NaN if the contact is open at `bottom`.
double depth_of_share(const ContactLaw& law, double bottom, double share) {
  const double least = share * law.force(bottom);
  if (!(least > 0)) return unknown;
  double inside = 0, beyond = law.force(bottom) / law.normal_stiffness(bottom);
  while (law.force(bottom - beyond) > least) {
    if (!std::isfinite(beyond)) return unknown;
    inside = beyond, beyond *= 2;
  }
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (inside + beyond);
    (law.force(bottom - middle) > least ? inside : beyond) = middle;
  }
  return beyond;
}

// The springs that never open, under a slow drag forwards and backwards between turning points.
// Lengths are in units of μ/g. displacement: v/ω.
class ClosedLevels {
 public:
  ClosedLevels(const ContactLaw& law, double bottom, double amplitude, double displacement)
      : law_(law),
        bottom_(bottom),
        distance_per_cycle_(2 * pi * displacement),
        springs_(amplitude, displacement),
        // The small margin includes springs that all touch at the same indentation.
        depth_(1.001 * depth_of_share(law, bottom, 1e-9)) {}

  double distance_per_cycle() const { return distance_per_cycle_; }
  // Loss while the body moves by the distance `excursion` between two turning points: the sum over
  // the springs, each with the stretch limit δ_min − ζ at the smallest indentation.
  double loss(double excursion) const {
    constexpr int cells = 256;
    // Springs below depth_ carry no force and lose nothing. Without this bound a large distance
    // would make the cells wider than the depth of all springs.
    const double depth = std::fmin(springs_.deepest(excursion), depth_);
    double sum = 0, above = law_.tangential_stiffness(bottom_);
    for (int i = 0; i < cells; ++i) {
      const double end = depth * (i + 1) / cells;
      const double below = law_.tangential_stiffness(bottom_ - end);
      const double stretch = depth * (i + 0.5) / cells;
      sum += (above - below) * springs_.loss_over_distance(stretch, excursion);
      above = below;
    }
    return sum;
  }
  // Loss per normal cycle, averaged over the distance `excursion` between two turning points.
  double loss_per_cycle(double excursion) const {
    return loss(excursion) * distance_per_cycle_ / excursion;
  }

  // Fraction of the loss of the opening springs that remains, since springs that are closed at a
  // turning point lose less. cost: result of cost_of_turning(), which is two thirds of the mean of
  // θ/π over the springs that touch from the phase −θ to θ.
  double kept(double cost, double excursion) const {
    return std::max(0.0, 1 - 1.5 * cost * springs_.turning_share(excursion));
  }

  // Excursions at which the loss per normal cycle of the springs that never open is 5 % and 20 % of
  // the loss `relaxation` of those that open. An excursion shorter than the distance per cycle is
  // returned as 0.
  Limits limits(double relaxation, double longest) const {
    const double negligible = no_loss * law_.tangential_stiffness(bottom_);
    const auto change = [&](double excursion) {
      const double slip = loss_per_cycle(excursion);
      if (relaxation > 0) return slip / relaxation;
      return slip > negligible * excursion * excursion ? infinity : 0;
    };
    Limits found = first_crossings(change, distance_per_cycle_, longest + distance_per_cycle_);
    for (double* limit : {&found.five, &found.twenty})
      if (*limit <= distance_per_cycle_) *limit = 0;
    return found;
  }

 private:
  const ContactLaw& law_;
  double bottom_, distance_per_cycle_;
  detail::SlidingSprings springs_;
  double depth_;
};

// stick: loss without slip for a tangential displacement of 1. displacements: tangential
// displacements at which slip changes the loss by 5 % and 20 %. Lengths are in units of μ/g.
struct SlipLimits {
  double stick = 0;
  Limits displacements = {};
};

SlipLimits slip_limits(const ContactLaw& law, const JudgedMotion& motion, double length) {
  // If the contact loses nothing without slip, slip begins at a displacement of about F/K. If it
  // loses something, slip changes the loss by more than 20 % before the displacement is 10 u_z (M =
  // 0.1).
  const double longest = std::max(10 * motion.amplitude, 2 * (length + motion.amplitude));
  const auto [back, ahead] = std::ranges::minmax(motion.path->displacement);
  Springs springs(law, *motion.path, !motion.drag, 2 * longest * (ahead - back));
  double shortest = 1e-2 * motion.amplitude;
  while (springs.change(shortest) > 0.01 && shortest > 1e-9 * motion.amplitude) shortest /= 4;
  return {springs.stick(),
          first_crossings([&](double x) { return springs.change(x); }, shortest, longest)};
}

// In gross sliding, a contact as small as the region that still sticks may carry this fraction of
// the mean normal force.
constexpr double stuck_share = 0.05;

// Returns whether (almost) all springs slip. Lengths are in units of μ/g. displacement: u_x under
// oscillation at equal frequency, v/ω under a drag. excursion: distance between the turning points
// of the drag. stick: loss without slip for a tangential displacement of 1. stuck: force that springs
// which still stick may carry.
bool slides(const ContactLaw& law, const JudgedMotion& motion, double displacement,
            double excursion, double stick, double stuck) {
  const double bottom = motion.mean - motion.amplitude, top = motion.mean + motion.amplitude;
  const double least = law.force(bottom);
  // All springs open in each cycle. In an oscillation a spring of depth ζ slips in both halves of
  // the cycle if the displacement exceeds its largest stretch limit δ_max − ζ.
  if (!(least > 0))
    return motion.drag ? displacement >= detail::fastest_opening(law, motion.mean, motion.amplitude)
                       : law.force(top - displacement) <= stuck;
  double deepest = bottom - 0.5 * excursion;
  if (!motion.drag) {
    // A spring of depth ζ sticks if one anchor stays within the stretch limit δ − ζ of x at all
    // times: 2ζ < min(x + δ) − max(x − δ).
    double low = infinity, high = -infinity;
    for (std::size_t i = 0; i < motion.path->time.size(); ++i) {
      const double x = displacement * motion.path->displacement[i];
      low = std::min(low, x + motion.path->indentation[i]);
      high = std::max(high, x - motion.path->indentation[i]);
    }
    deepest = 0.5 * (low - high);
  }
  if (law.force(deepest) > stuck) return false;
  // A drag slower than v_c: the springs that open stick while they are closed, and their loss grows
  // with v. It is gross sliding only if the springs that never open lose more than these.
  return !motion.drag || displacement >= motion.amplitude ||
         ClosedLevels(law, bottom, motion.amplitude, displacement).loss_per_cycle(excursion) >=
             stick * displacement * displacement;
}

// Loss that one turning point at a random phase of a slow drag prevents, in units of the loss per
// normal cycle. A spring that touches from the phase −θ to θ separates with the stretch 2vθ/ω; if
// the drag turns at the phase τ in between, it separates with 2vτ/ω. θ² − τ² averages 2θ³/(3π) over
// τ in the whole cycle. Integration by parts turns the sums of θ³ and θ² over the springs into
// integrals of θ² and θ times K_t, which the loop computes.
double cost_of_turning(const ContactLaw& law, double mean, double amplitude) {
  constexpr int cells = 360;
  const double closed = law.tangential_stiffness(mean - amplitude);
  double squares = 0, distances = 0;
  for (int i = 0; i < cells; ++i) {
    const double angle = pi * (i + 0.5) / cells;
    const double opening = law.tangential_stiffness(mean + amplitude * std::cos(angle)) - closed;
    squares += angle * angle * opening;
    distances += angle * opening;
  }
  return distances > no_loss * cells * closed ? squares / (pi * distances) : 0;
}

Assumption slow_motion_of(const ContactLaw& law, const JudgedMotion& motion,
                          const ContactParameters& parameters) {
  Assumption assumption;
  if (!motion.drag) {
    assumption.verdict = Verdict::holds;
    return assumption;
  }
  const double cost = cost_of_turning(law, motion.mean, motion.amplitude);
  // The path must be longer than the distance per normal cycle, however short the contacts last.
  assumption.limit_5_percent = std::max(1.0, cost / 0.05);
  assumption.limit_20_percent = std::max(1.0, cost / 0.2);
  assumption.value = parameters.excursion / (2 * pi * std::abs(motion.displacement));
  if (std::isnan(motion.displacement))
    assumption.needs = "drag_velocity";
  else if (std::isnan(parameters.excursion))
    assumption.needs = "excursion";
  judge(assumption, true);
  return assumption;
}

void check(const NormalOscillation& normal, const std::vector<double>& velocities,
           const std::vector<double>& excursions, double friction_coefficient) {
  require_positive(friction_coefficient, "friction_coefficient");
  require_positive(normal.normal_amplitude, "normal_amplitude");
  require_positive(normal.angular_frequency, "angular_frequency");
  for (const double velocity : velocities) require_positive(velocity, "velocity");
  for (const double excursion : excursions) require_positive(excursion, "excursion");
}

void check(const ContactParameters& parameters) {
  for (const auto& [value, field] :
       {std::pair{parameters.friction_coefficient, "friction_coefficient"},
        {parameters.hardness, "hardness"},
        {parameters.density, "density"},
        {parameters.excursion, "excursion"},
        {parameters.contact_modulus, "contact_modulus"},
        {parameters.loaded_size, "loaded_size"},
        {parameters.first_load, "first_load"}})
    if (!std::isnan(value)) require_positive(value, field);
  if (parameters.nominal_pressure > parameters.hardness && std::isnan(parameters.first_load))
    require(false, "hardness", parameters.hardness,
            "Pa is below the mean pressure of the contact, so that all of it would yield; reduce "
            "the load or give the hardness in Pa");
}

// Poisson's ratio of one elastic body with this G*/E* = 2(1 − ν)/(2 − ν).
double poisson_of(double modulus_ratio) { return (2 - 2 * modulus_ratio) / (2 - modulus_ratio); }

void judge_flow(Assumption& assumption) {
  if (std::isnan(assumption.value)) return;
  assumption.verdict = assumption.value > 1                  ? Verdict::broken
                       : assumption.value > assumption.onset ? Verdict::doubtful
                                                             : Verdict::holds;
}

}  // namespace

// peak_force: normal force at the largest indentation of the motion.
Assumption detail::plasticity_of(const ContactParameters& parameters, double peak_force) {
  if (!std::isnan(parameters.first_load)) {
    // A first loading ends at the peak force of the oscillation. The law interpolates between loads
    // and gives this force with a relative accuracy of 0.02.
    constexpr double accuracy = 0.02;
    const double share = peak_force / parameters.first_load;
    Assumption assumption{.value = std::abs(share - 1) < accuracy ? 1 : share, .onset = 1};
    judge_flow(assumption);
    return assumption;
  }
  // The pressures are compared with the hardness H = 2.8 Y of a material with the yield stress Y. A
  // paraboloid begins to yield below its centre at a maximum pressure of 1.6 Y, about 0.6 H.
  Assumption assumption{.onset = 0.6};
  // Ratio of maximum to mean pressure under a paraboloid.
  constexpr double max_over_mean = 1.5;
  double stress = unknown;
  for (const double one :
       {parameters.max_pressure, max_over_mean * parameters.mean_contact_pressure,
        parameters.contact_modulus * parameters.rms_slope})
    stress = std::fmax(stress, one);
  assumption.value = stress / parameters.hardness;
  if (std::isnan(parameters.hardness))
    assumption.needs = "hardness";
  else if (std::isnan(stress))
    assumption.needs = "max_pressure";
  judge_flow(assumption);
  return assumption;
}

namespace {

// drag: true leaves the verdict unknown, because the effect of coupling on a slow drag was never
// computed; neither was that in a body that is not a half-space.
Assumption coupling_of(const ContactLaw& law, bool indenter, bool drag,
                       const ContactParameters& parameters) {
  Assumption assumption{.limit_5_percent = 0.05, .limit_20_percent = 0.2};
  if (drag || std::isnan(law.modulus_ratio())) return assumption;
  const double poisson = poisson_of(law.modulus_ratio());
  const double dundurs =
      std::isnan(parameters.dundurs) ? (1 - 2 * poisson) / (2 * (1 - poisson)) : parameters.dundurs;
  // Fits to the largest changes of the loss in direct simulations, with Dundurs' constant β. For β
  // = 0.286 (ν = 0.3) and β = 0.5 (ν = 0) they were 12 and 52 % for a paraboloid at a phase of 45°,
  // and 4 and 18 % for rough surfaces (docs/direct_simulation.md).
  assumption.value =
      indenter ? 3.2 * std::pow(std::abs(dundurs), 2.62) : 1.16 * std::pow(std::abs(dundurs), 2.69);
  judge(assumption);
  return assumption;
}

// stick: loss without slip for u_x = 1 m.
Assumption inertia_of(const ContactLaw& law, const JudgedMotion& motion, double stick,
                      const ContactParameters& parameters) {
  // Impedance of a stuck circle with radius a on a half-space with the shear wave speed c_s: K(1 +
  // 0.58i a0) for small a0 = ωa/c_s.
  constexpr double radiation = 0.58;
  const auto change_of_modulus = [](double change) {
    return std::sqrt((1 + change) * (1 + change) - 1) / radiation;
  };
  Assumption assumption{.limit_5_percent = change_of_modulus(0.05),
                        .limit_20_percent = change_of_modulus(0.2)};
  if (!(motion.fastest > 0)) {
    assumption.needs = "angular_frequency";
    return assumption;
  }
  // Layers and graded bodies have no one wave speed.
  if (std::isnan(law.modulus_ratio())) return assumption;
  for (const auto& [value, field] : {std::pair{parameters.density, "density"},
                                     {parameters.contact_modulus, "contact_modulus"},
                                     {parameters.loaded_size, "loaded_size"}})
    if (std::isnan(value) && assumption.needs.empty()) assumption.needs = field;
  if (!assumption.needs.empty()) return assumption;
  const double ratio = law.modulus_ratio(), poisson = poisson_of(ratio);
  const double shear = ratio * parameters.contact_modulus * (2 - poisson) / 4;
  assumption.value =
      motion.fastest * parameters.loaded_size / std::sqrt(shear / parameters.density);
  if (!motion.drag && stick > 0) {
    const double stiffness = law.tangential_stiffness(motion.mean + motion.amplitude);
    const double whole = 2 * ratio * parameters.contact_modulus * parameters.loaded_size;
    const double radiated = pi * radiation * stiffness * std::min(1.0, stiffness / whole);
    assumption.limit_5_percent = std::min(assumption.limit_5_percent, 0.05 * stick / radiated);
    assumption.limit_20_percent = std::min(assumption.limit_20_percent, 0.2 * stick / radiated);
  }
  judge(assumption);
  return assumption;
}

Assumption amplitude_of(const ContactLaw& law, const JudgedMotion& motion, double length,
                        double stick) {
  Assumption assumption{.value = motion.amplitude};
  // The loss is compared with a line in u_z. Its slope is W/u_z at a small u_z; the formula with
  // F'' would not do, since F'' of a table jumps at its samples.
  const double least = 1e-4 * length;
  const double range =
      std::min(motion.mean - law.lowest_indentation(), law.highest_indentation() - motion.mean);
  // At 30 times the length F/K every small-amplitude formula has failed for an exponential contact.
  const double most = std::min(30 * length, range);
  const double slope = motion.loss && stick > 0 && most > least ? motion.loss(least) / least : 0;
  if (slope > 0) {
    const Limits limits = first_crossings(
        [&](double amplitude) { return std::abs(slope * amplitude / motion.loss(amplitude) - 1); },
        least, most);
    assumption.limit_5_percent = limits.five;
    assumption.limit_20_percent = limits.twenty;
  }
  judge(assumption);
  // The loss reaches neither limit in the range of the law, but the motion leaves this range.
  if (slope > 0 && std::isnan(assumption.limit_5_percent) && motion.amplitude > 1.001 * most)
    assumption.verdict = Verdict::unknown;
  return assumption;
}

// Length over which the force changes at the mean indentation: F/K, or u_z if there is no contact.
double length_of(const ContactLaw& law, double mean, double amplitude) {
  const double force = law.force(mean), stiffness = law.normal_stiffness(mean);
  return force > 0 && stiffness > 0 ? force / stiffness : amplitude;
}

void set_limits(Assumption& assumption, const Limits& limits, double unit) {
  assumption.limit_5_percent = unit * limits.five;
  assumption.limit_20_percent = unit * limits.twenty;
}

// Largest motions without slip for the given μ or, if μ is unknown, for three values of μ.
// displacement: tangential displacement, in units of μ/g, at which slip changes the loss by 5 %.
// closed_limits: function that returns, for a given μ/g, the excursions at which the springs that
// never open lose 5 % and 20 % of the relaxation loss.
template <class ClosedLimits>
std::vector<MaxMotion> max_motions(const JudgedMotion& motion, const ContactParameters& parameters,
                                   double stiffness_ratio, double displacement,
                                   const ClosedLimits& closed_limits) {
  std::vector<double> coefficients{parameters.friction_coefficient};
  if (std::isnan(parameters.friction_coefficient)) coefficients = {0.1, 0.3, 1};
  std::vector<MaxMotion> motions;
  for (const double coefficient : coefficients) {
    const double limit = coefficient / stiffness_ratio;
    MaxMotion largest{.friction_coefficient = coefficient};
    if (motion.drag) {
      largest.drag_velocity = limit * displacement * motion.angular_frequency;
      if (!std::isnan(motion.displacement)) largest.excursion = limit * closed_limits(limit).five;
    } else {
      largest.tangential_amplitude = largest.excursion = limit * displacement;
    }
    motions.push_back(largest);
  }
  return motions;
}

// Decides between no slip, partial slip, lift-off and sliding: first by the verdicts on slip of the
// springs that open and of those that never open, then by slides(). stretch: μ/g. stick: loss
// without slip for a tangential displacement of 1.
Regime regime_of(const ContactLaw& law, const JudgedMotion& motion, const Assumptions& assumptions,
                 double stretch, double stick) {
  const Assumption& opening = assumptions.slip_of_opening_springs;
  const Assumption& closed = assumptions.slip_of_closed_springs;
  if (opening.verdict == Verdict::unknown || closed.verdict == Verdict::unknown)
    return assumptions.regime;
  const bool sticks = opening.verdict == Verdict::holds && closed.verdict == Verdict::holds;
  if (!sticks) {
    const double stuck = stuck_share * mean_force_of_cycle(law, motion.mean, motion.amplitude);
    if (slides(law, motion, std::abs(motion.displacement) / stretch, closed.value / stretch, stick,
               stuck))
      return Regime::sliding;
  }
  if (motion.mean - motion.amplitude < law.first_touch()) return Regime::lifts_off;
  return sticks ? Regime::no_slip : Regime::partial_slip;
}

Assumptions all_assumptions(const ContactLaw& given, const JudgedMotion& motion,
                            const ContactParameters& parameters) {
  check(parameters);
  const ContinuedLaw law(given);
  const double amplitude = motion.amplitude;
  require_positive(amplitude, "normal_amplitude");
  detail::require_possible(given, motion.mean, amplitude);
  const double length = length_of(law, motion.mean, amplitude);
  Assumptions assumptions;
  assumptions.plasticity = detail::plasticity_of(
      parameters, law.force(std::min(motion.mean + amplitude, given.highest_indentation())));
  assumptions.coupling = coupling_of(law, dynamic_cast<const IndenterLaw*>(&given) != nullptr,
                                     motion.drag, parameters);
  assumptions.slow_motion = slow_motion_of(law, motion, parameters);
  Assumption& opening = assumptions.slip_of_opening_springs;
  Assumption& closed = assumptions.slip_of_closed_springs;
  const double ratio = law.stiffness_ratio(motion.mean);
  const double stretch = parameters.friction_coefficient / ratio;
  const double displacement = std::abs(motion.displacement);
  opening.value = stretch * amplitude / displacement;
  closed.value =
      std::isnan(parameters.excursion) && !motion.drag ? displacement : parameters.excursion;
  if (std::isnan(displacement)) opening.needs = "drag_velocity";
  if (std::isnan(parameters.friction_coefficient)) opening.needs = "friction_coefficient";
  closed.needs = opening.needs;

  double stick = 0;
  Limits displacements;  // tangential displacements in units of μ/g
  if (motion.path) {
    const SlipLimits slip = slip_limits(law, motion, length);
    stick = slip.stick;
    displacements = slip.displacements;
    opening.limit_5_percent = amplitude / displacements.five;
    opening.limit_20_percent = amplitude / displacements.twenty;
  } else {
    // A motion with two frequencies and no common period has no path, so its slip is unknown.
    opening.value = closed.value = unknown;
  }
  if (opening.needs.empty()) judge(opening, true);
  // Without a path the loss without slip is unknown, but it is not 0; any positive number will do.
  assumptions.amplitude = amplitude_of(given, motion, length, motion.path ? stick : 1);
  assumptions.inertia = inertia_of(law, motion, stick, parameters);

  const auto closed_limits = [&](double limit) {
    const double moved = displacement / limit;
    return ClosedLevels(law, motion.mean - amplitude, amplitude, moved)
        .limits(stick * moved * moved, 100 * length);
  };
  assumptions.largest = max_motions(motion, parameters, ratio, displacements.five, closed_limits);
  if (!motion.drag) {
    set_limits(closed, displacements, stretch);
  } else if (closed.needs.empty()) {
    const Limits limits = closed_limits(stretch);
    set_limits(closed, limits, stretch);
    if (std::isnan(closed.value)) closed.needs = "excursion";
    // Even an excursion of one distance per normal cycle gives too much slip of closed springs.
    if (limits.twenty == 0) closed.verdict = Verdict::broken, closed.needs.clear();
  }
  if (closed.needs.empty()) judge(closed);
  if (!motion.drag || closed.value >= 2 * pi * displacement)
    assumptions.regime = regime_of(law, motion, assumptions, stretch, stick);
  return assumptions;
}

const ForceSample& nearest_load(const ForceCurve& curve, double force) {
  return *std::ranges::min_element(curve.samples, {}, [&](const ForceSample& sample) {
    return std::abs(std::log(sample.force / force));
  });
}

}  // namespace

ContactParameters at_state(ContactParameters parameters, const ContactLaw& law,
                           const ForceCurve* curve, double indentation, double deepest) {
  check(parameters);
  // The motion may exceed the highest indentation of a table; nothing is known there.
  deepest = std::min(deepest, law.highest_indentation());
  const double force = law.force(indentation), peak = law.force(deepest);
  if (const auto* indenter = dynamic_cast<const IndenterLaw*>(&law); indenter && peak > 0) {
    const auto pressure = [](double load, double radius) { return load / (pi * radius * radius); };
    const double radius = indenter->contact_radius(deepest);
    parameters.contact_modulus = indenter->contact_modulus();
    parameters.loaded_size = radius;
    parameters.mean_contact_pressure = pressure(peak, radius);
    if (force > 0)
      parameters.nominal_pressure = pressure(force, indenter->contact_radius(indentation));
  }
  if (curve == nullptr || !(curve->nominal_area > 0)) return parameters;
  parameters.loaded_size = std::sqrt(curve->nominal_area);
  parameters.nominal_pressure = force / curve->nominal_area;
  // Contact area and force are almost proportional, so the mean pressure at the nearest load of the
  // curve is that at the peak force.
  const ForceSample& nearest = nearest_load(*curve, peak);
  parameters.mean_contact_pressure =
      nearest.force / (nearest.contact_area_fraction * curve->nominal_area);
  return parameters;
}

double spot_radius(const ContactParameters& parameters, const ContactLaw& law,
                   const ForceCurve* curve, double indentation) {
  if (const auto* indenter = dynamic_cast<const IndenterLaw*>(&law))
    return indenter->contact_radius(indentation);
  if (curve == nullptr) return ContactParameters::unknown;
  const ForceSample& nearest = nearest_load(*curve, law.force(indentation));
  return 2 * parameters.contact_modulus * nearest.contact_area_fraction * curve->nominal_area /
         (std::numbers::pi * nearest.normal_stiffness);
}

Assumptions assumptions_of(const ContactLaw& law, double mean_indentation,
                           const Oscillation& motion, const ContactParameters& parameters) {
  return all_assumptions(law, case_of(law, mean_indentation, motion), parameters);
}

Assumptions assumptions_of(const ContactLaw& law, double mean_indentation,
                           const TwoFrequencies& motion, const ContactParameters& parameters) {
  return all_assumptions(law, case_of(law, mean_indentation, motion), parameters);
}

Assumptions assumptions_of(const ContactLaw& law, const SampledMotion& path,
                           const ContactParameters& parameters) {
  return all_assumptions(law, case_of(path), parameters);
}

Loss loss_with_slip(const ContactLaw& given, double mean_indentation, const Oscillation& motion,
                    double friction_coefficient, double excursion) {
  require_positive(friction_coefficient, "friction_coefficient");
  if (!std::isnan(excursion)) require_positive(excursion, "excursion");
  const ContinuedLaw law(given);
  const JudgedMotion one = case_of(law, mean_indentation, motion);
  require_positive(one.amplitude, "normal_amplitude");
  detail::require_possible(given, one.mean, one.amplitude);
  const double full_stick = one.loss(one.amplitude) * one.displacement * one.displacement;
  const double limit = friction_coefficient / law.stiffness_ratio(one.mean), unit = limit * limit;
  const double displacement = std::abs(one.displacement) / limit;
  const auto loss_of = [&](double relaxation, double slip) {
    Loss loss;
    loss.relaxation_work = unit * relaxation;
    loss.slip_work = unit * slip;
    loss.work_per_cycle = unit * (relaxation + slip);
    loss.work_per_cycle_without_slip = full_stick;
    loss.set_damping_constants(motion);
    return loss;
  };
  if (!one.drag) {
    const SpringLoss loss = Springs(law, *one.path, true, 2 * displacement).at(displacement);
    return loss_of(loss.total - loss.permanent, loss.permanent);
  }
  const double bottom = mean_indentation - one.amplitude, distance = 2 * pi * displacement;
  double relaxation = Springs(law, *one.path, false, distance).at(displacement).total, slip = 0;
  if (!std::isnan(excursion)) {
    const ClosedLevels closed(law, bottom, one.amplitude, displacement);
    relaxation *= closed.kept(cost_of_turning(law, one.mean, one.amplitude), excursion / limit);
    slip = closed.loss_per_cycle(excursion / limit);
  } else if (law.tangential_stiffness(bottom) > 0) {
    // The springs that never open first slide at the smallest indentation. An exponential contact
    // carries nothing at 40 F/K below the smallest indentation, so all springs slide after this
    // distance.
    const double ahead = 40 * law.force(bottom) / law.normal_stiffness(bottom) + distance;
    slip = Springs(law, *one.path, true, ahead + distance).at(displacement, ahead).permanent;
  }
  return loss_of(relaxation, slip);
}

RegimeMap regime_map(const ContactLaw& given, double mean_indentation,
                     const NormalOscillation& normal, const std::vector<double>& velocities,
                     const std::vector<double>& excursions, double friction_coefficient) {
  check(normal, velocities, excursions, friction_coefficient);
  const double amplitude = normal.normal_amplitude, omega = normal.angular_frequency;
  detail::require_possible(given, mean_indentation, amplitude);
  const ContinuedLaw law(given);
  // `velocities` sets the velocity of each case. Here the drag velocity is only a unit.
  const Drag drag{amplitude, amplitude * omega, omega};
  const JudgedMotion motion = case_of(law, mean_indentation, drag);
  const double limit = friction_coefficient / law.stiffness_ratio(mean_indentation);
  const double bottom = mean_indentation - amplitude;
  const double stuck = stuck_share * mean_force_of_cycle(law, mean_indentation, amplitude);
  const double length = length_of(law, mean_indentation, amplitude);
  const DampingResult without = detail::damping_about(given, mean_indentation, drag, 1e-10);
  const SlipLimits slip = slip_limits(law, motion, length);
  const double cost = cost_of_turning(law, mean_indentation, amplitude);
  const bool lifts_off = bottom < law.first_touch();

  const auto rows = static_cast<Index>(velocities.size());
  const auto columns = static_cast<Index>(excursions.size());
  RegimeMap map{
      .velocity = velocities,
      .excursion = excursions,
      .regime = {},
      .loss_ratio = Field::Constant(rows, columns, unknown),
      .slip_ratio = Field::Constant(rows, columns, unknown),
      .no_slip_excursion = {},
      .no_slip_velocity = limit * slip.displacements.five * omega,
      .sliding_excursion = 2 * limit * depth_of_share(law, bottom, stuck / law.force(bottom)),
      .critical_velocity =
          limit * detail::fastest_opening(law, mean_indentation, amplitude) * omega,
      .full_stick_ratio = without.work_per_cycle / without.small_amplitude_work};
  if (velocities.empty()) return map;
  Springs springs(law, *motion.path, false,
                  2 * pi * std::ranges::max(velocities) / (limit * omega));
  for (Index i = 0; i < rows; ++i) {
    const double displacement = velocities[static_cast<std::size_t>(i)] / (limit * omega);
    const ClosedLevels closed(law, bottom, amplitude, displacement);
    const double stick = slip.stick * displacement * displacement;
    const double relaxation = springs.at(displacement).total;
    const Limits limits = closed.limits(stick, 100 * length);
    const bool may_stick = !(displacement > slip.displacements.five);
    map.no_slip_excursion.push_back(may_stick ? limit * limits.five : 0);
    std::vector<Regime>& regimes = map.regime.emplace_back();
    for (Index j = 0; j < columns; ++j) {
      const double excursion = excursions[static_cast<std::size_t>(j)] / limit;
      if (excursion < closed.distance_per_cycle()) {
        regimes.push_back(Regime::unknown);
        continue;
      }
      regimes.push_back(may_stick && !(excursion > limits.five)
                            ? (lifts_off ? Regime::lifts_off : Regime::no_slip)
                        : slides(law, motion, displacement, excursion, slip.stick, stuck)
                            ? Regime::sliding
                        : lifts_off ? Regime::lifts_off
                                    : Regime::partial_slip);
      if (!(stick > 0)) continue;
      map.slip_ratio(i, j) = closed.loss_per_cycle(excursion) / stick;
      map.loss_ratio(i, j) =
          closed.kept(cost, excursion) * relaxation / stick + map.slip_ratio(i, j);
    }
  }
  return map;
}

}  // namespace salebra
