// SPDX-License-Identifier: GPL-3.0-or-later
// Included once for each instruction set, with SALEBRA_SIMD naming it.
#include "spectrum_kernels.hpp"

namespace salebra::detail::SALEBRA_SIMD {

using Size = std::ptrdiff_t;

// Columns are so far apart that the prefetcher does not predict them: prefetch this many columns ahead.
inline constexpr Size ahead = 32;

template <class Real>
struct Complex {
  Real re, im;
};

template <class Real>
void interleave(const Real* a, const Real* b, Size count, Real* row) {
  if (b) {
    for (Size i = 0; i < count; ++i) {
      row[2 * i] = a[i];
      row[2 * i + 1] = b[i];
    }
  } else {
    for (Size i = 0; i < count; ++i) {
      row[2 * i] = a[i];
      row[2 * i + 1] = 0;
    }
  }
}

template <class Real>
void split(const Real* row, Size count, Real* a, Real* b) {
  if (b) {
    for (Size i = 0; i < count; ++i) {
      a[i] = row[2 * i];
      b[i] = row[2 * i + 1];
    }
  } else {
    for (Size i = 0; i < count; ++i) a[i] = row[2 * i];
  }
}

template <class Real>
void to_columns(const Real* rows, Size row_stride, Size count, Real* columns, Size column_stride) {
  const auto* from = reinterpret_cast<const Complex<Real>*>(rows);
  auto* to = reinterpret_cast<Complex<Real>*>(columns);
  for (Size k = 0; k < count; ++k) {
    const Size next = k + ahead < count ? k + ahead : count - 1;
    __builtin_prefetch(to + next * column_stride, 1);
#pragma GCC unroll 8
    for (Size i = 0; i < 8; ++i) to[k * column_stride + i] = from[i * row_stride + k];
  }
}

template <class Real>
void to_rows(const Real* columns, Size column_stride, Size count, Real* rows, Size row_stride) {
  const auto* from = reinterpret_cast<const Complex<Real>*>(columns);
  auto* to = reinterpret_cast<Complex<Real>*>(rows);
  for (Size k = 0; k < count; ++k) {
    const Size next = k + ahead < count ? k + ahead : count - 1;
    __builtin_prefetch(from + next * column_stride);
#pragma GCC unroll 8
    for (Size i = 0; i < 8; ++i) to[i * row_stride + k] = from[k * column_stride + i];
  }
}

template <class Real>
void separate(const Real* z, const Real* mirrored, Size count, Real* near, Real* far) {
  for (Size i = 0; i < 2 * count; i += 2) {
    const Real re = z[i], im = z[i + 1], mirrored_re = mirrored[i], mirrored_im = mirrored[i + 1];
    near[i] = re + mirrored_re;
    near[i + 1] = im - mirrored_im;
    far[i] = im + mirrored_im;
    far[i + 1] = mirrored_re - re;
  }
}

template <class Real>
void join(const Real* near, const Real* far, Size count, Real* z, Real* mirrored) {
  for (Size i = 0; i < 2 * count; i += 2) {
    const Real re = near[i], im = near[i + 1], far_re = far[i], far_im = far[i + 1];
    z[i] = re - far_im;
    z[i + 1] = im + far_re;
    mirrored[i] = re + far_im;
    mirrored[i + 1] = far_re - im;
  }
}

template <class Real>
void multiply(Real* numbers, Size count, Size mirrored, Real sign, const Real* symbol) {
  for (Size i = 0; i < count; ++i) {
    numbers[2 * i] *= symbol[i];
    numbers[2 * i + 1] *= symbol[i];
  }
  numbers += 2 * count;
  for (Size i = 0; i < mirrored; ++i) {
    const Real factor = sign * symbol[mirrored - i];
    numbers[2 * i] *= factor;
    numbers[2 * i + 1] *= factor;
  }
}

template <class Real>
SpectrumKernels<Real> table() {
  return {interleave<Real>, split<Real>, to_columns<Real>, to_rows<Real>,
          separate<Real>,   join<Real>,  multiply<Real>};
}

SpectrumKernels<float> spectrum_float() { return table<float>(); }
SpectrumKernels<double> spectrum_double() { return table<double>(); }

}  // namespace salebra::detail::SALEBRA_SIMD
