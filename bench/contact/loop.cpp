// SPDX-License-Identifier: GPL-3.0-or-later
// contact_loop — one loop of partial slip at constant load by salebra, timed as friction.py times
// ASPHER: the free contact of a rough surface is pressed, moved along x by a quarter of a period to
// the amplitude, and then over one whole period.
//
// usage: contact_loop HEIGHTS.raw N PRESSURE AMPLITUDE STEPS FRICTION POISSON TOLERANCE
//                     TANGENTIAL_TOLERANCE
// HEIGHTS.raw: N x N float64 without a header, side 1, E* = 1. STEPS of a period: a multiple of 4,
// or 2 (then one step to the amplitude, one back and one there). Prints one JSON object. "loss" is
// the sum of traction times slip with the mean traction of each step, as the simulation of the
// library takes it; "loss_at_end" takes the traction at the end of the step, which is exact if each
// cell slips in one direction at an unchanged limit.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <vector>

#include "process_cost.hpp"

namespace {

using namespace salebra;

struct Loss {
  double mean_traction = 0, end_traction = 0, max_force = 0;
};

std::vector<double> positions(double amplitude, int steps) {
  constexpr double pi = std::numbers::pi;
  const int quarter = std::max(steps / 4, 1);
  std::vector<double> x;
  for (int k = 1; k <= quarter; ++k) x.push_back(amplitude * std::sin(pi / 2 * k / quarter));
  for (int k = 1; k <= steps; ++k) x.push_back(amplitude * std::cos(2 * pi * k / steps));
  return x;
}

// The losses of the last `steps` moves.
Loss follow(SlidingContact& contact, const Field& pressure, const std::vector<double>& x,
            std::size_t steps, double cell_area) {
  Loss loss;
  double at = 0, before = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (k == x.size() - steps) before = contact.loss().sum();
    SlidingContact::Increment step = contact.attempt(pressure, {x[k] - at});
    if (k >= x.size() - steps)
      for (std::size_t i = 0; i < step.slip.size(); ++i)
        loss.end_traction += cell_area * step.traction[i] * step.slip[i];
    contact.accept(std::move(step));
    loss.max_force = std::max(loss.max_force, contact.tangential_force().x);
    at = x[k];
  }
  loss.mean_traction = contact.loss().sum() - before;
  return loss;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 10) return 2;
  const Index n = std::atol(argv[2]);
  Surface surface{{n, n, 1.0, 1.0}, Field(n, n), true, argv[1]};
  std::ifstream(argv[1], std::ios::binary)
      .read(reinterpret_cast<char*>(surface.heights.data()),
            static_cast<std::streamsize>(sizeof(double)) * n * n);
  const double amplitude = std::atof(argv[4]), friction = std::atof(argv[6]);
  const int steps = std::atoi(argv[5]);
  parallel::set_threads(1);

  const double cpu = bench::cpu_seconds();
  const NormalContactState state =
      press(surface, 1.0, at_pressure(std::atof(argv[3])),
            {.tolerance = std::atof(argv[8]), .boundary = Boundary::free});
  const double pressed = bench::cpu_seconds();
  SlidingContact contact(surface.grid, Material::of_contact_modulus(1.0, std::atof(argv[7])),
                         {.friction_coefficient = friction,
                          .motion_scale = 2 * amplitude,
                          .stick = {.tolerance = std::atof(argv[9]), .boundary = Boundary::free}});
  contact.advance(state.contact_pressure);
  const Loss loss = follow(contact, state.contact_pressure, positions(amplitude, steps),
                           static_cast<std::size_t>(steps), surface.grid.cell_area());
  const double spent = bench::cpu_seconds();
  const bool converged = state.converged() && contact.termination() == Termination::converged;
  std::printf(
      "{\"cpu\": %.6f, \"cpu_normal\": %.6f, \"loss\": %.12e, \"loss_at_end\": %.12e, "
      "\"force_ratio\": %.8f, \"area\": %.6f, \"indentation\": %.8e, \"iterations\": %ld, "
      "\"converged\": %s}\n",
      spent - cpu, pressed - cpu, loss.mean_traction, loss.end_traction,
      loss.max_force / (friction * state.force), state.contact_area_fraction, state.indentation,
      contact.iterations(), converged ? "true" : "false");
  return converged ? 0 : 1;
}
