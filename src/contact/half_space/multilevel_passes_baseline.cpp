// SPDX-License-Identifier: GPL-3.0-or-later
// The multilevel kernel's kernels for any machine.
#define SALEBRA_SIMD baseline
#include "multilevel_passes.inl"
