// SPDX-License-Identifier: GPL-3.0-or-later
// How often the 95 % intervals of a fitted self-affine law hold the truth, over generated Gaussian
// surfaces.
//   coverage [surfaces [points [roll-off over side [cells in the shortest wavelength]]]]
// One line for each kind: Hurst exponent, periodic or a crop that is not; found, covered, mean and
// scatter over half-width.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/surface/self_affine_fit.hpp>

namespace {

using namespace salebra;

class Tally {
 public:
  void add(double value, double low, double high, double truth) {
    if (std::isnan(value)) return;
    ++found_;
    covered_ += low <= truth && truth <= high;
    sum_ += value / truth - 1;
    square_ += (value / truth - 1) * (value / truth - 1);
    width_ += (high - low) / (2 * truth);
  }
  void print(const char* name) const {
    if (found_ == 0) {
      std::printf("  %-12s found   0\n", name);
      return;
    }
    const double mean = sum_ / found_;
    std::printf("  %-12s found %3d  covered %5.1f %%  bias %+.3f  scatter %.3f  half-width %.3f\n",
                name, found_, 100.0 * covered_ / found_, mean,
                std::sqrt(std::max(0.0, square_ / found_ - mean * mean)), width_ / found_);
  }

 private:
  int found_ = 0, covered_ = 0;
  double sum_ = 0, square_ = 0, width_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int surfaces = argc > 1 ? std::atoi(argv[1]) : 200;
  const int n = argc > 2 ? std::atoi(argv[2]) : 256;
  const double rolloff = argc > 3 ? std::atof(argv[3]) : 0.2;
  const double short_cutoff = (argc > 4 ? std::atof(argv[4]) : 4) / n;
  for (const bool periodic : {true, false}) {
    for (const double hurst : {0.3, 0.5, 0.8}) {
      const SelfAffineSpectrum target(
          {.hurst = hurst, .rolloff = rolloff, .short_cutoff = short_cutoff, .rms_height = 1});
      Tally exponent, roll, end;
      for (int seed = 0; seed < surfaces; ++seed) {
        Surface surface = filtered_noise({n, n, 1, 1}, target, static_cast<std::uint64_t>(seed));
        if (!periodic) surface = crop_surface(surface, 0, 0, 3 * n / 4, 3 * n / 4);
        const SelfAffineFit fit = fit_self_affine(power_spectrum(surface));
        exponent.add(fit.hurst.value, fit.hurst.low, fit.hurst.high, hurst);
        roll.add(fit.rolloff.value, fit.rolloff.low, fit.rolloff.high, rolloff);
        end.add(fit.short_cutoff.value, fit.short_cutoff.low, fit.short_cutoff.high, short_cutoff);
      }
      std::printf("H = %.1f, %d x %d points, %s, %d surfaces\n", hurst, periodic ? n : 3 * n / 4,
                  periodic ? n : 3 * n / 4, periodic ? "periodic" : "cropped", surfaces);
      exponent.print("H");
      roll.print("roll-off");
      end.print("shortest");
    }
  }
}
