// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the passes of the multilevel kernel for this processor.
#include "multilevel_passes.hpp"

#include "base/vector_width.hpp"

namespace salebra::detail {

namespace {

MultilevelKernels widest_table() {
#ifdef SALEBRA_X86_KERNELS
  switch (vector_width()) {
    case VectorWidth::avx512:
      return avx512::multilevel_table();
    case VectorWidth::avx2:
      return avx2::multilevel_table();
    case VectorWidth::baseline:
      break;
  }
#endif
  return baseline::multilevel_table();
}

}  // namespace

const MultilevelKernels& multilevel_passes() {
  static const MultilevelKernels kernels = widest_table();
  return kernels;
}

}  // namespace salebra::detail
