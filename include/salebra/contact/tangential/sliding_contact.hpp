// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/tangential/partial_slip.hpp>
#include <vector>

namespace salebra {
namespace detail {
class TangentialWorkspace;
}  // namespace detail

struct SlidingContactOptions {
  /// μ >= 0: |τ| <= μp in every cell; infinite: full stick.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  /// Tangential displacement, m, > 0, for example the range of the motion; stick.tolerance is
  /// relative to it.
  double motion_scale = 1;
  StickOptions stick = {.tolerance = 1e-8};
};

/// A rigid tangential displacement of the body, m.
struct TangentialMove {
  double x = 0;
  double y = 0;
};

/// Complete history of a sliding contact between increments.
struct SlidingState {
  Field contact_pressure;                   ///< (nx, ny), Pa
  TangentialField shift;                    ///< displacement that τ does not cause (coupling), m
  TangentialField traction;                 ///< τ, Pa
  TangentialField displacement;             ///< displacement of the cells in contact, m; includes
                                            ///< `shift`
  Field pressure_before;                    ///< pressure before the last increment, Pa
  TangentialField traction_before;          ///< traction before the last increment, Pa
  double last_move_x = 0, last_move_y = 0;  ///< move of the last increment, m
  Field loss;                               ///< loss since the start, J in each cell
  /// The kernels are ready for all contacts within these cells; the rounding of results depends on
  /// this set.
  ContactSet prepared;
  double motion_scale = 1;  ///< SlidingContactOptions::motion_scale of later increments, m
  Index slipping = 0;       ///< cells at their limit after the last increment
  double work = 0;          ///< ∫F dx since the start, J
  double released = 0;      ///< part of the sum of `loss` released by opening cells, J
  Termination termination = Termination::converged;  ///< worst over all increments
  long iterations = 0;
  long fft_count = 0;
};

constexpr void describe(auto&& visit, std::type_identity<SlidingState>) {
  using enum Dimension;
  using S = SlidingState;
  visit(&S::contact_pressure, Kept{"contact_pressure", "contact pressure", pressure});
  visit(&S::shift, Kept{"shift", "displacement by other causes", length});
  visit(&S::traction, Kept{"traction", "shear traction", pressure});
  visit(&S::displacement, Kept{"displacement", "displacement of cells in contact", length});
  visit(&S::pressure_before,
        Kept{"pressure_before", "contact pressure before the last increment", pressure});
  visit(&S::traction_before,
        Kept{"traction_before", "shear traction before the last increment", pressure});
  visit(&S::last_move_x, Kept{"last_move_x", "last move of the body along x", length});
  visit(&S::last_move_y, Kept{"last_move_y", "last move of the body along y", length});
  visit(&S::loss, Kept{"loss", "energy dissipated in each cell since the start", energy});
  visit(&S::prepared, Kept{"prepared", "1 within the window of the kernels"});
  visit(&S::motion_scale,
        Kept{"motion_scale", "displacement that the tolerance refers to", length});
  visit(&S::slipping, Kept{"slipping", "cells at their limit"});
  visit(&S::work, Kept{"work", "work of the tangential force", energy});
  visit(&S::released, Kept{"released", "energy dissipated by cells as they opened", energy});
  visit(&S::termination, Kept{"termination", "how the increments ended"});
  visit(&S::iterations, Kept{"iterations", "iterations so far"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms so far, in pairs"});
}

/// Rough contact with friction and memory of the displacement of each cell:
///     SlidingContact contact(grid, material, {.friction_coefficient = 0.3, .motion_scale = 1e-9});
///     contact.advance(state.contact_pressure, {.x = 1e-9});
/// Each increment (a new pressure field and a simultaneous move of the body) leads from one
/// equilibrium to the next and is solved implicitly as by PartialSlipSolver:
///     stay      a cell that sticks keeps its displacement relative to the body; one that slips has
///               |τ| = μp along its slip
///     leave     p = 0 and so τ = 0; at finite μ the cell slips while its pressure falls
///     enter     a cell enters during the increment, with the displacement that the cells already
///               in contact have caused by then, and sticks to the body from that moment. Entries
///               are spread over the increment in the order of the cells' pressures: if all cells
///               entered in the middle of the increment, those with the smallest pressures would
///               slip although they should stick
/// An increment of any size gives Cattaneo and Mindlin's solution as long as the slipping part only
/// grows during it; along a smooth path the error is of second order in the increments. (Changing
/// pressures and position in turn instead of together, as is possible in full stick, would give a
/// first-order error: a body that moves back while its load falls would ratchet.) Energies are sums
/// over increments by the trapezoidal rule, in which work, stored energy and losses balance to the
/// tolerance of the solver.
class SlidingContact {
 public:
  /// body: a Material, or any Body, which must be under a periodic surface. Throws InvalidInput for a
  /// bad grid or option, or a body without tangential constants.
  SlidingContact(const Grid2D& grid, const Body& body, const SlidingContactOptions& options = {});

  SlidingContact(SlidingContact&&) noexcept;
  SlidingContact& operator=(SlidingContact&&) noexcept;
  ~SlidingContact();

  /// Candidate state after an increment, with a report on its solve. Arrays contain the values of
  /// the cells listed in `cells` only. Arrays of vectors have the shape (components × cells): first
  /// all x components and, with hold_lateral, then all y components.
  struct Increment {
    /// Indices ix·ny + iy, increasing, of the cells in contact before or after the increment.
    std::vector<Index> cells;
    std::vector<double> contact_pressure;     ///< (cells), Pa
    std::vector<double> traction;             ///< Pa
    std::vector<double> traction_halfway;     ///< traction that determined the displacement of
                                              ///< entering cells, Pa
    std::vector<double> displacement;         ///< displacement of the cells, m; includes `shift`
    std::vector<double> displacement_before;  ///< displacement before the increment, m
    std::vector<double> slip;                 ///< slip of the body over the cells, m
    /// Displacement that τ does not cause, at the end of the increment, m; empty: unchanged.
    std::optional<TangentialField> shift;
    TangentialMove move;
    PartialSlipReport report;
  };
  /// Computes an increment without accepting it.
  /// shift   tangential displacement of the surface at the end of the increment that is caused by
  ///         the pressures (coupling), not by τ; nullptr: unchanged
  /// guess   increment to start from: an earlier attempt or foreseen(); nullptr: foreseen(move)
  Increment attempt(const Field& pressure, const TangentialMove& move,
                    const TangentialField* shift = nullptr, const Increment* guess = nullptr);
  /// Makes the increment part of the history.
  void accept(Increment increment);
  /// Predicts the next increment of a smooth path: repeats the changes of the last increment,
  /// scaled by the ratio of the new move to the last move. `step` and `last_step` are the new and
  /// the last change of the indentation, m, if it changes too. Only the pressures and tractions of
  /// the result are set.
  Increment foreseen(const TangentialMove& move, double step = 0, double last_step = 0) const;
  /// Calls attempt() and accept().
  PartialSlipReport advance(const Field& pressure, const TangentialMove& move = {});

  /// Sets the steady state of sliding along (direction.x, direction.y) at these pressures: τ = μp
  /// in that direction in every cell, without lateral slip. Resets work and losses to 0. Cost: 2
  /// transform pairs. Throws InvalidInput if μ is infinite or the direction is 0.
  void slide(const Field& pressure, const TangentialMove& direction);

  /// Sets the motion_scale of future increments, > 0, m.
  void set_motion_scale(double scale);

  /// Prepares the kernels for every contact within `largest`, so that later increments need not
  /// rebuild them.
  void reserve(const ContactSet& largest);

  SlidingState state() const;
  /// Continues from the state of a contact with the same grid, material and options. Throws
  /// InvalidInput for another grid.
  void restore(SlidingState state);

  const Field& contact_pressure() const { return state_.contact_pressure; }
  const TangentialField& traction() const { return state_.traction; }
  TangentialMove tangential_force() const;  ///< of the body on the surface, N
  /// Return the tangential force (N), the pressures (Pa) and the tractions (Pa) after an increment
  /// that was not yet accepted.
  TangentialMove tangential_force(const Increment& increment) const;
  Field contact_pressure(const Increment& increment) const;
  TangentialField traction(const Increment& increment) const;
  Index slipping() const {
    return state_.slipping;
  }  ///< cells at their limit after the last increment
  /// Elastic energy ½∫τ·(u − shift) dA, J: u is the displacement, shift the part of u that τ does
  /// not cause.
  double stored_energy() const;
  double tangential_energy() const;  ///< ½∫τ·u dA with the full displacement u, J
  /// ∫F dx since the start, J; a cell that enters during an increment counts from its entry.
  double work() const { return state_.work; }
  /// Frictional loss ∫τ·ds since the start, (nx, ny), J in each cell: by slip and, if a cell
  /// separates with a traction, by its release.
  const Field& loss() const { return state_.loss; }
  /// Part of the total of loss(), J, that is released when cells open with a traction: all of it
  /// for μ = ∞; for finite μ it vanishes for small increments, because the traction of a cell slips
  /// to zero before the cell opens.
  double released_energy() const { return state_.released; }
  Termination termination() const { return state_.termination; }  ///< worst over all increments
  long iterations() const { return state_.iterations; }
  long fft_count() const { return state_.fft_count; }

 private:
  class Attempt;

  void require_pressure(const Field& pressure) const;
  double limit(double pressure) const;
  void note_cells();

  double cell_area_;
  SlidingContactOptions options_;
  std::unique_ptr<detail::TangentialWorkspace> workspace_;
  SlidingState state_;
  std::vector<Index> cells_;  // in contact before or after the last increment
};

}  // namespace salebra
