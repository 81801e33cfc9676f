// SPDX-License-Identifier: GPL-3.0-or-later
#define SALEBRA_SIMD avx2
#include "spectrum_kernels.inl"
