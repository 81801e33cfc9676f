// SPDX-License-Identifier: GPL-3.0-or-later
// Steady sliding on a tabulated law and joints of a surface: processor time of 10⁴ states of
// sliding, and of a loss over 30 forces after the sweep of a rough surface.
// Sample runs:  damping_sliding        damping_sliding 10000 200 256
// Arguments: states, samples of the law, cells of the surface along a side.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <vector>

int main(int argc, char** argv) {
  using namespace salebra;
  const int states = argc > 1 ? std::atoi(argv[1]) : 10'000;
  const int samples = argc > 2 ? std::atoi(argv[2]) : 200;
  const Index points = argc > 3 ? std::atoi(argv[3]) : 256;

  // A curve that bends in ln F, as those of rough surfaces do.
  ForceCurve curve;
  for (int i = 0; i < samples; ++i) {
    const double indentation = 8e-7 * i / (samples - 1);
    curve.samples.push_back(
        {.indentation = indentation,
         .force = std::exp(1e7 * indentation - 2e12 * indentation * indentation)});
  }
  const TabulatedLaw law(curve, 0.8);
  const double amplitude = 2e-7, omega = 1e5, friction = 0.3;
  const double critical = friction / 0.8 * amplitude * omega;
  const auto seconds_since = [](std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };

  std::clock_t start = std::clock();  // CPU time: the machine may be busy
  std::vector<double> velocities;
  for (int i = 0; i < states; ++i)
    velocities.push_back(critical * std::pow(10, -4 + 4.5 * i / states));
  double sum = 0;
  for (const SteadySliding& one :
       steady_sliding(law, at_indentation(5e-7), {amplitude, omega}, velocities, friction))
    sum += one.friction_coefficient;
  std::printf("%d states of sliding, law of %d samples: %.3f s, mean friction %.6f\n", states,
              samples, seconds_since(start), sum / states);

  SelfAffineParameters parameters;
  parameters.hurst = 0.8;
  parameters.rolloff = 1.25e-6;
  parameters.short_cutoff = 0.625e-6;
  parameters.rms_slope = 0.1;
  const Surface surface =
      filtered_noise({points, points, 10e-6, 10e-6}, SelfAffineSpectrum(parameters), 1);
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const double pressure = 5e6;  // Pa
  std::vector<double> pressures;
  for (int k = -40; k <= 9; ++k) pressures.push_back(pressure * std::pow(1.2, k));
  SweepOptions sweep;
  sweep.stick = true;
  start = std::clock();
  const ForceCurve swept = sweep_pressures(surface, material, pressures, sweep);
  const double sweep_seconds = seconds_since(start);
  start = std::clock();
  const TabulatedLaw of_surface(swept, material.modulus_ratio());
  const double force = pressure * surface.grid.area();
  double work = 0;
  for (int i = 1; i <= 30; ++i)
    work += joint_loss(of_surface, at_force(force),
                       TangentialForce{friction * force * 0.95 * i / 30}, friction)
                .work_per_cycle;
  const double curve_seconds = seconds_since(start);
  std::printf(
      "surface of %td x %td: sweep of %zu contacts %.1f s; a loss over 30 tangential forces after "
      "it %.3f s, sum %.6g J\n",
      points, points, pressures.size(), sweep_seconds, curve_seconds, work);
}
