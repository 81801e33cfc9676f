// SPDX-License-Identifier: GPL-3.0-or-later
// Force curve of a surface: contacts at a list of pressures, several at a time, with stiffnesses.
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/share.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/surface/moments.hpp>

#include "normal/contact_memory.hpp"

namespace salebra {
namespace {

// K_t is a maximum over the tractions: its error is about the square of this.
constexpr double stick_tolerance = 1e-3;

ForceSample sample_of(const NormalContactState& state, const Surface& surface,
                      const Material& material, const SweepOptions& options) {
  ForceSample sample;
  sample.indentation = state.indentation;
  if (options.contact.boundary == Boundary::periodic) sample.mean_gap = state.mean_gap;
  sample.force = state.force;
  sample.pressure = state.mean_pressure;
  sample.contact_area_fraction = state.contact_area_fraction;
  sample.converged = state.converged;
  if (options.stiffness && state.converged) {
    Field punch_pressure;
    sample.normal_stiffness =
        normal_stiffness(state, surface.grid, material.contact_modulus, options.contact,
                         options.stick ? &punch_pressure : nullptr);
    sample.converged = !std::isnan(sample.normal_stiffness);
    if (options.stick && std::isfinite(sample.normal_stiffness)) {
      StickOptions stick;
      stick.tolerance = stick_tolerance;
      stick.boundary = options.contact.boundary;
      stick.on_progress = options.contact.on_progress;
      const StickStiffness stiffness =
          stick_stiffness(contact_set(state), surface.grid, material, stick, true,
                          punch_pressure * material.modulus_ratio(), surface.ranks);
      sample.tangential_stiffness = stiffness.xx;
      sample.converged = sample.converged && stiffness.converged;
    } else if (std::isfinite(material.tangential_modulus)) {
      // Exact for one circular contact and for ν = 0; about 1 % off for rough ones at ν = 0.3 (docs/theory.md, section 7).
      sample.tangential_stiffness = material.modulus_ratio() * sample.normal_stiffness;
    }
  }
  return sample;
}

}  // namespace

ForceCurve sweep_pressures(const Surface& surface, const Material& material,
                           const std::vector<double>& pressures, const SweepOptions& options) {
  collectively(surface.ranks, [&] { surface.require_complete_rows("a contact calculation"); });
  require_that(!pressures.empty(), "pressures", "none given; name at least one");
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    require_positive(pressures[k], "pressures");
    require(k == 0 || pressures[k] > pressures[k - 1], "pressures", pressures[k], "must increase");
  }
  require(options.concurrent_loads >= 0, "concurrent_loads", options.concurrent_loads,
          "must be >= 0");

  const int loads = static_cast<int>(pressures.size());
  // Two loads of a surface that is spread would send through each other.
  const int wanted = !surface.ranks.alone()         ? 1
                     : options.concurrent_loads > 0 ? options.concurrent_loads
                                                    : parallel::threads();
  const int concurrent = std::min({wanted, loads, parallel::threads()});
  // A stick solve follows a contact whose fields are still there.
  const double each =
      (detail::contact_memory(surface.grid, options.contact) +
       (options.stiffness && options.stick ? detail::stick_memory(surface.grid) : 0)) *
      static_cast<double>(surface.heights.rows()) / static_cast<double>(surface.grid.nx);
  collectively(surface.ranks, [&] {
    require_memory(
        surface.grid, concurrent * each,
        concurrent > 1 ? "contacts on all threads (fewer `threads` need less)" : "a contact");
  });
  std::vector<std::optional<ForceSample>> samples(pressures.size());
  std::atomic<bool> stop = false;
  std::atomic<int> finished = 0;
  std::exception_ptr failure;
  SweepOptions inner = options;
  if (options.contact.on_progress)
    inner.contact.on_progress = [&](const ProgressReport& report) {
      // Only the calling thread may talk to its caller.
      if (omp_get_thread_num() == 0 &&
          !options.contact.on_progress(
              {"sweep", double(finished) / loads, finished, report.residual}))
        stop = true;
      return !stop.load();
    };

    // The highest loads take longest and go first.
#pragma omp parallel for schedule(dynamic, 1) num_threads(concurrent) if (concurrent > 1)
  for (int back = 0; back < loads; ++back) {
    // One process may have been told to stop where the others were not.
    if (!surface.ranks.all_agree(!stop)) stop = true;
    if (stop) continue;
    const auto k = static_cast<std::size_t>(loads - 1 - back);
    try {
      const auto state =
          press_to_pressure(surface, material.contact_modulus, pressures[k], inner.contact);
      if (state.interrupted) {
        stop = true;
        continue;
      }
      const ForceSample sample = sample_of(state, surface, material, inner);
      // A stiffness solve that was stopped half-way is not a load that failed.
      if (!surface.ranks.all_agree(!stop || sample.converged)) {
        stop = true;
        continue;
      }
      samples[k] = sample;
      if (options.on_state && state.converged) options.on_state(k, state);
      const int done = ++finished;
      if (omp_get_thread_num() == 0 && options.contact.on_progress &&
          !options.contact.on_progress({"sweep", double(done) / loads, done, state.residual}))
        stop = true;
    } catch (...) {
      stop = true;
#pragma omp critical(salebra_sweep_failure)
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);

  ForceCurve curve;
  curve.model = "bem";
  curve.nominal_area = surface.grid.area();
  curve.rms_height = height_statistics(surface).rms_height;
  for (const auto& sample : samples)
    if (sample) curve.samples.push_back(*sample);
  return curve;
}

}  // namespace salebra
