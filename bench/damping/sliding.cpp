// SPDX-License-Identifier: GPL-3.0-or-later
// Steady sliding and joints on a tabulated law, one core: processor time of 10⁴ states of sliding and of a loss over 30 forces.
// Sample runs:  damping_sliding        damping_sliding 10000 200
// Arguments: states, samples of the law.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <vector>

int main(int argc, char** argv) {
  using namespace salebra;
  const int states = argc > 1 ? std::atoi(argv[1]) : 10'000;
  const int samples = argc > 2 ? std::atoi(argv[2]) : 200;

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
       steady_sliding(law, AtIndentation{5e-7}, {amplitude, omega}, velocities, friction))
    sum += one.friction_coefficient;
  std::printf("%d states of sliding, law of %d samples: %.3f s, mean friction %.6f\n", states,
              samples, seconds_since(start), sum / states);

  start = std::clock();
  double work = 0;
  const double most = friction * (law.force(5e-7) - law.force(1e-9));
  for (int i = 1; i <= 30; ++i)
    work += joint_loss(law, AtIndentation{5e-7}, TangentialForce{most * i / 31}, friction)
                .work_per_cycle;
  std::printf("a loss over 30 tangential forces: %.3f s, sum %.6g J\n", seconds_since(start), work);
}
