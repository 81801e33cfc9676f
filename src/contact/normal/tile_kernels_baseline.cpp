// SPDX-License-Identifier: GPL-3.0-or-later
// The tile kernels for any processor.
#define SALEBRA_SIMD baseline
#include "tile_kernels.inl"
