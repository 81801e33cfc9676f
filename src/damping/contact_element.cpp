// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law as a stack of springs with friction (LawSprings), and the steps of a contact
// element made of these springs, each computed from the state before the step and the position
// after it.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/damping/contact_element.hpp>
#include <utility>

#include "base/numerics/quadrature.hpp"
#include "max_motion.hpp"
#include "sweep_breaks.hpp"

namespace salebra {
namespace {

// Fraction of the highest force. All indentations with a smaller force belong to the lowest spring.
constexpr double negligible_force = 1e-6;
// Distance of the first two nodes below the range of the motion is at least this fraction of F/K at
// the highest indentation.
constexpr double shortest_level = 1e-3;

// The indentation of the lowest node: first touch, or for a law that never opens one at which F is
// at most `least`.
double deepest(const ContactLaw& law, double lowest, double highest, double least) {
  if (const double touch = law.first_touch(); std::isfinite(touch)) return touch;
  double depth = highest - lowest + law.force(highest) / law.normal_stiffness(highest);
  double low = lowest;
  for (; law.force(low) > least; depth *= 1.5) low = lowest - depth;
  return low;
}

// Depths of `count` nodes below the range of the motion, up to `last`. The distances between them
// grow in equal ratios, beginning with `first`.
std::vector<double> depths(double first, double last, int count) {
  std::vector<double> result;
  if (!(last > 0)) return result;
  const auto sum = [&](double ratio) { return first * (std::pow(ratio, count) - 1) / (ratio - 1); };
  constexpr double even = 1 + 1e-9;
  if (sum(even) >= last) {
    for (int i = 1; i <= count; ++i) result.push_back(last * i / count);
    return result;
  }
  double largest = 2;
  while (sum(largest) < last) largest *= 2;
  const double ratio = detail::find_root([&](double r) { return sum(r) - last; }, even, largest);
  double depth = 0, step = first;
  for (int i = 1; i < count; ++i, step *= ratio) result.push_back(depth += step);
  result.push_back(last);
  return result;
}

// Where the mean K_t of an interval falls from one interval to the next, these share the mean of
// their K_t. This may change G = ∫K_t dζ by at most max_change of it, the noise of a good
// measurement. Where G is smaller than `small` times that at the highest indentation, it may change
// by as much as there: the noise of the lowest load of a curve is also that of its first touch.
constexpr double max_change = 0.03, small = 0.01;

// Values (low, high) and slopes of an increasing function at the two ends of an interval.
struct Ends {
  double low, high, low_slope, high_slope;
};

// Interpolates an increasing, convex function at the fraction t of an interval from its values and
// slopes at the two ends. The cubic with these values and slopes is convex if the mean slope lies
// in the middle third between the slopes at the ends. Otherwise, as in wide intervals and at first
// touch, a power of the distance from one end is used, which is convex and joins the cubics
// smoothly.
LawSprings::Normal between(const Ends& ends, double width, double t) {
  const double mean = (ends.high - ends.low) / width - ends.low_slope;
  const double rise = ends.high_slope - ends.low_slope;
  if (3 * mean < rise && mean > 0) {
    const double power = rise / mean - 1, part = std::pow(t, power);
    return {ends.low + width * t * (ends.low_slope + mean * part), ends.low_slope + rise * part,
            rise * power * std::pow(t, power - 1) / width};
  }
  if (3 * mean > 2 * rise && mean < rise) {
    const double power = rise / (rise - mean) - 1, part = std::pow(1 - t, power);
    return {ends.high - width * (1 - t) * (ends.high_slope - (rise - mean) * part),
            ends.high_slope - rise * part, rise * power * std::pow(1 - t, power - 1) / width};
  }
  const double b = 3 * mean - rise, c = rise - 2 * mean;
  return {ends.low + width * t * (ends.low_slope + t * (b + c * t)),
          ends.low_slope + t * (2 * b + 3 * c * t), (2 * b + 6 * c * t) / width};
}

LawSprings::Normal tangent(double force, double slope, double distance) {
  const double there = force + slope * distance;
  return there > 0 ? LawSprings::Normal{there, slope, 0} : LawSprings::Normal{};
}

// Interpolates a function between nodes from its values and slopes there. Below the first and above
// the last node it follows the tangent.
LawSprings::Normal through(const std::vector<double>& node, const std::vector<double>& value,
                           const std::vector<double>& slope, double at) {
  if (at <= node.front()) return tangent(value.front(), slope.front(), at - node.front());
  if (at >= node.back()) return tangent(value.back(), slope.back(), at - node.back());
  const std::size_t above =
      static_cast<std::size_t>(std::ranges::upper_bound(node, at) - node.begin());
  const std::size_t i = above - 1;
  const double width = node[above] - node[i];
  return between({value[i], value[above], slope[i], slope[above]}, width, (at - node[i]) / width);
}

// The increasing sequence closest to `values` (least squares with weights): neighbouring values
// that fall are replaced by their mean.
std::vector<double> rising(const std::vector<double>& values, const std::vector<double>& weights) {
  struct Block {
    double mean, weight;
    std::size_t count;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Block last{values[i], weights[i], 1};
    for (; !blocks.empty() && blocks.back().mean > last.mean; blocks.pop_back()) {
      const Block& below = blocks.back();
      const double weight = below.weight + last.weight;
      last = {below.mean + last.weight / weight * (last.mean - below.mean), weight,
              last.count + below.count};
    }
    blocks.push_back(last);
  }
  std::vector<double> result;
  for (const Block& block : blocks) result.insert(result.end(), block.count, block.mean);
  return result;
}

}  // namespace

LawSprings::LawSprings(const ContactLaw& law, double lowest, double highest,
                       const LawSpringsOptions& options)
    : friction_coefficient_(options.friction_coefficient) {
  require(options.friction_coefficient >= 0, "friction_coefficient", options.friction_coefficient,
          "must be >= 0 (infinity: full stick)");
  require(options.springs >= 8 && options.springs <= 4096, "springs", options.springs,
          "must lie between 8 and 4096");
  require(std::isfinite(lowest) && std::isfinite(highest) && lowest <= highest, "lowest", lowest,
          "and highest must be finite and in this order");
  require(law.force(highest) > 0, "highest", highest, "m is an indentation without contact");
  detail::require_possible(law, 0.5 * (lowest + highest), 0.5 * (highest - lowest));
  // At smaller forces, springs need not be fine.
  const double least = negligible_force * law.force(highest);
  lowest = std::max(lowest, std::min(law.indentation_of(least), highest));
  const double bottom = deepest(law, lowest, highest, least);
  int fine = options.springs / 2;
  // Where nodes at equal distances reach down to the bottom, none are coarser.
  if (lowest - bottom <= (highest - lowest) / fine * (options.springs - fine))
    lowest = bottom, fine = options.springs;
  std::vector<double> nodes;
  for (int i = 0; i <= fine; ++i) nodes.push_back(lowest + (highest - lowest) * i / fine);
  const double first = std::max((highest - lowest) / fine, shortest_level * law.force(highest) /
                                                               law.normal_stiffness(highest));
  for (const double depth : depths(first, lowest - bottom, options.springs - fine))
    nodes.push_back(std::max(bottom, lowest - depth));
  std::ranges::sort(nodes);
  // Nodes closer to each other than this are merged.
  const double apart = 1e-9 * (highest - bottom) + 1e-15 * std::abs(highest);
  for (const double node : nodes)
    if (node_.empty() || node > node_.back() + apart) node_.push_back(node);
  set_normal(law);
  set_tangential(law);
}

// The indentation whose K and K_t a node takes. At first touch these may jump, as under a flat
// punch, whose springs touch and separate as one; the node takes them from above the jump.
double LawSprings::above_jump(std::size_t node) const {
  const bool touches = node == 0 && !(force_.front() > 0);
  return touches ? node_[0] + 1e-12 * (node_.back() - node_[0]) : node_[node];
}

// Sets F and K at the nodes. Lowers K where the data scatter so much that F, interpolated between
// two nodes, would not increase.
void LawSprings::set_normal(const ContactLaw& law) {
  for (std::size_t i = 0; i < node_.size(); ++i) {
    // A statistical law may have a force of round-off at first touch.
    force_.push_back(node_[i] > law.first_touch() ? law.force(node_[i]) : 0);
    slope_.push_back(law.normal_stiffness(above_jump(i)));
  }
  for (std::size_t i = 1; i < node_.size(); ++i) {
    const double mean = (force_[i] - force_[i - 1]) / (node_[i] - node_[i - 1]);
    if (mean >= slope_[i - 1] && mean <= slope_[i]) continue;
    slope_[i - 1] = std::min(slope_[i - 1], 3 * mean);
    slope_[i] = std::min(slope_[i], 3 * mean);
  }
  // The tangent at the lowest node must fall to F = 0 at some lower indentation.
  if (force_.front() > 0 && !(slope_.front() > 0) && node_.size() > 1)
    slope_.front() = (force_[1] - force_[0]) / (node_[1] - node_[0]);
}

// Sets K_t of the springs, and G = ∫K_t dζ at the nodes. The mean K_t between two nodes is that of
// the law, so G is right at each node however much K_t scatters between the loads of a curve.
void LawSprings::set_tangential(const ContactLaw& law) {
  std::vector<double> stiffness;
  bool proportional = true;  // K_t/K is the same at all nodes, so ∫K_t is a multiple of F
  for (std::size_t i = 0; i < node_.size(); ++i) {
    stiffness.push_back(law.tangential_stiffness(above_jump(i)));
    proportional = proportional && law.stiffness_ratio(node_[i]) == law.modulus_ratio();
  }
  std::vector<double> means, widths;
  double whole = 0;
  for (std::size_t i = 1; i < node_.size(); ++i) {
    widths.push_back(node_[i] - node_[i - 1]);
    const double gain =
        proportional ? law.modulus_ratio() * (force_[i] - force_[i - 1])
                     : detail::integrate([&](double at) { return law.tangential_stiffness(at); },
                                         detail::sweep_breaks(law, node_[i - 1], node_[i]), 1e-10)
                           .value;
    means.push_back(gain / widths.back());
    whole += gain;
  }
  const std::vector<double> pooled = rising(means, widths);
  for (std::size_t i = 0; i < node_.size(); ++i) {
    const double below = i > 0 ? pooled[i - 1] : 0,
                 above = i < pooled.size() ? pooled[i] : std::max(below, stiffness[i]);
    sum_.push_back(std::clamp(stiffness[i], below, above));
  }
  const double floor = slope_[0] > 0 ? node_[0] - force_[0] / slope_[0] : node_[0];
  stiffness_ = {sum_[0]}, depth_ = {floor}, held_ = {sum_[0] * (node_[0] - floor)};
  double exact = held_[0];
  for (std::size_t i = 1; i < node_.size(); ++i) {
    const double width = widths[i - 1], rise = sum_[i] - sum_[i - 1];
    // A spring represents all springs between two nodes, so its depth must lie between these nodes.
    constexpr double edge = 1e-3;
    const double within = std::clamp(pooled[i - 1] - sum_[i - 1], edge * rise, (1 - edge) * rise);
    stiffness_.push_back(rise);
    depth_.push_back(rise > 0 ? node_[i] - width * (within / rise) : node_[i]);
    held_.push_back(held_.back() + width * (sum_[i - 1] + within));
    exact += width * means[i - 1];
    require(std::abs(held_[i] - exact) <= max_change * std::max(exact, small * whole), "law",
            node_[i],
            "m lies where the tangential stiffness falls by more than scatter, and springs cannot "
            "follow; smooth the curve, or leave out the loads near it");
  }
}

LawSprings::Normal LawSprings::normal(double indentation) const {
  return through(node_, force_, slope_, indentation);
}

LawSprings::Normal LawSprings::held(double indentation) const {
  return through(node_, held_, sum_, indentation);
}

ContactElement::ContactElement(std::shared_ptr<const LawSprings> springs)
    : springs_(std::move(springs)) {
  require(springs_ != nullptr, "intervals", "none", "must be given");
  state_.assign(3 + 2 * springs_->size(), 0.0);
  held_.assign(springs_->size(), {});
  // The indentation at which the tangent of F at the lowest node reaches 0.
  state_[0] = springs_->depth_.front();
}

void ContactElement::start(double indentation, double x, double y) {
  for (const double one : {indentation, x, y})
    require(std::isfinite(one), "displacement", one, "must be finite");
  state_[0] = indentation, state_[1] = x, state_[2] = y;
  const auto anchors = state_.begin() + 3;
  const auto half = static_cast<std::ptrdiff_t>(springs_->size());
  std::fill(anchors, anchors + half, x);
  std::fill(anchors + half, state_.end(), y);
  sum(0, springs_->size());
}

// Updates held_, the forces of the anchors Σ K_t x0 and Σ K_t y0 summed from the lowest spring on,
// for the springs in [from, to).
void ContactElement::sum(std::size_t from, std::size_t to) {
  const std::size_t count = springs_->size();
  std::array<double, 2> sum = from > 0 ? held_[from - 1] : std::array<double, 2>{};
  for (std::size_t i = from; i < to; ++i) {
    const double k = springs_->stiffness_[i];
    sum[0] += k * state_[3 + i], sum[1] += k * state_[3 + count + i];
    held_[i] = sum;
  }
}

void ContactElement::restore(std::span<const double> state) {
  require(state.size() == state_.size(), "state", state.size(),
          "numbers do not match the number of springs");
  for (const double one : state) require(std::isfinite(one), "state", one, "must be finite");
  std::ranges::copy(state, state_.begin());
  sum(0, springs_->size());
}

// A step from the state of an element to a new position of the body, spring by spring.
struct ContactElement::Step {
  // One spring. If it sticks, it exerts the force f on the body, with ∂f/∂x = hold · (unit matrix)
  // and ∂f/∂δ = push. The magnitude of its force is limited to μ(F/G) · bears, where bears = k(δ −
  // c) for a spring of stiffness k and depth c, and G is the sum of `bears` over the springs.
  struct Level {
    double k, f_x, f_y, hold, push_x, push_y, bears, bears_slope;
  };

  Step(const ContactElement& from, double indentation, double x, double y)
      : of(*from.springs_),
        anchor_x(from.state_.data() + 3),
        anchor_y(anchor_x + of.size()),
        held(from.held_),
        indentation(indentation),
        x(x),
        y(y),
        before(from.state_[0]),
        travel_x(x - from.state_[1]),
        travel_y(y - from.state_[2]),
        normal(of.normal(indentation)),
        now(of.held(indentation)),
        then(of.held(before)) {
    for (const double one : {indentation, x, y})
      require(std::isfinite(one), "displacement", one, "must be finite");
    touching = static_cast<std::size_t>(std::ranges::lower_bound(of.node_, indentation) -
                                        of.node_.begin());
    touching = indentation > floor(0) ? std::min(touching + 1, of.size()) : 0;
    if (full_stick() || !(now.force > 0)) return;
    share = of.friction_coefficient_ * normal.force / now.force;
    share_slope = (of.friction_coefficient_ * normal.stiffness - share * now.stiffness) / now.force;
  }

  bool full_stick() const { return std::isinf(of.friction_coefficient_); }

  // Indentation at which spring i begins to touch. The lowest spring touches and separates at the
  // indentation where its normal force is 0.
  double floor(std::size_t i) const { return i > 0 ? of.node_[i - 1] : of.depth_[0]; }

  bool held_throughout(std::size_t i) const {
    const double from = i > 0 ? of.node_[i] : std::nextafter(floor(0), indentation);
    return std::min(before, indentation) >= from;
  }

  Level whole(std::size_t i) const {
    const double k = of.stiffness_[i];
    return {
        k, k * (x - anchor_x[i]), k * (y - anchor_y[i]), k, 0, 0, k * (indentation - of.depth_[i]),
        k};
  }

  // Stiffness of the touching part of spring i at the indentation `at`, and its derivative with
  // respect to the indentation.
  std::pair<double, double> touched(std::size_t i, double at,
                                    const LawSprings::Normal& held) const {
    if (at <= floor(i)) return {0, 0};
    if (i == 0 || at >= of.node_[i]) return {of.stiffness_[i], 0};
    return {held.stiffness - of.sum_[i - 1], held.curvature};
  }

  // A spring between whose two nodes the step begins or ends, or which the step crosses.
  Level passed(std::size_t i) const {
    const auto [k, slope] = touched(i, indentation, now);
    const double k_before = touched(i, before, then).first;
    Level spring_depth = whole(i);
    const bool inside = i > 0 && indentation < of.node_[i];
    if (inside) {
      spring_depth.bears_slope = k;
      spring_depth.bears = now.force - of.held_[i - 1] - of.sum_[i - 1] * (indentation - floor(i));
    }
    const double stretch_x = x - anchor_x[i], stretch_y = y - anchor_y[i];
    spring_depth.k = k;
    if (k <= k_before) {
      spring_depth.f_x = k * stretch_x, spring_depth.f_y = k * stretch_y, spring_depth.hold = k;
      spring_depth.push_x = slope * stretch_x, spring_depth.push_y = slope * stretch_y;
      return spring_depth;
    }
    // The part of the spring that touches during the step is anchored where the body is in the
    // middle of the indentations at which this part touches.
    const double climb = indentation - before, start = std::max(floor(i), before);
    const double finish = i == 0 ? start : std::min(of.node_[i], indentation);
    const double fraction = (0.5 * (start + finish) - before) / climb;
    const double gained = k - k_before, kept = gained * (1 - fraction);
    const double push = slope * (1 - fraction) - gained * ((inside ? 0.5 : 0.0) - fraction) / climb;
    spring_depth.f_x = k_before * stretch_x + kept * travel_x;
    spring_depth.f_y = k_before * stretch_y + kept * travel_y;
    spring_depth.hold = k_before + kept;
    spring_depth.push_x = push * travel_x, spring_depth.push_y = push * travel_y;
    return spring_depth;
  }

  double limit_of(const Level& spring_depth) const {
    return share * std::max(0.0, spring_depth.bears);
  }

  bool sticks(const Level& spring_depth) const {
    if (full_stick()) return true;
    const double limit = limit_of(spring_depth);
    return spring_depth.f_x * spring_depth.f_x + spring_depth.f_y * spring_depth.f_y <=
           limit * limit;
  }

  // Number of springs, counted from the lowest, that touch during the whole step and stick at its
  // end.
  std::size_t sticking() const {
    std::size_t whole = 0;
    while (whole < touching && held_throughout(whole)) ++whole;
    if (full_stick()) return whole;
    for (std::size_t i = 0; i < whole; ++i) {
      const double s_x = x - anchor_x[i], s_y = y - anchor_y[i];
      const double limit = share * (indentation - of.depth_[i]);
      if (s_x * s_x + s_y * s_y > limit * limit) return i;
    }
    return whole;
  }

  // Goes down from the highest touching spring to those that keep their anchors, and calls
  // anchor(i, x, y) with the new anchor of each spring. Returns the number of springs below that
  // keep their anchors.
  template <typename Anchor>
  std::size_t follow(const Anchor& anchor) {
    const std::size_t lowest = sticking();
    std::size_t i = touching;
    for (; i > lowest; --i) {
      const Level spring_depth = held_throughout(i - 1) ? whole(i - 1) : passed(i - 1);
      const double part = add(spring_depth);
      if (spring_depth.k > 0)
        anchor(i - 1, x - part * spring_depth.f_x / spring_depth.k,
               y - part * spring_depth.f_y / spring_depth.k);
    }
    if (i == 0) return 0;
    force_x += of.sum_[i - 1] * x - held[i - 1][0], xx += of.sum_[i - 1];
    force_y += of.sum_[i - 1] * y - held[i - 1][1], yy += of.sum_[i - 1];
    return i;
  }

  // Adds the force and stiffness of a spring to the sums. Returns the fraction of its stretch that
  // remains after slip.
  double add(const Level& spring_depth) {
    if (sticks(spring_depth)) {
      force_x += spring_depth.f_x, force_y += spring_depth.f_y;
      along_x += spring_depth.push_x, along_y += spring_depth.push_y;
      xx += spring_depth.hold, yy += spring_depth.hold;
      return 1;
    }
    // Perpendicular to the stretch, ∂f/∂δ of the sticking spring remains; along the stretch the
    // friction limit sets the force.
    const double size =
        std::sqrt(spring_depth.f_x * spring_depth.f_x + spring_depth.f_y * spring_depth.f_y);
    const double limit = limit_of(spring_depth);
    const double n_x = spring_depth.f_x / size, n_y = spring_depth.f_y / size;
    const double part = limit / size;
    const double limit_slope = share * spring_depth.bears_slope + share_slope * spring_depth.bears;
    const double push = spring_depth.push_x * n_x + spring_depth.push_y * n_y;
    force_x += limit * n_x, force_y += limit * n_y;
    along_x += part * (spring_depth.push_x - push * n_x) + limit_slope * n_x;
    along_y += part * (spring_depth.push_y - push * n_y) + limit_slope * n_y;
    xx += part * spring_depth.hold * n_y * n_y, yy += part * spring_depth.hold * n_x * n_x;
    xy -= part * spring_depth.hold * n_x * n_y;
    return part;
  }

  ElementForces result() const {
    return {normal.force,
            {force_x, force_y},
            {{{normal.stiffness, 0, 0}, {along_x, xx, xy}, {along_y, xy, yy}}}};
  }

  const LawSprings& of;
  const double *anchor_x, *anchor_y;
  const std::vector<std::array<double, 2>>& held;
  std::size_t touching;  // number of springs that touch at the end of the step
  double indentation, x, y, before, travel_x, travel_y;
  // The normal force F (`normal`) and G (`now`) at the end of the step, and G before it (`then`).
  LawSprings::Normal normal, now, then;
  double share = 0, share_slope = 0;  // μF/G, and its derivative with respect to δ
  double force_x = 0, force_y = 0, along_x = 0, along_y = 0, xx = 0, xy = 0, yy = 0;
};

ElementForces ContactElement::forces(double indentation, double x, double y) const {
  Step step(*this, indentation, x, y);
  step.follow([](std::size_t, double, double) {});
  return step.result();
}

ElementForces ContactElement::move_to(double indentation, double x, double y) {
  Step step(*this, indentation, x, y);
  const std::size_t lowest = step.follow([&](std::size_t i, double anchor_x, double anchor_y) {
    state_[3 + i] = anchor_x, state_[3 + springs_->size() + i] = anchor_y;
  });
  state_[0] = indentation, state_[1] = x, state_[2] = y;
  sum(lowest, step.touching);
  return step.result();
}

}  // namespace salebra
