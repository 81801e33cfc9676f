// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential contact with Coulomb friction in increments of pressure and of the rigid displacement.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <utility>
#include <vector>

#include "disc_problem.hpp"

namespace salebra {
namespace {

TangentialField zero(const Grid2D& grid) {
  return {Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
}

Field dot(const TangentialField& a, const TangentialField& b) { return a.x * b.x + a.y * b.y; }

TangentialField mean(const TangentialField& a, const TangentialField& b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

// a + part · move on `where`, 0 elsewhere.
TangentialField moved(const TangentialField& a, const TangentialMove& move, double part,
                      const ContactSet& where) {
  return {where.select(a.x + part * move.x, 0.0), where.select(a.y + part * move.y, 0.0)};
}

void validate(const SlidingContactOptions& options) {
  require(options.friction_coefficient >= 0, "friction_coefficient", options.friction_coefficient,
          "must be >= 0 (infinity: full stick)");
  require_positive(options.motion_scale, "motion_scale");
}

Field limit_of(const Field& pressure, double friction) {
  if (std::isfinite(friction)) return friction * pressure;
  return (pressure > 0).select(Field::Constant(pressure.rows(), pressure.cols(), friction), 0.0);
}

// A start for tractions within other limits than those that they were found for: where they were at
// their limit they are at the new one, and slip as they did.
void carry_to_limit(TangentialField& traction, const Field& limit_before, const Field& limit) {
  for (Index k = 0; k < limit.size(); ++k) {
    double &x = traction.x.data()[k], &y = traction.y.data()[k];
    const double size = std::sqrt(x * x + y * y);
    if (!(size > 0) || size < (1 - detail::limit_round_off) * limit_before.data()[k]) continue;
    x *= limit.data()[k] / size;
    y *= limit.data()[k] / size;
  }
}

// Where cells enter is known to the square of an increment only. The solve that says it may leave so
// many times what others may, as long as this is a small part of the motion.
double entry_looseness(double tolerance) { return std::clamp(1e-4 / tolerance, 1.0, 100.0); }

// For how much of an increment the entering cells were in contact, 0 … 1: half of it on average.
// Near the edge of a contact p² grows in proportion to the indentation, so that the part is c p²
// where that is less than 1.
Field part_in_contact(const Field& pressure, const ContactSet& entering) {
  const Field squared = entering.select(pressure.square(), 0.0);
  std::vector<double> squares;
  for (Index k = 0; k < squared.size(); ++k)
    if (entering.data()[k]) squares.push_back(squared.data()[k]);
  const Eigen::Map<const Eigen::ArrayXd> some(squares.data(), static_cast<Index>(squares.size()));
  double low = 0, high = 1 / some.minCoeff();
  for (int halving = 0; halving < 100; ++halving) {
    const double factor = (low + high) / 2;
    ((factor * some).min(1.0).sum() < static_cast<double>(some.size()) / 2 ? low : high) = factor;
  }
  return (high * squared).min(1.0);
}

}  // namespace

SlidingContact::SlidingContact(const Grid2D& grid, const Material& material,
                               const SlidingContactOptions& options)
    : cell_area_(grid.cell_area()),
      options_(options),
      solver_(grid, material, options.stick),
      contact_(ContactSet::Constant(grid.nx, grid.ny, false)) {
  state_.contact_pressure = state_.pressure_before = state_.loss = Field::Zero(grid.nx, grid.ny);
  state_.shift = state_.traction = state_.traction_before = state_.displacement = zero(grid);
  validate(options);
  state_.motion_scale = options.motion_scale;
}

void SlidingContact::set_motion_scale(double scale) {
  require_positive(scale, "motion_scale");
  state_.motion_scale = scale;
}

void SlidingContact::restore(SlidingState state) {
  for (const Field* field :
       {&state.contact_pressure, &state.loss, &state.shift.x, &state.shift.y, &state.traction.x,
        &state.traction.y, &state.displacement.x, &state.displacement.y, &state.pressure_before,
        &state.traction_before.x, &state.traction_before.y})
    require(field->rows() == contact_.rows() && field->cols() == contact_.cols(), "state",
            field->size(), "cells do not match the grid; resume with the run's own settings");
  require_positive(state.motion_scale, "motion_scale");
  state_ = std::move(state);
  if (state_.prepared.size() > 0) reserve(state_.prepared);
  contact_ = limit_of(state_.contact_pressure, options_.friction_coefficient) > 0;
}

SlidingState SlidingContact::state() const {
  SlidingState state = state_;
  state.prepared = solver_.prepared();
  return state;
}

void SlidingContact::reserve(const ContactSet& largest) { solver_.reserve(largest); }

TangentialField SlidingContact::displacement_under(const ContactSet& loaded,
                                                   const TangentialField& traction,
                                                   const TangentialField& shift,
                                                   const ContactSet& where) {
  TangentialField displacement = solver_.displacement(loaded, traction, where);
  state_.fft_count += 2;
  displacement.x += where.select(shift.x, 0.0);
  displacement.y += where.select(shift.y, 0.0);
  return displacement;
}

// Half of the increment with the cells that are in contact already: where it takes those that enter
// in its middle.
TangentialField SlidingContact::displacement_halfway(const TangentialMove& move,
                                                     const TangentialField& shift,
                                                     const ContactSet& entering,
                                                     Increment& increment) {
  const TangentialField halfway = mean(state_.shift, shift);
  TangentialField target = moved(state_.displacement, move, 0.5, contact_), slip;
  target.x -= contact_.select(halfway.x, 0.0);
  target.y -= contact_.select(halfway.y, 0.0);
  const PartialSlipReport report =
      solver_.solve(limit_of(state_.contact_pressure, options_.friction_coefficient), target,
                    entry_looseness(options_.stick.tolerance) * state_.motion_scale,
                    increment.traction_halfway, slip);
  count(report);
  increment.report.termination = report.termination;
  return displacement_under(contact_, increment.traction_halfway, halfway, entering);
}

void SlidingContact::require_pressure(const Field& pressure) const {
  require(pressure.rows() == state_.contact_pressure.rows() &&
              pressure.cols() == state_.contact_pressure.cols(),
          "pressure", pressure.size(), "values do not match the grid; give nx × ny values");
  require((pressure >= 0).all(), "pressure", pressure.minCoeff(), "must be >= 0 in every cell");
}

void SlidingContact::slide(const Field& pressure, const TangentialMove& direction) {
  require_pressure(pressure);
  require(std::isfinite(options_.friction_coefficient), "friction_coefficient",
          options_.friction_coefficient, "never slides; give a finite one");
  require(options_.stick.hold_lateral || direction.y == 0, "direction", direction.y,
          "along y must be 0 where the lateral displacement is free; turn the surface instead");
  const double length = std::hypot(direction.x, direction.y);
  require_positive(length, "direction");
  const Field limit = limit_of(pressure, options_.friction_coefficient);
  contact_ = limit > 0;
  state_.contact_pressure = pressure;
  state_.traction = {limit * (direction.x / length), limit * (direction.y / length)};
  state_.displacement = displacement_under(contact_, state_.traction, state_.shift, contact_);
  state_.last_move_x = state_.last_move_y = 0;
  state_.loss.setZero();
  state_.work = state_.released = 0;
  state_.slipping = contact_.count();
}

SlidingContact::Increment SlidingContact::attempt(const Field& pressure, const TangentialMove& move,
                                                  const TangentialField* shift,
                                                  const Increment* guess) {
  require_pressure(pressure);
  require(options_.stick.hold_lateral || move.y == 0, "move", move.y,
          "along y must be 0 where the lateral displacement is free; turn the surface instead");
  const Field limit = limit_of(pressure, options_.friction_coefficient);
  const ContactSet contact = limit > 0, entering = contact && !contact_;
  Increment increment{.contact_pressure = pressure,
                      .shift = shift ? *shift : state_.shift,
                      .traction = guess ? guess->traction : state_.traction,
                      .traction_halfway = guess ? guess->traction_halfway : state_.traction,
                      .displacement = moved(state_.displacement, move, 1, contact && contact_),
                      .displacement_before = state_.displacement,
                      .slip = {},
                      .move = move,
                      .report = {.termination = Termination::converged}};
  if (std::isfinite(options_.friction_coefficient))
    carry_to_limit(increment.traction,
                   limit_of(guess ? guess->contact_pressure : state_.contact_pressure,
                            options_.friction_coefficient),
                   limit);
  if (entering.any()) {
    const TangentialField present =
        displacement_under(contact_, state_.traction, state_.shift, entering);
    increment.displacement_before.x += present.x;
    increment.displacement_before.y += present.y;
    const bool at_rest = !shift && move.x == 0 && move.y == 0;
    const TangentialField halfway =
        at_rest || !contact_.any()
            ? present
            : displacement_halfway(move, increment.shift, entering, increment);
    const Field stay = part_in_contact(pressure, entering);
    // Linear in time before and after the middle.
    const auto enter = [&](const Field& at_start, const Field& in_middle, double distance,
                           Field& displacement) {
      displacement += entering.select(
          in_middle + (1 - 2 * stay) * (in_middle - at_start) + stay * distance, 0.0);
    };
    enter(present.x, halfway.x, move.x, increment.displacement.x);
    enter(present.y, halfway.y, move.y, increment.displacement.y);
  }
  const TangentialField target{increment.displacement.x - increment.shift.x,
                               increment.displacement.y - increment.shift.y};
  const Termination halfway = increment.report.termination;
  increment.report =
      solver_.solve(limit, target, state_.motion_scale, increment.traction, increment.slip);
  count(increment.report);
  increment.report.termination = std::max(increment.report.termination, halfway);
  increment.displacement.x -= increment.slip.x;
  increment.displacement.y -= increment.slip.y;
  return increment;
}

void SlidingContact::count(const PartialSlipReport& report) {
  state_.iterations += report.iterations;
  state_.fft_count += report.fft_count;
}

void SlidingContact::accept(Increment increment) {
  state_.termination = std::max(state_.termination, increment.report.termination);
  state_.slipping = increment.report.slipping;
  const ContactSet contact =
      limit_of(increment.contact_pressure, options_.friction_coefficient) > 0;
  const ContactSet leaving = contact_ && !contact;
  TangentialField relaxed;
  if (leaving.any())
    relaxed = displacement_under(contact, increment.traction, increment.shift, leaving);
  double work = 0, released = 0;
  for (Index k = 0; k < contact.size(); ++k) {
    const bool stayed = contact_.data()[k], stays = contact.data()[k];
    if (!stayed && !stays) continue;
    const auto at = [k](const TangentialField& field) {
      return TangentialMove{field.x.data()[k], field.y.data()[k]};
    };
    const auto by_middle = [before = at(state_.traction), after = at(increment.traction)](
                               double x, double y) {
      return (before.x + after.x) / 2 * x + (before.y + after.y) / 2 * y;
    };
    const TangentialMove& move = increment.move;
    double& loss = state_.loss.data()[k];
    if (!stays) {
      const TangentialMove carried = at(state_.displacement), free = at(relaxed);
      const double let_go =
          cell_area_ * by_middle(carried.x + move.x - free.x, carried.y + move.y - free.y);
      work += by_middle(move.x, move.y);
      loss += let_go;
      released += let_go;
      continue;
    }
    const TangentialMove slip = at(increment.slip);
    loss += cell_area_ * by_middle(slip.x, slip.y);
    if (stayed) {
      work += by_middle(move.x, move.y);
    } else {
      // The body's motion as the cell feels it, from its entry on.
      const TangentialMove end = at(increment.displacement),
                           start = at(increment.displacement_before);
      work += by_middle(end.x + slip.x - start.x, end.y + slip.y - start.y);
    }
  }
  state_.work += cell_area_ * work;
  state_.released += released;
  contact_ = contact;
  state_.pressure_before =
      std::exchange(state_.contact_pressure, std::move(increment.contact_pressure));
  state_.traction_before = std::exchange(state_.traction, std::move(increment.traction));
  state_.shift = std::move(increment.shift);
  state_.displacement = std::move(increment.displacement);
  state_.last_move_x = increment.move.x;
  state_.last_move_y = increment.move.y;
}

SlidingContact::Increment SlidingContact::foreseen(const TangentialMove& move, double step,
                                                   double last_step) const {
  const double x = state_.last_move_x, y = state_.last_move_y;
  const double square = x * x + y * y + last_step * last_step;
  const double along = move.x * x + move.y * y + step * last_step;
  const double part = square > 0 ? std::clamp(along / square, 0.0, 2.0) : 0;
  const auto further = [part](const Field& now, const Field& before) -> Field {
    return now + part * (now - before);
  };
  const TangentialField &now = state_.traction, &before = state_.traction_before;
  Increment guess;
  guess.contact_pressure = further(state_.contact_pressure, state_.pressure_before).max(0.0);
  const ContactSet touching = guess.contact_pressure > 0;
  guess.traction = {touching.select(further(now.x, before.x), 0.0),
                    touching.select(further(now.y, before.y), 0.0)};
  guess.traction_halfway = mean(now, guess.traction);
  return guess;
}

PartialSlipReport SlidingContact::advance(const Field& pressure, const TangentialMove& move) {
  const Increment start = foreseen(move);
  Increment increment = attempt(pressure, move, nullptr, &start);
  const PartialSlipReport report = increment.report;
  accept(std::move(increment));
  return report;
}

TangentialMove SlidingContact::tangential_force() const {
  return {cell_area_ * state_.traction.x.sum(), cell_area_ * state_.traction.y.sum()};
}

double SlidingContact::stored_energy() const {
  const TangentialField elastic{state_.displacement.x - state_.shift.x,
                                state_.displacement.y - state_.shift.y};
  return cell_area_ / 2 * dot(state_.traction, elastic).sum();
}

double SlidingContact::tangential_energy() const {
  return cell_area_ / 2 * dot(state_.traction, state_.displacement).sum();
}

}  // namespace salebra
