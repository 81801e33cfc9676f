// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>

namespace salebra {

struct CoupledContactOptions {
  SlidingContactOptions sliding = {};
  NormalContactOptions contact = {};  ///< contact.boundary must equal sliding.stick.boundary
  /// Constant β/(πE*) of the coupling, 1/Pa, for example coupling_constant() of the two bodies.
  /// Default: coupling_constant(material).
  std::optional<double> coupling_constant = {};
  /// In each increment, sweeps (a normal and a tangential solve in turn) stop when the estimated
  /// remaining change is below this tolerance, 1e-12 to 1e-1. The change of one sweep is (Σ|Δp| +
  /// Σ|Δτ|)/Σp; the remaining change is the sum over all later sweeps, extrapolated from the last
  /// two.
  double tolerance = 1e-6;
  int max_sweeps = 60;  ///< limit per increment, >= 1
};

/// Report on one increment of a coupled contact.
struct CoupledReport {
  int sweeps = 0;
  double change = 0;  ///< change (Σ|Δp| + Σ|Δτ|)/Σp of the last sweep
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
/// In each increment two solves alternate until nothing changes (Panagiotopoulos): a normal solve
/// for the heights lowered by the normal displacement u_z[τ] due to the tractions, and a
/// partial-slip solve with the tangential displacement u_t[p] due to the pressures. The error falls
/// by a factor of about β² per sweep or faster. For β = 0 the result equals that of SlidingContact
/// with the pressures of press(), after two sweeps.
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

  /// The frictional part of the contact: pressures, tractions, slip and losses.
  const SlidingContact& sliding() const;
  double indentation() const;   ///< m
  double normal_force() const;  ///< N
  /// Elastic energy ½∫(p u_z + τ·u_t) dA, J, where u_z and u_t include the displacements due to the
  /// coupling.
  double stored_energy() const;
  double normal_work() const;  ///< ∫F dδ since the start by the trapezoidal rule, J
  /// Part of normal_work(), J, that the trapezoidal rule assigns to cells that touch during only
  /// part of an increment, while their gap g closes or opens: ½Σ∫p g dA over the increments. Total
  /// work minus gap_work() equals stored energy plus losses within the tolerance of the sweeps.
  /// gap_work() vanishes for small increments unless cells separate at a finite pressure.
  double gap_work() const;
  Termination termination() const;  ///< worst over all increments and their solves

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace salebra
