// SPDX-License-Identifier: GPL-3.0-or-later
// The ladder's kernels for any machine.
#define SALEBRA_SIMD baseline
#include "ladder_kernels.inl"
