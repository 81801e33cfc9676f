// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_kernels.hpp"

#include <type_traits>

namespace salebra::detail {

#define SALEBRA_DECLARE_TABLES(simd)         \
  namespace simd {                           \
  SpectrumKernels<float> spectrum_float();   \
  SpectrumKernels<double> spectrum_double(); \
  }
SALEBRA_DECLARE_TABLES(baseline)
#ifdef SALEBRA_X86_KERNELS
SALEBRA_DECLARE_TABLES(avx2)
SALEBRA_DECLARE_TABLES(avx512)
#endif
#undef SALEBRA_DECLARE_TABLES

namespace {

template <class Real>
SpectrumKernels<Real> choose(SpectrumKernels<float> (*single)(),
                             SpectrumKernels<double> (*dual)()) {
  if constexpr (std::is_same_v<Real, float>) {
    return single();
  } else {
    return dual();
  }
}

template <class Real>
SpectrumKernels<Real> widest() {
#ifdef SALEBRA_X86_KERNELS
  // What the two files are compiled for, by the names that every compiler knows.
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                        __builtin_cpu_supports("bmi2");
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd");
  if (has_avx2 && has_avx512) return choose<Real>(avx512::spectrum_float, avx512::spectrum_double);
  if (has_avx2) return choose<Real>(avx2::spectrum_float, avx2::spectrum_double);
#endif
  return choose<Real>(baseline::spectrum_float, baseline::spectrum_double);
}

}  // namespace

template <class Real>
const SpectrumKernels<Real>& spectrum_kernels() {
  static const SpectrumKernels<Real> kernels = widest<Real>();
  return kernels;
}

template const SpectrumKernels<float>& spectrum_kernels<float>();
template const SpectrumKernels<double>& spectrum_kernels<double>();

}  // namespace salebra::detail
