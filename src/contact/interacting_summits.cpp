// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/interacting_summits.hpp>

#include "given_summits.hpp"
#include "periodic_point_loads.hpp"

namespace salebra {
namespace {

using Values = std::vector<double>;

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

}  // namespace

// Loads are in units of E* throughout, so that they and the kernel are geometry.
struct InteractingSummits::System {
  std::vector<detail::HertzCap> caps;
  mutable std::mutex mutex;  // of the kernel's work space: at() may run in several threads
  mutable detail::PeriodicPointLoads kernel;

  System(const std::vector<Summit>& summits, const Grid2D& grid, SummitShape shape)
      : caps(detail::hertz_caps(summits, shape)), kernel(positions_of(summits), grid.lx, grid.ly) {}

  std::size_t size() const { return caps.size(); }

  Values displacements(const Values& loads) const {
    Values result(size());
    kernel.apply(loads, result);
    return result;
  }

  /// P and dP/dδ of each summit at its indentation; 0 out of contact.
  void hertz(const Values& indentation, Values& loads, Values& stiffness) const {
    for (std::size_t i = 0; i < size(); ++i) {
      const double depth = std::max(indentation[i], 0.0);
      stiffness[i] = 2 * std::sqrt(caps[i].force_radius * depth);
      loads[i] = 2.0 / 3 * stiffness[i] * depth;
    }
  }

  struct LinearSolution {
    Values scaled;  ///< D^{−1/2}x of (D⁻¹ + G)x = rhs, zero where D is
    bool converged = false;
  };
  /// Conjugate gradients on I + √D G √D, whose spectrum starts near 1. Stops where two contacts so close to each other that a point
  /// force no longer describes them make it indefinite, with the descent direction reached until then.
  LinearSolution linear_solve(const Values& stiffness, const Values& right,
                              double tolerance) const {
    const std::size_t n = size();
    LinearSolution solution{Values(n), false};
    Values root(n), residual(n), scaled_direction(n);
    for (std::size_t i = 0; i < n; ++i) {
      root[i] = std::sqrt(stiffness[i]);
      residual[i] = root[i] * right[i];
    }
    Values direction = residual;
    double square = dot(residual, residual);
    const double goal = tolerance * tolerance * square;
    for (int iteration = 0; iteration < 500; ++iteration) {
      if (square <= goal) {
        solution.converged = true;
        break;
      }
      for (std::size_t i = 0; i < n; ++i) scaled_direction[i] = root[i] * direction[i];
      Values image = displacements(scaled_direction);
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
      const double next = dot(residual, residual);
      for (std::size_t i = 0; i < n; ++i) direction[i] = residual[i] + next / square * direction[i];
      square = next;
    }
    return solution;
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

/// The state that Newton's method moves: indentations (negative: gaps) and what follows from them.
struct InteractingSummits::Iterate {
  Values indentation, loads, stiffness, displacement;
  double energy = 0;  ///< Σ∫δ dP + ½ P·GP − P·(z−s), least where all contacts are in equilibrium
  double residual = 0;  ///< greatest error of an indentation over the greatest indentation
};

InteractingSummits::State InteractingSummits::solve(double separation) const {
  Values independent;
  for (const detail::HertzCap& cap : system_->caps) independent.push_back(cap.height - separation);
  return solve_from(separation, std::move(independent));
}

InteractingSummits::State InteractingSummits::solve_from(double separation,
                                                         Values indentation) const {
  const System& system = *system_;
  const std::lock_guard lock(system.mutex);
  const std::size_t n = system.size();
  Values approach(n);
  for (std::size_t i = 0; i < n; ++i) approach[i] = system.caps[i].height - separation;

  const auto evaluated = [&](Values trial) {
    Iterate iterate{std::move(trial), Values(n), Values(n), {}, 0, 0};
    system.hertz(iterate.indentation, iterate.loads, iterate.stiffness);
    iterate.displacement = system.displacements(iterate.loads);
    double error = 0, greatest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double depth = std::max(iterate.indentation[i], 0.0);
      const double left = approach[i] - iterate.displacement[i];
      error = std::max(error, std::abs(depth - std::max(left, 0.0)));
      greatest = std::max({greatest, depth, left});
      iterate.energy +=
          iterate.loads[i] * (0.6 * depth + 0.5 * iterate.displacement[i] - approach[i]);
    }
    iterate.residual = greatest > 0 ? error / greatest : 0;
    return iterate;
  };

  State state;
  Iterate current = evaluated(std::move(indentation));
  for (; state.iterations < options_.max_iterations; ++state.iterations) {
    if (current.residual <= options_.tolerance) break;
    Values error(n);
    for (std::size_t i = 0; i < n; ++i)
      error[i] = approach[i] - current.displacement[i] - current.indentation[i];
    const auto newton =
        system.linear_solve(current.stiffness, error, std::clamp(current.residual, 1e-8, 0.1));
    Values load_step(n);
    for (std::size_t i = 0; i < n; ++i)
      load_step[i] = std::sqrt(current.stiffness[i]) * newton.scaled[i];
    const Values moved = system.displacements(load_step);
    Values step(n);
    double slope = 0;
    for (std::size_t i = 0; i < n; ++i) {
      step[i] = current.stiffness[i] > 0 ? newton.scaled[i] / std::sqrt(current.stiffness[i])
                                         : error[i] - moved[i];
      slope -= error[i] * load_step[i];
    }
    bool accepted = false;
    for (double length = 1; !accepted && length > 1e-6; length /= 2) {
      Values moved_indentation(n);
      for (std::size_t i = 0; i < n; ++i)
        moved_indentation[i] = current.indentation[i] + length * step[i];
      Iterate trial = evaluated(std::move(moved_indentation));
      // Close to the end the energy no longer resolves the step, but the residual does.
      accepted = trial.energy <= current.energy + 1e-4 * length * slope ||
                 trial.residual <= 0.5 * current.residual;
      if (accepted) current = std::move(trial);
    }
    if (!accepted) break;
  }
  state.residual = current.residual;
  state.converged = current.residual <= options_.tolerance;
  state.loads = std::move(current.loads);
  state.indentation = std::move(current.indentation);
  for (double& load : state.loads) load *= common().material.contact_modulus;
  return state;
}

double InteractingSummits::force(double separation) const {
  const State state = solve(separation);
  return std::accumulate(state.loads.begin(), state.loads.end(), 0.0);
}

double InteractingSummits::separation_of(double target) const {
  require_positive(target, "force");
  const double scale = common().height_scale;
  double separation = common().first_touch - scale;
  double low = -std::numeric_limits<double>::infinity(), high = common().first_touch;
  Values start;
  for (const detail::HertzCap& cap : system_->caps) start.push_back(cap.height - separation);
  for (int step = 0; step < 100; ++step) {
    const State state = solve_from(separation, start);
    const AsperityContact sum = sums_of(state);
    if (!sum.converged) break;
    const double excess = std::log(sum.force / target);
    if (std::abs(excess) < 1e-9) return separation;
    (excess < 0 ? high : low) = separation;
    double next = separation + std::clamp(excess * sum.force / sum.normal_stiffness, -scale, scale);
    if (!(next > low && next < high)) next = (separation + (excess < 0 ? low : high)) / 2;
    start = state.indentation;
    for (double& indentation : start) indentation += separation - next;
    separation = next;
  }
  throw NotConverged("interacting_summits: no equilibrium at the force asked for");
}

AsperityContact InteractingSummits::at(double separation) const {
  return sums_of(solve(separation));
}

AsperityContact InteractingSummits::sums_of(const State& state) const {
  const System& system = *system_;
  const std::size_t n = system.size();
  const double modulus = common().material.contact_modulus;
  AsperityContact sum;
  Values loads(n), stiffness(n);
  system.hertz(state.indentation, loads, stiffness);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(state.loads[i] > 0)) continue;
    sum.contacts += 1;
    sum.contact_area += std::numbers::pi * system.caps[i].area_radius * state.indentation[i];
    sum.force += state.loads[i];
  }

  const std::lock_guard lock(system.mutex);
  // (D⁻¹ + G)P' = 1 and, once more differentiated, (D⁻¹ + G)P'' = ½(P'/D)²/δ, on the summits in contact.
  const auto first = system.linear_solve(stiffness, Values(n, 1.0), options_.tolerance);
  Values right(n);
  for (std::size_t i = 0; i < n; ++i)
    if (stiffness[i] > 0)
      right[i] = first.scaled[i] * first.scaled[i] / (2 * stiffness[i] * state.indentation[i]);
  const auto second = system.linear_solve(stiffness, right, options_.tolerance);
  for (std::size_t i = 0; i < n; ++i) {
    sum.normal_stiffness += modulus * std::sqrt(stiffness[i]) * first.scaled[i];
    sum.curvature += modulus * std::sqrt(stiffness[i]) * second.scaled[i];
  }
  sum.converged = state.converged && first.converged && second.converged;
  return sum;
}

}  // namespace salebra
