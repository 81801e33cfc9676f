// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>

namespace salebra {

struct CoupledContactOptions {
  SlidingContactOptions sliding = {};
  NormalContactOptions contact = {};  ///< its boundary must be that of sliding.stick
  /// β/(πE*), 1/Pa, such as coupling_constant() of the two bodies; default:
  /// coupling_constant(material).
  std::optional<double> coupling_constant = {};
  /// The sweeps stop when the remaining (Σ|Δp| + Σ|Δτ|)/Σp is < tolerance, 1e-12 … 1e-1. It is the
  /// sum of the changes to come, extrapolated from the decrease of the last two.
  double tolerance = 1e-6;
  int max_sweeps = 60;  ///< per increment, >= 1
};

/// Report on one increment of a coupled contact.
struct CoupledReport {
  int sweeps = 0;
  double change = 0;  ///< (Σ|Δp| + Σ|Δτ|)/Σp of the last sweep
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

/// Complete history of a coupled contact between increments.
struct CoupledState {
  SlidingState sliding;
  double last_step = 0;                              ///< last change of the indentation, m
  Field gap;                                         ///< (nx, ny), m
  double indentation = 0;                            ///< m
  double normal_work = 0;                            ///< ∫F dδ since the start, J
  double gap_work = 0;                               ///< gap_work() since the start, J
  Termination termination = Termination::converged;  ///< worst over all increments
};

constexpr void describe(auto&& visit, std::type_identity<CoupledState>) {
  using enum Dimension;
  using S = CoupledState;
  visit(&S::sliding, Part{"sliding", "tractions and slip"});
  visit(&S::last_step, Kept{"last_step", "last change of the indentation", length});
  visit(&S::gap, Kept{"gap", "gap between the deformed surfaces", length});
  visit(&S::indentation, Kept{"indentation", "indentation", length});
  visit(&S::normal_work, Kept{"normal_work", "work of the normal force", energy});
  visit(&S::gap_work, Kept{"gap_work", "work across gaps", energy});
  visit(&S::termination, Kept{"increments_termination", "how the increments ended"});
}

/// Rough contact with friction and normal–tangential coupling (Dundurs' β), advanced through its
/// history:
///     CoupledContact contact(surface, material, {.sliding = {.friction_coefficient = 0.3}});
///     contact.advance(2e-9, {.x = 1e-9});
/// In each increment a normal solve on the heights lowered by u_z[τ] alternates with a partial-slip
/// solve with the displacement u_t[p] until nothing changes (Panagiotopoulos); the error falls by a
/// factor of about β² per sweep or faster. For β = 0 it equals SlidingContact on the pressures of
/// press, in two sweeps.
class CoupledContact {
 public:
  /// Throws InvalidInput for a bad surface, material or option.
  CoupledContact(const Surface& surface, const Material& material,
                 const CoupledContactOptions& options = {});
  CoupledContact(CoupledContact&&) noexcept;
  CoupledContact& operator=(CoupledContact&&) noexcept;
  ~CoupledContact();

  /// Moves to a rigid approach, m, measured from the first touch of the undeformed bodies, while
  /// the body moves tangentially. Cost: sweeps × (a normal solve from the previous state and one or
  /// two partial-slip solves).
  CoupledReport advance(double indentation, const TangentialMove& move = {});

  CoupledState state() const;
  /// Continues from the state of a contact with the same surface, material and options. Throws
  /// InvalidInput for another grid.
  void restore(CoupledState state);

  /// Pressures, tractions, slip and losses.
  const SlidingContact& sliding() const;
  double indentation() const;   ///< m
  double normal_force() const;  ///< N
  /// ½∫(p u_z + τ·u_t) dA with all displacements, J
  double stored_energy() const;
  double normal_work() const;  ///< ∫F dδ since the start by the trapezoidal rule, J
  /// Part of normal_work(), J, that the trapezoidal rule assigns to cells that touch during only
  /// part of an increment, while their gap closes or opens: ½Σ∫p g. Work minus this, stored energy
  /// and losses balance to the tolerance of the sweeps. It vanishes for small increments unless
  /// cells separate at a finite pressure.
  double gap_work() const;
  Termination termination() const;  ///< worst over all increments and their solves

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace salebra
