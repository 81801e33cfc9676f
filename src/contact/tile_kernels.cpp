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
  if (__builtin_cpu_supports("x86-64-v4"))
    return choose<Real>(avx512::table_float, avx512::table_double);
  if (__builtin_cpu_supports("x86-64-v3"))
    return choose<Real>(avx2::table_float, avx2::table_double);
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
