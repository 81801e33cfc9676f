// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/checksum.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <string_view>

using salebra::detail::Checksum;

TEST_CASE("A checksum is that of its definition, however the bytes are cut", "[checksum]") {
  // Values from integers of any size: each word w of eight bytes (low byte first, the last word
  // padded with zeros), and at the end the number of bytes, turns s into
  // (s xor w)·0x9e3779b97f4a7c15 modulo 2^64, then into s xor s/2^32. Existing files need them.
  CHECK(Checksum().digits() == "0000000000000000");
  CHECK(Checksum("a").digits() == "ffde1b4163a5fcc0");
  CHECK(Checksum("salebra ").digits() == "ed211ace478def46");
  const std::string_view text = "The quick brown fox jumps over the lazy dog";
  CHECK(Checksum(text).value() == 0xbf2b3df474fb56d1);
  for (std::size_t first = 0; first <= text.size(); ++first)
    for (const std::size_t second : {first, (first + text.size()) / 2}) {
      Checksum sum(text.substr(0, first));
      sum.add(text.substr(first, second - first));
      sum.add(text.substr(second));
      CHECK(sum.digits() == "bf2b3df474fb56d1");
    }
}
