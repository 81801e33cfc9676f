// SPDX-License-Identifier: GPL-3.0-or-later
// Version of the library, and everything else that the last digits of its results depend on.
#include <fftw3.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <salebra/base/version.hpp>

#include "vector_width.hpp"

namespace salebra {

std::string_view version() { return SALEBRA_VERSION; }

std::string arithmetic() {
#if defined(__clang__)
  const char* compiler = "Clang " __clang_version__;
#else
  const char* compiler = "GCC " __VERSION__;
#endif
  // FFTW uses the widest vectors that its build supports; Debian builds it for SSE2 and AVX.
#if defined(__x86_64__)
  const char* transforms = __builtin_cpu_supports("avx") ? "avx" : "sse2";
#else
  const char* transforms = "baseline";
#endif
  // fftw_version reads like "fftw-3.3.10-sse2-avx".
  std::string_view fftw(fftw_version);
  fftw.remove_prefix(fftw.find('-') + 1);
  return fmt::format("{}, Eigen {}.{}.{}, FFTW {} for {}, vectors {}", compiler,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     fftw.substr(0, fftw.find('-')), transforms,
                     detail::name_of(detail::vector_width()));
}

}  // namespace salebra
