// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace salebra {

/// Which surfaces of a study one of several processes computes. Surfaces are counted over all
/// points of the parameter grid and all seeds, in their order.
struct Shard {
  std::size_t number = 0;
  std::size_t count = 0;  ///< 0: every surface that no other process has taken

  bool any() const { return count == 0; }
  /// place: from 0 on. The i-th surface, i from 1 on, belongs to the shard where i mod count =
  /// number mod count.
  bool holds(std::size_t place) const { return any() || (place + 1) % count == number % count; }
};

/// "3/8", with the number from 1 to 8 or, for schedulers that count from 0, from 0 to 7; or "any".
/// Throws InvalidInput.
Shard parse_shard(std::string_view text);
/// The inverse.
std::string to_text(const Shard& shard);

}  // namespace salebra
