// SPDX-License-Identifier: GPL-3.0-or-later
// The ladder's kernels for x86-64-v4.
#define SALEBRA_SIMD avx512
#include "ladder_kernels.inl"
