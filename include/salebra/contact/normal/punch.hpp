// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/half_space/contact_set.hpp>

namespace salebra {

struct PunchOptions {
  /// The solver stops at this relative error of the displacement; the relative error of K is of the
  /// order of its square. 1e-14 to 1e-1.
  double tolerance = 1e-6;
  int max_iterations = 1000;  ///< >= 1
  Boundary boundary = Boundary::periodic;
  Progress on_progress = {};
};

/// Normal stiffness K = dF/dδ of a contact set, i.e. of a flat punch of that shape.
/// normal_stiffness() in normal.hpp computes K for the elastic cells of a contact state.
struct PunchStiffness {
  double normal_stiffness = 0;  ///< K, N/m
  int iterations = 0;
  int fft_count = 0;  ///< forward-and-backward transform pairs
  /// Applications of the multilevel kernel, each replacing a transform pair.
  int multilevel_count = 0;
  /// Relative rms error of the displacement over the contact set; the relative error of K is of the
  /// order of its square.
  double residual = 0;
  /// `converged` means that K no longer changes by more than the square of the tolerance, or than
  /// 1e-14, relative to K.
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<PunchStiffness>) {
  using S = PunchStiffness;
  visit(&S::normal_stiffness,
        Kept{"normal_stiffness", "normal stiffness dF/d(indentation)", Dimension::stiffness});
  visit(&S::iterations, Kept{"iterations", "iterations of the solver"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms of the solver, in pairs"});
  visit(&S::multilevel_count, Kept{"multilevel_count", "applications of the multilevel kernel"});
  visit(&S::residual, Kept{"residual", "rms error of the displacement over the set, relative"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Kept{"converged", "false: do not use the stiffness"});
}

/// Computes the stiffness of a contact set:
///     const double K = punch_stiffness(contact, grid, 1.1e11).normal_stiffness;
/// pressure, if given, receives the pressure under a unit approach, Pa/m. Throws InvalidInput for a
/// bad grid or option, and if every cell of a periodic grid is in contact. Cost: one transform pair
/// per iteration in float, and one transform pair in double; with the multilevel kernel (press())
/// three transform pairs in total.
PunchStiffness punch_stiffness(const ContactSet& contact, const Grid2D& grid,
                               double contact_modulus, const PunchOptions& options = {},
                               Field* pressure = nullptr);
/// The same on any body, with displacements measured from the body's datum. From a base, every cell
/// may be in contact. Throws InvalidInput as press() on a body does.
PunchStiffness punch_stiffness(const ContactSet& contact, const Grid2D& grid, const Body& body,
                               const PunchOptions& options = {}, Field* pressure = nullptr);

}  // namespace salebra
