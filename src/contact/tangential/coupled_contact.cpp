// SPDX-License-Identifier: GPL-3.0-or-later
// Frictional contact with Dundurs coupling: alternates a solve for pressures and one for tractions
// (together a sweep) until pressures and tractions no longer change.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <salebra/contact/tangential/coupled_contact.hpp>
#include <utility>

namespace salebra {
namespace {

// Accuracy of the solves of a sweep. The looseness of a solve, its residual in units of its own
// tolerance, is this fraction of the change of the previous sweep in units of the sweeps'
// tolerance. Most sweeps change a thirtieth of what the previous one changed; the fourth is then
// the first whose solves are as accurate as the options require, and the last.
constexpr double inner_share = 0.005;
constexpr double loosest_contact = 1e-2;
constexpr double first_looseness = 1000;
// Bounds of the ratio of the changes of two successive sweeps. A smaller ratio was luck and a
// larger one round-off: the error falls by the square of Dundurs' constant β, β² < 1/4, per sweep.
constexpr double min_fall = 0.1, max_fall = 0.99;

}  // namespace

struct CoupledContact::Parts {
  Surface surface;
  double contact_modulus;
  CoupledContactOptions options;
  double highest;
  double dundurs;
  NormalTangentialCoupling coupling;
  SlidingContact sliding;
  CoupledState kept;  // without the state of `sliding`

  Parts(const Surface& given, const Material& material, const CoupledContactOptions& wanted)
      : surface(given),
        contact_modulus(material.contact_modulus),
        options(wanted),
        highest(given.heights.maxCoeff()),
        dundurs(dundurs_constant(material.contact_modulus, wanted.coupling_constant
                                                               ? *wanted.coupling_constant
                                                               : coupling_constant(material))),
        coupling(given.grid,
                 wanted.coupling_constant ? *wanted.coupling_constant : coupling_constant(material),
                 wanted.contact.boundary),
        sliding(given.grid, material, wanted.sliding) {
    kept.gap = highest - given.heights;
  }

  double force() const { return surface.grid.cell_area() * sliding.contact_pressure().sum(); }

  // Presses a surface that the tractions have lowered by `sunk` to the rigid approach `approach`.
  // Cells in `out` stay out of the contact, so that the other cells carry their load; the gap of
  // such a cell may be below 0.
  NormalContactState press(double approach, const Field& sunk, Field guess, const ContactSet& out,
                           double looseness) const {
    Surface lowered{surface.grid, surface.heights - sunk, surface.periodic, surface.origin};
    const double depth =
        std::abs(approach) + lowered.heights.maxCoeff() - lowered.heights.minCoeff();
    lowered.heights -= out.select(Field::Constant(out.rows(), out.cols(), depth), 0.0);
    guess = out.select(0.0, guess);
    NormalContactOptions contact = options.contact;
    contact.tolerance = std::min(loosest_contact, contact.tolerance * looseness);
    if ((guess > 0).any()) contact.initial_pressure = &guess;
    const double from_first_touch = approach + lowered.heights.maxCoeff() - highest;
    if (!(from_first_touch > 0)) {
      NormalContactState apart;
      apart.contact_pressure = Field::Zero(surface.grid.nx, surface.grid.ny);
      apart.gap = highest - (surface.heights - sunk) - approach;
      apart.termination = Termination::converged;
      return apart;
    }
    NormalContactState state =
        salebra::press(lowered, contact_modulus, at_indentation(from_first_touch), contact);
    state.gap = out.select(state.gap - depth, state.gap);
    return state;
  }
};

CoupledContact::CoupledContact(const Surface& surface, const Material& material,
                               const CoupledContactOptions& options) {
  surface.require_complete("a contact");
  require(options.tolerance >= 1e-12 && options.tolerance <= 0.1, "tolerance", options.tolerance,
          "must lie in 1e-12 … 0.1");
  require(options.max_sweeps >= 1, "max_sweeps", options.max_sweeps, "must be >= 1");
  if (options.contact.boundary != options.sliding.stick.boundary)
    throw InvalidInput(
        "boundary", "differs between the normal and the tangential solves; give the same for both");
  parts_ = std::make_unique<Parts>(surface, material, options);
}
CoupledContact::CoupledContact(CoupledContact&&) noexcept = default;
CoupledContact& CoupledContact::operator=(CoupledContact&&) noexcept = default;
CoupledContact::~CoupledContact() = default;

CoupledReport CoupledContact::advance(double indentation, const TangentialMove& move) {
  Parts& p = *parts_;
  const double force_before = p.force();
  // The displacements by coupling are small if the contact is small, and the sweeps end only if the
  // solves resolve these displacements.
  const double scale =
      std::hypot(move.x, move.y) + std::abs(p.dundurs) * std::max(indentation, 0.0);
  const double motion_scale =
      scale > 0 ? std::min(p.options.sliding.motion_scale, scale) : p.options.sliding.motion_scale;
  CoupledReport report;
  const double step = indentation - p.kept.indentation;
  SlidingContact::Increment increment = p.sliding.foreseen(move, step, p.kept.last_step);
  Field pressure = p.sliding.contact_pressure(increment);
  TangentialField traction = p.sliding.traction(increment);
  Field gap;
  Termination solved = Termination::iteration_limit;
  // Without a friction limit a cell at the edge may carry traction in every second sweep only,
  // without end. After this many sweeps, a cell that leaves the contact stays out.
  constexpr int patience = 8;
  ContactSet barred = ContactSet::Constant(p.surface.grid.nx, p.surface.grid.ny, false);
  bool still = false;
  double looseness = p.dundurs == 0 ? 1 : first_looseness;
  while (!still && report.sweeps < p.options.max_sweeps) {
    // Solves become more accurate from sweep to sweep; those of the last sweeps are as accurate as
    // the options require.
    if (report.sweeps > 0)
      looseness = std::clamp(inner_share * report.change / p.options.tolerance, 1.0, looseness);
    p.sliding.set_motion_scale(looseness * motion_scale);
    NormalContactState state =
        p.press(indentation, p.coupling.normal_displacement(traction), pressure, barred, looseness);
    if (report.sweeps > patience) barred = barred || (pressure > 0 && state.contact_pressure <= 0);
    const TangentialField shift = p.coupling.tangential_displacement(state.contact_pressure);
    increment = p.sliding.attempt(state.contact_pressure, move, &shift, &increment);
    TangentialField next = p.sliding.traction(increment);
    const double change = (state.contact_pressure - pressure).abs().sum() +
                          (next.x - traction.x).abs().sum() + (next.y - traction.y).abs().sum();
    pressure = std::move(state.contact_pressure);
    traction = std::move(next);
    const double total = pressure.sum();
    gap = std::move(state.gap);
    solved = std::max(state.termination, increment.report.termination);
    const double before = report.change;
    report.change = total > 0 ? change / total : 0;
    ++report.sweeps;
    // If the changes of all further sweeps fall in the same ratio, their sum must be below the
    // tolerance. A ratio near 1 means that the change is the solvers' own error, below which no
    // change can be required.
    const double fall = std::min(max_fall, std::max(min_fall, report.change / before));
    still = looseness == 1 && report.sweeps > 1 &&
            report.change * fall < (1 - fall) * p.options.tolerance;
    if (solved == Termination::interrupted) break;
  }
  report.termination = still ? solved : std::max(solved, Termination::iteration_limit);
  CoupledState& now = p.kept;
  now.termination = std::max(now.termination, report.termination);
  const Field& last = p.sliding.contact_pressure();
  const Field across =
      (last <= 0).select(pressure * now.gap, 0.0) - (pressure <= 0).select(last * gap, 0.0);
  now.gap_work += p.surface.grid.cell_area() / 2 * across.sum();
  now.gap = std::move(gap);
  p.sliding.accept(std::move(increment));
  now.normal_work += (force_before + p.force()) / 2 * step;
  now.indentation = indentation;
  now.last_step = step;
  return report;
}

CoupledState CoupledContact::state() const {
  CoupledState state = parts_->kept;
  state.sliding = parts_->sliding.state();
  return state;
}

void CoupledContact::restore(CoupledState state) {
  Parts& p = *parts_;
  require(state.gap.rows() == p.surface.grid.nx && state.gap.cols() == p.surface.grid.ny, "state",
          state.gap.size(),
          "cells do not match the grid; resume with the settings of the first run");
  p.sliding.restore(std::move(state.sliding));
  p.kept = std::move(state);
}

const SlidingContact& CoupledContact::sliding() const { return parts_->sliding; }
double CoupledContact::indentation() const { return parts_->kept.indentation; }
double CoupledContact::normal_force() const { return parts_->force(); }
double CoupledContact::normal_work() const { return parts_->kept.normal_work; }
double CoupledContact::gap_work() const { return parts_->kept.gap_work; }
Termination CoupledContact::termination() const { return parts_->kept.termination; }

double CoupledContact::stored_energy() const {
  const Parts& p = *parts_;
  // In contact the displaced surface coincides with the rigid body.
  const Field normal =
      p.sliding.contact_pressure() * (p.kept.indentation - (p.highest - p.surface.heights));
  return p.sliding.tangential_energy() + p.surface.grid.cell_area() / 2 * normal.sum();
}

}  // namespace salebra
