// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's entry for the reader that the environment names as SALEBRA_READER.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "read_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const reader = std::getenv("SALEBRA_READER");
  salebra::fuzz::read_input(reader ? reader : "",
                            std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
