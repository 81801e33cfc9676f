// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of a generated surface beside that of one bare complex-to-real FFT of the same size, as one
// JSON object.
//   generate [points [cells [threads [repeats]]]]
// cells: the shortest wavelength in cells. Times are medians of alternating runs, of processor time
// on one thread, which a busy machine disturbs little, of wall time on more; `measured` is a plan
// that FFTW chose by trial. `two_threads_over_one` compares the shortest wall times of each, since
// a neighbour on the second core makes any other figure its own. With repeats = 0 one surface is
// made and nothing else: its wall time and peak memory, for grids of which the machine holds only
// one.
#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"

namespace {

using namespace salebra;

double seconds(clockid_t clock) {
  timespec time;
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Stopwatch {
 public:
  template <class Work>
  void run(const Work& work) {
    const clockid_t clock = parallel::threads() == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
    const double start = seconds(clock);
    work();
    seconds_.push_back(seconds(clock) - start);
  }
  double median() {
    std::sort(seconds_.begin(), seconds_.end());
    return seconds_[seconds_.size() / 2];
  }

 private:
  std::vector<double> seconds_;
};

/// Peak memory of this program alone: getrusage counts what the process that started it held.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::atof(line.c_str() + 6);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 2048;
  const double cells = argc > 2 ? std::atof(argv[2]) : 8;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 1;
  const int repeats = argc > 4 ? std::atoi(argv[4]) : 9;
  parallel::set_threads(threads);
  const Grid2D grid{n, n, 1, 1};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 0.125, .short_cutoff = cells / n, .rms_slope = 0.1});

  const auto points = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  // The arrays of the bare transform do not exist yet.
  const double memory_before = peak_memory();
  const double start = seconds(CLOCK_MONOTONIC);
  { const Surface surface = filtered_noise(grid, spectrum, 1); }
  const double once = seconds(CLOCK_MONOTONIC) - start;
  const double memory = peak_memory() - memory_before;
  if (repeats == 0) {
    std::printf(
        "{\"points\": %d, \"cells\": %g, \"threads\": %d, \"wall_seconds\": %.4g, "
        "\"peak_memory_gigabytes\": %.3f, \"memory_over_heights\": %.3f}\n",
        n, cells, threads, once, 1e-9 * peak_memory(), memory / (8 * static_cast<double>(points)));
    return 0;
  }
  const auto half = static_cast<std::size_t>(n) * static_cast<std::size_t>(n / 2 + 1);
  fftw_complex* modes = fftw_alloc_complex(half);
  double* heights = fftw_alloc_real(points);
  const fftw_plan estimated = fftw_plan_dft_c2r_2d(n, n, modes, heights, FFTW_ESTIMATE);
  const fftw_plan measured = fftw_plan_dft_c2r_2d(n, n, modes, heights, FFTW_MEASURE);
  std::fill_n(reinterpret_cast<double*>(modes), 2 * half, 0.0);

  Stopwatch noise, phase, transform_estimated, transform_measured, random;
  std::vector<std::complex<double>> row(static_cast<std::size_t>(n));
  for (int repeat = 0; repeat < repeats; ++repeat) {
    transform_estimated.run([&] { fftw_execute(estimated); });
    transform_measured.run([&] { fftw_execute(measured); });
    noise.run([&] { filtered_noise(grid, spectrum, 1); });
    phase.run([&] { random_phase(grid, spectrum, 1); });
    random.run([&] {
      for (int j = 0; j <= n / 2; ++j) fill_gaussian(1, 0, j, row);
    });
  }
  double one_thread = std::numeric_limits<double>::infinity(), two_threads = one_thread;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (const int team : {1, 2}) {
      parallel::set_threads(team);
      const double begin = seconds(CLOCK_MONOTONIC);
      filtered_noise(grid, spectrum, 1);
      double& least = team == 1 ? one_thread : two_threads;
      least = std::min(least, seconds(CLOCK_MONOTONIC) - begin);
    }
  }
  const double best_transform = std::min(transform_estimated.median(), transform_measured.median());
  std::printf(
      "{\"points\": %d, \"cells\": %g, \"threads\": %d, \"filtered_noise\": %.4g, "
      "\"random_phase\": %.4g, \"fft_estimate\": %.4g, \"fft_measured\": %.4g, "
      "\"random_numbers_of_all_modes\": %.4g, \"noise_over_fft\": %.3f, "
      "\"two_threads_over_one\": %.3f, \"memory_over_heights\": %.3f}\n",
      n, cells, threads, noise.median(), phase.median(), transform_estimated.median(),
      transform_measured.median(), random.median(), noise.median() / best_transform,
      one_thread / two_threads, memory / (8 * static_cast<double>(points)));
}
