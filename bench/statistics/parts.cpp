// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time of each part of `salebra statistics`:  statistics_parts [N [THREADS]]
// A line for each part: milliseconds, as the least of three runs.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/peaks.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/summits.hpp>

using namespace salebra;

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::atol(argv[1]) : 2048;
  parallel::set_threads(argc > 2 ? std::atoi(argv[2]) : 1);
  const double side = static_cast<double>(n);
  const SelfAffineParameters parameters{.hurst = 0.8,
                                        .long_cutoff = side / 4,
                                        .rolloff = side / 4,
                                        .short_cutoff = 8,
                                        .rms_slope = 0.1};
  const Surface surface = filtered_noise({n, n, side, side}, SelfAffineSpectrum(parameters), 1);
  const auto measure = [](const char* part, const std::function<void()>& body) {
    double least = 1e300;
    for (int run = 0; run < 3; ++run) {
      const std::clock_t start = std::clock();
      body();
      least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::printf("%-20s %8.1f\n", part, least);
  };
  const PowerSpectrum spectrum = power_spectrum(surface);
  const CorrelationMap map = correlation_map(surface);
  const BearingCurve curve(surface);
  const double height = height_statistics(surface).maximum - height_statistics(surface).minimum;
  measure("height_statistics", [&] { height_statistics(surface); });
  measure("surface_moments", [&] { surface_moments(surface); });
  measure("difference_moments", [&] { difference_moments(surface); });
  measure("find_summits", [&] { summit_statistics(find_summits(surface)); });
  measure("power_spectrum", [&] { power_spectrum(surface); });
  measure("fit_self_affine", [&] { fit_self_affine(spectrum); });
  measure("radial_spectrum", [&] { radial_spectrum(spectrum); });
  measure("profile_psd x", [&] { profile_psd(surface, Axis::x); });
  measure("profile_psd y", [&] { profile_psd(surface, Axis::y); });
  measure("correlation_map", [&] { correlation_map(surface); });
  measure("radial_correlation", [&] { radial_correlation(map); });
  measure("scale_dependence x", [&] { scale_dependence(surface, Axis::x); });
  measure("scale_dependence y", [&] { scale_dependence(surface, Axis::y); });
  measure("bearing curve", [&] { BearingCurve{surface}; });
  measure("core, histogram", [&] { core_parameters(curve), height_histogram(curve); });
  measure("significant_peaks", [&] { significant_peaks(surface, 0.05 * height); });
  measure("areal_parameters", [&] { areal_parameters(surface); });
}
