// SPDX-License-Identifier: GPL-3.0-or-later
// Force curve of a surface: contacts at a list of pressures, several of them at a time, with
// stiffnesses.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/surface/moments.hpp>
#include <string>
#include <type_traits>

#include "base/memory.hpp"
#include "base/task_pool.hpp"
#include "normal/contact_memory.hpp"

namespace salebra {
namespace {

// Tolerance of the tractions. K_t is a maximum over the tractions, so its error is about the square
// of this tolerance.
constexpr double stick_tolerance = 1e-3;

// What the contacts of a material and of any other body do differently.
NormalContactState press_on(const Surface& surface, const Material& material,
                            const OperatingPoint& point, const NormalContactOptions& options) {
  return press(surface, material.contact_modulus, point, options);
}
NormalContactState press_on(const Surface& surface, const Body& body, const OperatingPoint& point,
                            const NormalContactOptions& options) {
  return press(surface, body, point, options);
}
double stiffness_on(const NormalContactState& state, const Grid2D& grid, const Material& material,
                    const NormalContactOptions& options, Field* punch_pressure) {
  return normal_stiffness(state, grid, material.contact_modulus, options, punch_pressure);
}
double stiffness_on(const NormalContactState& state, const Grid2D& grid, const Body& body,
                    const NormalContactOptions& options, Field* punch_pressure) {
  return normal_stiffness(state, grid, body, options, punch_pressure);
}
std::string fingerprint_of(const Material&) { return {}; }
std::string fingerprint_of(const Body& body) { return body.fingerprint(); }
Field first_tractions(const Material& material, const Field& punch_pressure) {
  return punch_pressure * material.modulus_ratio();
}
Field first_tractions(const Body&, const Field&) { return {}; }
// K_t/K where it is known without a solve.
std::optional<double> stiffness_ratio(const Material& material) {
  if (!std::isfinite(material.tangential_modulus)) return {};
  return material.modulus_ratio();
}
std::optional<double> stiffness_ratio(const Body&) { return {}; }

template <class Pressed>
std::vector<ForceSample> samples_of(const NormalContactState& state, const Surface& surface,
                                    const Pressed& pressed, const SweepOptions& options,
                                    const std::vector<double>& directions,
                                    Field* growth = nullptr) {
  ForceSample sample;
  sample.indentation = state.indentation;
  if (options.contact.boundary == Boundary::periodic) sample.mean_gap = state.mean_gap;
  sample.force = state.force;
  sample.pressure = state.mean_pressure;
  sample.contact_area_fraction = state.contact_area_fraction;
  sample.converged = state.converged();
  const bool sticks = options.stiffness && options.stick;
  StickStiffness stick;
  stick.xx = stick.xy = stick.yy = ForceSample::unknown;
  Field punch_pressure;
  if (options.stiffness && state.converged()) {
    sample.normal_stiffness = stiffness_on(state, surface.grid, pressed, options.contact,
                                           options.stick || growth ? &punch_pressure : nullptr);
    sample.converged = !std::isnan(sample.normal_stiffness);
    if (options.stick && std::isfinite(sample.normal_stiffness)) {
      StickOptions solve;
      solve.tolerance = stick_tolerance;
      solve.boundary = options.contact.boundary;
      solve.on_progress = options.contact.on_progress;
      stick = stick_stiffness(contact_set(state), surface.grid, pressed, solve,
                              directions == std::vector<double>{0},
                              first_tractions(pressed, punch_pressure), surface.communicator);
      sample.converged = sample.converged && stick.converged();
    } else if (const auto ratio = stiffness_ratio(pressed)) {
      // K_t = (G*/E*)K is exact for one circular contact and for ν = 0; about 1 % off for rough
      // contacts at ν = 0.3 (docs/theory.md, section 7).
      sample.tangential_stiffness = *ratio * sample.normal_stiffness;
    }
  }
  if (growth) *growth = std::move(punch_pressure);
  std::vector<ForceSample> samples(directions.size(), sample);
  for (std::size_t k = 0; sticks && k < samples.size(); ++k) {
    samples[k].direction = directions[k];
    if (std::isfinite(stick.xx)) samples[k].tangential_stiffness = stick.along(directions[k]);
  }
  return samples;
}

}  // namespace

std::vector<ForceSample> force_samples(const NormalContactState& state, const Surface& surface,
                                       const Material& material, const SweepOptions& options,
                                       const std::vector<double>& directions) {
  return samples_of(state, surface, material, options, directions);
}

std::vector<ForceSample> force_samples(const NormalContactState& state, const Surface& surface,
                                       const Body& body, const SweepOptions& options,
                                       const std::vector<double>& directions) {
  if (const auto& material = body.half_space_material())
    return samples_of(state, surface, *material, options, directions);
  return samples_of(state, surface, body, options, directions);
}

ForceSample force_sample(const NormalContactState& state, const Surface& surface,
                         const Material& material, const SweepOptions& options) {
  return force_samples(state, surface, material, options, {options.direction}).front();
}

ForceSample force_sample(const NormalContactState& state, const Surface& surface, const Body& body,
                         const SweepOptions& options) {
  return force_samples(state, surface, body, options, {options.direction}).front();
}

namespace {

/// The loads of one group of processes, from the highest, which takes longest, to the lowest. Loads
/// are assigned to the groups in turn, forwards and then backwards, so that all groups take similar
/// times.
std::vector<std::size_t> loads_of(const Groups& groups, std::size_t count) {
  std::vector<std::size_t> mine;
  for (std::size_t back = 0; back < count; ++back) {
    const int turn = static_cast<int>(back % (2 * static_cast<std::size_t>(groups.count())));
    if (std::min(turn, 2 * groups.count() - 1 - turn) == groups.index())
      mine.push_back(count - 1 - back);
  }
  return mine;
}

void validate(const std::vector<double>& pressures) {
  require_that(!pressures.empty(), "pressures", "not given; give at least one");
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    require_positive(pressures[k], "pressures");
    require(k == 0 || pressures[k] > pressures[k - 1], "pressures", pressures[k], "must increase");
  }
}

void require_memory_of_sweep(const Surface& surface, const SweepOptions& options,
                             const Groups& groups, int concurrent) {
  // The fields of a contact still exist while its tangential stiffness is solved.
  const double each =
      detail::contact_memory(surface, options.contact) +
      (options.stiffness && options.stick ? detail::stick_memory(surface.grid) : 0) *
          static_cast<double>(surface.heights.rows()) / static_cast<double>(surface.grid.nx);
  require_memory(surface.grid, concurrent * each,
                 concurrent > 1       ? "contacts on all threads (fewer `threads` need less)"
                 : groups.count() > 1 ? "contacts of all groups (fewer groups need less)"
                                      : "a contact",
                 groups.all());
}

/// The samples of each load, one for each direction.
using Samples = std::vector<std::optional<std::vector<ForceSample>>>;

/// Gathers the samples of all groups of processes in every process.
void gather(const Groups& groups, Samples& samples) {
  struct Found {
    std::size_t load;
    ForceSample sample;
  };
  static_assert(std::is_trivially_copyable_v<Found>);
  std::string mine;
  if (groups.own().is_root())
    for (std::size_t load = 0; load < samples.size(); ++load)
      if (samples[load])
        for (const ForceSample& sample : *samples[load]) {
          const Found found{load, sample};
          mine.append(reinterpret_cast<const char*>(&found), sizeof found);
        }
  samples.assign(samples.size(), {});
  for (const std::string& others : groups.all().gather_all(mine))
    for (std::size_t at = 0; at < others.size(); at += sizeof(Found)) {
      Found found;
      std::memcpy(&found, others.data() + at, sizeof found);
      if (!samples[found.load]) samples[found.load].emplace();
      samples[found.load]->push_back(found.sample);
    }
}

template <class Pressed>
std::vector<ForceCurve> sweep(const Surface& surface, const Pressed& pressed,
                              const std::vector<double>& pressures,
                              const std::vector<double>& directions, const SweepOptions& options) {
  const Groups groups = options.groups.value_or(Groups(surface.communicator, 1));
  collectively(groups.all(), [&] { surface.require_complete_rows("a contact calculation"); });
  validate(pressures);
  require_that(!directions.empty(), "directions", "not given; give at least one");
  for (const double direction : directions)
    require(std::isfinite(direction), "direction", direction, "must be finite");
  require(options.concurrent_loads >= 0, "concurrent_loads", options.concurrent_loads,
          "must be >= 0");

  const std::vector<std::size_t> mine = loads_of(groups, pressures.size());
  const int loads = static_cast<int>(mine.size());
  // If the surface is distributed over processes, messages of two concurrent loads would mix;
  // otherwise the number of concurrent loads of a group must not depend on the size of the group.
  const int wanted = !groups.all().alone()          ? 1
                     : options.concurrent_loads > 0 ? options.concurrent_loads
                                                    : parallel::threads();
  const int concurrent = std::max(1, std::min({wanted, loads, parallel::threads()}));
  require_memory_of_sweep(surface, options, groups, concurrent);
  Samples samples(pressures.size());
  SweepOptions inner = options;
  const Progress& on_progress = options.contact.on_progress;
  std::atomic<double> residual = 0;  // of the contact that reported last
  detail::TaskLoop loop({.at_once = concurrent, .communicator = surface.communicator, .talk = [&] {
                           const int done = loop.finished();
                           return !on_progress ||
                                  on_progress({"sweep", double(done) / loads, done, residual});
                         }});
  // Processes that solve a contact together must all call the progress function, or none of them.
  if (on_progress || surface.communicator.alone())
    inner.contact.on_progress = [&](const ProgressReport& report) {
      residual = report.residual;
      return loop.going_on();
    };
  loop.run(loads, [&](Index turn) {
    const std::size_t k = mine[static_cast<std::size_t>(turn)];
    const NormalContactState state =
        press_on(surface, pressed, at_pressure(pressures[k]), inner.contact);
    if (state.termination == Termination::interrupted) return loop.stop();
    Field growth;
    const std::vector<ForceSample> found = samples_of(state, surface, pressed, inner, directions,
                                                      options.on_stiffness ? &growth : nullptr);
    // A sample whose stiffness solve was interrupted is dropped; it is not a failed load.
    if (!surface.communicator.all_agree(!loop.stopped() || found.front().converged))
      return loop.stop();
    samples[k] = found;
    if (options.on_state && state.converged()) options.on_state(k, state);
    const double stiffness = found.front().normal_stiffness;
    if (options.on_stiffness && found.front().converged && std::isfinite(stiffness) &&
        stiffness > 0)
      options.on_stiffness(k, state, stiffness, growth);
  });
  if (groups.count() > 1) gather(groups, samples);

  ForceCurve curve;
  curve.model = "bem";
  curve.body = fingerprint_of(pressed);
  curve.nominal_area = surface.grid.area();
  curve.rms_height = height_statistics(surface).rms_height;
  std::vector<ForceCurve> curves(directions.size(), curve);
  for (const auto& found : samples)
    for (std::size_t k = 0; found && k < curves.size(); ++k)
      curves[k].samples.push_back((*found)[k]);
  return curves;
}

}  // namespace

std::vector<ForceCurve> sweep_directions(const Surface& surface, const Material& material,
                                         const std::vector<double>& pressures,
                                         const std::vector<double>& directions,
                                         const SweepOptions& options) {
  return sweep(surface, material, pressures, directions, options);
}

std::vector<ForceCurve> sweep_directions(const Surface& surface, const Body& body,
                                         const std::vector<double>& pressures,
                                         const std::vector<double>& directions,
                                         const SweepOptions& options) {
  if (const auto& material = body.half_space_material())
    return sweep(surface, *material, pressures, directions, options);
  return sweep(surface, body, pressures, directions, options);
}

ForceCurve sweep_pressures(const Surface& surface, const Material& material,
                           const std::vector<double>& pressures, const SweepOptions& options) {
  return sweep_directions(surface, material, pressures, {options.direction}, options).front();
}

ForceCurve sweep_pressures(const Surface& surface, const Body& body,
                           const std::vector<double>& pressures, const SweepOptions& options) {
  return sweep_directions(surface, body, pressures, {options.direction}, options).front();
}

}  // namespace salebra
