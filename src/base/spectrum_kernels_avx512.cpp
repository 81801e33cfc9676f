// SPDX-License-Identifier: GPL-3.0-or-later
// The convolution's vectorised passes for x86-64-v4.
#define SALEBRA_SIMD avx512
#include "spectrum_kernels.inl"
