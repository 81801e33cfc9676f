// SPDX-License-Identifier: GPL-3.0-or-later
#define SALEBRA_SIMD baseline
#include "spectrum_kernels.inl"
