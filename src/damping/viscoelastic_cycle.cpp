// SPDX-License-Identifier: GPL-3.0-or-later
// Rough contact of a viscoelastic body along a path, and its periodic state under an oscillation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <utility>

#include "base/memory.hpp"
#include "base/numerics/dense_systems.hpp"
#include "base/stop_check.hpp"
#include "contact/mdr/viscoelastic_spring.hpp"
#include "contact/normal/anderson.hpp"
#include "phase_quadrature.hpp"

namespace salebra {
namespace {

using detail::MaxwellSpring;
using detail::Stretching;
using std::numbers::pi;

// Anderson's extrapolation combines this many cycles.
constexpr std::size_t kept_cycles = 12;
// The search of a periodic state stalls after this many cycles without a smaller residual.
constexpr int patience = 25;

double factor(const MaxwellSpring& spring, const Stretching& step) {
  return 1 + (spring.ratios() * step.gain).sum();
}

// Displacements u and the stretches y_k of the Maxwell branches in all cells, below each other.
class History {
 public:
  History(const MaxwellSpring& spring, Field displacement)
      : spring_(spring), rows_(displacement.rows()) {
    values_ = Field::Zero(rows_ * (1 + spring.terms()), displacement.cols());
    values_.topRows(rows_) = displacement;
  }

  Field& values() { return values_; }
  auto displacement() const { return values_.topRows(rows_); }
  auto branch(Index k) const { return values_.middleRows((k + 1) * rows_, rows_); }

  // Cp − αu at the end of a step, with its α = factor(step).
  Field offset(const Stretching& step) const {
    Field sum = Field::Zero(rows_, values_.cols());
    for (Index k = 0; k < spring_.terms(); ++k)
      sum += spring_.ratios()[k] * (step.decay[k] * branch(k) - step.gain[k] * displacement());
    return sum;
  }
  // The response Cp at present.
  Field response() const {
    Field sum = displacement();
    for (Index k = 0; k < spring_.terms(); ++k) sum += spring_.ratios()[k] * branch(k);
    return sum;
  }
  void move_to(const Stretching& step, const Field& displacement) {
    const Field change = displacement - values_.topRows(rows_);
    for (Index k = 0; k < spring_.terms(); ++k) {
      auto stretch = values_.middleRows((k + 1) * rows_, rows_);
      stretch = step.decay[k] * stretch + step.gain[k] * change;
    }
    values_.topRows(rows_) = displacement;
  }

 private:
  const MaxwellSpring& spring_;
  Index rows_;
  Field values_;
};

// Values over a cycle in cells that touch at some time: at the start, and after each of its steps.
struct CellRecord {
  std::vector<Field> displacement, traction;
  std::vector<Field> branches;  // stretches at the start
};

// Loss in the Maxwell branches of the body over a cycle, divided by the cell area. With the
// response C of the relaxed body, branch k loses (g_k/τ_k) ∫ y_k·C⁻¹y_k dt. The tractions s_k =
// C⁻¹y_k and s_0 = C⁻¹u are 0 in cells that never touch; in the others they follow from the traction
// τ = s_0 + Σ g_k s_k, with s_k' = s_0' − s_k/τ_k, and from the condition that they are periodic,
// apart from the growth of s_0. A free cell recovers within a step on a curve; its straight
// displacement leaves it with tractions inside the step, whose work a free surface loses as well.
class BranchLoss {
 public:
  BranchLoss(const MaxwellSpring& spring, const PronySeries& series) : spring_(spring) {
    for (const PronyTerm& term : series.terms) times_.push_back(term.relaxation_time);
  }

  // durations: of the steps between the records, 0 for jumps. growth: of s_0 in a cycle.
  double operator()(const CellRecord& record, const std::vector<double>& durations,
                    const Field& growth) const {
    const Index terms = spring_.terms();
    if (terms == 0 || record.displacement.front().size() == 0) return 0;
    std::vector<Part> parts;
    for (const double duration : durations) parts.push_back(part_of(duration));
    Eigen::MatrixXd period = Eigen::MatrixXd::Identity(terms + 1, terms + 1);
    for (const Part& part : parts) period = (part.map * period).eval();
    Eigen::VectorXd drift = Eigen::VectorXd::Zero(terms + 1);
    const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(terms + 1, terms + 1) - period;
    const Eigen::MatrixXd inverse = detail::pseudo_inverse(system);
    double lost = 0;
    const Index cells = record.displacement.front().size();
    Eigen::VectorXd s(terms + 1), next(terms + 1), y(terms);
    for (Index cell = 0; cell < cells; ++cell) {
      s.setZero();
      for (std::size_t n = 0; n < parts.size(); ++n)
        s = (parts[n].map * s + parts[n].load * record.traction[n + 1].data()[cell]).eval();
      drift[0] = growth.size() > 0 ? growth.data()[cell] : 0;
      s = (inverse * (s - drift)).eval();
      for (Index k = 0; k < terms; ++k)
        y[k] = record.branches[static_cast<std::size_t>(k)].data()[cell];
      for (std::size_t n = 0; n < parts.size(); ++n) {
        const Part& part = parts[n];
        next = part.map * s + part.load * record.traction[n + 1].data()[cell];
        const double ds = next[0] - s[0], du = record.displacement[n + 1].data()[cell] -
                                               record.displacement[n].data()[cell];
        for (Index k = 0; k < terms; ++k) {
          lost += spring_.ratios()[k] *
                  (part.stay[k] * s[k + 1] * y[k] + part.mixed[k] * (s[k + 1] * du + ds * y[k]) +
                   part.move[k] * ds * du);
          y[k] = part.step.decay[k] * y[k] + part.step.gain[k] * du;
        }
        if (record.traction[n].data()[cell] == 0 && record.traction[n + 1].data()[cell] == 0) {
          double mean = s[0] + ds / 2;
          for (Index k = 0; k < terms; ++k)
            mean += spring_.ratios()[k] *
                    (part.step.mean_decay()[k] * s[k + 1] + part.step.mean_gain[k] * ds);
          lost -= mean * du;
        }
        s = next;
      }
    }
    return lost;
  }

 private:
  struct Part {
    Stretching step;
    Eigen::MatrixXd map;   // of (s_0, s_k) over the step without traction at its end
    Eigen::VectorXd load;  // their change by a unit traction at its end
    // ∫y²dt/τ = stay·y² + 2·mixed·yΔu + move·Δu² over a step that begins with the stretch y
    detail::Branches stay, mixed, move;
  };

  Part part_of(double duration) const {
    const Index terms = spring_.terms();
    Part part{spring_.stretching(duration), Eigen::MatrixXd::Zero(terms + 1, terms + 1),
              Eigen::VectorXd(terms + 1),   detail::Branches(terms),
              detail::Branches(terms),      detail::Branches(terms)};
    const double alpha = factor(spring_, part.step);
    part.map(0, 0) = (alpha - 1) / alpha;
    part.load[0] = 1 / alpha;
    for (Index k = 0; k < terms; ++k)
      part.map(0, k + 1) = -spring_.ratios()[k] * part.step.decay[k] / alpha;
    for (Index k = 0; k < terms; ++k) {
      part.map.row(k + 1) = part.step.gain[k] * part.map.row(0);
      part.map(k + 1, 0) -= part.step.gain[k];
      part.map(k + 1, k + 1) += part.step.decay[k];
      part.load[k + 1] = part.step.gain[k] / alpha;
      const double a = duration / times_[static_cast<std::size_t>(k)], lost = -std::expm1(-a),
                   lost_twice = -std::expm1(-2 * a);
      part.stay[k] = lost_twice / 2;
      part.mixed[k] = a > 0 ? lost * lost / (2 * a) : 0;
      // For small a the terms cancel; the first omitted term is of order a⁴.
      part.move[k] = a > 1e-2 ? (a - 2 * lost + lost_twice / 2) / (a * a)
                              : a / 3 - a * a / 4 + a * a * a * 7 / 60;
    }
    return part;
  }

  const MaxwellSpring& spring_;
  std::vector<double> times_;
};

void check(const Surface& surface, const NormalContactOptions& options) {
  surface.require_complete("a viscoelastic contact");
  require(std::isinf(options.hardness), "hardness", options.hardness,
          "must be infinite, because the body is linear");
}

// The indentation at which a contact is full and has no finite force, m; infinite for a body that
// allows more.
double full_indentation(const Surface& surface, const Body& body, Boundary boundary) {
  return boundary == Boundary::periodic && body.stops_at_full_contact()
             ? surface.heights.maxCoeff() - surface.heights.mean()
             : std::numeric_limits<double>::infinity();
}

// The name of the argument that prescribes a path.
std::string_view argument_of(const OperatingPoints& path) {
  return path.control == ControlQuantity::normal_force ? "force" : name_of(path.control);
}

// Checks the values of a path here, because the elastic contact of a step has scaled ones.
void check_values(const OperatingPoints& path, double full_indentation) {
  const bool by_load = path.control != ControlQuantity::indentation;
  const std::string_view name = argument_of(path);
  if (path.values.size() == 1) require_positive(path.values.front(), name);
  for (const double value : path.values) {
    require(std::isfinite(value), name, value, "must be finite");
    require(!by_load || value >= 0, name, value, "must be >= 0, because nothing pulls; 0: no load");
    require(by_load || value < full_indentation, name, value,
            fmt::format("must be below {} m, at which a periodic surface is in full contact",
                        full_indentation));
  }
}

// The elastic contacts of single steps.
class NormalSteps {
 public:
  NormalSteps(const Surface& surface, const Body& body, const MaxwellSpring& spring,
              const NormalContactOptions& options)
      : surface_(surface),
        body_(body),
        spring_(spring),
        options_(options),
        highest_(surface.heights.maxCoeff()) {}

  double highest() const { return highest_; }

  // Moves to the operating point at the end of a step, and returns the pressures, the true gap and
  // indentation there. guess: pressures to start from.
  NormalContactState advance(History& history, const Stretching& step, const OperatingPoint& point,
                             const Field* guess = nullptr) const {
    detail::stop_if_asked();
    const double alpha = factor(spring_, step);
    const Field offset = history.offset(step);
    Surface elastic{surface_.grid, alpha * surface_.heights + offset, surface_.periodic, {}, {}};
    const double top = elastic.heights.maxCoeff();
    const bool by_load = point.load_given();
    const double depth = by_load ? point.value : top - alpha * (highest_ - point.value);
    NormalContactState state;
    if (depth > 0) {
      NormalContactOptions options = options_;
      options.initial_pressure = guess && guess->size() > 0 ? guess : nullptr;
      state = press(elastic, body_, {by_load ? point.control : ControlQuantity::indentation, depth},
                    options);
      const double height = (top - state.indentation) / alpha;
      state.indentation = highest_ - height;
      state.gap /= alpha;
      history.move_to(step, state.gap + surface_.heights - height);
    } else {
      const Field displacement = -offset / alpha;
      // Without load the lowest plane that does not touch.
      const double height =
          by_load ? (surface_.heights - displacement).maxCoeff() : highest_ - point.value;
      state.contact_pressure = Field::Zero(surface_.grid.nx, surface_.grid.ny);
      state.gap = displacement - surface_.heights + height;
      state.indentation = highest_ - height;
      state.datum = body_.datum();
      state.termination = Termination::converged;
      history.move_to(step, displacement);
    }
    state.mean_gap = state.gap.mean();
    state.elastic_energy = std::numeric_limits<double>::quiet_NaN();
    return state;
  }

 private:
  const Surface& surface_;
  const Body& body_;
  const MaxwellSpring& spring_;
  const NormalContactOptions& options_;
  double highest_;
};

// The displacements under a state of the relaxed body.
Field displacement_of(const NormalContactState& state, const Surface& surface, double highest) {
  return state.gap + surface.heights - (highest - state.indentation);
}

// Counts the cycles of one direction and the outcome of their solves.
struct SearchReport {
  int cycles = 0;
  double residual = 0;
  Termination termination = Termination::converged;
};

// Repeats cycles from x until they end where they began. lost: smallest part of a deviation from
// the periodic state that a cycle removes. x is then the state at the start of the last cycle.
template <class Cycle>
SearchReport find_periodic(Field& x, Cycle& cycle, double scale, double lost,
                           const ViscoelasticCycleOptions& options) {
  SearchReport report;
  detail::Anderson anderson(RowPartition(x.rows()), kept_cycles);
  report.termination = Termination::iteration_limit;
  double best = std::numeric_limits<double>::infinity();
  int since_best = 0;
  while (report.cycles < options.max_cycles) {
    const Field change = cycle.run(x) - x;
    ++report.cycles;
    report.residual = change.size() > 0 ? change.abs().maxCoeff() / (scale * lost) : 0;
    if (options.on_progress && !options.on_progress({.stage = "viscoelastic",
                                                     .fraction = 0,
                                                     .step = report.cycles,
                                                     .residual = report.residual}))
      throw Interrupted("viscoelastic: interrupted");
    if (report.residual <= options.tolerance) {
      report.termination = Termination::converged;
      break;
    }
    // The tolerance of the solves sets a floor to the residual.
    since_best = report.residual < 0.9 * best ? 0 : since_best + 1;
    best = std::min(best, report.residual);
    if (since_best > patience) {
      report.termination = Termination::stalled;
      break;
    }
    x = anderson.extrapolate(x, change);
  }
  report.termination = std::max(report.termination, cycle.termination());
  return report;
}

// The motion over a cycle in steps.
struct CyclePath {
  double amplitude = 0, angular_frequency = 0;
  int steps = 0;
  std::vector<double> tangential;  // at the times (n + 1/2) of the steps, n = 0 … steps
  double range = 0;                // of the tangential motion; 0: none
  double drift = 0;

  CyclePath(const Oscillation& motion, int count) : steps(count) {
    amplitude = detail::normal_amplitude(motion);
    angular_frequency = std::visit([](const auto& m) { return m.angular_frequency; }, motion);
    const auto* drag = std::get_if<Drag>(&motion);
    if (drag) drift = drag->drag_velocity * period();
    for (int n = 0; n <= count; ++n) tangential.push_back(position(motion, n + 0.5));
    range =
        drag ? std::abs(drift) : std::abs(std::get<EqualFrequency>(motion).tangential_amplitude);
  }
  double period() const { return 2 * pi / angular_frequency; }
  // Tangential position after a number of steps from the minimum of the indentation.
  double position(const Oscillation& motion, double step) const {
    const double angle = 2 * pi * step / steps;
    if (std::holds_alternative<Drag>(motion)) return drift * (angle - pi) / (2 * pi);
    const auto& equal = std::get<EqualFrequency>(motion);
    return equal.tangential_amplitude * std::cos(angle - pi + equal.phase);
  }
  double dip(int step) const { return -amplitude * std::cos(2 * pi * step / steps); }
};

// Cycles of the normal motion. The state is a History, and in a last row the mean indentation.
class NormalCycles {
 public:
  NormalCycles(const NormalSteps& steps, const Surface& surface, const MaxwellSpring& spring,
               const CyclePath& path)
      : steps_(steps),
        surface_(surface),
        spring_(spring),
        path_(path),
        step_(spring.stretching(path.period() / path.steps)) {}

  // Changes the mean indentation by the lack of mean force over this stiffness, N/m.
  void hold_force(double force, double stiffness) {
    held_force_ = force;
    stiffness_ = stiffness;
  }
  void limit(double highest_indentation) { limit_ = highest_indentation; }

  static Field state_of(const MaxwellSpring& spring, const Field& displacement,
                        double indentation) {
    History history(spring, displacement);
    Field state(history.values().rows() + 1, displacement.cols());
    state << history.values(), Field::Constant(1, displacement.cols(), indentation);
    return state;
  }

  Field run(const Field& start) {
    const Index rows = start.rows() - 1, count = path_.steps;
    History history(spring_, start.topRows(surface_.grid.nx));
    history.values() = start.topRows(rows);
    indentation_ = start.row(rows).mean();
    require(indentation_ + path_.amplitude < limit_, "normal_amplitude", path_.amplitude,
            "m reaches full contact, where a periodic surface has no finite force; use a smaller "
            "amplitude or load");
    const std::vector<Index> cells = cells_in_contact();
    CellRecord before = std::move(record_);
    record_ = {};
    for (Index k = 0; k < spring_.terms(); ++k)
      record_.branches.push_back(values_at(history.branch(k), cells));
    record_.displacement.push_back(values_at(history.displacement(), cells));
    record_.traction.emplace_back();  // that at the end, because the cycle repeats
    force_.clear();
    sets_.clear();
    termination_ = Termination::converged;
    Field guess = last_pressure_;
    for (Index n = 1; n <= count; ++n) {
      const auto index = static_cast<std::size_t>(n);
      if (before.traction.size() > index) guess = spread(before.traction[index], recorded_);
      const NormalContactState state = steps_.advance(
          history, step_, at_indentation(indentation_ + path_.dip(static_cast<int>(n))), &guess);
      termination_ = std::max(termination_, state.termination);
      force_.push_back(state.force);
      sets_.push_back(contact_set(state));
      record_.displacement.push_back(values_at(history.displacement(), cells));
      record_.traction.push_back(values_at(state.contact_pressure, cells));
      guess = state.contact_pressure;
    }
    record_.traction.front() = record_.traction.back();
    last_pressure_ = guess;
    recorded_ = cells;
    Field end(start.rows(), start.cols());
    double next = indentation_;
    if (stiffness_ > 0) next += (held_force_ - mean_force()) / stiffness_;
    end << history.values(), Field::Constant(1, start.cols(), next);
    return end;
  }

  Termination termination() const { return termination_; }
  double indentation() const { return indentation_; }
  const std::vector<ContactSet>& sets() const { return sets_; }
  const CellRecord& record() const { return record_; }
  double force_at(int step) const {
    return force_[static_cast<std::size_t>(step > 0 ? step - 1 : path_.steps - 1)];
  }
  double mean_force() const {
    return std::accumulate(force_.begin(), force_.end(), 0.0) / path_.steps;
  }
  // ∮F dδ by the trapezoidal rule.
  double work() const {
    double sum = 0;
    for (int n = 0; n < path_.steps; ++n)
      sum += (force_at(n) + force_at(n + 1)) / 2 * (path_.dip(n + 1) - path_.dip(n));
    return sum;
  }
  double storage_stiffness() const {
    double sum = 0;
    for (int n = 0; n < path_.steps; ++n) sum += force_at(n) * path_.dip(n);
    return path_.amplitude > 0 ? 2 * sum / path_.steps / (path_.amplitude * path_.amplitude)
                               : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  // Cells that touched in the last cycle.
  std::vector<Index> cells_in_contact() const {
    std::vector<Index> cells;
    if (sets_.empty()) return cells;
    ContactSet all = sets_.front();
    for (const ContactSet& set : sets_) all = all || set;
    for (Index k = 0; k < all.size(); ++k)
      if (all.data()[k]) cells.push_back(k);
    return cells;
  }
  static Field values_at(const Field& field, const std::vector<Index>& cells) {
    Field values(1, static_cast<Index>(cells.size()));
    for (Index k = 0; k < values.size(); ++k)
      values(0, k) = field.data()[cells[static_cast<std::size_t>(k)]];
    return values;
  }
  Field spread(const Field& values, const std::vector<Index>& cells) const {
    Field field = Field::Zero(surface_.grid.nx, surface_.grid.ny);
    for (Index k = 0; k < values.size(); ++k)
      field.data()[cells[static_cast<std::size_t>(k)]] = values(0, k);
    return field;
  }

  const NormalSteps& steps_;
  const Surface& surface_;
  const MaxwellSpring& spring_;
  const CyclePath& path_;
  Stretching step_;
  double held_force_ = 0, stiffness_ = 0, indentation_ = 0,
         limit_ = std::numeric_limits<double>::infinity();
  std::vector<double> force_;
  std::vector<ContactSet> sets_;
  std::vector<Index> recorded_;
  CellRecord record_;
  Field last_pressure_;
  Termination termination_ = Termination::converged;
};

// Cycles of the tangential motion with given contact sets. The state is a History of the cells that
// touch at some time, with the x components in its first row and the y components in the second.
class TangentialCycles {
 public:
  TangentialCycles(const Grid2D& grid, const Body& body, const MaxwellSpring& spring,
                   const CyclePath& path, const std::vector<ContactSet>& sets,
                   const StickOptions& options)
      : grid_(grid),
        spring_(spring),
        path_(path),
        sets_(sets),
        step_(spring.stretching(path.period() / path.steps)),
        jump_(spring.stretching(0)),
        solver_(grid, body, options),
        touched_(sets.front()) {
    ContactSet always = sets.front();
    for (const ContactSet& set : sets) {
      touched_ = touched_ || set;
      always = always && set;
    }
    for (Index k = 0; k < touched_.size(); ++k)
      if (touched_.data()[k]) cells_.push_back(k);
    growth_ = growth_traction_ = Field::Zero(2, columns());
    if (!cells_.empty()) solver_.reserve(touched_);
    if (path.drift != 0 && always.any()) find_growth(always);
  }

  Index columns() const { return static_cast<Index>(cells_.size()); }
  const Field& growth_traction() const { return growth_traction_; }

  // The surface at the first mid-step, without force in cells in permanent contact at x = 0.
  Field start() const {
    Field displacement = Field::Zero(2, columns());
    displacement.row(0) = path_.drift != 0 ? 0 : path_.tangential.front();
    return History(spring_, displacement).values();
  }

  Field run(const Field& start) {
    History history(spring_, start.topRows(2));
    history.values() = start;
    const std::vector<Field> before = std::move(record_.traction);
    record_ = {};
    for (Index k = 0; k < spring_.terms(); ++k) record_.branches.push_back(history.branch(k));
    termination_ = Termination::converged;
    work_ = jump_work_ = 0;
    force_.clear();
    Field traction = before.empty() ? Field::Zero(2, columns()) : before.front();
    solve_start(history, traction);
    keep(history, traction);
    for (int n = 0; n < path_.steps; ++n) {
      detail::stop_if_asked();
      const ContactSet& old = sets_[static_cast<std::size_t>(n > 0 ? n - 1 : path_.steps - 1)];
      const ContactSet& now = sets_[static_cast<std::size_t>(n)];
      const std::size_t index = record_.traction.size();
      const auto guess = [&](std::size_t k) { return k < before.size() ? before[k] : traction; };
      if ((old && !now).any()) {
        const Field held = traction;
        const Field from = history.displacement();
        solve(history, jump_, old && now, 0, guess(index), traction);
        const Field moved = history.displacement() - from;
        for (Index k = 0; k < columns(); ++k)
          if (!now.data()[cells_[static_cast<std::size_t>(k)]])
            jump_work_ -=
                grid_.cell_area() / 2 * (held(0, k) * moved(0, k) + held(1, k) * moved(1, k));
      }
      keep(history, traction);
      const double move = path_.tangential[static_cast<std::size_t>(n) + 1] -
                          path_.tangential[static_cast<std::size_t>(n)];
      const double force = force_of(traction);
      solve(history, step_, now, move, guess(index + 1), traction);
      keep(history, traction);
      work_ += (force + force_of(traction)) / 2 * move;
      force_.push_back((force + force_of(traction)) / 2);
    }
    // The permanent contact drags a stationary field along, whose energy is stored.
    if (path_.drift != 0) {
      const Field at_start = start.topRows(2);
      work_ -= grid_.cell_area() *
               ((growth_traction_ * at_start).sum() + (growth_traction_ * growth_).sum() / 2);
    }
    Field end = history.values();
    end.topRows(2) -= growth_;
    return end;
  }

  Termination termination() const { return termination_; }
  double work() const { return work_; }
  double jump_work() const { return jump_work_; }
  const std::vector<double>& force() const { return force_; }  // in the middle of the moves
  // The record of one component.
  CellRecord record(Index component) const {
    CellRecord one;
    const auto row = [&](const Field& both) -> Field { return both.row(component); };
    std::ranges::transform(record_.displacement, std::back_inserter(one.displacement), row);
    std::ranges::transform(record_.traction, std::back_inserter(one.traction), row);
    std::ranges::transform(record_.branches, std::back_inserter(one.branches), row);
    return one;
  }
  std::vector<double> durations() const {
    std::vector<double> all;
    for (int n = 0; n < path_.steps; ++n)
      all.insert(all.end(), {0.0, path_.period() / path_.steps});
    return all;
  }

 private:
  void keep(const History& history, const Field& traction) {
    record_.displacement.push_back(history.displacement());
    record_.traction.push_back(traction);
  }
  double force_of(const Field& traction) const { return grid_.cell_area() * traction.row(0).sum(); }

  TangentialField spread(const Field& values) const {
    TangentialField field{Field::Zero(grid_.nx, grid_.ny), Field::Zero(grid_.nx, grid_.ny)};
    for (Index k = 0; k < columns(); ++k) {
      field.x.data()[cells_[static_cast<std::size_t>(k)]] = values(0, k);
      field.y.data()[cells_[static_cast<std::size_t>(k)]] = values(1, k);
    }
    return field;
  }
  Field gather(const TangentialField& field) const {
    Field values(2, columns());
    for (Index k = 0; k < columns(); ++k) {
      values(0, k) = field.x.data()[cells_[static_cast<std::size_t>(k)]];
      values(1, k) = field.y.data()[cells_[static_cast<std::size_t>(k)]];
    }
    return values;
  }

  // Tractions that belong to the displacements at the start of a cycle.
  void solve_start(const History& history, Field& traction) {
    traction *= sets_.back().any() ? 1 : 0;
    if (!sets_.back().any()) return;
    TangentialField tractions = spread(traction);
    const StickReport report =
        solver_.solve(sets_.back(), spread(history.response()), path_.range, tractions);
    termination_ = std::max(termination_, report.termination);
    traction = gather(tractions);
  }

  // A step at whose end the cells of `contact` have moved by `move` along x.
  void solve(History& history, const Stretching& step, const ContactSet& contact, double move,
             const Field& guess, Field& traction) {
    const double alpha = factor(spring_, step);
    const Field offset = history.offset(step);
    Field response = Field::Zero(2, columns());
    traction.setZero();
    Field moved = history.displacement();
    moved.row(0) += move;
    if (contact.any()) {
      TangentialField tractions = spread(guess);
      const StickReport report =
          solver_.solve(contact, spread(alpha * moved + offset), alpha * path_.range, tractions);
      termination_ = std::max(termination_, report.termination);
      traction = gather(tractions);
      response = gather(solver_.displacement(contact, tractions, touched_));
    }
    Field displacement = (response - offset) / alpha;
    for (Index k = 0; k < columns(); ++k)
      if (contact.data()[cells_[static_cast<std::size_t>(k)]]) displacement.col(k) = moved.col(k);
    history.move_to(step, displacement);
  }

  void find_growth(const ContactSet& always) {
    TangentialField motion{Field::Constant(grid_.nx, grid_.ny, path_.drift),
                           Field::Zero(grid_.nx, grid_.ny)};
    TangentialField tractions;
    termination_ = solver_.solve(always, motion, path_.range, tractions).termination;
    growth_traction_ = gather(tractions);
    growth_ = gather(solver_.displacement(always, tractions, touched_));
  }

  const Grid2D& grid_;
  const MaxwellSpring& spring_;
  const CyclePath& path_;
  const std::vector<ContactSet>& sets_;
  Stretching step_, jump_;
  StickSolver solver_;
  ContactSet touched_;
  std::vector<Index> cells_;
  Field growth_, growth_traction_;
  CellRecord record_;
  std::vector<double> force_;
  double work_ = 0, jump_work_ = 0;
  Termination termination_ = Termination::converged;
};

// Finds the periodic state of one problem, for one number of steps and one frequency after another.
class SteadyState {
 public:
  SteadyState(const Surface& surface, const Body& body, const PronySeries& series,
              const OperatingPoint& point, double amplitude,
              const ViscoelasticCycleOptions& options)
      : surface_(surface),
        body_(body),
        series_(series),
        options_(options),
        spring_(series),
        steps_(surface, body, spring_, options.contact) {
    const NormalContactState rest = press(surface, body, point, options.contact);
    if (!rest.converged()) {
      failed_ = rest.termination;
      return;
    }
    rest_indentation_ = rest.indentation;
    const bool leaves = point.load_given() && amplitude > rest.indentation;
    if (options.hold == Hold::force || (options.hold == Hold::automatic && leaves)) {
      held_force_ = rest.force;
      const double stiffness = normal_stiffness(rest, surface.grid, body, options.contact);
      held_stiffness_ = std::isfinite(stiffness) ? stiffness * spring_.unrelaxed_stiffness()
                                                 : rest.force / rest.indentation;
    }
    state_ = NormalCycles::state_of(spring_, displacement_of(rest, surface, steps_.highest()),
                                    rest.indentation);
  }

  ViscoelasticCycle cycle(const Oscillation& motion, int count) {
    const CyclePath path(motion, count);
    ViscoelasticCycle result;
    result.angular_frequency = path.angular_frequency;
    result.termination = failed_;
    if (failed_ != Termination::converged) return result;
    const detail::Branches decay = spring_.mode_decay(path.period());
    const double lost = decay.size() > 0 ? 1 - decay.maxCoeff() : 1;

    const Field before = state_;
    NormalCycles normal(steps_, surface_, spring_, path);
    if (held_stiffness_ > 0) normal.hold_force(held_force_, held_stiffness_);
    normal.limit(full_indentation(surface_, body_, options_.contact.boundary));
    const SearchReport found = find_periodic(
        state_, normal, path.amplitude > 0 ? path.amplitude : rest_indentation_, lost, options_);
    // The search of the next frequency shall not start from where this one ended.
    if (found.termination != Termination::converged) state_ = before;
    const double area = surface_.grid.cell_area();
    const BranchLoss branch_loss(spring_, series_);
    set_normal(result, normal, path, found);
    result.dissipated = area * branch_loss(normal.record(),
                                           std::vector<double>(static_cast<std::size_t>(path.steps),
                                                               path.period() / path.steps),
                                           {});
    if (path.range > 0 && !(result.contact_area_max > 0)) result.tangential_work = 0;
    if (path.range > 0 && result.contact_area_max > 0) {
      TangentialCycles tangential(surface_.grid, body_, spring_, path, normal.sets(),
                                  options_.stick);
      Field start = tangential.start();
      const SearchReport tangentially =
          find_periodic(start, tangential, path.range, lost, options_);
      set_tangential(result, tangential, motion, path, tangentially);
      for (const Index component : {0, 1})
        result.dissipated +=
            area * branch_loss(tangential.record(component), tangential.durations(),
                               tangential.growth_traction().row(component));
      result.dissipated += tangential.jump_work();
    }
    result.work_per_cycle = result.normal_work + result.tangential_work;
    result.power = result.work_per_cycle / path.period();
    const double square = path.drift != 0 ? std::pow(path.drift / path.period(), 2)
                                          : std::pow(path.range * path.angular_frequency, 2) / 2;
    if (path.range > 0) result.damping_constant = result.tangential_work / path.period() / square;
    return result;
  }

 private:
  void set_normal(ViscoelasticCycle& result, const NormalCycles& normal, const CyclePath& path,
                  const SearchReport& found) const {
    result.termination = found.termination;
    result.cycles = found.cycles;
    result.residual = found.residual;
    result.normal_work = normal.work();
    result.mean_indentation = normal.indentation();
    result.mean_force = normal.mean_force();
    result.normal_storage_stiffness = normal.storage_stiffness();
    if (path.amplitude > 0)
      result.normal_loss_stiffness = normal.work() / (pi * path.amplitude * path.amplitude);
    for (int n = 0; n <= path.steps; ++n) {
      const ContactSet& set =
          normal.sets()[static_cast<std::size_t>(n > 0 ? n - 1 : path.steps - 1)];
      result.samples.push_back(
          {.time = path.period() * n / path.steps,
           .indentation = normal.indentation() + path.dip(n),
           .tangential = 0,
           .normal_force = normal.force_at(n),
           .tangential_force = 0,
           .contact_area = static_cast<double>(set.count()) * surface_.grid.cell_area()});
    }
    const auto [least, most] =
        std::ranges::minmax(result.samples, {}, &ViscoelasticSample::contact_area);
    result.contact_area_min = least.contact_area;
    result.contact_area_max = most.contact_area;
  }

  static void set_tangential(ViscoelasticCycle& result, const TangentialCycles& tangential,
                             const Oscillation& motion, const CyclePath& path,
                             const SearchReport& found) {
    result.termination = std::max(result.termination, found.termination);
    result.cycles += found.cycles;
    result.residual = std::max(result.residual, found.residual);
    result.tangential_work = tangential.work();
    result.jump_work = tangential.jump_work();
    double in_phase = 0;
    for (int n = 0; n <= path.steps; ++n) {
      ViscoelasticSample& sample = result.samples[static_cast<std::size_t>(n)];
      const auto index = static_cast<std::size_t>(n > 0 ? n - 1 : path.steps - 1);
      sample.tangential = path.position(motion, n);
      sample.tangential_force = tangential.force()[index];
      if (n > 0) in_phase += sample.tangential * sample.tangential_force;
    }
    if (path.drift != 0) return;
    const double square = path.range * path.range;
    result.tangential_storage_stiffness = 2 * in_phase / path.steps / square;
    result.tangential_loss_stiffness = tangential.work() / (pi * square);
  }

  const Surface& surface_;
  const Body& body_;
  const PronySeries& series_;
  const ViscoelasticCycleOptions& options_;
  MaxwellSpring spring_;
  NormalSteps steps_;
  Termination failed_ = Termination::converged;
  double rest_indentation_ = 0, held_force_ = 0, held_stiffness_ = 0;
  Field state_;
};

// The contact along a path, with a number of straight steps between the given times.
class PathSteps {
 public:
  PathSteps(const Surface& surface, const Body& body, const PronySeries& relaxation,
            std::span<const double> time, const OperatingPoints& path,
            const ViscoelasticPathOptions& options)
      : surface_(surface),
        time_(time),
        path_(path),
        options_(options),
        spring_(relaxation),
        contacts_(surface, body, spring_, options.contact) {}

  ViscoelasticPath run(int steps) const {
    History history(spring_, Field::Zero(surface_.grid.nx, surface_.grid.ny));
    ViscoelasticPath result;
    result.converged = true;
    NormalContactState state;
    for (std::size_t i = 0; i < time_.size(); ++i) {
      const int count = i > 0 ? steps : 1;
      const double duration = i > 0 ? (time_[i] - time_[i - 1]) / steps : 0,
                   before = value_at(i > 0 ? i - 1 : 0), change = value_at(i) - before;
      const Stretching step = spring_.stretching(duration);
      for (int k = 1; k <= count; ++k) {
        const double value = before + change * k / count;
        const Field guess = state.contact_pressure;
        state = contacts_.advance(history, step, {path_.control, value}, &guess);
        if (state.termination == Termination::interrupted) stop();
        result.converged = result.converged && state.converged();
      }
      result.points.push_back({.time = time_[i],
                               .pressure = state.force / surface_.grid.area(),
                               .force = state.force,
                               .indentation = state.indentation,
                               .mean_gap = state.mean_gap,
                               .contact_area_fraction = state.contact_area_fraction});
      report(steps, i + 1);
    }
    result.contact_pressure = state.contact_pressure;
    result.gap = state.gap;
    return result;
  }

 private:
  double value_at(std::size_t i) const { return path_.values[path_.values.size() > 1 ? i : 0]; }

  // The first run has half as many steps as the second one.
  void report(int steps, std::size_t done) const {
    const double part = static_cast<double>(done) / static_cast<double>(time_.size()),
                 fraction = steps < options_.steps ? part / 3 : (1 + 2 * part) / 3;
    if (options_.on_progress &&
        !options_.on_progress({.stage = "viscoelastic", .fraction = fraction}))
      stop();
  }
  [[noreturn]] static void stop() { throw Interrupted("viscoelastic: interrupted"); }

  const Surface& surface_;
  std::span<const double> time_;
  const OperatingPoints& path_;
  const ViscoelasticPathOptions& options_;
  MaxwellSpring spring_;
  NormalSteps contacts_;
};

}  // namespace

void ViscoelasticCycle::drop_uncertain() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!converged()) {
    samples.clear();
    describe(
        [&](auto member, const auto&) {
          if constexpr (std::is_same_v<decltype(member), double ViscoelasticCycle::*>)
            if (member != &ViscoelasticCycle::angular_frequency &&
                member != &ViscoelasticCycle::residual)
              this->*member = unknown;
        },
        std::type_identity<ViscoelasticCycle>{});
    return;
  }
  if (!(work_per_cycle_error < tangential_work))
    damping_constant = tangential_loss_stiffness = unknown;
  if (work_per_cycle_error < work_per_cycle) return;
  for (double ViscoelasticCycle::*const number :
       {&ViscoelasticCycle::work_per_cycle, &ViscoelasticCycle::normal_work,
        &ViscoelasticCycle::tangential_work, &ViscoelasticCycle::jump_work,
        &ViscoelasticCycle::dissipated, &ViscoelasticCycle::power,
        &ViscoelasticCycle::normal_loss_stiffness})
    this->*number = unknown;
}

ViscoelasticPath viscoelastic_path(const Surface& surface, const Body& body,
                                   const PronySeries& relaxation, std::span<const double> time,
                                   const OperatingPoints& path,
                                   const ViscoelasticPathOptions& options) {
  check(surface, options.contact);
  require(!time.empty(), "time", time.size(), "values given; give at least 1");
  require(path.values.size() == time.size() || path.values.size() == 1, argument_of(path),
          path.values.size(), "values do not match the times; give one, or one for each");
  require(path.control != ControlQuantity::mean_gap, "mean_gap", path.values.front(),
          "cannot be prescribed along a path; give pressures, forces or indentations");
  require(options.steps >= 2 && options.steps % 2 == 0, "steps", options.steps,
          "must be even and >= 2");
  for (std::size_t i = 0; i < time.size(); ++i)
    require(std::isfinite(time[i]) && (i == 0 || time[i] > time[i - 1]), "time", time[i],
            "s must be finite and later than the time before");
  check_values(path, full_indentation(surface, body, options.contact.boundary));
  const PathSteps steps(surface, body, relaxation, time, path, options);
  const ViscoelasticPath coarse = steps.run(options.steps / 2);
  ViscoelasticPath fine = steps.run(options.steps);
  for (std::size_t i = 0; i < time.size(); ++i) {
    ViscoelasticPoint& point = fine.points[i];
    const ViscoelasticPoint& half = coarse.points[i];
    if (path.control == ControlQuantity::indentation)
      point.pressure_error = std::abs(point.pressure - half.pressure);
    else
      point.indentation_error = std::abs(point.indentation - half.indentation);
  }
  fine.converged = fine.converged && coarse.converged;
  return fine;
}

std::vector<ViscoelasticCycle> viscoelastic_sweep(const Surface& surface, const Body& body,
                                                  const PronySeries& relaxation,
                                                  const Oscillation& motion,
                                                  const OperatingPoint& point,
                                                  std::span<const double> angular_frequencies,
                                                  const ViscoelasticCycleOptions& options) {
  check(surface, options.contact);
  require(options.steps >= 16 && options.steps % 2 == 0, "steps", options.steps,
          "must be even and >= 16");
  require(options.tolerance >= 1e-10 && options.tolerance <= 0.1, "tolerance", options.tolerance,
          "must lie in 1e-10 … 0.1");
  require(options.max_cycles >= 2, "max_cycles", options.max_cycles, "must be >= 2");
  require(options.stick.boundary == options.contact.boundary, "boundary",
          name_of(options.stick.boundary),
          "of the tangential solves must be that of the normal contact");
  const double amplitude = detail::normal_amplitude(motion);
  require(std::isfinite(amplitude) && amplitude >= 0, "normal_amplitude", amplitude,
          "must be >= 0");
  std::visit(
      [](const auto& one) {
        if constexpr (requires { one.drag_velocity; })
          require(std::isfinite(one.drag_velocity), "drag_velocity", one.drag_velocity,
                  "must be finite");
        else
          require(std::isfinite(one.tangential_amplitude) && std::isfinite(one.phase),
                  "tangential_amplitude", one.tangential_amplitude, "and the phase must be finite");
      },
      motion);
  for (const double frequency : angular_frequencies)
    require_positive(frequency, "angular_frequency");
  require_memory(surface.grid,
                 (8.0 * kept_cycles + 40) * static_cast<double>(1 + relaxation.terms.size()) *
                         static_cast<double>(surface.grid.points()) +
                     options.steps * static_cast<double>(surface.grid.points()),
                 "the cycles of a viscoelastic contact");

  SteadyState steady(surface, body, relaxation, point, amplitude, options);
  std::vector<ViscoelasticCycle> sweep;
  for (const double frequency : angular_frequencies) {
    Oscillation here = motion;
    std::visit([&](auto& one) { one.angular_frequency = frequency; }, here);
    const ViscoelasticCycle coarse = steady.cycle(here, options.steps / 2);
    ViscoelasticCycle fine = steady.cycle(here, options.steps);
    fine.cycles += coarse.cycles;
    fine.termination = std::max(fine.termination, coarse.termination);
    fine.step_error = std::abs(fine.work_per_cycle - coarse.work_per_cycle);
    fine.work_per_cycle_error = fine.step_error + std::abs(fine.dissipated - fine.work_per_cycle);
    fine.drop_uncertain();
    sweep.push_back(std::move(fine));
  }
  return sweep;
}

ViscoelasticCycle viscoelastic_cycle(const Surface& surface, const Body& body,
                                     const PronySeries& relaxation, const Oscillation& motion,
                                     const OperatingPoint& point,
                                     const ViscoelasticCycleOptions& options) {
  const double frequency =
      std::visit([](const auto& one) { return one.angular_frequency; }, motion);
  return viscoelastic_sweep(surface, body, relaxation, motion, point, std::span(&frequency, 1),
                            options)
      .front();
}

}  // namespace salebra
