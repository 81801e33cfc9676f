// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <salebra/io/result_file.hpp>
#include <string>

/// Checks every dataset of both files, bit by bit; their number.
inline int compare_groups(const salebra::ResultReader& a, const salebra::ResultReader& b,
                          const std::string& path) {
  int compared = 0;
  CHECK(a.groups(path) == b.groups(path));
  CHECK(a.datasets(path) == b.datasets(path));
  for (const std::string& name : a.datasets(path)) {
    const std::string where = path + "/" + name;
    INFO(where);
    if (name == "model") {
      CHECK(a.labels(where) == b.labels(where));
    } else {
      const auto left = a.numbers(where), right = b.numbers(where);
      REQUIRE(left.size() == right.size());
      CHECK(std::memcmp(left.data(), right.data(), left.size() * sizeof(double)) == 0);
    }
    ++compared;
  }
  for (const std::string& name : a.groups(path))
    compared += compare_groups(a, b, path == "/" ? name : path + "/" + name);
  return compared;
}
