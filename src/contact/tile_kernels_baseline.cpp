// SPDX-License-Identifier: GPL-3.0-or-later
#define SALEBRA_SIMD baseline
#include "tile_kernels.inl"
