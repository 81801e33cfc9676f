// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/joint.hpp>
#include <vector>

namespace salebra::detail {

/// One period of the steady motion of a joint, whose last sample is the first again.
struct JointLoop {
  std::vector<double> displacement, tangential_force;  // m, N
};

/// The loop whose half ranges and loss joint_loss() returns, from the middle of the displacement or
/// from a force of zero on. Arguments and exceptions are those of joint_loss().
JointLoop joint_loop(const ContactLaw& law, double indentation, const JointMotion& motion,
                     double friction_coefficient, int steps, const Progress& on_progress);

}  // namespace salebra::detail
