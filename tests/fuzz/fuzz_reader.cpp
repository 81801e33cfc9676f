// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's entry for one reader, which the build names as SALEBRA_READER.
#include <cstddef>
#include <cstdint>
#include <string>

#include "read_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  salebra::fuzz::read_input(SALEBRA_READER, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
