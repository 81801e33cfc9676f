// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the tile kernels for the processor at hand, in float and double.
#include "tile_kernels.hpp"

#include "base/vector_width.hpp"

namespace salebra::detail {

namespace {

template <class Real>
TileKernels<Real> widest() {
#ifdef SALEBRA_X86_KERNELS
  switch (vector_width()) {
    case VectorWidth::avx512:
      return table_of<Real>(avx512::table_float, avx512::table_double);
    case VectorWidth::avx2:
      return table_of<Real>(avx2::table_float, avx2::table_double);
    case VectorWidth::baseline:
      break;
  }
#endif
  return table_of<Real>(baseline::table_float, baseline::table_double);
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
