// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/joint.hpp>
#include <vector>

namespace salebra::detail {

/// One period of the steady motion of a joint; the last sample repeats the first.
struct JointLoop {
  std::vector<double> displacement, tangential_force;  // m, N
};

/// The loop of displacement and force that belongs to the half ranges and the loss of joint_loss().
/// It begins in the middle of the displacement or, if the force is given, at a force of zero.
/// Arguments and exceptions are those of joint_loss().
JointLoop joint_loop(const ContactLaw& law, double indentation, const JointMotion& motion,
                     double friction_coefficient, int steps, const Progress& on_progress);

/// K_t/K of a whole contact at an indentation, ∫K_t dδ/F: with this slope of the friction limits the
/// springs of a contact that slides as a whole carry μF.
double stiffness_ratio_of_whole(const ContactLaw& law, double indentation);

}  // namespace salebra::detail
