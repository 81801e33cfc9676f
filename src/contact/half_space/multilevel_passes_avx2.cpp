// SPDX-License-Identifier: GPL-3.0-or-later
// The multilevel kernel's kernels for x86-64-v3.
#define SALEBRA_SIMD avx2
#include "multilevel_passes.inl"
