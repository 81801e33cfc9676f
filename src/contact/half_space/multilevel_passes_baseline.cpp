// SPDX-License-Identifier: GPL-3.0-or-later
// The passes of the multilevel kernel for any processor.
#define SALEBRA_SIMD baseline
#include "multilevel_passes.inl"
