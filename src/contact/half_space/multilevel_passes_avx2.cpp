// SPDX-License-Identifier: GPL-3.0-or-later
// The passes of the multilevel kernel for x86-64-v3.
#define SALEBRA_SIMD avx2
#include "multilevel_passes.inl"
