// SPDX-License-Identifier: GPL-3.0-or-later
// The tile kernels for x86-64-v4.
#define SALEBRA_SIMD avx512
#include "tile_kernels.inl"
