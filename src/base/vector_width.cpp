// SPDX-License-Identifier: GPL-3.0-or-later
// The widest vector instruction set of this processor.
#include "vector_width.hpp"

namespace salebra::detail {

VectorWidth vector_width() {
#ifdef SALEBRA_X86_KERNELS
  // What the passes are compiled for, by the names that every compiler knows.
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                        __builtin_cpu_supports("bmi2");
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd");
  if (has_avx2 && has_avx512) return VectorWidth::avx512;
  if (has_avx2) return VectorWidth::avx2;
#endif
  return VectorWidth::baseline;
}

}  // namespace salebra::detail
