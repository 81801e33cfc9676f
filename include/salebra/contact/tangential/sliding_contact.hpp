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
  /// m, > 0: the tangential displacement that the tolerance of `stick` refers to, such as the range
  /// of the motion.
  double motion_scale = 1;
  StickOptions stick = {.tolerance = 1e-8};
};

/// A rigid tangential displacement of the body, m.
struct TangentialMove {
  double x = 0;
  double y = 0;
};

/// All that a sliding contact remembers from one increment to the next.
struct SlidingState {
  Field contact_pressure;                   ///< (nx, ny), Pa
  TangentialField shift;                    ///< displacement by other causes, m
  TangentialField traction;                 ///< Pa
  TangentialField displacement;             ///< of the cells in contact, `shift` included, m
  Field pressure_before;                    ///< at the start of the last increment, Pa
  TangentialField traction_before;          ///< the same, Pa
  double last_move_x = 0, last_move_y = 0;  ///< of the last increment, m
  Field loss;                               ///< since the start, J in each cell
  ContactSet
      prepared;  ///< cells within which no contact rebuilds the kernels, whose rounding depends on
                 ///< it
  double motion_scale = 1;  ///< that of the increments to come, m
  Index slipping = 0;       ///< cells at their limit after the last increment
  double work = 0;          ///< ∫F dx since the start, J
  double released = 0;      ///< of the sum of `loss`, by cells as they opened, J
  Termination termination = Termination::converged;  ///< of all increments
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

/// A rough contact with friction that remembers: where each of its cells has been drawn to. It goes
/// from one state of rest to the next by increments (a new field of pressures and a move of the
/// body, at once), each solved implicitly as by PartialSlipSolver:
///     stay      a cell that sticks keeps its displacement relative to the body; one that slips has
///               |τ| = μp along its slip
///     leave     p = 0 and so τ = 0; at finite μ the cell slips while its pressure goes
///     enter     a cell enters on the way, with the displacement that the others have given it by
///               then, and sticks to the body from there. The entries of an increment are spread
///               over it in the order of their pressures: if all were at the middle, the last ones
///               would slip that ought to stick
/// An increment is exact in the sense of Cattaneo and Mindlin, however large, while the slipping
/// part only grows in it; a smooth path is followed at second order. (Pressures and motion in turn,
/// as a stuck contact allows, would be of first order: a body that moves back while its load falls
/// then ratchets.) Energies are sums over increments by the trapezoidal rule, in which work, stored
/// energy and losses balance to the solver's tolerance.
class SlidingContact {
 public:
  /// Throws InvalidInput for a bad grid or option, or a material without tangential constants.
  SlidingContact(const Grid2D& grid, const Material& material,
                 const SlidingContactOptions& options = {});

  SlidingContact(SlidingContact&&) noexcept;
  SlidingContact& operator=(SlidingContact&&) noexcept;
  ~SlidingContact();

  /// A state that an increment may lead to, and what it costs. Values are of `cells` only, for which
  /// vectors are (components × cells), the components being x and, with hold_lateral, y.
  struct Increment {
    std::vector<Index> cells;              ///< in contact before or after it: ix·ny + iy, rising
    std::vector<double> contact_pressure;  ///< (cells), Pa
    std::vector<double> traction;          ///< Pa
    std::vector<double> traction_halfway;  ///< that led to the entering cells' displacement, Pa
    std::vector<double> displacement;      ///< of the cells, `shift` included, m
    std::vector<double> displacement_before;  ///< the same before the increment, m
    std::vector<double> slip;                 ///< of the body over the cells, m
    /// Displacement by other causes at the end, m; none: as it was.
    std::optional<TangentialField> shift;
    TangentialMove move;
    PartialSlipReport report;
  };
  /// Where an increment would lead.
  /// shift   tangential displacement of the surface by causes other than τ (the coupling to the
  ///         pressures) at the end; nullptr: as it was
  /// guess   an earlier attempt or foreseen() to begin from; nullptr: foreseen(move)
  Increment attempt(const Field& pressure, const TangentialMove& move,
                    const TangentialField* shift = nullptr, const Increment* guess = nullptr);
  void accept(Increment increment);
  /// A guess of where a smooth path leads: what the last increment changed is changed again, as far
  /// as this one goes the same way. `step` and `last_step` are these increments of an indentation
  /// that moves with the body, m. Only pressures and tractions are given.
  Increment foreseen(const TangentialMove& move, double step = 0, double last_step = 0) const;
  /// attempt and accept.
  PartialSlipReport advance(const Field& pressure, const TangentialMove& move = {});

  /// The state after endless sliding along (direction.x, direction.y) at these pressures: τ = μp
  /// that way in every cell, lateral slip having died away. Sets work and losses to 0. Cost: 2 FFT
  /// pairs. Throws InvalidInput where μ is infinite or the direction is 0.
  void slide(const Field& pressure, const TangentialMove& direction);

  /// Another motion_scale for the increments to come, > 0, m.
  void set_motion_scale(double scale);

  /// Prepares the kernels for every contact within `largest`, so that none of them has to rebuild
  /// them.
  void reserve(const ContactSet& largest);

  SlidingState state() const;
  /// Goes on from the state of a contact with the same grid, material and options. Throws
  /// InvalidInput for another grid.
  void restore(SlidingState state);

  const Field& contact_pressure() const { return state_.contact_pressure; }
  const TangentialField& traction() const { return state_.traction; }
  TangentialMove tangential_force() const;  ///< the body's on the surface: x, y in N
  /// What an increment would lead to.
  TangentialMove tangential_force(const Increment& increment) const;
  Field contact_pressure(const Increment& increment) const;
  TangentialField traction(const Increment& increment) const;
  Index slipping() const {
    return state_.slipping;
  }  ///< cells at their limit after the last increment
  /// ½∫τ·(u − shift) dA, J
  double stored_energy() const;
  double tangential_energy() const;  ///< ½∫τ·u dA, the shift included, J
  /// ∫F dx since the start, J; in an increment, a cell that enters counts from its entry.
  double work() const { return state_.work; }
  /// Friction's ∫τ·ds since the start, (nx, ny), J in each cell: by slip and, where a cell leaves
  /// with a traction, by its release.
  const Field& loss() const { return state_.loss; }
  /// The part of the sum of loss() that cells had left in the increment in which they opened, J:
  /// all of it at μ = ∞; at finite μ it vanishes with the increments, since a cell slips to zero
  /// before it opens.
  double released_energy() const { return state_.released; }
  Termination termination() const { return state_.termination; }  ///< of all increments
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
