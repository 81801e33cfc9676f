// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace salebra {

/// Returns the version of this library, "major.minor.patch", from project() in CMake.
std::string_view version();

/// Returns a text with everything that the last digits of a result depend on besides the version,
/// e.g. "GCC 12.2.0, Eigen 3.4.0, FFTW 3.3.10 for avx, vectors avx512"; docs/conventions.md says
/// how many digits. Before you continue a stored computation, compare its arithmetic() with this
/// one: they must be equal.
std::string arithmetic();

}  // namespace salebra
