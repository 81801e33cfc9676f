// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential force and loss of a contact law along any path of indentation and displacement. The
// law is a stack of springs; a spring of depth ζ touches at the indentation ζ, and is then anchored
// at the position x0. The state is x0 as a piecewise linear function of ζ.
#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <sstream>
#include <vector>

#include "base/numerics/quadrature.hpp"
#include "stiffness_table.hpp"

namespace salebra {
namespace {

// Springs may be left out if their stiffness is below this fraction of that of the whole contact.
constexpr double negligible = 1e-15;

using Moments = detail::StiffnessTable::Moments;

// The values at the lower and the upper end of a range of depths ζ, of a quantity linear in ζ.
struct Linear {
  double low, high;
};

// ∫K_t' v w dζ over a range of depths of the given width, for v and w linear in ζ.
double integral(const Moments& moments, double width, Linear v, Linear w) {
  if (!(width > 0)) return 0;
  const double v_slope = (v.high - v.low) / width, w_slope = (w.high - w.low) / width;
  return v.low * w.low * moments.zeroth + (v.low * w_slope + w.low * v_slope) * moments.first +
         v_slope * w_slope * moments.second;
}

}  // namespace

struct TangentialContact::State {
  // A range of depths, from `top` of the piece below to `top`. anchor: x0 at the lower and the
  // upper end.
  struct Piece {
    double top;
    Linear anchor;
    double first_integral;   // ∫K_t' x0 dζ over all depths up to `top`
    double second_integral;  // ∫K_t' x0² dζ over all depths up to `top`
    double deviation;        // bound of the change of x0 by merging pieces
  };

  State(const ContactLaw& law, double low, double high, double lowest_of_motion,
        double stiffness_ratio, const TangentialContactOptions& given)
      : table(
            std::make_shared<const detail::StiffnessTable>(law, low, high, given.table_tolerance)),
        permanent_below(lowest_of_motion),
        parts_below(!(law.force(lowest_of_motion) > 0)),
        permanent_stiffness(law.tangential_stiffness(lowest_of_motion)),
        slope_limit(given.friction_coefficient / stiffness_ratio),
        merge_tolerance(given.merge_tolerance),
        slack(1e-9 * (high - lowest_of_motion) + 1e-15 * std::abs(high)) {
    // One spring (the core) replaces all springs below the table and carries their normal force.
    core_depth = low;
    if (table->core() > 0) core_depth -= stiffness_ratio * law.force(low) / table->core();
  }

  double within_range(double spring_depth) const {
    if (parts_below && spring_depth < permanent_below) return spring_depth;
    require(spring_depth >= permanent_below - slack && spring_depth <= table->highest() + slack,
            "indentation", spring_depth,
            "m lies outside the range from lowest to highest for which the contact was made");
    return std::clamp(spring_depth, permanent_below, table->highest());
  }

  double bottom() const {
    return pieces.size() > 1 ? pieces[pieces.size() - 2].top : table->lowest();
  }
  double anchor_at(double spring_depth) const {
    const Piece& piece = pieces.back();
    const double low = bottom();
    // Returns the exact end values, so that adjacent pieces meet without a step.
    if (spring_depth >= piece.top) return piece.anchor.high;
    if (spring_depth <= low) return piece.anchor.low;
    return piece.anchor.low +
           (piece.anchor.high - piece.anchor.low) * ((spring_depth - low) / (piece.top - low));
  }

  void push(double top, Linear anchor, double deviation = 0) {
    const double low = pieces.empty() ? table->lowest() : pieces.back().top;
    if (!(top > low)) return;
    const Moments moments = table->moments(low, top);
    const double first = integral(moments, top - low, anchor, {1, 1});
    const double second = integral(moments, top - low, anchor, anchor);
    const bool empty = pieces.empty();
    pieces.push_back({top, anchor, (empty ? 0 : pieces.back().first_integral) + first,
                      (empty ? 0 : pieces.back().second_integral) + second, deviation});
  }

  // Removes the depths above spring_depth from the topmost piece, or the whole piece if it lies
  // above. moments: of K_t' over the removed range; removed: x0 in this range.
  void cut(double spring_depth, const Moments& moments, Linear removed) {
    Piece& piece = pieces.back();
    const double low = bottom(), width = piece.top - spring_depth;
    if (spring_depth <= low) {
      pieces.pop_back();
      return;
    }
    piece.first_integral -= integral(moments, width, removed, {1, 1});
    piece.second_integral -= integral(moments, width, removed, removed);
    piece.anchor.high = removed.low;
    piece.top = spring_depth;
  }

  // Adds ∫K_t' v w dζ over [low, high] to the dissipated energy, and the part below permanent_below
  // to that of springs that never open.
  void lose(double low, double high, const Moments& moments, Linear v, Linear w) {
    const double loss = integral(moments, high - low, v, w);
    dissipated += loss;
    if (low >= permanent_below) return;
    if (high <= permanent_below) {
      permanent += loss;
      return;
    }
    const double width = permanent_below - low, fraction = width / (high - low);
    permanent += integral(table->moments(low, permanent_below), width,
                          {v.low, v.low + fraction * (v.high - v.low)},
                          {w.low, w.low + fraction * (w.high - w.low)});
  }

  // Releases the springs whose depth ζ exceeds new_indentation; they separate in this step. In full
  // stick a spring with the stretch s at separation loses ½K_t' s². With finite friction it has
  // slipped before, both because its stretch limit fell and because the body moved. The loss by
  // release is then ½K_t' s² times the share of the falling limit in this slip.
  void release(double new_indentation, double new_x) {
    const double descent = indentation - new_indentation, travel = new_x - x;
    auto position = [&](double spring_depth) {
      return x + (indentation - spring_depth) / descent * travel;
    };
    auto share = [&](double stretch) {
      if (std::isinf(slope_limit)) return 1.0;
      const double retreat = slope_limit * descent;
      const double pull = stretch > 0 ? retreat + travel : retreat - travel;
      return pull > 0 ? retreat / pull : 0.0;
    };
    while (!pieces.empty() && pieces.back().top > new_indentation) {
      const double high = pieces.back().top, low = std::max(bottom(), new_indentation);
      const Linear removed{anchor_at(low), anchor_at(high)};
      const Linear stretch{position(low) - removed.low, position(high) - removed.high};
      const Moments moments = table->moments(low, high);
      const bool turns = !std::isinf(slope_limit) && (stretch.low > 0) != (stretch.high > 0) &&
                         stretch.low != 0 && stretch.high != 0;
      if (turns) {
        const double zero = low + (high - low) * stretch.low / (stretch.low - stretch.high);
        lose(low, zero, table->moments(low, zero), {0.5 * share(stretch.low) * stretch.low, 0},
             {stretch.low, 0});
        lose(zero, high, table->moments(zero, high), {0, 0.5 * share(stretch.high) * stretch.high},
             {0, stretch.high});
      } else {
        const double factor = 0.5 * share(stretch.low != 0 ? stretch.low : stretch.high);
        lose(low, high, moments, {factor * stretch.low, factor * stretch.high}, stretch);
      }
      cut(low, moments, removed);
    }
  }

  void touch(double new_indentation, double new_x) {
    if (merge_tolerance > 0 && !pieces.empty() && pieces.back().anchor.high == x) {
      const Piece& last = pieces.back();
      const double low = bottom();
      const double chord = last.anchor.low +
                           (new_x - last.anchor.low) * ((last.top - low) / (new_indentation - low));
      const double deviation = last.deviation + std::abs(chord - x);
      if (deviation <= merge_tolerance) {
        const Linear merged{last.anchor.low, new_x};
        pieces.pop_back();
        push(new_indentation, merged, deviation);
        return;
      }
    }
    push(new_indentation, {x, new_x});
  }

  // Slip in one direction. Forward slip (side = 1) raises the anchor x0 to the bound x −
  // slope_limit(δ − ζ) where x0 is lower. Backward slip (side = −1) is its mirror image. From the
  // time in the step at which the bound reaches x0, the anchor follows the bound; until the end of
  // the step the stretch is slope_limit(δ(t) − ζ), where δ changes in proportion to the bound.
  void slip(double side, double new_indentation, double new_x) {
    const double climb = new_indentation - indentation;
    const double advance = side * (new_x - x) - slope_limit * climb;
    if (!(advance > 0)) return;
    auto bound = [&](double spring_depth) {
      return side * new_x - slope_limit * (new_indentation - spring_depth);
    };
    double reach = new_indentation;
    double reach_bound = bound(reach);
    while (!pieces.empty()) {
      const double high = pieces.back().top;
      double low = bottom();
      Linear removed{anchor_at(low), anchor_at(high)};
      Linear slipped{bound(low) - side * removed.low, bound(high) - side * removed.high};
      // At the top of the contact the anchor and the bound are both x, up to round-off.
      if (slipped.low <= 0 && slipped.high <= 0) break;
      if (slipped.low < 0) {
        low += (high - low) * slipped.low / (slipped.low - slipped.high);
        removed.low = anchor_at(low);
        slipped.low = 0;
      }
      const Moments moments = table->moments(low, high);
      const Linear stretch{slope_limit * (new_indentation - low),
                           slope_limit * (new_indentation - high)};
      const double lead = 0.5 * slope_limit * climb / advance;
      lose(low, high, moments,
           {stretch.low - lead * slipped.low, stretch.high - lead * slipped.high}, slipped);
      reach = low, reach_bound = bound(low);
      const bool partial = low > bottom();
      cut(low, moments, removed);
      if (partial) break;
    }
    if (reach <= table->lowest())
      slip_core(side, new_indentation, side * bound(core_depth), climb, advance);
    push(new_indentation, {side * reach_bound, new_x});
  }

  // The core, which represents the springs below the table, slips as one spring. This is allowed
  // only if all its springs already slide in the same direction; otherwise it throws.
  void slip_core(double side, double new_indentation, double new_anchor, double climb,
                 double advance) {
    if (!(table->core() > negligible * table->at(table->highest()))) return;
    if (side != carried)
      throw InvalidInput(
          "friction_coefficient",
          "slip reaches indentations below the range of the law; raise the friction, reduce the "
          "motion, or give a curve that begins at lower forces");
    const double slipped = side * (new_anchor - core_anchor);
    if (!(slipped > 0)) return;
    const double stretch = slope_limit * (new_indentation - core_depth);
    const double loss =
        table->core() * (stretch - 0.5 * slope_limit * climb / advance * slipped) * slipped;
    dissipated += loss;
    permanent += loss;
    core_anchor = new_anchor;
  }

  // Stored energy up to an unknown constant: the springs that the core represents have different
  // stretches.
  double energy() const {
    const double first =
        (pieces.empty() ? 0 : pieces.back().first_integral) + table->core() * core_anchor;
    const double second = (pieces.empty() ? 0 : pieces.back().second_integral) +
                          table->core() * core_anchor * core_anchor;
    return 0.5 * ((table->core() + table->at(indentation)) * x * x - 2 * x * first + second);
  }

  void begin(double new_indentation, double new_x) {
    pieces.clear();
    origin = new_x;
    indentation = within_range(new_indentation), x = 0;
    dissipated = permanent = core_anchor = carried = 0;
  }

  // Puts every spring, the core included, at its stretch limit in the given direction.
  void slide(double new_indentation, double new_x, int direction) {
    begin(new_indentation, new_x);
    const auto anchor = [&](double spring_depth) {
      return -direction * slope_limit * (indentation - spring_depth);
    };
    push(indentation, {anchor(table->lowest()), 0});
    core_anchor = anchor(core_depth);
    carried = direction;
    energy_at_start = energy();
  }

  void move(double new_indentation, double new_x) {
    if (indentation < table->lowest() && new_indentation > table->lowest()) {
      // First touch occurs during the step; the path continues from there.
      x += (table->lowest() - indentation) / (new_indentation - indentation) * (new_x - x);
      indentation = table->lowest();
    }
    if (new_indentation < indentation) release(new_indentation, new_x);
    if (new_indentation > indentation) touch(new_indentation, new_x);
    if (std::isfinite(slope_limit)) {
      slip(1, new_indentation, new_x);
      slip(-1, new_indentation, new_x);
    }
    indentation = new_indentation, x = new_x;
  }

  double force() const {
    const double anchored = pieces.empty() ? 0 : pieces.back().first_integral;
    return table->core() * (x - core_anchor) + table->at(indentation) * x - anchored;
  }

  // Stiffness table, shared by all copies of a state.
  std::shared_ptr<const detail::StiffnessTable> table;
  double permanent_below;
  bool parts_below;
  double permanent_stiffness, slope_limit, merge_tolerance, slack;
  std::vector<Piece> pieces;
  double indentation = 0, x = 0, origin = 0;  // x is measured from `origin`
  double dissipated = 0, permanent = 0, energy_at_start = 0;
  double core_depth = 0, core_anchor = 0;
  double carried = 0;  // direction in which all springs of the core slide, ±1; 0: they do not
};

TangentialContact::TangentialContact(const ContactLaw& law, double lowest, double highest,
                                     const TangentialContactOptions& options) {
  require(std::isfinite(lowest) && std::isfinite(highest) && lowest <= highest, "indentation",
          lowest, "and the highest indentation of the motion must be finite and in this order");
  require(options.friction_coefficient >= 0, "friction_coefficient", options.friction_coefficient,
          "must be >= 0 (infinity: full stick)");
  require(options.merge_tolerance >= 0, "merge_tolerance", options.merge_tolerance, "must be >= 0");
  require(options.table_tolerance >= 1e-14 && options.table_tolerance <= 1e-3, "table_tolerance",
          options.table_tolerance, "must lie between 1e-14 and 1e-3");
  if (const double end = law.highest_indentation(); !(highest <= end)) {
    std::ostringstream constraint;
    constraint.precision(9);
    constraint << "m is the largest indentation of the motion, but the law ends at " << end
               << " m; reduce the motion, or give a curve that covers it";
    require(false, "indentation", highest, constraint.str());
  }
  const double ratio = std::isnan(options.stiffness_ratio)
                           ? law.stiffness_ratio(0.5 * (lowest + highest))
                           : options.stiffness_ratio;
  double low = lowest;
  if (std::isfinite(options.friction_coefficient)) {
    require(
        options.tangential_range > 0 || options.friction_coefficient == 0, "tangential_range",
        options.tangential_range,
        "m must be > 0 if friction is finite; it is the largest distance between two positions x");
    // A spring this far below the lowest indentation is never stretched to its limit.
    const double reach = options.friction_coefficient > 0 ? 1.001 * options.tangential_range *
                                                                ratio / options.friction_coefficient
                                                          : std::numeric_limits<double>::infinity();
    low = lowest - reach;
    // Ends the table at first touch, since no springs lie below it, or, for a law without first
    // touch, where K_t is negligible. With little or no friction nothing else bounds the depth of
    // slip.
    if (!(law.force(low) > 0) || !std::isfinite(low)) {
      double open = low, closed = highest;
      if (!std::isfinite(open))
        for (double step = std::max(highest - lowest, 1e-12);; step *= 2) {
          open = lowest - step;
          if (!(law.tangential_stiffness(open) > negligible * law.tangential_stiffness(highest)))
            break;
        }
      if (!(law.force(open) > 0) && law.force(closed) > 0)
        for (int halving = 0; halving < 200; ++halving) {
          const double middle = 0.5 * (open + closed);
          (law.force(middle) > 0 ? closed : open) = middle;
        }
      low = std::min(open, lowest);
    }
  }
  state_ = std::make_unique<State>(law, low, highest, lowest, ratio, options);
}

TangentialContact::TangentialContact(const TangentialContact& other)
    : state_(std::make_unique<State>(*other.state_)) {}

TangentialContact& TangentialContact::operator=(const TangentialContact& other) {
  return *this = TangentialContact(other);
}

TangentialContact::TangentialContact(TangentialContact&&) noexcept = default;
TangentialContact& TangentialContact::operator=(TangentialContact&&) noexcept = default;
TangentialContact::~TangentialContact() = default;

void TangentialContact::start(double indentation, double x) {
  State& s = *state_;
  require(std::isfinite(x), "displacement", x, "must be finite");
  s.begin(indentation, x);
  s.push(s.indentation, {0, 0});
  s.energy_at_start = 0;
}

void TangentialContact::slide(double indentation, double x, int direction) {
  State& s = *state_;
  require(std::isfinite(x), "displacement", x, "must be finite");
  require(direction == 1 || direction == -1, "direction", direction, "must be 1 or -1");
  require(std::isfinite(s.slope_limit), "friction_coefficient", s.slope_limit,
          "must be finite for sliding");
  s.slide(indentation, x, direction);
}

void TangentialContact::move_to(double indentation, double x) {
  State& s = *state_;
  indentation = s.within_range(indentation);
  require(std::isfinite(x), "displacement", x, "must be finite");
  s.move(indentation, x - s.origin);
}

void TangentialContact::move_to_force(double indentation, double force) {
  State& s = *state_;
  indentation = s.within_range(indentation);
  require(std::isfinite(force), "tangential_force", force, "must be finite");
  if (std::isfinite(s.slope_limit)) {
    State slid = s;
    slid.slide(indentation, 0, force > 0 ? 1 : -1);
    const double limit = std::abs(slid.force());
    std::ostringstream constraint;
    constraint << "N must be below " << limit << " N, at which the contact slides";
    require(std::abs(force) < limit || force == 0, "tangential_force", force, constraint.str());
  }
  // The tangential force grows with x. Finds a bracket of the required force, and then the x that
  // gives it.
  const auto excess = [&](double x) {
    State moved = s;
    moved.move(indentation, x);
    return moved.force() - force;
  };
  const double here = excess(s.x);
  if (here == 0) return s.move(indentation, s.x);
  const double stiffness = s.table->core() + s.table->at(indentation);
  require(stiffness > 0, "tangential_force", force, "N acts without contact");
  double step = std::max(std::abs(here) / stiffness, 1e-12 * std::abs(s.x)), far = s.x;
  double near = s.x;
  for (int doubling = 0; doubling < 60; ++doubling, step *= 2) {
    near = far;
    far = s.x - std::copysign(step, here);
    if (excess(far) * here <= 0) {
      s.move(indentation, detail::find_root(excess, std::min(near, far), std::max(near, far)));
      return;
    }
  }
  require(false, "tangential_force", force,
          "N is not reached within the displacements that can be computed");
}

double TangentialContact::displacement() const { return state_->x + state_->origin; }

double TangentialContact::tangential_force() const { return state_->force(); }

double TangentialContact::stored_energy() const { return state_->energy(); }

double TangentialContact::dissipated() const { return state_->dissipated; }

double TangentialContact::dissipated_in_permanent_contact() const { return state_->permanent; }

double TangentialContact::external_work() const {
  return stored_energy() - state_->energy_at_start + dissipated();
}

double TangentialContact::permanent_stiffness() const { return state_->permanent_stiffness; }

std::size_t TangentialContact::memory() const { return state_->pieces.size(); }

}  // namespace salebra
