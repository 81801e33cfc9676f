// SPDX-License-Identifier: GPL-3.0-or-later
// contact_ledger — processor time of contacts in one process, and what the machine needs for the
// same transforms and bytes at least (docs/performance.md, "Where the time of a contact goes").
//
// usage: contact_ledger contact|sweep|bare N [REPEATS [LOAD]]          one thread
//
// contact: REPEATS contacts at LOAD = p/(E*·rms slope), default 0.02, on the surface of
// contact_profile. sweep: 16 loads from 0.001 to 0.2 with the normal stiffness. Both print the
// processor time of the first and the median of all, and the page faults. bare: FFTW's own time for
// a pair of transforms of N² points, as one transform of the plane and as its rows and columns
// alone, in cache; and the bandwidth of one core.

#include <fftw3.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <string_view>
#include <vector>

#include "base/fftw.hpp"
#include "base/memory.hpp"
#include "process_cost.hpp"

namespace {

using namespace salebra;

constexpr double rms_slope = 0.1;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Body>
std::vector<double> seconds_of(int repeats, const Body& body) {
  std::vector<double> seconds;
  for (int k = 0; k < repeats; ++k) {
    const double start = bench::cpu_seconds();
    body();
    seconds.push_back(bench::cpu_seconds() - start);
  }
  return seconds;
}

template <class Real>
void bare_transforms(const char* precision, int n) {
  using Api = detail::Fftw<Real>;
  using Complex = typename Api::Complex;
  const auto points = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  const auto plane = large_array<Real>(points);
  const auto modes = large_array<Complex>(points / 2 + static_cast<std::size_t>(n));
  std::fill_n(plane.get(), points, Real(0));
  const auto forward = detail::plan<Real>(
      [&] { return Api::plan_r2c_2d(n, n, plane.get(), modes.get(), FFTW_ESTIMATE); });
  const auto backward = detail::plan<Real>(
      [&] { return Api::plan_c2r_2d(n, n, modes.get(), plane.get(), FFTW_ESTIMATE); });
  const double whole = median(seconds_of(15, [&] {
    Api::execute_r2c(forward.get(), plane.get(), modes.get());
    Api::execute_c2r(backward.get(), modes.get(), plane.get());
  }));
  const auto from = large_array<Complex>(static_cast<std::size_t>(n)),
             to = large_array<Complex>(static_cast<std::size_t>(n));
  std::fill_n(&from[0][0], 2 * n, Real(0));
  const auto line = [&](Complex* x, Complex* y, int sign) {
    return detail::plan<Real>([&] { return Api::plan_1d(n, x, y, sign, FFTW_ESTIMATE); });
  };
  const auto there = line(from.get(), to.get(), FFTW_FORWARD),
             back = line(to.get(), from.get(), FFTW_BACKWARD);
  // Two real rows are one complex row, and half of the columns mirror the others.
  const double lines = median(seconds_of(15, [&] {
    for (int k = 0; k < n + 1; ++k) {
      Api::execute(there.get(), from.get(), to.get());
      Api::execute(back.get(), to.get(), from.get());
    }
  }));
  std::printf("%s, %d²: pair %.3f ms, its rows and columns alone in cache %.3f ms\n", precision, n,
              1e3 * whole, 1e3 * lines);
}

void bandwidth(double megabytes) {
  const auto count = static_cast<std::size_t>(megabytes * 1e6 / sizeof(double));
  const auto a = large_array<double>(count), b = large_array<double>(count);
  std::fill_n(a.get(), count, 1.0);
  std::fill_n(b.get(), count, 1.0);
  const double seconds = median(seconds_of(15, [&] {
    for (std::size_t k = 0; k < count; ++k) b[k] = 1.0001 * a[k];
  }));
  std::printf("one array of %.0f MB read and one written: %.0f GB/s\n", megabytes,
              2e-9 * static_cast<double>(count * sizeof(double)) / seconds);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string_view job = argv[1];
  const Index n = std::atol(argv[2]);
  const int repeats = argc > 3 ? std::atoi(argv[3]) : 9;
  const double load = argc > 4 ? std::atof(argv[4]) : 0.02;
  parallel::set_threads(1);
  if (job == "bare") {
    bare_transforms<float>("float", static_cast<int>(n));
    bare_transforms<double>("double", static_cast<int>(n));
    for (const double megabytes : {4.0, 16.0, 64.0}) bandwidth(megabytes);
    return 0;
  }
  const SelfAffineSpectrum spectrum({.hurst = 0.8,
                                     .rolloff = 0.125,
                                     .short_cutoff = 8.0 / static_cast<double>(n),
                                     .rms_slope = rms_slope});
  const Surface surface = exact_rms({n, n, 1, 1}, spectrum, 1, Rms::slope);
  const auto faults = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  const long before = faults();
  long first_faults = 0;
  const std::vector<double> seconds = seconds_of(repeats, [&] {
    if (job == "contact") {
      const NormalContactState state =
          press(surface, 1.0, at_pressure(rms_slope * load), {.tolerance = 1e-8});
      if (first_faults == 0)
        std::printf("e_c %.1e, %d iterations, %d pairs, %d times the multilevel kernel\n",
                    state.residual, state.iterations, state.fft_count, state.multilevel_count);
    } else {
      std::vector<double> pressures;
      for (int k = 0; k < 16; ++k) pressures.push_back(rms_slope * 1e-3 * std::pow(200, k / 15.0));
      SweepOptions options;
      options.stiffness = true;
      options.contact.tolerance = 1e-8;
      sweep_pressures(surface, Material::of_contact_modulus(1.0), pressures, options);
    }
    if (first_faults == 0) first_faults = faults() - before;
  });
  std::printf("first %.4f s with %ld page faults, median %.4f s of %d\n", seconds.front(),
              first_faults, median(seconds), repeats);
}
