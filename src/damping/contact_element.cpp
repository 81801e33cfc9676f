// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law as levels of springs with friction, and implicit steps of them.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/damping/contact_element.hpp>
#include <utility>

#include "contact/quadrature.hpp"

namespace salebra {
namespace {

// Of the highest force: levels that bear less all lie in the lowest one.
constexpr double negligible_force = 1e-6;
// Of F/K at the highest indentation: the shortest level below the motion.
constexpr double shortest_level = 1e-3;

// The lowest node: where the law ends, or bears next to nothing.
double deepest(const ContactLaw& law, double lowest, double highest) {
  const double bottom = law.lowest_indentation();
  const double least = negligible_force * law.force(highest);
  double depth = highest - lowest + law.force(highest) / law.normal_stiffness(highest);
  double low = lowest;
  while (low > bottom && law.force(low) > least) {
    low = std::max(bottom, lowest - depth);
    depth *= 1.5;
  }
  return low;
}

// Depths of levels below the motion: equal ratios of neighbours, the first as given.
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

}  // namespace

LawLevels::LawLevels(const ContactLaw& law, double lowest, double highest,
                     const LawLevelsOptions& options)
    : friction_coefficient_(options.friction_coefficient) {
  require(options.friction_coefficient >= 0, "friction_coefficient", options.friction_coefficient,
          "must be >= 0 (infinity: full stick)");
  require(options.levels >= 8 && options.levels <= 4096, "levels", options.levels,
          "must lie between 8 and 4096");
  require(std::isfinite(lowest) && std::isfinite(highest) && lowest <= highest, "lowest", lowest,
          "and highest must be finite and in this order");
  require(law.force(highest) > 0, "highest", highest, "m is where nothing touches");
  const int half = options.levels / 2;
  std::vector<double> nodes;
  for (int i = 0; i <= half; ++i) nodes.push_back(lowest + (highest - lowest) * i / half);
  const double bottom = deepest(law, lowest, highest);
  const double first = std::max((highest - lowest) / half, shortest_level * law.force(highest) /
                                                               law.normal_stiffness(highest));
  for (const double depth : depths(first, lowest - bottom, options.levels - half))
    nodes.push_back(std::max(bottom, lowest - depth));
  for (const double at : law.break_points())
    if (std::isfinite(at) && at > bottom && at < highest && law.force(at) == 0) nodes.push_back(at);
  std::ranges::sort(nodes);
  // Nodes closer than this are one.
  const double apart = 1e-9 * (highest - bottom) + 1e-15 * std::abs(highest);
  for (const double node : nodes)
    if (node_.empty() || node > node_.back() + apart) append(law, node);
}

// Adds the level below the node.
void LawLevels::append(const ContactLaw& law, double node) {
  const bool first = node_.empty();
  const double force = law.force(node), slope = law.normal_stiffness(node);
  const double held = law.tangential_stiffness(node);
  const double tangential = held - (first ? 0 : sum_.back());
  require(first || (slope >= slope_.back() && tangential >= -1e-12 * held), "law", node,
          "m has a smaller stiffness than lower indentations, which levels cannot have; take a "
          "range of the law in which K and K_t grow");
  share_.push_back(first ? slope : slope - slope_.back());
  share_zero_.push_back(first
                            ? force - slope * node
                            : force - force_.back() - slope * node + slope_.back() * node_.back());
  stiffness_.push_back(force > 0 ? std::max(0.0, tangential) : 0);
  sum_.push_back((first ? 0 : sum_.back()) + stiffness_.back());
  node_.push_back(node), force_.push_back(force), slope_.push_back(slope);
}

LawLevels::Normal LawLevels::normal(double indentation) const {
  const auto tangent = [&](std::size_t i) {
    const double force = force_[i] + slope_[i] * (indentation - node_[i]);
    return force > 0 ? Normal{force, slope_[i], 0} : Normal{};
  };
  if (indentation <= node_.front()) return tangent(0);
  if (indentation >= node_.back()) return tangent(node_.size() - 1);
  const std::size_t above =
      static_cast<std::size_t>(std::ranges::upper_bound(node_, indentation) - node_.begin());
  const std::size_t i = above - 1;
  const double width = node_[above] - node_[i], t = (indentation - node_[i]) / width;
  // F_i + K_i w t + w(b t² + c t³), of which the value and the slope at t = 1 are known.
  const double mean = (force_[above] - force_[i]) / width - slope_[i];
  const double rise = slope_[above] - slope_[i];
  const double b = 3 * mean - rise, c = rise - 2 * mean;
  return {force_[i] + width * t * (slope_[i] + t * (b + c * t)),
          slope_[i] + t * (2 * b + 3 * c * t), (2 * b + 6 * c * t) / width};
}

ContactElement::ContactElement(std::shared_ptr<const LawLevels> levels)
    : levels_(std::move(levels)) {
  require(levels_ != nullptr, "levels", "none", "must be given");
  state_.assign(3 + 2 * levels_->size(), 0.0);
  held_.assign(levels_->size(), {});
  // Where F along the lowest tangent is 0, or below.
  state_[0] = levels_->node_.front();
  if (levels_->slope_.front() > 0) state_[0] -= levels_->force_.front() / levels_->slope_.front();
}

void ContactElement::start(double indentation, double x, double y) {
  for (const double one : {indentation, x, y})
    require(std::isfinite(one), "displacement", one, "must be finite");
  state_[0] = indentation, state_[1] = x, state_[2] = y;
  const auto anchors = state_.begin() + 3;
  const auto half = static_cast<std::ptrdiff_t>(levels_->size());
  std::fill(anchors, anchors + half, x);
  std::fill(anchors + half, state_.end(), y);
  sum(0, levels_->size());
}

// Sums what levels from here on hold, below the last.
void ContactElement::sum(std::size_t from, std::size_t to) {
  const std::size_t count = levels_->size();
  std::array<double, 2> sum = from > 0 ? held_[from - 1] : std::array<double, 2>{};
  for (std::size_t i = from; i < to; ++i) {
    const double k = levels_->stiffness_[i];
    sum[0] += k * state_[3 + i], sum[1] += k * state_[3 + count + i];
    held_[i] = sum;
  }
}

void ContactElement::restore(std::span<const double> state) {
  require(state.size() == state_.size(), "state", state.size(),
          "numbers are not those of these levels");
  for (const double one : state) require(std::isfinite(one), "state", one, "must be finite");
  std::ranges::copy(state, state_.begin());
  sum(0, levels_->size());
}

// A step from the state of an element, level by level.
struct ContactElement::Step {
  // A level that holds the body with f if it sticks, ∂f/∂x = hold·1 and ∂f/∂δ = push, and bears a
  // part of the normal force.
  struct Level {
    double k, f_x, f_y, hold, push_x, push_y, bears, bears_slope;
  };

  Step(const ContactElement& from, double indentation, double x, double y)
      : of(*from.levels_),
        anchor_x(from.state_.data() + 3),
        anchor_y(anchor_x + of.size()),
        held(from.held_),
        indentation(indentation),
        x(x),
        y(y),
        before(from.state_[0]),
        travel_x(x - from.state_[1]),
        travel_y(y - from.state_[2]),
        now(of.normal(indentation)),
        then(of.normal(before)),
        friction(of.friction_coefficient_) {
    for (const double one : {indentation, x, y})
      require(std::isfinite(one), "displacement", one, "must be finite");
    touching = static_cast<std::size_t>(std::ranges::lower_bound(of.node_, indentation) -
                                        of.node_.begin());
    touching = indentation > floor(0) ? std::min(touching + 1, of.size()) : 0;
  }

  // The lowest level touches and parts as one, where its force is 0.
  double floor(std::size_t i) const {
    if (i > 0) return of.node_[i - 1];
    return of.share_[0] > 0 ? -of.share_zero_[0] / of.share_[0] : of.node_[0];
  }

  bool held_throughout(std::size_t i) const {
    const double from = i > 0 ? of.node_[i] : std::nextafter(floor(0), indentation);
    return std::min(before, indentation) >= from;
  }

  Level whole(std::size_t i) const {
    const double k = of.stiffness_[i];
    return {k,
            k * (x - anchor_x[i]),
            k * (y - anchor_y[i]),
            k,
            0,
            0,
            of.share_[i] * indentation + of.share_zero_[i],
            of.share_[i]};
  }

  // A level touches by the part of K_t that K has reached between its ends.
  std::pair<double, double> touched(std::size_t i, double at,
                                    const LawLevels::Normal& normal) const {
    if (at <= floor(i)) return {0, 0};
    if (i == 0 || at >= of.node_[i] || !(of.share_[i] > 0)) return {of.stiffness_[i], 0};
    const double part = (normal.stiffness - of.slope_[i - 1]) / of.share_[i];
    if (!(part > 0 && part < 1)) return {std::clamp(part, 0.0, 1.0) * of.stiffness_[i], 0};
    return {of.stiffness_[i] * part, of.stiffness_[i] * normal.curvature / of.share_[i]};
  }

  // A level in which the step begins or ends, or which it passes.
  Level passed(std::size_t i) const {
    const auto [k, slope] = touched(i, indentation, now);
    const double k_before = touched(i, before, then).first;
    Level level = whole(i);
    const bool inside = i > 0 && indentation < of.node_[i];
    if (inside) {
      level.bears_slope = now.stiffness - of.slope_[i - 1];
      level.bears = now.force - of.force_[i - 1] - of.slope_[i - 1] * (indentation - floor(i));
    }
    const double stretch_x = x - anchor_x[i], stretch_y = y - anchor_y[i];
    level.k = k;
    if (k <= k_before) {
      level.f_x = k * stretch_x, level.f_y = k * stretch_y, level.hold = k;
      level.push_x = slope * stretch_x, level.push_y = slope * stretch_y;
      return level;
    }
    // Springs that touch on the way are anchored where the body was in the middle of them.
    const double climb = indentation - before, start = std::max(floor(i), before);
    const double finish = i == 0 ? start : std::min(of.node_[i], indentation);
    const double fraction = (0.5 * (start + finish) - before) / climb;
    const double gained = k - k_before, kept = gained * (1 - fraction);
    const double push = slope * (1 - fraction) - gained * ((inside ? 0.5 : 0.0) - fraction) / climb;
    level.f_x = k_before * stretch_x + kept * travel_x;
    level.f_y = k_before * stretch_y + kept * travel_y;
    level.hold = k_before + kept;
    level.push_x = push * travel_x, level.push_y = push * travel_y;
    return level;
  }

  bool sticks(const Level& level) const {
    if (std::isinf(friction)) return true;
    const double limit = friction * level.bears;
    return level.f_x * level.f_x + level.f_y * level.f_y <= limit * limit;
  }

  // Goes down from the last level that touches to one that the step neither passes nor lets slip;
  // anchor(i, x, y) is told of each on the way. Returns how many levels it left alone.
  template <typename Anchor>
  std::size_t follow(const Anchor& anchor) {
    std::size_t i = touching;
    for (; i > 0; --i) {
      const bool held_on = held_throughout(i - 1);
      const Level level = held_on ? whole(i - 1) : passed(i - 1);
      if (held_on && sticks(level)) break;
      const double part = add(level);
      if (level.k > 0)
        anchor(i - 1, x - part * level.f_x / level.k, y - part * level.f_y / level.k);
    }
    if (i == 0) return 0;
    force_x += of.sum_[i - 1] * x - held[i - 1][0], xx += of.sum_[i - 1];
    force_y += of.sum_[i - 1] * y - held[i - 1][1], yy += of.sum_[i - 1];
    return i;
  }

  // Adds a level, and returns the part of its stretch that the limit of friction leaves.
  double add(const Level& level) {
    if (sticks(level)) {
      force_x += level.f_x, force_y += level.f_y;
      along_x += level.push_x, along_y += level.push_y;
      xx += level.hold, yy += level.hold;
      return 1;
    }
    // Of what pulls across the stretch the part remains; along it the limit decides.
    const double size = std::sqrt(level.f_x * level.f_x + level.f_y * level.f_y),
                 limit = friction * level.bears;
    const double n_x = level.f_x / size, n_y = level.f_y / size;
    const double part = limit / size, limit_slope = friction * level.bears_slope;
    const double push = level.push_x * n_x + level.push_y * n_y;
    force_x += limit * n_x, force_y += limit * n_y;
    along_x += part * (level.push_x - push * n_x) + limit_slope * n_x;
    along_y += part * (level.push_y - push * n_y) + limit_slope * n_y;
    xx += part * level.hold * n_y * n_y, yy += part * level.hold * n_x * n_x;
    xy -= part * level.hold * n_x * n_y;
    return part;
  }

  ElementForces result() const {
    return {now.force,
            {force_x, force_y},
            {{{now.stiffness, 0, 0}, {along_x, xx, xy}, {along_y, xy, yy}}}};
  }

  const LawLevels& of;
  const double *anchor_x, *anchor_y;
  const std::vector<std::array<double, 2>>& held;
  std::size_t touching;  // levels that touch at the end
  double indentation, x, y, before, travel_x, travel_y;
  LawLevels::Normal now, then;
  double friction;
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
    state_[3 + i] = anchor_x, state_[3 + levels_->size() + i] = anchor_y;
  });
  state_[0] = indentation, state_[1] = x, state_[2] = y;
  sum(lowest, step.touching);
  return step.result();
}

}  // namespace salebra
