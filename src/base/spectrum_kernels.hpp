// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace salebra::detail {

// The passes of Convolution2D between its Fourier transforms. Complex numbers are pairs of real
// ones. One source file is compiled for each vector width. That file may not include headers with
// inline functions, because the linker could then use code for a wide machine on a narrow one. No
// pass adds products, so every width gives the same bits.
template <class Real>
struct SpectrumKernels {
  // row = a + ib as complex numbers; b may be null.
  void (*interleave)(const Real* a, const Real* b, std::ptrdiff_t count, Real* row);
  // a = Re row, b = Im row; b may be null.
  void (*split)(const Real* row, std::ptrdiff_t count, Real* a, Real* b);

  // Transposes eight rows of complex numbers to `count` columns of eight numbers (to_columns), or
  // back (to_rows). Strides count complex numbers.
  void (*to_columns)(const Real* rows, std::ptrdiff_t row_stride, std::ptrdiff_t count,
                     Real* columns, std::ptrdiff_t column_stride);
  void (*to_rows)(const Real* columns, std::ptrdiff_t column_stride, std::ptrdiff_t count,
                  Real* rows, std::ptrdiff_t row_stride);

  // Converts blocks of 8 complex numbers of z and of `mirrored` to blocks of 16 numbers of x. The
  // first 8 numbers of a block are near = z + mirrored*, the others far = −i(z − mirrored*).
  void (*separate)(const Real* z, const Real* mirrored, std::ptrdiff_t blocks, Real* x);
  // Inverse of separate(): z = near + i far, mirrored = near* + i far*.
  void (*join)(const Real* x, std::ptrdiff_t blocks, Real* z, Real* mirrored);

  // numbers[i] *= symbol[i] for i < count, and for the mirror images numbers[count + k] *=
  // sign·symbol[mirrored − k].
  void (*multiply)(Real* numbers, std::ptrdiff_t count, std::ptrdiff_t mirrored, Real sign,
                   const Real* symbol);
};

// The kernels for the widest vectors of this processor.
template <class Real>
const SpectrumKernels<Real>& spectrum_kernels();

}  // namespace salebra::detail
