// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the ladder's kernels for the processor at hand.
#include "ladder_kernels.hpp"

#include "base/vector_width.hpp"

namespace salebra::detail {

namespace {

LadderKernels widest_ladder_table() {
#ifdef SALEBRA_X86_KERNELS
  switch (vector_width()) {
    case VectorWidth::avx512:
      return avx512::ladder_table();
    case VectorWidth::avx2:
      return avx2::ladder_table();
    case VectorWidth::baseline:
      break;
  }
#endif
  return baseline::ladder_table();
}

}  // namespace

const LadderKernels& ladder_kernels() {
  static const LadderKernels kernels = widest_ladder_table();
  return kernels;
}

}  // namespace salebra::detail
