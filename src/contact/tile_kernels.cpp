// SPDX-License-Identifier: GPL-3.0-or-later
#include "tile_kernels.hpp"

#include <type_traits>

namespace salebra::detail {

#define SALEBRA_DECLARE_TABLES(simd)  \
  namespace simd {                    \
  TileKernels<float> table_float();   \
  TileKernels<double> table_double(); \
  }
SALEBRA_DECLARE_TABLES(baseline)
#ifdef SALEBRA_X86_KERNELS
SALEBRA_DECLARE_TABLES(avx2)
SALEBRA_DECLARE_TABLES(avx512)
#endif
#undef SALEBRA_DECLARE_TABLES

namespace {

template <class Real>
TileKernels<Real> choose(TileKernels<float> (*single)(), TileKernels<double> (*dual)()) {
  if constexpr (std::is_same_v<Real, float>) {
    return single();
  } else {
    return dual();
  }
}

template <class Real>
TileKernels<Real> widest() {
#ifdef SALEBRA_X86_KERNELS
  // What the two files are compiled for, by the names that every compiler knows.
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                        __builtin_cpu_supports("bmi2");
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd");
  if (has_avx2 && has_avx512) return choose<Real>(avx512::table_float, avx512::table_double);
  if (has_avx2) return choose<Real>(avx2::table_float, avx2::table_double);
#endif
  return choose<Real>(baseline::table_float, baseline::table_double);
}

}  // namespace

template <class Real>
const TileKernels<Real>& tile_kernels() {
  static const TileKernels<Real> kernels = widest<Real>();
  return kernels;
}

template const TileKernels<float>& tile_kernels<float>();
template const TileKernels<double>& tile_kernels<double>();

}  // namespace salebra::detail
