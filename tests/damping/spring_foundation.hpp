// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra_test {

/// The independent second method for every number of damping/: simulates the elastic foundation of
/// Fig. 1 spring by spring. One spring lies at the middle of each of `levels` equal steps of
/// indentation from `lowest` to `highest`, with the tangential stiffness that K_t gains over that
/// step; the springs below `lowest` are one spring that is always in contact. Between two points of
/// the trajectory the motion is straight, and touch and release are placed exactly. Second order in
/// the depth step where K_t' is smooth.
class SpringFoundation {
 public:
  SpringFoundation(const salebra::ContactLaw& law, double lowest, double highest, int levels)
      : core_(law.tangential_stiffness(lowest)) {
    const double step = (highest - lowest) / levels;
    for (int i = 0; i < levels; ++i)
      springs_.push_back({lowest + (i + 0.5) * step,
                          law.tangential_stiffness(lowest + (i + 1) * step) -
                              law.tangential_stiffness(lowest + i * step),
                          0, false});
  }

  /// Puts the indenter down at (indentation, x) with every spring free of stress.
  void start(double indentation, double x) {
    indentation_ = indentation, x_ = core_origin_ = x;
    released_ = work_ = 0;
    for (Spring& spring : springs_) spring.touched = spring.level < indentation, spring.origin = x;
  }

  void move_to(double indentation, double x) {
    const double descent = indentation - indentation_;
    work_ += core_ * (0.5 * (x + x_) - core_origin_) * (x - x_);
    for (Spring& spring : springs_) {
      const bool was = spring.touched, is = spring.level < indentation;
      if (!was && !is) continue;
      double from = x_, to = x;
      if (was != is) {
        const double crossing = x_ + (spring.level - indentation_) / descent * (x - x_);
        (is ? from : to) = crossing;
        if (is) spring.origin = crossing;
      }
      work_ += spring.stiffness * (0.5 * (from + to) - spring.origin) * (to - from);
      if (was && !is) {
        const double distance = to - spring.origin;
        released_ += 0.5 * spring.stiffness * distance * distance;
      }
      spring.touched = is;
    }
    indentation_ = indentation, x_ = x;
  }

  double released() const { return released_; }  ///< energy lost by springs that separate, J
  double work() const { return work_; }          ///< ∫F_x dx, J
  double force() const {                         ///< F_x, N
    double force = core_ * (x_ - core_origin_);
    for (const Spring& spring : springs_)
      if (spring.touched) force += spring.stiffness * (x_ - spring.origin);
    return force;
  }
  double stored() const {  ///< elastic energy of the tangential stretch, J
    double energy = 0.5 * core_ * (x_ - core_origin_) * (x_ - core_origin_);
    for (const Spring& spring : springs_)
      if (spring.touched)
        energy += 0.5 * spring.stiffness * (x_ - spring.origin) * (x_ - spring.origin);
    return energy;
  }

 private:
  struct Spring {
    double level, stiffness, origin;
    bool touched;
  };

  std::vector<Spring> springs_;
  double core_ = 0, core_origin_ = 0;
  double indentation_ = 0, x_ = 0, released_ = 0, work_ = 0;
};

}  // namespace salebra_test
