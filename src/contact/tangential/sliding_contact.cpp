// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential contact with Coulomb friction, in increments of pressure and rigid tangential
// displacement.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <utility>
#include <vector>

#include "disc_problem.hpp"
#include "tangential_workspace.hpp"

namespace salebra {
namespace {

using Values = std::vector<double>;

TangentialField zero(const Grid2D& grid) {
  return {Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
}

Field dot(const TangentialField& a, const TangentialField& b) { return a.x * b.x + a.y * b.y; }

void validate(const SlidingContactOptions& options) {
  require(options.friction_coefficient >= 0, "friction_coefficient", options.friction_coefficient,
          "must be >= 0 (infinity: full stick)");
  require_positive(options.motion_scale, "motion_scale");
}

// Factor by which the tolerance of the solve for the displacements of entering cells may exceed
// that of other solves, as long as its error is a small part of the motion: these displacements are
// accurate only to the square of an increment.
double entry_looseness(double tolerance) { return std::clamp(1e-4 / tolerance, 1.0, 100.0); }

// A cell that enters the contact during an increment and ends at the pressure p is in contact for
// the fraction min(c p², 1) of the increment, because p² near the edge of a contact grows in
// proportion to the indentation. Returns the factor c for which the cells with these final
// pressures are in contact for half of the increment on average.
double entry_factor(const Values& pressures) {
  const double least = *std::ranges::min_element(pressures);
  double low = 0, high = 1 / (least * least);
  for (int halving = 0; halving < 100; ++halving) {
    const double factor = (low + high) / 2;
    double sum = 0;
    for (const double pressure : pressures) sum += std::min(factor * (pressure * pressure), 1.0);
    (sum < static_cast<double>(pressures.size()) / 2 ? low : high) = factor;
  }
  return high;
}

}  // namespace

SlidingContact::SlidingContact(const Grid2D& grid, const Body& body,
                               const SlidingContactOptions& options)
    : cell_area_(grid.cell_area()),
      options_(options),
      workspace_(std::make_unique<detail::TangentialWorkspace>(grid, body, options.stick)) {
  state_.contact_pressure = state_.pressure_before = state_.loss = Field::Zero(grid.nx, grid.ny);
  state_.shift = state_.traction = state_.traction_before = state_.displacement = zero(grid);
  validate(options);
  state_.motion_scale = options.motion_scale;
}
SlidingContact::SlidingContact(SlidingContact&&) noexcept = default;
SlidingContact& SlidingContact::operator=(SlidingContact&&) noexcept = default;
SlidingContact::~SlidingContact() = default;

void SlidingContact::set_motion_scale(double scale) {
  require_positive(scale, "motion_scale");
  state_.motion_scale = scale;
}

void SlidingContact::restore(SlidingState state) {
  const Grid2D& grid = workspace_->grid();
  for (const Field* field :
       {&state.contact_pressure, &state.loss, &state.shift.x, &state.shift.y, &state.traction.x,
        &state.traction.y, &state.displacement.x, &state.displacement.y, &state.pressure_before,
        &state.traction_before.x, &state.traction_before.y})
    require(field->rows() == grid.nx && field->cols() == grid.ny, "state", field->size(),
            "cells do not match the grid; resume with the settings of the first run");
  require_positive(state.motion_scale, "motion_scale");
  state_ = std::move(state);
  if (state_.prepared.size() > 0) reserve(state_.prepared);
  note_cells();
}

SlidingState SlidingContact::state() const {
  SlidingState state = state_;
  state.prepared = workspace_->prepared();
  return state;
}

void SlidingContact::reserve(const ContactSet& largest) {
  detail::require_contact(largest, workspace_->grid(), Boundary::free);
  workspace_->system_for(largest);
}

void SlidingContact::note_cells() {
  cells_.clear();
  for (Index k = 0; k < state_.contact_pressure.size(); ++k)
    if (state_.contact_pressure.data()[k] > 0 || state_.pressure_before.data()[k] > 0)
      cells_.push_back(k);
}

double SlidingContact::limit(double pressure) const {
  return pressure > 0 ? options_.friction_coefficient * pressure : 0;
}

void SlidingContact::require_pressure(const Field& pressure) const {
  const Grid2D& grid = workspace_->grid();
  require(pressure.rows() == grid.nx && pressure.cols() == grid.ny, "pressure", pressure.size(),
          "values do not match the grid; give nx × ny values");
  require((pressure >= 0).all(), "pressure", pressure.minCoeff(), "must be >= 0 in every cell");
}

void SlidingContact::slide(const Field& pressure, const TangentialMove& direction) {
  require_pressure(pressure);
  require(std::isfinite(options_.friction_coefficient), "friction_coefficient",
          options_.friction_coefficient, "never slides; give a finite coefficient");
  require(options_.stick.hold_lateral || direction.y == 0, "direction", direction.y,
          "along y must be 0 where the lateral displacement is free; turn the surface instead");
  const double length = std::hypot(direction.x, direction.y);
  require_positive(length, "direction");
  const Field limit = options_.friction_coefficient * pressure;
  const ContactSet contact = limit > 0;
  state_.contact_pressure = state_.pressure_before = pressure;
  state_.traction = {limit * (direction.x / length), limit * (direction.y / length)};
  state_.traction_before = state_.traction;
  state_.displacement = workspace_->displacement(contact, state_.traction, contact);
  state_.fft_count += 2;
  state_.displacement.x += contact.select(state_.shift.x, 0.0);
  state_.displacement.y += contact.select(state_.shift.y, 0.0);
  state_.last_move_x = state_.last_move_y = 0;
  state_.loss.setZero();
  state_.work = state_.released = 0;
  state_.slipping = contact.count();
  note_cells();
}

/// One increment during its computation. Vectors hold the cells that are in contact before the
/// increment or after it. A cell that is out of contact before or after has the limit 0 at that
/// time, but its displacement is computed all the same.
class SlidingContact::Attempt {
 public:
  Attempt(SlidingContact& contact, const Field& pressure, const TangentialMove& move,
          const TangentialField* shift)
      : contact_(contact),
        workspace_(*contact.workspace_),
        touching_(pressure > 0 || contact.state_.contact_pressure > 0),
        system_(workspace_.system_for(touching_)),
        points_(system_.points(touching_)),
        size_(points_.cell.size() * workspace_.components()),
        stays_put_(!shift && move.x == 0 && move.y == 0),
        pressure_before_(detail::values_at(contact.state_.contact_pressure, points_)),
        traction_before_(workspace_.gather(contact.state_.traction, points_)),
        shift_before_(workspace_.gather(contact.state_.shift, points_)),
        shift_after_(shift ? workspace_.gather(*shift, points_) : shift_before_),
        response_(size_, 0.0) {
    increment_.cells = points_.cell;
    increment_.contact_pressure = detail::values_at(pressure, points_);
    increment_.traction = increment_.traction_halfway = Values(size_, 0.0);
    increment_.displacement_before = workspace_.gather(contact.state_.displacement, points_);
    if (shift) increment_.shift = *shift;
    increment_.move = move;
    for (std::size_t k = 0; k < points_.cell.size(); ++k)
      if (enters(k)) entering_pressures_.push_back(increment_.contact_pressure[k]);
  }

  Increment from(const Increment& guess) {
    begin_from(guess);
    respond();
    increment_.displacement = increment_.displacement_before;
    for (std::size_t i = 0; i < size_; ++i) increment_.displacement[i] += distance(i);
    const Termination entered =
        entering_pressures_.empty() ? Termination::converged : place_entering();
    Values targets(size_);
    for (std::size_t i = 0; i < size_; ++i)
      targets[i] = increment_.displacement[i] - shift_after_[i];
    increment_.report =
        solve(increment_.contact_pressure, std::move(targets), 1, increment_.traction);
    increment_.report.termination = std::max(increment_.report.termination, entered);
    for (std::size_t i = 0; i < size_; ++i) increment_.displacement[i] -= increment_.slip[i];
    return std::move(increment_);
  }

 private:
  bool enters(std::size_t i) const { return !(pressure_before_[i % points_.cell.size()] > 0); }
  double distance(std::size_t i) const {
    return i < points_.cell.size() ? increment_.move.x : increment_.move.y;
  }

  // Starts from the tractions of another increment. Tractions at their limit are scaled to the new
  // limit, because points that slipped are expected to slip further.
  void begin_from(const Increment& guess) {
    const std::size_t count = points_.cell.size(), given = guess.cells.size();
    for (std::size_t k = 0, at = 0; k < count; ++k) {
      while (at < given && guess.cells[at] < points_.cell[k]) ++at;
      if (at == given) break;
      if (guess.cells[at] != points_.cell[k]) continue;
      double square = 0;
      for (std::size_t i = k, from = at; i < size_; i += count, from += given) {
        increment_.traction[i] = guess.traction[from];
        increment_.traction_halfway[i] = guess.traction_halfway[from];
        square += guess.traction[from] * guess.traction[from];
      }
      const double length = std::sqrt(square), last = contact_.limit(guess.contact_pressure[at]);
      if (!(length > 0) || length < (1 - detail::limit_round_off) * last) continue;
      const double stretch = contact_.limit(increment_.contact_pressure[k]) / length;
      for (std::size_t i = k; i < size_; i += count) increment_.traction[i] *= stretch;
    }
  }

  // Computes the displacements by the previous tractions. For cells in contact they are known
  // within the tolerance, for cells that enter they are not.
  void respond() {
    Values& before = increment_.displacement_before;
    if (entering_pressures_.empty()) {
      for (std::size_t i = 0; i < size_; ++i) response_[i] = before[i] - shift_before_[i];
      response_error_ = contact_.options_.stick.tolerance * contact_.state_.motion_scale;
      return;
    }
    if (!all_enter()) {
      system_.response().apply(points_, traction_before_.data(), points_, response_.data());
      contact_.state_.fft_count += 2;
    }
    for (std::size_t i = 0; i < size_; ++i)
      if (enters(i)) before[i] = response_[i] + shift_before_[i];
  }

  // Computes the displacement that the cells that enter would have at the end of the increment if
  // they stick.
  Termination place_entering() {
    const Values& before = increment_.displacement_before;
    Values in_middle = before;
    Termination termination = Termination::converged;
    if (!stays_put_ && !all_enter()) {
      // Solves half of the increment with only the cells already in contact, which gives the
      // displacement at mid-increment of the cells that enter.
      Values targets(size_);
      for (std::size_t i = 0; i < size_; ++i)
        targets[i] = before[i] + (enters(i) ? 0 : distance(i) / 2) - shift_halfway(i);
      termination =
          solve(pressure_before_, targets, entry_looseness(contact_.options_.stick.tolerance),
                increment_.traction_halfway)
              .termination;
      for (std::size_t i = 0; i < size_; ++i)
        in_middle[i] = targets[i] - increment_.slip[i] + shift_halfway(i);
    }
    const double factor = entry_factor(entering_pressures_);
    for (std::size_t i = 0; i < size_; ++i) {
      if (!enters(i)) continue;
      const double pressure = increment_.contact_pressure[i % points_.cell.size()];
      const double stay = std::min(factor * (pressure * pressure), 1.0);
      // The displacement of a cell is taken as linear in time in each half of the increment.
      increment_.displacement[i] =
          in_middle[i] + (1 - 2 * stay) * (in_middle[i] - before[i]) + stay * distance(i);
    }
    return termination;
  }

  PartialSlipReport solve(const Values& pressures, Values targets, double looseness,
                          Values& tractions) {
    Values limits(pressures.size());
    std::ranges::transform(pressures, limits.begin(),
                           [this](double pressure) { return contact_.limit(pressure); });
    const detail::KnownResponse known{traction_before_, response_, response_error_};
    const PartialSlipReport report = detail::solve_discs(
        workspace_, system_, points_, std::move(limits), std::move(targets),
        looseness * contact_.state_.motion_scale, tractions, increment_.slip, &known);
    contact_.state_.iterations += report.iterations;
    contact_.state_.fft_count += report.fft_count;
    return report;
  }

  bool all_enter() const { return entering_pressures_.size() == points_.cell.size(); }
  double shift_halfway(std::size_t i) const { return (shift_before_[i] + shift_after_[i]) / 2; }

  SlidingContact& contact_;
  detail::TangentialWorkspace& workspace_;
  const ContactSet touching_;
  detail::ContactSystem& system_;
  const detail::PointList points_;
  const std::size_t size_;  // length of a vector: components × cells
  const bool stays_put_;
  const Values pressure_before_, traction_before_, shift_before_, shift_after_;
  Values response_;
  double response_error_ = 0;
  Values entering_pressures_;
  Increment increment_;
};

SlidingContact::Increment SlidingContact::attempt(const Field& pressure, const TangentialMove& move,
                                                  const TangentialField* shift,
                                                  const Increment* guess) {
  require_pressure(pressure);
  require(options_.stick.hold_lateral || move.y == 0, "move", move.y,
          "along y must be 0 where the lateral displacement is free; turn the surface instead");
  if (options_.friction_coefficient > 0)
    detail::require_contact(pressure > 0, workspace_->grid(), options_.stick.boundary);
  Attempt attempt(*this, pressure, move, shift);
  return guess ? attempt.from(*guess) : attempt.from(foreseen(move));
}

void SlidingContact::accept(Increment increment) {
  state_.termination = std::max(state_.termination, increment.report.termination);
  state_.slipping = increment.report.slipping;
  for (const Index cell : cells_)
    for (Field* field :
         {&state_.pressure_before, &state_.traction_before.x, &state_.traction_before.y})
      field->data()[cell] = 0;
  const std::size_t count = increment.cells.size();
  const TangentialMove& move = increment.move;
  struct Axis {
    Field &traction, &before, &displacement;
    double distance;
  };
  const std::array axes{
      Axis{state_.traction.x, state_.traction_before.x, state_.displacement.x, move.x},
      Axis{state_.traction.y, state_.traction_before.y, state_.displacement.y, move.y}};
  double work = 0, released = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Index cell = increment.cells[k];
    double& pressure = state_.contact_pressure.data()[cell];
    const bool stayed = pressure > 0, stays = increment.contact_pressure[k] > 0;
    state_.pressure_before.data()[cell] = std::exchange(pressure, increment.contact_pressure[k]);
    double lost = 0;
    for (std::size_t c = 0, i = k; i < increment.traction.size(); ++c, i += count) {
      double& traction = axes[c].traction.data()[cell];
      const double last = std::exchange(traction, increment.traction[i]);
      axes[c].before.data()[cell] = last;
      axes[c].displacement.data()[cell] = stays ? increment.displacement[i] : 0;
      const double middle = (last + traction) / 2, slip = increment.slip[i];
      lost += middle * slip;
      // A cell that enters moves with the body only from the moment it enters.
      work +=
          middle * (stayed ? axes[c].distance
                           : increment.displacement[i] + slip - increment.displacement_before[i]);
    }
    state_.loss.data()[cell] += cell_area_ * lost;
    if (!stays) released += cell_area_ * lost;
  }
  state_.work += cell_area_ * work;
  state_.released += released;
  cells_ = std::move(increment.cells);
  if (increment.shift) state_.shift = std::move(*increment.shift);
  state_.last_move_x = move.x;
  state_.last_move_y = move.y;
}

SlidingContact::Increment SlidingContact::foreseen(const TangentialMove& move, double step,
                                                   double last_step) const {
  const double x = state_.last_move_x, y = state_.last_move_y;
  const double square = x * x + y * y + last_step * last_step;
  const double along = move.x * x + move.y * y + step * last_step;
  const double part = square > 0 ? std::clamp(along / square, 0.0, 2.0) : 0;
  Increment guess;
  guess.cells = cells_;
  const auto add = [&](const Field& now, const Field& before) {
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const double traction = now.data()[cells_[k]];
      const double further = traction + part * (traction - before.data()[cells_[k]]);
      guess.traction.push_back(guess.contact_pressure[k] > 0 ? further : 0);
      guess.traction_halfway.push_back((traction + guess.traction.back()) / 2);
    }
  };
  for (const Index cell : cells_) {
    const double pressure = state_.contact_pressure.data()[cell];
    guess.contact_pressure.push_back(
        std::max(pressure + part * (pressure - state_.pressure_before.data()[cell]), 0.0));
  }
  add(state_.traction.x, state_.traction_before.x);
  if (options_.stick.hold_lateral) add(state_.traction.y, state_.traction_before.y);
  return guess;
}

PartialSlipReport SlidingContact::advance(const Field& pressure, const TangentialMove& move) {
  Increment increment = attempt(pressure, move);
  const PartialSlipReport report = increment.report;
  accept(std::move(increment));
  return report;
}

TangentialMove SlidingContact::tangential_force() const {
  TangentialMove force;
  for (const Index cell : cells_) {
    force.x += state_.traction.x.data()[cell];
    force.y += state_.traction.y.data()[cell];
  }
  return {cell_area_ * force.x, cell_area_ * force.y};
}

TangentialMove SlidingContact::tangential_force(const Increment& increment) const {
  const auto middle =
      increment.traction.begin() + static_cast<std::ptrdiff_t>(increment.cells.size());
  return {cell_area_ * std::accumulate(increment.traction.begin(), middle, 0.0),
          cell_area_ * std::accumulate(middle, increment.traction.end(), 0.0)};
}

Field SlidingContact::contact_pressure(const Increment& increment) const {
  Field field = Field::Zero(state_.loss.rows(), state_.loss.cols());
  for (std::size_t k = 0; k < increment.cells.size(); ++k)
    field.data()[increment.cells[k]] = increment.contact_pressure[k];
  return field;
}

TangentialField SlidingContact::traction(const Increment& increment) const {
  return workspace_->scatter(increment.traction, increment.cells);
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
