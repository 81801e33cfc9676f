// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/oscillation.hpp>

#include "damping/phase_quadrature.hpp"

// The loss of a slow tangential motion, W = 2(v/ω)²[2∫θK_t dθ − π²K_t(δ − u_z)], from K of
// independently solved contacts, with K_t = (G*/E*)K. Cells enter one at a time, so K is a
// staircase; over few of its steps the loss is that of the parabola through them.
namespace salebra {

/// W of a parabola through K at equal angles of a window, with its standard error, J.
struct WorkOfParabola {
  double work = 0, error = 0;
};

/// K of contacts at equal angles of a window, each solved without an initial guess.
inline Eigen::VectorXd separate_stiffnesses(const Surface& surface, double contact_modulus,
                                            double center, double half, int nodes,
                                            Boundary boundary = Boundary::periodic) {
  Eigen::VectorXd found(nodes + 1);
  for (int k = 0; k <= nodes; ++k) {
    NormalContactOptions options{.tolerance = 1e-12, .boundary = boundary};
    const NormalContactState state =
        press(surface, contact_modulus,
              at_indentation(center + half * std::cos(std::numbers::pi * k / nodes)), options);
    found(k) = state.converged() ? normal_stiffness(state, surface.grid, contact_modulus, options)
                                 : std::numeric_limits<double>::quiet_NaN();
  }
  return found;
}

inline WorkOfParabola work_of_parabola(const Eigen::VectorXd& stiffness, double half,
                                       double modulus_ratio, const Drag& motion) {
  const Index nodes = stiffness.size() - 1;
  Eigen::MatrixXd powers(nodes + 1, 3);
  for (Index k = 0; k <= nodes; ++k)
    for (int power = 0; power < 3; ++power)
      powers(k, power) = std::pow(std::cos(std::numbers::pi * double(k) / double(nodes)), power);
  // W is linear in the coefficients.
  Eigen::Vector3d of_power;
  for (int power = 0; power < 3; ++power)
    of_power(power) = modulus_ratio * detail::loss_of(motion, [&](double theta) {
                        return std::pow(motion.normal_amplitude / half * std::cos(theta), power);
                      });
  const Eigen::VectorXd parabola = powers.colPivHouseholderQr().solve(stiffness);
  const double variance = (stiffness - powers * parabola).squaredNorm() / double(nodes + 1 - 3);
  return {of_power.dot(parabola),
          std::sqrt(variance * of_power.dot((powers.transpose() * powers).ldlt().solve(of_power)))};
}

}  // namespace salebra
