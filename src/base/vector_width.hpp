// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

namespace salebra::detail {

/// What passes are compiled for more than once, by -march: any machine, x86-64-v3, x86-64-v4.
enum class VectorWidth { baseline, avx2, avx512 };

/// The widest that this machine runs, baseline on other processors than x86-64; or a narrower one
/// by its name in the environment variable SALEBRA_VECTOR_WIDTH, which repeats on a newer processor
/// what an older one computes. Throws InvalidInput for other names and for a wider one.
VectorWidth vector_width();
const char* name_of(VectorWidth width);

/// The table of passes in one of the two precisions.
template <class Real, class Single, class Dual>
auto table_of(Single (*single)(), Dual (*dual)()) {
  if constexpr (std::is_same_v<Real, float>) {
    return single();
  } else {
    return dual();
  }
}

}  // namespace salebra::detail
