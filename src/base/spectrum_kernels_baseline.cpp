// SPDX-License-Identifier: GPL-3.0-or-later
// The convolution's vectorised passes for any processor.
#define SALEBRA_SIMD baseline
#include "spectrum_kernels.inl"
