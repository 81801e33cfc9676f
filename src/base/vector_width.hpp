// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <type_traits>

namespace salebra::detail {

/// Instruction sets that the vectorised passes are compiled for: that of any machine, x86-64-v3 and
/// x86-64-v4.
enum class VectorWidth { baseline, avx2, avx512 };

/// The widest vector instruction set of this machine (baseline if it is not x86-64), or a narrower
/// one named by the environment variable SALEBRA_VECTOR_WIDTH, which makes a newer processor
/// reproduce the results of an older one. Throws InvalidInput if the variable holds an unknown name
/// or a set that the machine does not have.
VectorWidth vector_width();
const char* name_of(VectorWidth width);

/// Returns the table of passes for Real: single() if Real is float, dual() if it is double.
template <class Real, class Single, class Dual>
auto table_of(Single (*single)(), Dual (*dual)()) {
  if constexpr (std::is_same_v<Real, float>) {
    return single();
  } else {
    return dual();
  }
}

}  // namespace salebra::detail
