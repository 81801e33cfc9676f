// SPDX-License-Identifier: GPL-3.0-or-later
// Time, transform pairs, residual and memory of one normal contact.
//   normal_contact [points [load [cut-off [threads [tolerance [mixed|full [hurst [seed]]]]]]]]
//   normal_contact 2048 0.02 8 1 1e-8
// load: p/(E*·rms slope); cut-off: shortest wave in cells. Surface: roll-off at 1/8 of the side,
// rms slope 0.1.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/base/fft.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <string>
#include <vector>

namespace {

using namespace salebra;
using std::numbers::pi;

double seconds(clockid_t clock) {
  timespec time;
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double uniform(std::uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (static_cast<double>(state >> 11) + 0.5) * 0x1p-53;
}

Surface rough_surface(Index n, double cutoff, double hurst, std::uint64_t seed) {
  Surface surface{{n, n, 1, 1}, Field(n, n), true, "bench"};
  std::uint64_t state = seed;
  for (Index k = 0; k < n * n; ++k)
    surface.heights.data()[k] =
        std::sqrt(-2 * std::log(uniform(state))) * std::cos(2 * pi * uniform(state));
  RealFft2D<double> fft(n, n);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(n * fft.modes_y()));
  fft.forward(surface.heights.data(), modes.data());
  double slope = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j <= n / 2; ++j) {
      auto& mode = modes[static_cast<std::size_t>(i * fft.modes_y() + j)];
      const double q = std::hypot(static_cast<double>(std::min(i, n - i)), static_cast<double>(j));
      mode *= q == 0 || q > static_cast<double>(n) / cutoff ? 0
              : q < 8                                       ? 1
                                                            : std::pow(q / 8, -1 - hurst);
      slope += (j == 0 || 2 * j == n ? 1 : 2) * 4 * pi * pi * q * q * std::norm(mode);
    }
  fft.backward(modes.data(), surface.heights.data());
  surface.heights *= 0.1 / std::sqrt(slope);
  return surface;
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int k, const char* otherwise) {
    return std::string(argc > k ? argv[k] : otherwise);
  };
  const Index n = std::stol(argument(1, "512"));
  const double load = std::stod(argument(2, "0.02")), cutoff = std::stod(argument(3, "8"));
  parallel::set_threads(std::stoi(argument(4, "1")));
  NormalContactOptions options;
  options.tolerance = std::stod(argument(5, "1e-8"));
  options.precision = argument(6, "mixed") == "full" ? Precision::full : Precision::mixed;
  const Surface surface =
      rough_surface(n, cutoff, std::stod(argument(7, "0.8")), std::stoul(argument(8, "1")));
  const double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
  const auto state = press_to_pressure(surface, 1, 0.1 * load, options);
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "n %ld load %g cut-off %g threads %d: cpu %.3f s wall %.3f s | iterations %d pairs %d | e_c "
      "%.2e%s "
      "area %.6f mean gap %.8e | peak %.1f bytes/cell\n",
      static_cast<long>(n), load, cutoff, parallel::threads(),
      seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu, seconds(CLOCK_MONOTONIC) - wall, state.iterations,
      state.fft_count, state.residual, state.converged ? "" : " NOT CONVERGED",
      state.contact_area_fraction, state.mean_gap,
      1024.0 * static_cast<double>(usage.ru_maxrss) / static_cast<double>(n * n));
  return state.converged ? 0 : 1;
}
