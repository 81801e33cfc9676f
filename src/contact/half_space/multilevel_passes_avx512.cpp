// SPDX-License-Identifier: GPL-3.0-or-later
// The passes of the multilevel kernel for x86-64-v4.
#define SALEBRA_SIMD avx512
#include "multilevel_passes.inl"
