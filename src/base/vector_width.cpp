// SPDX-License-Identifier: GPL-3.0-or-later
// Selects the vector instruction set of the vectorised passes: the widest of this processor, or a
// narrower one named by the environment variable SALEBRA_VECTOR_WIDTH.
#include "vector_width.hpp"

#include <cstdlib>
#include <salebra/base/error.hpp>
#include <string>

namespace salebra::detail {
namespace {

VectorWidth widest() {
#ifdef SALEBRA_X86_KERNELS
  // Checks one by one the processor features that the passes are compiled for, under names that
  // every compiler knows.
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

}  // namespace

VectorWidth vector_width() {
  const char* wanted = std::getenv("SALEBRA_VECTOR_WIDTH");
  const VectorWidth most = widest();
  if (!wanted || !*wanted) return most;
  for (const VectorWidth width : {VectorWidth::baseline, VectorWidth::avx2, VectorWidth::avx512})
    if (width <= most && std::string(wanted) == name_of(width)) return width;
  throw InvalidInput(
      "SALEBRA_VECTOR_WIDTH", wanted,
      std::string("must be baseline, avx2 or avx512 and supported by this processor, which has ") +
          name_of(most));
}

const char* name_of(VectorWidth width) {
  switch (width) {
    case VectorWidth::avx512:
      return "avx512";
    case VectorWidth::avx2:
      return "avx2";
    case VectorWidth::baseline:
      break;
  }
  return "baseline";
}

}  // namespace salebra::detail
