// SPDX-License-Identifier: GPL-3.0-or-later
// Included once for each instruction set, which SALEBRA_SIMD names.
#include "spectrum_kernels.hpp"

#define SALEBRA_INLINE inline __attribute__((always_inline))

namespace salebra::detail::SALEBRA_SIMD {

using Size = std::ptrdiff_t;

// Columns are too far apart for the processor's automatic prefetching, so the program prefetches
// this many columns ahead.
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

// A vector register of complex numbers. Eight complex numbers of float fill a cache line, and the
// halves of a block of sixteen are read and written together. Plain loops over eight numbers are
// slower than these registers.
template <class Real>
struct Register {
#if defined(__AVX512F__)
  static constexpr int bytes = 64;
#elif defined(__AVX__)
  static constexpr int bytes = 32;
#else
  static constexpr int bytes = 16;
#endif
  typedef Real Vector __attribute__((vector_size(bytes)));
  static constexpr int lanes = bytes / static_cast<int>(sizeof(Real)),
                       in_eight = 16 / lanes;  // registers per eight complex numbers

  static SALEBRA_INLINE Vector load(const Real* address) {
    Vector numbers;
    __builtin_memcpy(&numbers, address, bytes);
    return numbers;
  }
  static SALEBRA_INLINE void store(Vector numbers, Real* address) {
    __builtin_memcpy(address, &numbers, bytes);
  }
  // Exchanges real and imaginary parts.
  static SALEBRA_INLINE Vector swapped(Vector v) {
    if constexpr (lanes == 16) {
      return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14);
    } else if constexpr (lanes == 8) {
      return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
    } else if constexpr (lanes == 4) {
      return __builtin_shufflevector(v, v, 1, 0, 3, 2);
    } else {
      return __builtin_shufflevector(v, v, 1, 0);
    }
  }
  // Factors that negate imaginary parts; a product with ±1 is exact.
  static SALEBRA_INLINE Vector conjugating() {
    Vector signs;
    for (int lane = 0; lane < lanes; ++lane) signs[lane] = lane % 2 == 0 ? Real(1) : Real(-1);
    return signs;
  }
};

template <class Real>
void separate(const Real* z, const Real* mirrored, Size blocks, Real* x) {
  using Numbers = Register<Real>;
  const auto signs = Numbers::conjugating();
  for (Size block = 0; block < blocks; ++block, z += 16, mirrored += 16, x += 32)
#pragma GCC unroll 8
    for (int k = 0; k < Numbers::in_eight; ++k) {
      const auto here = Numbers::load(z + k * Numbers::lanes),
                 there = Numbers::load(mirrored + k * Numbers::lanes) * signs;
      Numbers::store(here + there, x + k * Numbers::lanes);
      Numbers::store(Numbers::swapped(here - there) * signs, x + 16 + k * Numbers::lanes);
    }
}

template <class Real>
void join(const Real* x, Size blocks, Real* z, Real* mirrored) {
  using Numbers = Register<Real>;
  const auto signs = Numbers::conjugating();
  for (Size block = 0; block < blocks; ++block, z += 16, mirrored += 16, x += 32)
#pragma GCC unroll 8
    for (int k = 0; k < Numbers::in_eight; ++k) {
      const auto near = Numbers::load(x + k * Numbers::lanes),
                 far = Numbers::swapped(Numbers::load(x + 16 + k * Numbers::lanes));
      Numbers::store(near - far * signs, z + k * Numbers::lanes);
      Numbers::store(near * signs + far, mirrored + k * Numbers::lanes);
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
