// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "read_input.hpp"

TEST_CASE("Inputs that fuzzing kept are read or refused in one line", "[fuzz]") {
  const std::filesystem::path corpus = SALEBRA_CORPUS;
  for (const std::string& reader : salebra::fuzz::readers()) {
    int inputs = 0, read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus / reader)) {
      INFO(entry.path().string());
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string content{std::istreambuf_iterator<char>(stream), {}};
      bool was_read = false;
      CHECK_NOTHROW(was_read = salebra::fuzz::read_input(reader, content));
      ++inputs;
      read += was_read;
    }
    INFO(reader);
    CHECK(inputs > 0);
    // A corpus of which nothing can be read would leave the fuzzer before the door.
    CHECK(read > 0);
  }
}
