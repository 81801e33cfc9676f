// SPDX-License-Identifier: GPL-3.0-or-later
// Hertzian summits that displace each other elastically, by Newton's method with conjugate
// gradients for its linear systems.
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/interacting_summits.hpp>

#include "contact/half_space/periodic_point_loads.hpp"
#include "given_summits.hpp"

namespace salebra {
namespace {

using Values = std::vector<double>;
using Members = std::vector<std::uint32_t>;

constexpr const char* stage = "interacting summits";

double dot(const Values& a, const Values& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<detail::PlanePoint> positions_of(const std::vector<Summit>& summits) {
  std::vector<detail::PlanePoint> points;
  for (const Summit& summit : summits) {
    require(std::isfinite(summit.x) && std::isfinite(summit.y), "summits.position", summit.x,
            "must be finite");
    points.push_back({summit.x, summit.y});
  }
  return points;
}

/// Load P divided by E*, and dP/dδ divided by E*, of a cap at its indentation δ; 0 out of contact.
struct Hertz {
  double load, stiffness;
};
Hertz hertz(const detail::HertzCap& cap, double indentation) {
  const double depth = std::max(indentation, 0.0);
  const double stiffness = 2 * std::sqrt(cap.force_radius * depth);
  return {2.0 / 3 * stiffness * depth, stiffness};
}

/// Returns the shift c for which caps at the indentations δ_i + c together carry the load. Newton's
/// method starts where one cap alone carries the load; the sum of the loads is convex in c, so no
/// step overshoots.
double common_shift(const std::vector<detail::HertzCap>& caps, const Values& indentation,
                    double load) {
  double shift = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < caps.size(); ++i) {
    const double depth = std::cbrt(9 * load * load / (16 * caps[i].force_radius));
    shift = std::min(shift, depth - indentation[i]);
  }
  for (int step = 0; step < 200; ++step) {
    double sum = 0, slope = 0;
    for (std::size_t i = 0; i < caps.size(); ++i) {
      const Hertz one = hertz(caps[i], indentation[i] + shift);
      sum += one.load;
      slope += one.stiffness;
    }
    constexpr double round_off = 1e-14;
    if (sum <= load * (1 + round_off)) break;
    shift -= (sum - load) / slope;
  }
  return shift;
}

/// The summits that carry load in the current iterate, with a PeriodicPointLoads kernel of their
/// own: most linear systems concern only these summits.
struct Contacts {
  Members members;
  detail::PeriodicPointLoads kernel;
};

/// Reports progress; throws Interrupted if the callback asks to stop.
struct SummitWatch {
  const Progress& progress;
  int step = 0;
  double residual = 0;

  void operator()() const {
    if (progress && !progress({.stage = stage, .step = step, .residual = residual}))
      throw Interrupted(std::string(stage) + ": interrupted");
  }
};

struct LinearSolution {
  Values scaled;     ///< √D⁻¹ x; x solves (D⁻¹ + G)x + shift = right
  double shift = 0;  ///< makes Σx = 0 if required, otherwise 0
  bool converged = false;
};

/// Solves (D⁻¹ + G)x + shift = right, where the diagonal matrix D holds the contact stiffnesses and
/// G the displacements of the summits under unit loads on the other summits. Conjugate gradients on
/// I + √D G √D, whose spectrum starts near 1; if hold_sum is true, a projection keeps Σx = 0. root:
/// the elements of √D, all > 0. Two contacts that are too close to be described as point forces
/// make the matrix indefinite; then the iteration stops at the descent direction reached so far.
/// This iteration has its own loop, because with an indefinite matrix the first direction is the
/// result, and because the projection acts on the residual, from which the shift is read.
LinearSolution linear_solve(Contacts& contacts, const Values& root, const Values& right,
                            double tolerance, bool hold_sum, const SummitWatch& watch) {
  const std::size_t n = root.size();
  LinearSolution solution{Values(n), 0, false};
  const double root_square = dot(root, root);
  const auto projected = [&](Values values) {
    if (!hold_sum) return values;
    const double part = dot(root, values) / root_square;
    for (std::size_t i = 0; i < n; ++i) values[i] -= part * root[i];
    return values;
  };
  Values residual(n), scaled_direction(n), image(n);
  for (std::size_t i = 0; i < n; ++i) residual[i] = root[i] * right[i];
  Values gradient = projected(residual), direction = gradient;
  double square = dot(gradient, gradient);
  const double goal = tolerance * tolerance * square;
  for (int iteration = 0; iteration < 500; ++iteration) {
    if (square <= goal) {
      solution.converged = true;
      break;
    }
    for (std::size_t i = 0; i < n; ++i) scaled_direction[i] = root[i] * direction[i];
    contacts.kernel.apply(scaled_direction, image);
    watch();
    for (std::size_t i = 0; i < n; ++i) image[i] = direction[i] + root[i] * image[i];
    const double bend = dot(direction, image);
    if (!(bend > 0)) {
      if (iteration == 0) solution.scaled = direction;
      break;
    }
    const double step = square / bend;
    for (std::size_t i = 0; i < n; ++i) {
      solution.scaled[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    gradient = projected(residual);
    const double next = dot(gradient, gradient);
    for (std::size_t i = 0; i < n; ++i) direction[i] = gradient[i] + next / square * direction[i];
    square = next;
  }
  if (hold_sum) solution.shift = dot(root, residual) / root_square;
  return solution;
}

}  // namespace

// Loads are divided by E*, so that loads and the kernel depend only on geometry.
struct InteractingSummits::System {
  std::vector<detail::HertzCap> caps;
  std::vector<detail::PlanePoint> points;
  double lx, ly;
  mutable std::mutex mutex;  // for the kernel's work space: threads share at()
  mutable detail::PeriodicPointLoads kernel;
  mutable std::unique_ptr<Contacts> last_contacts;

  System(const std::vector<Summit>& summits, const Grid2D& grid, SummitShape shape)
      : caps(detail::hertz_caps(summits, shape)),
        points(positions_of(summits)),
        lx(grid.lx),
        ly(grid.ly),
        kernel(points, lx, ly) {}

  std::size_t size() const { return caps.size(); }

  Values displacements(const Values& loads) const {
    Values result(size());
    kernel.apply(loads, result);
    return result;
  }

  /// Returns the summits with stiffness > 0; their kernel is kept while the set of these summits
  /// stays the same.
  Contacts& contacts_of(const Values& stiffness) const {
    Members members;
    for (std::size_t i = 0; i < size(); ++i)
      if (stiffness[i] > 0) members.push_back(static_cast<std::uint32_t>(i));
    if (!last_contacts || last_contacts->members != members) {
      std::vector<detail::PlanePoint> chosen;
      for (const std::uint32_t i : members) chosen.push_back(points[i]);
      last_contacts.reset(new Contacts{std::move(members), {std::move(chosen), lx, ly}});
    }
    return *last_contacts;
  }
};

InteractingSummits::InteractingSummits(const std::vector<Summit>& summits, const Material& material,
                                       const Grid2D& grid, double mean_plane, double rms_height,
                                       SummitShape shape, const InteractionOptions& options)
    : AsperityModel(detail::given_summits("greenwood-williamson-interacting", summits, material,
                                          grid.area(), mean_plane, rms_height)),
      options_(options) {
  grid.validate();
  require(options.tolerance > 0 && options.tolerance < 1, "tolerance", options.tolerance,
          "must satisfy 0 < tolerance < 1");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, "must be >= 1");
  system_ = std::make_unique<const System>(summits, grid, shape);
}

InteractingSummits::~InteractingSummits() = default;

/// One iterate of Newton's method: the indentations (negative: gaps) of all summits, and the
/// quantities that follow from the indentations. Below, z_i is the height of summit i, s the
/// separation, δ_i an indentation, P_i a load and (GP)_i the displacement of summit i by the loads
/// on the others.
struct InteractingSummits::Iterate {
  Values indentation, loads, stiffness;
  Values error;  ///< of each indentation: z_i − s − (GP)_i − δ_i
  double separation = 0;
  double energy = 0;  ///< Σ∫δ dP + ½ P·GP − P·(z−s), minimal if all contacts are in equilibrium
  double residual = 0;  ///< maximum error of an indentation over the maximum indentation
};

InteractingSummits::Iterate InteractingSummits::evaluated(Values indentation,
                                                          const Goal& goal) const {
  const System& system = *system_;
  const std::size_t n = system.size();
  Iterate iterate{std::move(indentation), Values(n), Values(n), Values(n), goal.separation, 0, 0};
  // If the load is given, every iterate carries this load, and its separation s is the one that
  // makes the errors of the indentations smallest.
  if (goal.load) {
    const double shift = common_shift(system.caps, iterate.indentation, *goal.load);
    for (double& depth : iterate.indentation) depth += shift;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Hertz one = hertz(system.caps[i], iterate.indentation[i]);
    iterate.loads[i] = one.load;
    iterate.stiffness[i] = one.stiffness;
  }
  const Values displacement = system.displacements(iterate.loads);
  for (std::size_t i = 0; i < n; ++i)
    iterate.error[i] = system.caps[i].height - displacement[i] - iterate.indentation[i];
  if (goal.load) {
    iterate.separation = dot(iterate.stiffness, iterate.error) /
                         std::accumulate(iterate.stiffness.begin(), iterate.stiffness.end(), 0.0);
  }
  double greatest_error = 0, greatest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    iterate.error[i] -= iterate.separation;
    const double depth = std::max(iterate.indentation[i], 0.0);
    const double left = iterate.error[i] + iterate.indentation[i];
    greatest_error = std::max(greatest_error, std::abs(depth - std::max(left, 0.0)));
    greatest = std::max({greatest, depth, left});
    const double approach = system.caps[i].height - (goal.load ? 0 : iterate.separation);
    iterate.energy += iterate.loads[i] * (0.6 * depth + 0.5 * displacement[i] - approach);
  }
  iterate.residual = greatest > 0 ? greatest_error / greatest : 0;
  return iterate;
}

InteractingSummits::State InteractingSummits::equilibrium(Values indentation, const Goal& goal,
                                                          const Progress& progress) const {
  const System& system = *system_;
  const std::lock_guard lock(system.mutex);
  const std::size_t n = system.size();
  State state;
  SummitWatch watch{progress ? progress : options_.on_progress};
  watch();
  Iterate current = evaluated(std::move(indentation), goal);
  for (; state.iterations < options_.max_iterations; ++state.iterations) {
    if (current.residual <= options_.tolerance) break;
    watch.step = state.iterations;
    watch.residual = current.residual;
    watch();
    LinearSolution newton;
    Values load_step(n), step(n), roots;
    double slope = 0;
    const bool touches = std::ranges::max(current.stiffness) > 0;
    if (touches) {
      Contacts& contacts = system.contacts_of(current.stiffness);
      Values errors;
      for (const std::uint32_t i : contacts.members) {
        roots.push_back(std::sqrt(current.stiffness[i]));
        errors.push_back(current.error[i]);
      }
      newton = linear_solve(contacts, roots, errors, std::clamp(current.residual, 1e-8, 0.1),
                            goal.load.has_value(), watch);
      for (std::size_t k = 0; k < roots.size(); ++k)
        load_step[contacts.members[k]] = roots[k] * newton.scaled[k];
    }
    const Values moved = touches ? system.displacements(load_step) : Values(n);
    for (std::size_t i = 0, k = 0; i < n; ++i) {
      step[i] = current.stiffness[i] > 0 ? newton.scaled[k] / roots[k]
                                         : current.error[i] - moved[i] - newton.shift;
      if (current.stiffness[i] > 0) ++k;
      slope -= current.error[i] * load_step[i];
    }
    bool accepted = false;
    for (double length = 1; !accepted && length > 1e-6; length /= 2) {
      Values trial_indentation(n);
      for (std::size_t i = 0; i < n; ++i)
        trial_indentation[i] = current.indentation[i] + length * step[i];
      Iterate trial = evaluated(std::move(trial_indentation), goal);
      watch();
      // Close to the solution the energy no longer resolves a step, but the residual does.
      accepted = trial.energy <= current.energy + 1e-4 * length * slope ||
                 trial.residual <= 0.5 * current.residual;
      if (accepted) current = std::move(trial);
    }
    if (!accepted) break;
  }
  state.separation = current.separation;
  state.residual = current.residual;
  state.converged = current.residual <= options_.tolerance;
  state.loads = std::move(current.loads);
  state.indentation = std::move(current.indentation);
  for (double& load : state.loads) load *= common().material.contact_modulus;
  return state;
}

InteractingSummits::State InteractingSummits::solve(double separation,
                                                    const Progress& progress) const {
  Values independent;
  for (const detail::HertzCap& cap : system_->caps) independent.push_back(cap.height - separation);
  return equilibrium(std::move(independent), {separation, {}}, progress);
}

InteractingSummits::State InteractingSummits::solve_for_force(double force, const State* near,
                                                              const Progress& progress) const {
  require_positive(force, "force");
  const Goal goal{0, force / common().material.contact_modulus};
  if (near) {
    State state = equilibrium(near->indentation, goal, progress);
    if (state.converged) return state;
  }
  Values heights;
  for (const detail::HertzCap& cap : system_->caps) heights.push_back(cap.height);
  return equilibrium(std::move(heights), goal, progress);
}

double InteractingSummits::force(double separation) const {
  const State state = solve(separation);
  return std::accumulate(state.loads.begin(), state.loads.end(), 0.0);
}

double InteractingSummits::separation_of(double target) const {
  const State state = solve_for_force(target);
  if (!state.converged)
    throw NotConverged("interacting_summits: no equilibrium at the requested force");
  return state.separation;
}

AsperityContact InteractingSummits::at(double separation) const {
  return contact_of(solve(separation));
}

AsperityContact InteractingSummits::contact_of(const State& state, const Progress& progress) const {
  const System& system = *system_;
  const double modulus = common().material.contact_modulus;
  AsperityContact sum;
  sum.converged = state.converged;
  Values stiffness(system.size());
  for (std::size_t i = 0; i < system.size(); ++i) {
    if (!(state.loads[i] > 0)) continue;
    stiffness[i] = hertz(system.caps[i], state.indentation[i]).stiffness;
    sum.contacts += 1;
    sum.contact_area += std::numbers::pi * system.caps[i].area_radius * state.indentation[i];
    sum.force += state.loads[i];
  }
  if (sum.contacts == 0) return sum;

  const std::lock_guard lock(system.mutex);
  Contacts& contacts = system.contacts_of(stiffness);
  Values roots;
  for (const std::uint32_t i : contacts.members) roots.push_back(std::sqrt(stiffness[i]));
  // With loads P of the summits in contact, stiffnesses D = dP/dδ, the compliance G between summits
  // and indentations δ, the derivatives of P with respect to the approach of the bodies follow from
  // (D⁻¹ + G)P' = 1 and, differentiated once more, (D⁻¹ + G)P'' = ½(P'/D)²/δ.
  const SummitWatch watch{progress ? progress : options_.on_progress};
  const auto first =
      linear_solve(contacts, roots, Values(roots.size(), 1.0), options_.tolerance, false, watch);
  Values right;
  for (std::size_t k = 0; k < roots.size(); ++k)
    right.push_back(first.scaled[k] * first.scaled[k] /
                    (2 * roots[k] * roots[k] * state.indentation[contacts.members[k]]));
  const auto second = linear_solve(contacts, roots, right, options_.tolerance, false, watch);
  sum.normal_stiffness = modulus * dot(roots, first.scaled);
  sum.force_curvature = modulus * dot(roots, second.scaled);
  sum.converged = state.converged && first.converged && second.converged;
  return sum;
}

ForceCurve curve_at_pressures(const InteractingSummits& model, std::vector<double> pressures,
                              const Progress& progress) {
  for (const double pressure : pressures) require_positive(pressure, "pressures");
  std::ranges::sort(pressures);
  const AsperityModel::Common& common = model.common();
  ForceCurve curve{.model = common.name,
                   .nominal_area = common.nominal_area,
                   .rms_height = common.rms_height,
                   .samples = {}};
  InteractingSummits::State state;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    Progress of_load;
    if (progress)
      of_load = [&](const ProgressReport& report) {
        return progress({.stage = stage,
                         .fraction = double(k) / double(pressures.size()),
                         .step = int(k),
                         .residual = report.residual});
      };
    try {
      state = model.solve_for_force(pressures[k] * common.nominal_area,
                                    state.converged ? &state : nullptr, of_load);
      curve.samples.push_back(
          state.converged ? force_sample(model, state.separation, model.contact_of(state, of_load))
                          : ForceSample{.force = pressures[k] * common.nominal_area,
                                        .pressure = pressures[k],
                                        .converged = false});
    } catch (const Interrupted&) {
      break;
    }
  }
  return curve;
}

}  // namespace salebra
