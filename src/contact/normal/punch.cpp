// SPDX-License-Identifier: GPL-3.0-or-later
// Normal stiffness of a contact set: the load under a unit rigid displacement of its cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <utility>
#include <vector>

#include "active_set_cg.hpp"
#include "base/stage_time.hpp"
#include "contact/half_space/cell_window.hpp"
#include "tile_sums.hpp"

namespace salebra {
namespace detail {
namespace {

// The punch solve ends when this many steps in a row gain little. The load is a maximum over the
// pressures q, so its error is the square of the error of q, and two small gains suffice.
constexpr int gains_in_a_row = 2;
// Maximum CG steps of invert(), which serves as a preconditioner: ten to twenty steps reach 99 % of
// the possible gain.
constexpr int max_inner_steps = 100;

}  // namespace

// Starts at the pressures q = 0 with the residual r of g = Gq − u = −u, where u is the requested
// displacement.
template <class Real>
void ActiveSetCg<Real>::begin_punch() {
  std::fill_n(p_, tile_points(), 0.0);
  const auto a = arrays(std::numeric_limits<double>::infinity());
  for_tiles([&](Index begin, Index end) { kernels_.residual(a, begin, end, 0); });
}

// Takes one step of CG; returns twice the decrease of ½q·Gq − q·u for pressures q and the requested
// displacement u. curvature: scalar product <t, w> of the search direction t and its displacement
// w, for the last direction on entry and for the new one on return.
template <class Real>
double ActiveSetCg<Real>::punch_step(double& curvature, PunchOutcome& outcome) {
  const auto a = arrays(std::numeric_limits<double>::infinity());
  fill_halo_of_residual();
  const auto sums = total_of(over_tiles<PreconditionSums>(
      [&](Index begin, Index end) { return kernels_.precondition(a, begin, end); }));
  const double beta = outcome.iterations > 0 ? -sums.zw / curvature : 0;
  const double descent = sums.zr + beta * sums.tr;
  {
    const Applying applying(*this, outcome);
    curvature = take_direction(0, beta, 0).tw;
  }
  if (!(curvature > 0)) return curvature;
  over_tiles<StepSums>(
      [&](Index begin, Index end) { return kernels_.step(a, begin, end, descent / curvature, 0); });
  ++outcome.iterations;
  return descent * descent / curvature;
}

template <class Real>
bool ActiveSetCg<Real>::hold(const std::vector<Index>& cells) {
  reset();
  multilevel_share_ = std::numeric_limits<double>::infinity();
  const auto tile_of = [&](Index cell) {
    return static_cast<std::size_t>(cell / grid_.ny * tiles_per_row_ +
                                    cell % grid_.ny / tile_width);
  };
  std::fill(in_use_.begin(), in_use_.end(), static_cast<unsigned char>(0));
  for (const Index cell : cells) in_use_[tile_of(cell)] = 1;
  list_tiles();
  std::fill_n(m_, tile_points(), Real(0));
  std::fill_n(g_, tile_points(), 0.0);
  indices_.clear();
  // Number of tiles found so far, and the index of the last found tile among all tiles of the grid.
  std::size_t tiles = 0, last = 0;
  for (const Index cell : cells) {
    if (tiles == 0 || tile_of(cell) != last) ++tiles;
    last = tile_of(cell);
    indices_.push_back(static_cast<Index>((tiles - 1) * tile_width) + cell % grid_.ny % tile_width);
    m_[indices_.back()] = Real(1);
  }
  return on_multilevel_;
}

template <class Real>
void ActiveSetCg<Real>::invert(const double* u, double step_ends, double* q,
                               PunchOutcome& outcome) {
  for (std::size_t k = 0; k < indices_.size(); ++k) g_[indices_[k]] = -u[k];
  begin_punch();
  outcome.iterations = 0;
  double curvature = 1, gained = 0, gain = 0;
  do {
    gain = punch_step(curvature, outcome);
    gained += gain;
  } while (gain > step_ends * gained && outcome.iterations < max_inner_steps);
  for (std::size_t k = 0; k < indices_.size(); ++k) q[k] = p_[indices_[k]];
}

// Minimises ½q·Gq − Σq over the pressures q by CG as in solve(), on a fixed set of cells, whose
// displacement is then 1. The load is computed as 2Σq − q·Gq in double precision, whose error is
// quadratic in that of q. On the multilevel kernel, whose relative error is eps, CG works in
// rounds, each of which begins with an exact residual: from round to round the possible gain falls
// by the factor (eps/(1 − eps))² or more.
template <class Real>
PunchOutcome ActiveSetCg<Real>::punch_load(const double* p, double bound, const PunchLimits& limits,
                                           Field* pressure) {
  PunchOutcome outcome;
  reset();
  multilevel_share_ = limits.multilevel_share.value_or(worthwhile_share(true));
  hold_punch_set(p, bound);
  std::fill_n(g_, tile_points(), -1.0);
  begin_punch();
  outcome.termination = punch_rounds(limits, outcome);
  measure_punch(outcome, pressure);
  return outcome;
}

// Chooses the tiles that hold cells of the punch (0 < p < bound), and sets m_ to 1 on these cells.
template <class Real>
void ActiveSetCg<Real>::hold_punch_set(const double* p, double bound) {
  const auto in_set = [bound](double x) { return x > 0 && x < bound; };
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * tiles_per_row_; k < end * tiles_per_row_; ++k) {
      const Index first = k / tiles_per_row_ * grid_.ny + k % tiles_per_row_ * tile_width;
      const Index width = std::min<Index>(tile_width, grid_.ny - k % tiles_per_row_ * tile_width);
      in_use_[static_cast<std::size_t>(k)] = std::any_of(p + first, p + first + width, in_set);
    }
  });
  list_tiles();
  std::fill_n(m_, tile_points(), Real(0));
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    const Index first = tiles_[k].row * grid_.ny + tiles_[k].column;
    const Index width = std::min<Index>(tile_width, grid_.ny - tiles_[k].column);
    for (Index i = 0; i < width; ++i)
      if (in_set(p[first + i])) m_[k * tile_width + static_cast<std::size_t>(i)] = Real(1);
  }
}

// Takes steps of CG until they gain too little, which counts as converged, or until a limit is
// reached.
template <class Real>
Termination ActiveSetCg<Real>::punch_rounds(const PunchLimits& limits, PunchOutcome& outcome) {
  double curvature = 1, gained = 0, round_gained = 0;
  double contraction = 1;  // of the possible gain, per round
  if (on_multilevel_) contraction = std::pow(multilevel_->error() / (1 - multilevel_->error()), 2);
  double last_round = 0;
  int small_gains = 0;
  while (small_gains < gains_in_a_row && outcome.iterations < limits.max_iterations) {
    if (limits.keep_going && !rows_.communicator().all_agree(limits.keep_going(outcome.iterations)))
      return Termination::interrupted;
    const double gain = punch_step(curvature, outcome);
    if (!(gain > 0)) {
      // The gain is 0 if none is possible, as after one step on a single cell, and NaN if the
      // values are NaN.
      return gain == 0 ? Termination::converged : Termination::out_of_range;
    }
    gained += gain;
    round_gained += gain;
    if (!on_multilevel_) {
      small_gains = gain < limits.relative_gain * gained ? small_gains + 1 : 0;
    } else if (gain < std::max(limits.round_ends * round_gained,
                               std::min(limits.round_ends, limits.relative_gain) * gained)) {
      if (last_round > 0) contraction = round_gained / last_round;
      last_round = round_gained;
      round_gained = 0;
      if (contraction * last_round < limits.relative_gain * gained) {
        small_gains = gains_in_a_row;
      } else {
        if (contraction > 0.25) on_multilevel_ = false;
        renew_punch_residual();
        ++outcome.fft_count;
      }
    }
  }
  return small_gains == gains_in_a_row ? Termination::converged : Termination::iteration_limit;
}

// Computes the load and residual of the punch by one exact application of the normal compliance.
template <class Real>
void ActiveSetCg<Real>::measure_punch(PunchOutcome& outcome, Field* pressure) {
  // Copies of the tiles' pressures and set, because the transform overwrites the memory of the
  // tiles' arrays.
  const std::vector<double> q(p_, p_ + tile_points());
  const std::vector<Real> in_set_of_tiles(m_, m_ + tile_points());
  // Calls body(k, column, width) for each tile k of a row: `width` cells from `column` on.
  const auto on_row = [&](Index row, const auto& body) {
    for (Index k = first_tile(row); k < first_tile(row + 1); ++k) {
      const Index column = tiles_[static_cast<std::size_t>(k)].column;
      body(k, column, std::min<Index>(tile_width, grid_.ny - column));
    }
  };
  const auto spread = [&](Index row, double* to) {
    on_row(row, [&](Index k, Index column, Index width) {
      std::copy_n(q.data() + k * tile_width, width, to + column);
    });
  };
  std::vector<PunchSums> sums(static_cast<std::size_t>(rows_.count()));
  exact_compliance().apply(
      [&](int, Index row, double* buffer) -> const double* {
        if (first_tile(row) == first_tile(row + 1)) return nullptr;
        std::fill_n(buffer, grid_.ny, 0.0);
        spread(row, buffer);
        return buffer;
      },
      [&](int, Index row, const double* image) {
        on_row(row, [&](Index k, Index column, Index width) {
          auto& [load, misfit, cells] = sums[static_cast<std::size_t>(row)];
          for (Index i = 0; i < width; ++i) {
            const Index packed = k * tile_width + i;
            if (!(in_set_of_tiles[static_cast<std::size_t>(packed)] > 0)) continue;
            const double value = image[column + i];
            load += q[static_cast<std::size_t>(packed)] * (2 - value);
            misfit += (1 - value) * (1 - value);
            cells += 1;
          }
        });
      });
  ++outcome.fft_count;
  const PunchSums total = total_of(by_blocks(rows_, sums));
  outcome.load = total.load;
  outcome.residual = std::sqrt(total.misfit / total.cells);
  if (pressure) {
    *pressure = Field::Zero(rows_.count(), grid_.ny);
    for_rows([&](Index begin, Index end) {
      for (Index row = begin; row < end; ++row) spread(row, pressure->data() + row * grid_.ny);
    });
  }
}

// Computes g = Gq − 1 (displacement by the pressures q minus 1) on the tiles by a Fourier
// transform, and the residual r on the punch.
template <class Real>
void ActiveSetCg<Real>::renew_punch_residual() {
  const bool on_multilevel = std::exchange(on_multilevel_, false);
  struct Nothing {};
  displace<Nothing>(
      [&](Index begin, Index end, Real* row) {
        for (Index k = begin; k < end; ++k) {
          const Index column = tiles_[static_cast<std::size_t>(k)].column,
                      width = std::min<Index>(tile_width, grid_.ny - column);
          for (Index i = 0; i < width; ++i)
            row[column + i] = static_cast<Real>(p_[k * tile_width + i]);
        }
      },
      [&](Index begin, Index end, const Real* row) {
        for (Index k = begin; k < end; ++k) {
          const Index column = tiles_[static_cast<std::size_t>(k)].column,
                      width = std::min<Index>(tile_width, grid_.ny - column);
          for (Index i = 0; i < width; ++i)
            g_[k * tile_width + i] = static_cast<double>(row[column + i]) - 1;
        }
        return Nothing{};
      });
  on_multilevel_ = on_multilevel;
  const auto a = arrays(std::numeric_limits<double>::infinity());
  for_tiles([&](Index begin, Index end) { kernels_.residual(a, begin, end, 0); });
}

template bool ActiveSetCg<float>::hold(const std::vector<Index>&);
template void ActiveSetCg<float>::invert(const double*, double, double*, PunchOutcome&);
template PunchOutcome ActiveSetCg<float>::punch_load(const double*, double, const PunchLimits&,
                                                     Field*);
template PunchOutcome ActiveSetCg<double>::punch_load(const double*, double, const PunchLimits&,
                                                      Field*);

}  // namespace detail

namespace {

// Presses the cells with 0 < p < bound in as one rigid piece. With a free boundary, a single
// process needs only the part of the grid that the cells span; several processes keep the rows of
// the grid that they have.
struct PunchProblem {
  const Field& p;
  double bound;
  const Grid2D& grid;
  const Communicator& communicator;
  double contact_modulus;           // of a body: detail::reference_modulus()
  detail::NormalResponse response;  // with lengths in cell sizes and contact_modulus = 1
  Boundary boundary;
  Precision precision;
};

PunchStiffness press_punch(const PunchProblem& problem, const detail::PunchLimits& limits,
                           Field* punch_pressure) {
  const detail::StageTime time(detail::Stage::stiffness);
  const Field& p = problem.p;
  const double bound = problem.bound, contact_modulus = problem.contact_modulus;
  const Grid2D& grid = problem.grid;
  const Communicator& communicator = problem.communicator;
  const Boundary boundary = problem.boundary;
  const double cell = std::sqrt(grid.cell_area());
  const bool alone = boundary == Boundary::free && communicator.alone();
  const auto window = alone ? detail::bounding_window(ContactSet(p > 0 && p < bound))
                            : detail::CellWindow{0, 0, grid.nx, grid.ny};
  Field spanned;
  if (alone) spanned = p.block(window.x0, window.y0, window.nx, window.ny);
  const Grid2D scaled{window.nx, window.ny, static_cast<double>(window.nx) * grid.dx() / cell,
                      static_cast<double>(window.ny) * grid.dy() / cell};
  Field q;
  const auto press = [&]<class Real>(Real) {
    return detail::ActiveSetCg<Real>(scaled, RowPartition(communicator, window.nx),
                                     problem.response, boundary, {}, 0)
        .punch_load((alone ? spanned : p).data(), bound, limits, punch_pressure ? &q : nullptr);
  };
  const detail::PunchOutcome outcome =
      problem.precision == Precision::mixed ? press(0.0f) : press(0.0);
  if (punch_pressure) {
    *punch_pressure = Field::Zero(p.rows(), p.cols());
    punch_pressure->block(window.x0, window.y0, q.rows(), window.ny) = q * (contact_modulus / cell);
  }
  // With lengths in cell sizes and E* = 1, the load Σq is the force in E*·(cell size)² for an
  // approach of one cell size.
  return {.normal_stiffness = outcome.load * contact_modulus * cell,
          .iterations = outcome.iterations,
          .fft_count = outcome.fft_count,
          .multilevel_count = outcome.multilevel_count,
          .residual = outcome.residual,
          .termination = outcome.termination};
}

std::function<bool(int)> keep_going(const Progress& progress) {
  if (!progress) return {};
  return [&progress](int iteration) { return progress({"stiffness", 0, iteration, 0}); };
}

// full: the stiffness in full contact, N/m, if no solve is needed for it.
double stiffness_of(const NormalContactState& state, const Grid2D& grid, double contact_modulus,
                    const detail::NormalResponse& response, std::optional<double> full,
                    const NormalContactOptions& options, Field* punch_pressure) {
  grid.validate();
  require_positive(contact_modulus, "contact_modulus");
  const RowPartition rows(state.communicator, grid.nx);
  collectively(state.communicator, [&] {
    require(
        state.contact_pressure.rows() == rows.count() && state.contact_pressure.cols() == grid.ny,
        "pressure", state.contact_pressure.size(), "points do not fill the grid");
  });
  const auto elastic = state.contact_pressure > 0 && state.contact_pressure < options.hardness;
  if (full && state.communicator.all_agree(elastic.all())) return *full;
  if (state.communicator.all_agree(!elastic.any())) return 0;
  const PunchStiffness punch =
      press_punch({state.contact_pressure, options.hardness, grid, state.communicator,
                   contact_modulus, response, options.boundary, options.precision},
                  {.relative_gain = std::clamp(0.1 * options.tolerance, 1e-11, 1e-7),
                   .max_iterations = options.max_iterations,
                   .keep_going = keep_going(options.on_progress)},
                  punch_pressure);
  return punch.converged() ? punch.normal_stiffness : std::numeric_limits<double>::quiet_NaN();
}

// fillable: whether every cell of a periodic grid may be in contact.
PunchStiffness stiffness_of(const ContactSet& contact, const Grid2D& grid, double contact_modulus,
                            const detail::NormalResponse& response, bool fillable,
                            const PunchOptions& options, Field* pressure) {
  grid.validate();
  require_positive(contact_modulus, "contact_modulus");
  detail::require_limits(options.tolerance, options.max_iterations);
  detail::require_contact(contact, grid, fillable ? Boundary::free : options.boundary);
  if (!contact.any()) {
    if (pressure) *pressure = Field::Zero(grid.nx, grid.ny);
    return {.termination = Termination::converged};
  }
  // K is a maximum over the pressures of the punch: its relative error is of the order of the
  // square of the relative error of the displacement.
  const double gain = std::clamp(options.tolerance * options.tolerance, 1e-14, 1e-4);
  const Field ones = contact.cast<double>();
  return press_punch({ones,
                      std::numeric_limits<double>::infinity(),
                      grid,
                      {},
                      contact_modulus,
                      response,
                      options.boundary,
                      Precision::mixed},
                     {.relative_gain = gain,
                      .max_iterations = options.max_iterations,
                      .keep_going = keep_going(options.on_progress)},
                     pressure);
}

}  // namespace

double normal_stiffness(const NormalContactState& state, const Grid2D& grid, double contact_modulus,
                        const NormalContactOptions& options, Field* punch_pressure) {
  // A periodic surface in full contact cannot approach further, because the mean displacement by
  // pressures is zero.
  std::optional<double> full;
  if (options.boundary == Boundary::periodic) full = std::numeric_limits<double>::infinity();
  return stiffness_of(state, grid, contact_modulus, 1, full, options, punch_pressure);
}

double normal_stiffness(const NormalContactState& state, const Grid2D& grid, const Body& body,
                        const NormalContactOptions& options, Field* punch_pressure) {
  require(state.datum == body.datum(), "datum", name_of(body.datum()),
          fmt::format("differs from that of the contact, {}", name_of(state.datum)));
  if (const auto& half_space = body.half_space_material())
    return normal_stiffness(state, grid, half_space->contact_modulus, options, punch_pressure);
  detail::require_pressable(body, grid, options.boundary);
  const detail::NormalResponse response(body, grid, true);
  const double uniform = body.compliance(0).normal;
  std::optional<double> full;
  if (!(uniform > 0)) full = std::numeric_limits<double>::infinity();
  return stiffness_of(state, grid, response.modulus, response, full, options, punch_pressure);
}

PunchStiffness punch_stiffness(const ContactSet& contact, const Grid2D& grid,
                               double contact_modulus, const PunchOptions& options,
                               Field* pressure) {
  return stiffness_of(contact, grid, contact_modulus, 1, false, options, pressure);
}

PunchStiffness punch_stiffness(const ContactSet& contact, const Grid2D& grid, const Body& body,
                               const PunchOptions& options, Field* pressure) {
  if (const auto& half_space = body.half_space_material())
    return punch_stiffness(contact, grid, half_space->contact_modulus, options, pressure);
  detail::require_pressable(body, grid, options.boundary);
  const detail::NormalResponse response(body, grid, true);
  return stiffness_of(contact, grid, response.modulus, response, body.compliance(0).normal > 0,
                      options, pressure);
}

}  // namespace salebra
