// SPDX-License-Identifier: GPL-3.0-or-later
// The convolution's vectorised passes for x86-64-v3.
#define SALEBRA_SIMD avx2
#include "spectrum_kernels.inl"
