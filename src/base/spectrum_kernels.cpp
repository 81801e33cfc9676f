// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the vectorised passes of the convolution for this processor.
#include "spectrum_kernels.hpp"

#include "vector_width.hpp"

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
SpectrumKernels<Real> widest() {
#ifdef SALEBRA_X86_KERNELS
  switch (vector_width()) {
    case VectorWidth::avx512:
      return table_of<Real>(avx512::spectrum_float, avx512::spectrum_double);
    case VectorWidth::avx2:
      return table_of<Real>(avx2::spectrum_float, avx2::spectrum_double);
    case VectorWidth::baseline:
      break;
  }
#endif
  return table_of<Real>(baseline::spectrum_float, baseline::spectrum_double);
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
