// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesive contact, solved as a sequence of contacts without adhesion.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <utility>
#include <vector>

#include "adhesion_reference.hpp"
#include "anderson.hpp"
#include "base/memory.hpp"
#include "contact/half_space/half_space.hpp"
#include "contact/half_space/normal_symbol.hpp"

namespace salebra {
namespace {

constexpr double coarse_zone = 1 / 0.3, min_zone = 1 / 0.7;
// Largest tension allowed at the edge of an isolated surface, as a fraction of the maximum tension.
constexpr double edge_tension = 1e-2;
// Number of earlier steps that Anderson's extrapolation combines.
constexpr std::size_t memory_of_steps = 7;
// If a branch of a hysteresis cycle is followed, extrapolation starts below this residual; earlier
// it would leave the energy minimum of the branch.
constexpr double near_a_minimum = 1e-2;
// Error of the tension that the contact solve inside a step may leave, as a fraction of the step's
// residual.
constexpr double inner_share = 0.02;
constexpr double loosest_inner = 1e-3, sharpest_inner = 1e-12;
constexpr double sharpening = 0.3, falls = 0.7;
// A mean pressure below this fraction of the maximum tension is round-off.
constexpr double no_load = 1e-14;
// The iteration has stalled after this many contact solves without a lower residual or energy.
constexpr int patience_of_adhesion = 60;

/// Sums over the heights, counted from `zero`.
struct HeightSums {
  double highest = -std::numeric_limits<double>::infinity();
  double first = 0, second = 0;  // Σ(h − zero), Σ(h − zero)²
};

HeightSums height_sums(const RowPartition& rows, const Field& heights, double zero) {
  HeightSums total;
  for (const HeightSums& part : parallel::map_blocks<HeightSums>(
           rows,
           [&](Index begin, Index end) {
             HeightSums sums;
             for (Index k = begin * heights.cols(); k < end * heights.cols(); ++k) {
               const double height = heights.data()[k] - zero;
               sums.highest = std::max(sums.highest, height);
               sums.first += height;
               sums.second += height * height;
             }
             return sums;
           },
           heights.size())) {
    total.highest = std::max(total.highest, part.highest);
    total.first += part.first;
    total.second += part.second;
  }
  total.highest += zero;
  return total;
}

/// rms slope of the heights, from the differences of neighbouring cells. Collective.
double rms_slope_of(const Surface& surface, const RowPartition& rows) {
  const Field& h = surface.heights;
  const Grid2D& grid = surface.grid;
  std::vector<double> next_row(static_cast<std::size_t>(grid.ny));
  const auto row_bytes = next_row.size() * sizeof(double);
  RowExchange(
      rows,
      [&](int rank) {
        const bool some = rows.end_of(rank) > rows.begin_of(rank);
        return RowExchange::Window{rows.end_of(rank), some ? 1 : 0};
      },
      RowExchange::Edge::repeat)(h.data(), row_bytes, next_row.data(), row_bytes, row_bytes);
  const double squares = parallel::sum_blocks(
      rows,
      [&](Index begin, Index end) {
        double sum = 0;
        for (Index i = begin; i < end; ++i) {
          const double* here = h.data() + i * grid.ny;
          const double* below = i + 1 < rows.count() ? here + grid.ny : next_row.data();
          const bool at_edge = rows.begin() + i + 1 == grid.nx && !surface.periodic;
          for (Index j = 0; j < grid.ny; ++j) {
            const bool last = j + 1 == grid.ny;
            const double x = at_edge ? 0 : (below[j] - here[j]) / grid.dx();
            const double y =
                last && !surface.periodic ? 0 : (here[last ? 0 : j + 1] - here[j]) / grid.dy();
            sum += x * x + y * y;
          }
        }
        return sum;
      },
      grid.points());
  return std::sqrt(squares / static_cast<double>(grid.points()));
}

/// E* of half-spaces; of any other body, of the half-space that responds alike to waves of two cells,
/// which are those at the edges of contact patches.
double modulus_of(const Body& body, const Grid2D& grid) {
  const auto& material = body.half_space_material();
  return material ? material->contact_modulus : detail::reference_modulus(body, grid);
}

void check_adhesion(const Surface& surface, const Body& body, const Adhesion& adhesion,
                    const AdhesiveContactOptions& options) {
  surface.require_complete_rows("a contact calculation");
  if (const auto& material = body.half_space_material()) {
    require_positive(material->contact_modulus, "contact_modulus");
  } else {
    detail::require_pressable(body, surface.grid, options.contact.boundary);
    require(body.datum() == Datum::mean_plane, "datum", name_of(body.datum()),
            "is for contacts without adhesion; measure from the mean plane");
    require(std::isinf(options.contact.hardness), "hardness", options.contact.hardness,
            "is for homogeneous half-spaces; leave it out");
  }
  require(adhesion.work >= 0 && std::isfinite(adhesion.work), "work_of_adhesion", adhesion.work,
          "must be >= 0 and finite, J/m²; 0: no adhesion");
  require_positive(adhesion.range, "adhesion_range");
  require(options.contact.hardness > 0, "hardness", options.contact.hardness, "must be > 0");
  require(options.tolerance >= 1e-10 && options.tolerance <= 1e-1, "tolerance", options.tolerance,
          "must lie in 1e-10 … 1e-1");
  require(options.max_outer_iterations >= 1, "max_outer_iterations", options.max_outer_iterations,
          "must be >= 1");
  if (const Field* start = options.start_tension)
    require(start->rows() == surface.heights.rows() && start->cols() == surface.grid.ny &&
                (*start >= 0 && *start <= std::numeric_limits<double>::max()).all(),
            "start_tension", start->size(), "cells must fill the grid with finite tensions >= 0");
  const double zone = cells_in_process_zone(adhesion, surface.grid, body);
  // The number of cells in the process zone is proportional to the square of the range and to 1/(cell
  // size).
  require(zone >= min_zone || options.force_coarse, "adhesion_range", adhesion.range,
          fmt::format("leaves {:.2g} cells in the process zone, so that the cells decide what "
                      "sticks; use a range of {:.3g} m, cells of {:.3g} m, or `force_coarse`",
                      zone, adhesion.range * std::sqrt(coarse_zone / zone),
                      std::max(surface.grid.dx(), surface.grid.dy()) * zone / coarse_zone));
}

class AdhesiveSolve {
 public:
  AdhesiveSolve(const Surface& surface, const Body& body, const Adhesion& adhesion,
                const AdhesiveContactOptions& options, const OperatingPoint& point)
      : surface_(surface),
        rows_(surface.partition()),
        cells_(static_cast<double>(surface.grid.points())),
        body_(body),
        modulus_(modulus_of(body, surface.grid)),
        adhesion_(adhesion),
        options_(options),
        periodic_(options.contact.boundary == Boundary::periodic) {
    highest_ = height_sums(rows_, surface.heights, 0).highest;
    mean_depth_ = -height_sums(rows_, surface.heights, highest_).first / cells_;
    point_ = checked(point);
    require_wide_grid();
    reference_ = detail::adhesion_reference(surface, body, adhesion);
  }

  AdhesiveContactState run() {
    start();
    detail::Anderson anderson(rows_, memory_of_steps);
    Field safe;  // next tension without extrapolation
    bool extrapolated = false;
    double energy = std::numeric_limits<double>::infinity(), noise = 0;
    double residual = 1, best = std::numeric_limits<double>::infinity(), lowest = best;
    double sharpness = 1;  // factor applied to the inner tolerance
    int since_best = 0;
    for (;;) {
      const double inner = std::max(sharpest_inner, sharpness * inner_tolerance(residual));
      if (!press_under_tension(inner)) {
        if (!state_.detached) measure();
        return finish();
      }
      const Measure found = measure();
      if (!std::isfinite(found.energy)) {
        state_.termination = Termination::out_of_range;
        return finish();
      }
      const double noise_here = state_.residual * found.contact_pressure * rms_raised_;
      const bool last = state_.outer_iterations >= options_.max_outer_iterations;
      if (!last && extrapolated && found.energy > energy + noise + noise_here) {
        anderson.forget();
        tension_ = safe;
        extrapolated = false;
        continue;
      }
      const double residual_here = found.max_change / reference_;
      // If neither the energy fell by more than the noise of the contact solves, nor the residual
      // fell by the factor `falls`, the tolerance of the contact solves is tightened.
      if (!(found.energy < energy - noise - noise_here) && residual_here > falls * residual)
        sharpness *= sharpening;
      energy = found.energy;
      noise = noise_here;
      residual = state_.adhesion_residual = residual_here;
      // The last contact solve must be as accurate as the tolerance requires.
      if (residual <= options_.tolerance &&
          state_.residual <= 2 * inner_tolerance(options_.tolerance)) {
        state_.termination = Termination::converged;
        return finish();
      }
      since_best = residual < best || found.energy < lowest - noise ? 0 : since_best + 1;
      best = std::min(best, residual);
      lowest = std::min(lowest, found.energy);
      if (since_best > patience_of_adhesion) {
        state_.termination = Termination::stalled;
        return finish();
      }
      if (options_.contact.on_progress &&
          !options_.contact.on_progress(
              {"adhesion", progress(residual), state_.outer_iterations, residual})) {
        state_.termination = Termination::interrupted;
        return finish();
      }
      if (last) {
        state_.termination = Termination::iteration_limit;
        return finish();
      }
      const bool may_jump = adhesion_.potential != AdhesionPotential::maugis &&
                            (!options_.start_tension || residual < near_a_minimum);
      if (may_jump) {
        safe = next_;
        tension_ = anderson.extrapolate(tension_, next_ - tension_).max(0.0).min(largest());
        extrapolated = true;
      } else {
        std::swap(tension_, next_);
        extrapolated = false;
      }
    }
  }

 private:
  double largest() const { return adhesion_.max_tension(); }
  bool yields() const { return std::isfinite(options_.contact.hardness); }
  double bound() const { return adhesion_.pressure_bound(options_.contact.hardness); }

  /// Converts the operating point: a force to a pressure, the indentation of a periodic contact to
  /// its mean gap.
  OperatingPoint checked(const OperatingPoint& point) const {
    const bool by_force = point.control == ControlQuantity::normal_force,
               by_gap = point.control == ControlQuantity::mean_gap;
    const double value = point.value;
    const std::string_view name = by_force ? "force" : name_of(point.control);
    require(std::isfinite(value), name, value, "must be finite");
    if (point.load_given()) {
      const double nominal = by_force ? value / surface_.grid.area() : value;
      require(nominal <= 1e12 * modulus_, name, value,
              fmt::format("must not exceed 1e12 times the contact modulus, {} Pa; check the units",
                          modulus_));
      const double hardness = options_.contact.hardness;
      require(!yields() || (nominal > 0 && nominal < hardness), name, value,
              fmt::format("must give a nominal pressure > 0 and below the hardness, {}, in a "
                          "first loading",
                          format_quantity(hardness, Dimension::pressure)));
      return at_pressure(nominal);
    }
    require(!yields(), name, value,
            "cannot be prescribed in a first loading; with a hardness give a pressure or a force");
    require(!by_gap || periodic_, "boundary", "free",
            "has no mean gap; give a force or an indentation");
    require(!by_gap || value > 0, name, value, "must be > 0");
    require(by_gap || !periodic_ || value < mean_depth_, name, value,
            fmt::format("must be below {} m, at which a periodic surface is in full contact",
                        mean_depth_));
    return periodic_ && !by_gap ? at_mean_gap(mean_depth_ - value) : point;
  }

  // Throws if there is tension at the edge of an isolated surface: the grid then cuts off adhesion
  // beyond its edge.
  void require_wide_grid() const {
    if (periodic_) return;
    const double approach = point_.load_given() ? 0.0 : std::max(0.0, point_.value);
    double held = 0;
    for (const double part : parallel::map_blocks<double>(rows_, [&](Index begin, Index end) {
           double most = 0;
           for (Index i = begin; i < end; ++i)
             for (Index j = 0; j < surface_.grid.ny; ++j) {
               const Index row = rows_.begin() + i;
               if (row > 0 && row + 1 < surface_.grid.nx && j > 0 && j + 1 < surface_.grid.ny)
                 continue;
               const double gap = highest_ - surface_.heights(i, j) - approach;
               most = std::max(most, adhesion_.tension(std::max(0.0, gap)));
             }
           return most;
         }))
      held = std::max(held, part);
    require(held <= edge_tension * largest(), "boundary", "free",
            fmt::format("needs a margin around the contact: at the edge of the grid the tension is "
                        "{:.2g} of the largest; use a larger grid or a shorter range",
                        held / largest()));
  }

  // Tension of the first contact solve: the given start; without one, the tension of the gaps at
  // first touch if the prescribed load does not press the bodies together, otherwise zero, which
  // gives a contact without adhesion.
  void start() {
    const Grid2D& grid = surface_.grid;
    require_memory(grid,
                   (8 * sizeof(double) + 2 * memory_of_steps * sizeof(float)) *
                       static_cast<double>(surface_.heights.size()),
                   "an adhesive contact", surface_.communicator);
    state_.communicator = surface_.communicator;
    state_.cells_in_process_zone = salebra::cells_in_process_zone(adhesion_, grid, modulus_);
    raised_ = {grid, Field(surface_.heights.rows(), grid.ny), surface_.periodic, surface_.origin,
               surface_.communicator};
    detail::NormalResponse response(modulus_);
    if (!body_.half_space_material()) response.body = body_;
    compliance_.emplace(detail::normal_compliance<double>(
        grid, detail::normal_symbol(grid, response, options_.contact.boundary, rows_), rows_));
    if (options_.start_tension) {
      tension_ = *options_.start_tension;
    } else if (point_.load_given() && !(point_.value > 0)) {
      tension_ = (highest_ - surface_.heights).unaryExpr([&](double gap) {
        return adhesion_.tension(gap);
      });
    } else {
      tension_ = Field::Zero(surface_.heights.rows(), grid.ny);
    }
    next_ = tension_;
  }

  // An error e·h_rms of the gap changes the tension by up to e·h_rms/range times the maximum
  // tension.
  double inner_tolerance(double residual) const {
    const double wanted = inner_share * std::max(residual, options_.tolerance);
    const double change = largest() * rms_raised_ / adhesion_.range;
    return std::clamp(std::min(wanted, change > 0 ? wanted * reference_ / change : wanted),
                      sharpest_inner, loosest_inner);
  }

  static double progress_of(double residual, double tolerance) {
    return std::log10(std::clamp(residual, tolerance, 1.0)) / std::log10(tolerance);
  }
  double progress(double residual) const { return progress_of(residual, options_.tolerance); }

  // Solves a contact without adhesion for the heights raised by the tension, with the prescribed
  // pressure or mean gap. Returns false if the iteration over the tension ends here.
  bool press_under_tension(double tolerance) {
    ++state_.outer_iterations;
    compliance_->apply(tension_.data(), raised_.heights.data());
    ++state_.fft_count;
    raised_.heights += surface_.heights;
    const HeightSums sums = height_sums(rows_, raised_.heights, highest_);
    highest_raised_ = sums.highest;
    const double mean = sums.first / cells_;
    rms_raised_ = std::sqrt(std::max(0.0, sums.second / cells_ - mean * mean));
    const double mean_tension = mean_of(tension_);
    OperatingPoint inner_point;
    if (point_.load_given()) {
      const double load = point_.value + mean_tension;
      if (!(load > no_load * largest()) && !(point_.value > 0)) {
        detach();
        return false;
      }
      inner_point = at_pressure(load);
    } else {
      // Indentation of the raised heights, counted from the plane height at which they first touch.
      const double depth = periodic_ ? sums.highest - highest_ - mean - point_.value
                                     : point_.value + sums.highest - highest_;
      if (!(depth > 0)) {
        float_above(depth, sums.highest);
        return true;
      }
      inner_point = at_indentation(depth);
    }
    NormalContactOptions inner = options_.contact;
    inner.tolerance = tolerance;
    inner.on_checkpoint = {};
    inner.initial_pressure = nullptr;
    inner.hardness = bound();
    if (!first_) {
      start_pressure_ = std::move(state_.contact_pressure);
      inner.initial_pressure = &start_pressure_;
    }
    first_ = false;
    const Counts before = counts();
    static_cast<NormalContactState&>(state_) = press(raised_, body_, inner_point, inner);
    state_.iterations += before.iterations;
    state_.fft_count += before.fft_count;
    state_.multilevel_count += before.multilevel_count;
    // A contact solve that has stalled is as accurate as round-off permits.
    return state_.converged() || state_.termination == Termination::stalled;
  }

  struct Counts {
    int iterations, fft_count, multilevel_count;
  };
  Counts counts() const { return {state_.iterations, state_.fft_count, state_.multilevel_count}; }

  double mean_of(const Field& field) const {
    return parallel::sum_blocks(
               rows_,
               [&](Index begin, Index end) {
                 double sum = 0;
                 for (Index k = begin * field.cols(); k < end * field.cols(); ++k)
                   sum += field.data()[k];
                 return sum;
               },
               field.size()) /
           cells_;
  }

  // No cell touches (depth <= 0): the plane lies −depth above the highest of the raised heights.
  void float_above(double depth, double highest_raised) {
    const Index nx = raised_.heights.rows(), ny = raised_.heights.cols();
    state_.contact_pressure = Field::Zero(nx, ny);
    state_.gap = highest_raised - depth - raised_.heights;
    state_.contact_area_fraction = 0;
    state_.residual = 0;
    state_.termination = Termination::converged;
    first_ = true;
  }

  void detach() {
    const Index nx = surface_.heights.rows(), ny = surface_.grid.ny;
    state_.detached = true;
    state_.contact_pressure = Field::Zero(nx, ny);
    state_.gap = Field::Constant(nx, ny, std::numeric_limits<double>::infinity());
    tension_ = Field::Zero(nx, ny);
    state_.contact_area_fraction = 0;
    state_.residual = state_.adhesion_residual = 0;
    state_.termination = Termination::converged;
  }

  struct Measure {
    double energy = 0;            // per area; falls with each step
    double max_change = 0;        // of the tension, over cells with a gap
    double contact_pressure = 0;  // mean contact pressure
  };

  // Measures energy, residual and loads of the state, and writes the next tension φ'(g), the
  // derivative of the adhesive energy at the gap g, into next_.
  Measure measure() {
    struct Sums {
      double work = 0, displacement = 0, adhesive = 0, contact = 0, tension = 0, gap = 0;
      double sunk = 0, change = 0;
    };
    if (yields()) {
      compliance_->apply(state_.contact_pressure.data(), next_.data());
      ++state_.fft_count;
    }
    Sums total;
    for (const Sums& part : parallel::map_blocks<Sums>(
             rows_,
             [&](Index begin, Index end) {
               Sums sums;
               const Index columns = surface_.grid.ny;
               const double top = largest();
               for (Index k = begin * columns; k < end * columns; ++k) {
                 double &p = state_.contact_pressure.data()[k], &t = tension_.data()[k];
                 const double gap = p > 0 ? 0.0 : std::max(0.0, state_.gap.data()[k]);
                 // next_ still holds the displacement Gp by the pressure: where the raised heights
                 // lie above the displaced body, this part of the height has sunk in plastically.
                 const double sunk =
                     p < bound() ? 0.0
                                 : std::max(0.0, raised_.heights.data()[k] - highest_raised_ +
                                                     state_.indentation - next_.data()[k]);
                 // Where the surfaces touch, the tension becomes that of gap 0, and the pressure p
                 // changes by the same amount: the difference of p and the tension is right
                 // already.
                 if (p > 0) {
                   p += top - t;
                   t = top;
                 }
                 const double next = adhesion_.tension(gap);
                 const double displaced = gap + surface_.heights.data()[k] - highest_ - sunk;
                 next_.data()[k] = next;
                 if (!(p > 0)) sums.change = std::max(sums.change, std::abs(next - t));
                 sums.work += displaced * (p - t);
                 sums.displacement += displaced;
                 sums.adhesive += adhesion_.energy(gap);
                 sums.contact += p;
                 sums.tension += t;
                 sums.gap += gap;
                 sums.sunk += sunk;
               }
               return sums;
             },
             surface_.heights.size())) {
      total.work += part.work;
      total.displacement += part.displacement;
      total.adhesive += part.adhesive;
      total.contact += part.contact;
      total.tension += part.tension;
      total.gap += part.gap;
      total.sunk += part.sunk;
      total.change = std::max(total.change, part.change);
    }
    const double pressure = (total.contact - total.tension) / cells_;
    const double mean_gap = total.gap / cells_, sunk = total.sunk / cells_;
    const double plastic = yields() ? options_.contact.hardness * sunk : 0;
    // The displacement is u = displaced + offset; in a free contact the offset is the indentation,
    // which is the height of the plane.
    const double offset = periodic_ ? -total.displacement / cells_ : indentation();
    const double elastic = 0.5 * (total.work / cells_ + offset * pressure);
    const double adhesive = total.adhesive / cells_;
    const double area = surface_.grid.area();
    state_.mean_pressure = pressure;
    state_.force = pressure * area;
    state_.mean_gap = mean_gap;
    state_.indentation = periodic_ ? mean_depth_ + sunk - mean_gap : indentation();
    state_.elastic_energy = elastic * area;
    state_.adhesive_energy = adhesive * area;
    state_.tension_force = total.tension / cells_ * area;
    const double load = point_.load_given() ? point_.value : pressure;
    const double potential = load * (periodic_ ? mean_gap - sunk : -state_.indentation);
    state_.total_energy = (elastic + adhesive + plastic + potential) * area;
    return {elastic + adhesive + plastic + (point_.load_given() ? potential : 0.0), total.change,
            total.contact / cells_};
  }

  // In a free contact the indentation counts from first touch of the surface as given, not raised
  // by the tension.
  double indentation() {
    if (!point_.load_given()) return point_.value;
    // state_.indentation counts from first touch of the raised heights until measure() replaces it.
    return state_.indentation - highest_raised_ + highest_;
  }

  AdhesiveContactState finish() {
    if (state_.detached) {
      state_.mean_pressure = point_.value;
      state_.force = point_.value * surface_.grid.area();
      state_.mean_gap = std::numeric_limits<double>::infinity();
      state_.indentation = -std::numeric_limits<double>::infinity();
      state_.elastic_energy = state_.adhesive_energy = state_.total_energy = 0;
      state_.tension_force = 0;
    }
    state_.tension = std::move(tension_);
    return std::move(state_);
  }

  const Surface& surface_;
  const RowPartition rows_;
  const double cells_;
  const Body body_;
  const double modulus_;
  const Adhesion adhesion_;
  const AdhesiveContactOptions& options_;
  const bool periodic_;
  OperatingPoint point_;
  double highest_ = 0, highest_raised_ = 0, mean_depth_ = 0, reference_ = 1;
  double rms_raised_ = 0;
  bool first_ = true;
  std::optional<Convolution2D<double>> compliance_;
  Surface raised_;
  Field tension_, next_, start_pressure_;
  AdhesiveContactState state_;
};

}  // namespace

double detail::adhesion_reference(const Surface& surface, const Body& body,
                                  const Adhesion& adhesion) {
  return std::max(modulus_of(body, surface.grid) * rms_slope_of(surface, surface.partition()),
                  adhesion.max_tension());
}

double Adhesion::energy(double gap) const {
  const double ratio = gap / range;
  switch (potential) {
    case AdhesionPotential::exponential:
      return -work * std::exp(-ratio);
    case AdhesionPotential::maugis:
      return -work * std::max(0.0, 1 - ratio);
    default:
      return -work / ((1 + ratio) * (1 + ratio));
  }
}

double Adhesion::tension(double gap) const {
  const double ratio = gap / range, top = max_tension();
  switch (potential) {
    case AdhesionPotential::exponential:
      return top * std::exp(-ratio);
    case AdhesionPotential::maugis:
      return ratio < 1 ? top : 0;
    default:
      return top / ((1 + ratio) * (1 + ratio) * (1 + ratio));
  }
}

double Adhesion::max_tension() const {
  return (potential == AdhesionPotential::van_der_waals ? 2 : 1) * work / range;
}

double cells_in_process_zone(const Adhesion& adhesion, const Grid2D& grid, double contact_modulus) {
  const double top = adhesion.max_tension();
  if (!(top > 0)) return std::numeric_limits<double>::infinity();
  return contact_modulus * adhesion.work / (top * top * std::max(grid.dx(), grid.dy()));
}

double cells_in_process_zone(const Adhesion& adhesion, const Grid2D& grid, const Body& body) {
  return cells_in_process_zone(adhesion, grid, modulus_of(body, grid));
}

std::optional<std::string> warning_of_process_zone(const Adhesion& adhesion, const Grid2D& grid,
                                                   const Body& body) {
  return warning_of_process_zone(adhesion, grid, modulus_of(body, grid));
}

std::optional<std::string> warning_of_process_zone(const Adhesion& adhesion, const Grid2D& grid,
                                                   double contact_modulus) {
  const double zone = cells_in_process_zone(adhesion, grid, contact_modulus);
  if (zone >= coarse_zone) return {};
  return fmt::format(
      "the process zone of adhesion has {:.2g} cells; below 3.3 the cells influence the result; "
      "use a range of {:.3g} m or cells of {:.3g} m",
      zone, adhesion.range * std::sqrt(coarse_zone / zone),
      std::max(grid.dx(), grid.dy()) * zone / coarse_zone);
}

AdhesiveContactState press_adhesive(const Surface& surface, const Body& body,
                                    const OperatingPoint& point, const Adhesion& adhesion,
                                    const AdhesiveContactOptions& options) {
  collectively(surface.communicator, [&] { check_adhesion(surface, body, adhesion, options); });
  return AdhesiveSolve(surface, body, adhesion, options, point).run();
}

AdhesiveContactState press_adhesive(const Surface& surface, double contact_modulus,
                                    const OperatingPoint& point, const Adhesion& adhesion,
                                    const AdhesiveContactOptions& options) {
  return press_adhesive(surface, Material::of_contact_modulus(contact_modulus), point, adhesion,
                        options);
}

}  // namespace salebra
