// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace salebra {

/// The version of this library, "major.minor.patch": the one of CMake's project().
std::string_view version();

/// "GCC 12.2.0, Eigen 3.4.0, FFTW 3.3.10 for avx, vectors avx512": what the last digits of a result
/// depend on in addition to the version of this library; docs/conventions.md says how many. What
/// was begun by one arithmetic must not be continued by another.
std::string arithmetic();

}  // namespace salebra
