// SPDX-License-Identifier: GPL-3.0-or-later
// The tile kernels for x86-64-v3.
#define SALEBRA_SIMD avx2
#include "tile_kernels.inl"
