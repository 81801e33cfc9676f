// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace salebra::detail {

// The passes of Convolution2D between the transforms. Complex numbers are pairs of real ones. One
// source is compiled for each vector width; no header with inline functions may be included there,
// because the linker could then give code for a wide machine to a narrow one. None of them adds
// products, so that every width gives the same bits.
template <class Real>
struct SpectrumKernels {
  // row = a + ib; b may be null.
  void (*interleave)(const Real* a, const Real* b, std::ptrdiff_t count, Real* row);
  // a = Re row, b = Im row; b may be null.
  void (*split)(const Real* row, std::ptrdiff_t count, Real* a, Real* b);

  // Eight rows to or from eight places of count columns. Strides count complex numbers.
  void (*to_columns)(const Real* rows, std::ptrdiff_t row_stride, std::ptrdiff_t count,
                     Real* columns, std::ptrdiff_t column_stride);
  void (*to_rows)(const Real* columns, std::ptrdiff_t column_stride, std::ptrdiff_t count,
                  Real* rows, std::ptrdiff_t row_stride);

  // Blocks of 8 numbers of z and of mirrored to blocks of 16 numbers of x: 8 near = z + mirrored*,
  // then 8 far = −i(z − mirrored*).
  void (*separate)(const Real* z, const Real* mirrored, std::ptrdiff_t blocks, Real* x);
  // Takes them back: z = near + i far, mirrored = near* + i far*.
  void (*join)(const Real* x, std::ptrdiff_t blocks, Real* z, Real* mirrored);

  // numbers[i] *= symbol[i] for i < count, and of the mirror images numbers[count + i] *=
  // sign·symbol[mirrored − i].
  void (*multiply)(Real* numbers, std::ptrdiff_t count, std::ptrdiff_t mirrored, Real sign,
                   const Real* symbol);
};

// The table for the widest vectors that this processor has.
template <class Real>
const SpectrumKernels<Real>& spectrum_kernels();

}  // namespace salebra::detail
