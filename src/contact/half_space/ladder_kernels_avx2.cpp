// SPDX-License-Identifier: GPL-3.0-or-later
// The ladder's kernels for x86-64-v3.
#define SALEBRA_SIMD avx2
#include "ladder_kernels.inl"
