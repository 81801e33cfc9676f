// SPDX-License-Identifier: GPL-3.0-or-later
#define SALEBRA_SIMD avx512
#include "spectrum_kernels.inl"
