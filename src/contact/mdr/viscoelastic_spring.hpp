// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <salebra/base/grid.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>
#include <span>
#include <vector>

#include "base/numerics/quadrature.hpp"

namespace salebra::detail {

using Branches = Eigen::ArrayXd;  ///< one number for each term of the Prony series

/// Change of the branch stretches y while the spring is stretched by Δw at a constant rate: at the
/// end y is decay·y + gain·Δw, and the mean over the time is mean_decay·y + mean_gain·Δw.
struct Stretching {
  Branches decay, gain, mean_gain;
  const Branches& mean_decay() const { return gain; }
};

/// A spring of relaxed stiffness 1 with Maxwell branches. Its force at displacement w is q = w + Σ
/// r_i y_i, where branch i has the stretch y_i with y_i' = w' − y_i/τ_i, the relaxation time τ_i
/// and the stiffness ratio r_i = G_i/G∞.
class MaxwellSpring {
 public:
  explicit MaxwellSpring(const PronySeries& prony);

  Index terms() const { return ratio_.size(); }
  double force(double w, const Branches& y) const { return w + (ratio_ * y).sum(); }
  double energy(double w, const Branches& y) const {
    return 0.5 * (w * w + (ratio_ * y * y).sum());
  }
  /// Displacement w at which a spring with the branch stretches y has no force.
  double free_displacement(const Branches& y) const { return -(ratio_ * y).sum(); }
  double free_displacement_of_anchors(const Branches& z) const {
    return (ratio_ * z).sum() / unrelaxed_;
  }
  const Branches& ratios() const { return ratio_; }
  double unrelaxed_stiffness() const { return unrelaxed_; }
  Stretching stretching(double duration) const;
  /// The part of its stretch that each branch loses at constant displacement: 1 − exp(−t/τ) after
  /// the duration t, with relaxation time τ.
  Branches lost_share(double duration) const { return -(-duration / time_).expm1(); }
  /// Work ∫ q dw of the force q, when the spring is stretched by dw from displacement w and branch
  /// stretches y.
  double work(const Stretching& step, double w, const Branches& y, double dw) const {
    return dw * (w + 0.5 * dw + mean_branch_force(step, y, dw));
  }
  /// Mean over the time of the branches' force Σ r_i y_i, while the spring is stretched by dw.
  double mean_branch_force(const Stretching& step, const Branches& y, double dw) const {
    return (ratio_ * (step.mean_decay() * y + step.mean_gain * dw)).sum();
  }

  // Without force, the branch stretches relax in modes, whose time constants are the retardation
  // times.
  Branches to_modes(const Branches& y) const { return (to_modes_ * y.matrix()).array(); }
  Branches from_modes(const Branches& modes) const {
    return (from_modes_ * modes.matrix()).array();
  }
  Branches mode_decay(double duration) const { return (-duration * mode_rates_).exp(); }
  double displacement_of_modes(const Branches& modes) const {
    return (mode_displacement_ * modes).sum();
  }
  Branches recovered(const Branches& y, double duration) const {
    return from_modes(to_modes(y) * mode_decay(duration));
  }
  /// Matrices that give, after the duration without force, the branch stretches y_i (recovery) and
  /// the anchors z_i = w − y_i (anchor_recovery) from their values at the beginning. Without force
  /// the displacement is w = Σ r_i z_i/(1 + Σ r_i), with the stiffness ratios r_i.
  Eigen::MatrixXd recovery(double duration) const {
    return from_modes_ * mode_decay(duration).matrix().asDiagonal() * to_modes_;
  }
  Eigen::MatrixXd anchor_recovery(double duration) const {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(terms(), terms());
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(terms());
    const Eigen::RowVectorXd ratios = ratio_.matrix().transpose();
    return (one + ones * ratios) * recovery(duration) * (one - ones * ratios / unrelaxed_);
  }

 private:
  Branches ratio_, time_, mode_rates_, mode_displacement_;
  Eigen::MatrixXd to_modes_, from_modes_;
  double unrelaxed_ = 1;
};

/// The steps of a path δ(t) of the indentation, with the coefficients that all springs need for
/// these steps.
struct SpringPath {
  SpringPath(const MaxwellSpring& spring, std::span<const double> time,
             std::span<const double> indentation);
  std::size_t steps() const { return duration.size(); }

  std::vector<double> indentation, duration;
  std::vector<Stretching> stretching;
  std::vector<Branches> mode_decay;
};

/// Springs between two radii: the flat end of a profile is one spring, the other springs lie in the
/// middle of cells of equal width.
struct SpringLayout {
  struct Cell {
    // Position of the spring, and the radius of contact at which it touches: the rim for the spring
    // of a flat end, otherwise the position.
    double middle, edge;
    double width, spring_depth;  // touching depth: indentation g(x), m
  };
  SpringLayout(const IndenterProfile& profile, double from, double to, int springs);
  std::vector<Cell> cells;
};

/// The normal state of a spring that the indenter touches at the indentation spring_depth.
class NormalSpring {
 public:
  NormalSpring(const MaxwellSpring& spring, double spring_depth)
      : spring_(spring),
        touching_depth_(spring_depth),
        y_(Branches::Zero(spring.terms())),
        modes_(y_) {}

  /// Starts from the anchors w − y_i (displacement minus branch stretch): in contact if the
  /// indenter is below the position that a spring with these anchors has without force.
  void start(double indentation, const Branches& anchors) {
    const double depth = indentation - touching_depth_,
                 free = spring_.free_displacement_of_anchors(anchors);
    closed_ = depth > free;
    y_ = std::max(depth, free) - anchors;
    if (!closed_) modes_ = spring_.to_modes(y_);
  }
  bool closed() const { return closed_; }
  Branches anchors(double indentation) const {
    return displacement(indentation) - (closed_ ? y_ : spring_.from_modes(modes_));
  }
  double displacement(double indentation) const {
    return closed_ ? indentation - touching_depth_ : spring_.displacement_of_modes(modes_);
  }
  double force(double indentation) const {
    return closed_ ? spring_.force(indentation - touching_depth_, y_) : 0;
  }
  /// Height of the indenter above the position that the spring would have without force, < 0 in
  /// contact; a continuous function of the touching depth.
  double clearance(double indentation) const {
    return closed_ ? -force(indentation) / spring_.unrelaxed_stiffness()
                   : displacement(indentation) - (indentation - touching_depth_);
  }

  /// Advances by one step of the path. The step consists of parts between touch and release; calls
  /// on_part(in contact or not, fraction of the step's duration, work of the force) for each part.
  template <class OnPart>
  void advance(const SpringPath& path, std::size_t step, OnPart&& on_part);

 private:
  const MaxwellSpring& spring_;
  double touching_depth_;
  bool closed_ = false;
  Branches y_, modes_;
};

template <class OnPart>
void NormalSpring::advance(const SpringPath& path, std::size_t step, OnPart&& on_part) {
  // Touch and release alternate; more than this many of them in one step are round-off.
  constexpr int max_events = 6;
  const double duration = path.duration[step];
  double depth = path.indentation[step] - touching_depth_;
  const double end = path.indentation[step + 1] - touching_depth_;
  double left = 1;
  for (int event = 0; left > 0; ++event) {
    const double move = end - depth, rest = left * duration;
    const bool whole = left == 1;
    double share = 1;
    if (closed_) {
      const auto force_at = [&](double s) {
        const Stretching part = spring_.stretching(s * rest);
        return spring_.force(depth + s * move, part.decay * y_ + s * move * part.gain);
      };
      Stretching partial;
      if (!whole) partial = spring_.stretching(rest);
      const Stretching* part = whole ? &path.stretching[step] : &partial;
      const bool leaves =
          event < max_events && spring_.force(end, part->decay * y_ + move * part->gain) < 0;
      if (leaves) {
        share = force_at(0) > 0 ? find_root(force_at, 0, 1) : 0;
        partial = spring_.stretching(share * rest);
        part = &partial;
      }
      if (share > 0) {
        on_part(true, left * share, spring_.work(*part, depth, y_, share * move));
        y_ = part->decay * y_ + share * move * part->gain;
      }
      if (leaves) {
        closed_ = false;
        modes_ = spring_.to_modes(y_);
      }
    } else {
      const auto gap_at = [&](double s) {
        return spring_.displacement_of_modes(modes_ * spring_.mode_decay(s * rest)) -
               (depth + s * move);
      };
      const bool touches =
          event < max_events &&
          (whole ? spring_.displacement_of_modes(modes_ * path.mode_decay[step]) - end
                 : gap_at(1)) < 0;
      if (touches) share = gap_at(0) > 0 ? find_root(gap_at, 0, 1) : 0;
      if (share > 0) {
        on_part(false, left * share, 0.0);
        if (whole && !touches)
          modes_ *= path.mode_decay[step];
        else
          modes_ *= spring_.mode_decay(share * rest);
      }
      if (touches) {
        closed_ = true;
        y_ = spring_.from_modes(modes_);
      }
    }
    depth += share * move;
    left *= 1 - share;
  }
}

}  // namespace salebra::detail
