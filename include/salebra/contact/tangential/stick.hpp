// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/half_space/contact_set.hpp>
#include <salebra/contact/half_space/material.hpp>

namespace salebra {

struct StickOptions {
  /// The solver stops when the rms of (u − u_given) over the contact set is below tolerance ·
  /// scale, with the `scale` of solve(). K_t is a minimum of the energy, so its relative error is
  /// of the order of the tolerance squared. 1e-14 to 1e-1.
  double tolerance = 1e-6;
  int max_iterations = 1000;  ///< limit per solve, >= 1
  Boundary boundary = Boundary::periodic;
  /// true: the displacement perpendicular to the motion is prescribed as 0 too. false: the traction
  /// perpendicular to the motion is 0 instead.
  bool hold_lateral = true;
  Progress on_progress = {};
};

/// Report on a linear solve on a contact set. Unless it converged, its results must not be used.
struct StickReport {
  int iterations = 0;
  int fft_count = 0;         ///< forward-and-backward transforms of a scalar field
  int multilevel_count = 0;  ///< applications of the multilevel kernel, in the preconditioner
  double residual =
      0;  ///< rms of the displacement error over the contact set, in units of the scale
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

/// Full stick on a contact set: computes the tractions that move its cells by given displacements.
///     StickSolver solver(grid, material);
///     const StickReport report = solver.solve(contact, displacement, 1e-9, traction);
/// The tractions τ give the prescribed displacements u on the cells of the contact set A and are 0
/// outside A. Displacements follow from Cerruti's solution, summed over the two bodies i (u_y
/// follows by exchanging x and y; q = |(q_x, q_y)|, û(0) = 0):
///     û_x = Σ_i [1/(G_i q)] [(1 − ν_i q_x²/q²) τ̂_x − (ν_i q_x q_y/q²) τ̂_y]         (periodic)
///     u_x = Σ_i 1/(2πG_i) ∬{[(1−ν_i)/r + ν_i x²/r³] τ_x + ν_i xy/r³ τ_y}          (free)
/// The solver uses conjugate gradients. Its preconditioner inverts the normal response on A with
/// the multilevel kernel (src/contact/README.md, "The multilevel kernel"), or, on grids without
/// such a kernel, a 7 × 7 stencil of |q|. Displacements of a periodic half-space are measured from
/// its mean plane. The coupling to the normal direction (∝ 1 − 2ν) is neglected. Kernels and
/// transforms are kept between calls: a contact set that fits into the window (part of the grid) of
/// an earlier set needs no set-up. Only one thread may use an object at a time. Memory: 45 to 65
/// bytes per cell of the grid (for Boundary::free, of the zero-padded window), and twice as much if
/// half of the cells are in contact.
class StickSolver {
 public:
  /// Throws InvalidInput for a bad grid or option, or a material without tangential constants.
  /// body: a Material, or any Body, which must be under a periodic surface.
  StickSolver(const Grid2D& grid, const Body& body, const StickOptions& options = {});
  StickSolver(StickSolver&&) noexcept;
  StickSolver& operator=(StickSolver&&) noexcept;
  ~StickSolver();

  /// Computes tractions on `contact` that give `displacement` there (values elsewhere are ignored).
  /// `traction` contains a first guess (an empty field: none) and is overwritten, 0 off the
  /// contact. The displacement error is divided by `scale` > 0, m, before it is compared with the
  /// tolerance. With hold_lateral off, only the x components are used: the motion is along x.
  /// Throws InvalidInput if every cell of a periodic grid is in contact, because its stiffness is
  /// not finite.
  StickReport solve(const ContactSet& contact, const TangentialField& displacement, double scale,
                    TangentialField& traction);

  /// Computes displacements in the cells of `where` under tractions on `loaded`; 0 in other cells.
  /// Cost: 2 transform pairs.
  TangentialField displacement(const ContactSet& loaded, const TangentialField& traction,
                               const ContactSet& where);

  /// Prepares the window for every contact set within `largest`, so that later solves need not
  /// rebuild it.
  void reserve(const ContactSet& largest);

 protected:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Tangential stiffness of a contact set in full stick: F_x = xx·x + xy·y, F_y = xy·x + yy·y, N/m.
struct StickStiffness {
  double xx = 0;
  double yy = 0;
  double xy = 0;
  int iterations = 0;        ///< total of the two solves (along x and y)
  int fft_count = 0;         ///< transform pairs of the two solves
  int multilevel_count = 0;  ///< total of the two solves
  double residual = 0;       ///< the larger residual of the two solves
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
  /// Force over displacement along the direction e at an angle from x, rad, if the displacement at
  /// right angles to it is held at 0: e·K·e, N/m.
  double along(double angle) const;
};

constexpr void describe(auto&& visit, std::type_identity<StickStiffness>) {
  using S = StickStiffness;
  visit(&S::xx, Kept{"xx", "force along x over displacement along x", Dimension::stiffness});
  visit(&S::yy, Kept{"yy", "force along y over displacement along y", Dimension::stiffness});
  visit(&S::xy, Kept{"xy", "force along x over displacement along y", Dimension::stiffness});
  visit(&S::iterations, Kept{"iterations", "iterations of both solves"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms of both solves, in pairs"});
  visit(&S::multilevel_count, Kept{"multilevel_count", "applications of the multilevel kernel"});
  visit(&S::residual, Kept{"residual", "rms error of the displacement over the set, relative"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Kept{"converged", "false: do not use the stiffness"});
}

/// Computes K_t of a contact set by two stick solves:
///     const double K_t = stick_stiffness(contact, grid, material).xx;
/// With hold_lateral off, each solve is a motion without traction perpendicular to it, and xy = 0.
/// `along_x_only` solves for one direction (yy = xy = NaN) at half the cost. guess: initial
/// traction along the motion per unit displacement, Pa/m, for example G*/E* times the
/// punch_pressure of normal_stiffness(); empty: none. communicator: processes that share the rows
/// of the set, as for NormalContactState; the call is then collective.
StickStiffness stick_stiffness(const ContactSet& contact, const Grid2D& grid,
                               const Material& material, const StickOptions& options = {},
                               bool along_x_only = false, const Field& guess = {},
                               const Communicator& communicator = {});

/// K_t of a contact set under any body, with displacements measured from the body's datum:
///     const double K_t = stick_stiffness(contact_set(state), surface.grid, coated).xx;
/// û = C_a τ̂ + (C_l − C_a)(q·τ̂) q/q² with the responses of SurfaceCompliance, without the coupling
/// to the normal direction. K_t/K depends on the load, since K_t is never taken from a ratio of
/// moduli. Homogeneous half-spaces have the same bits as with their material. The preconditioner is
/// the stencil of 2/(C_l + C_a), so that the number of iterations grows slowly with the grid. From a
/// base, a periodic surface in full contact is allowed. Throws InvalidInput also for Boundary::free,
/// for a body whose tangential response is not known, and for a table that does not cover the wave
/// numbers of the grid.
StickStiffness stick_stiffness(const ContactSet& contact, const Grid2D& grid, const Body& body,
                               const StickOptions& options = {}, bool along_x_only = false,
                               const Field& guess = {}, const Communicator& communicator = {});

}  // namespace salebra
