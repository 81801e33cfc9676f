// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/number_table.hpp"

#include <catch2/catch.hpp>
#include <salebra/base/error.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

NumberTable read(const Scratch& scratch, const std::string& text) {
  return read_number_table(scratch.file("table.txt", text),
                           {{"time", Dimension::time, {"t"}},
                            {"indentation", Dimension::length, {"delta"}},
                            {"psd", Dimension::length_to_the_fourth}},
                           2);
}

}  // namespace

TEST_CASE("The titles of a table name its columns and their units", "[number table]") {
  const Scratch scratch;
  const std::string text =
      GENERATE("1e-3 2e-9\n3e-3 4e-9\n", "time, indentation\n1e-3, 2e-9\n3e-3, 4e-9\n",
               "time [ms], indentation [nm]\n1, 2\n3, 4\n",
               "# time [ms], indentation [nm]\n1, 2\n3, 4\n", "T (ms)\tDelta (nm)\n1\t2\n3\t4\n",
               "t/ms delta/nm\n1 2\n3 4\n", "indentation [nm];time [ms]\n2;1\n4;3\n",
               "\"time [milliseconds]\",\"indentation [\u00c5]\"\n1.0,20\n3.0,40\n",
               "# of a drive\ntime [ms] indentation [nm]\n1 2\n3 4\n");
  INFO(text);
  const NumberTable table = read(scratch, text);
  REQUIRE(table.columns.size() == 2);
  // The product of value and unit is rounded.
  for (std::size_t i : {0, 1}) {
    CHECK(table.columns[0].at(i) == Approx(1e-3 + 2e-3 * double(i)).epsilon(1e-15).margin(0));
    CHECK(table.columns[1].at(i) == Approx(2e-9 + 2e-9 * double(i)).epsilon(1e-15).margin(0));
  }
}

TEST_CASE("A title, unit or comment that would not be used is refused by name", "[number table]") {
  const Scratch scratch;
  const auto [text, part] = GENERATE(table<const char*, const char*>({
      {"time [ms], depth [nm]\n1, 2\n", "'depth [nm]'"},
      {"time [mm], indentation [nm]\n1, 2\n", "'mm'"},
      {"time [ms], indentation [V]\n1, 2\n", "'V'"},
      {"time [ms], indentation\n1, 2\n", "none for indentation"},
      {"time [ms], time [ms]\n1, 2\n", "two columns time"},
      {"time [ms], psd [m^4]\n1, 2\n", "indentation"},
      {"time [ms], indentation [nm] rms\n1, 2\n", "'rms'"},
      {"time [ms], indentation [nm\n1, 2\n", "bracket"},
      {"# units: ms, nm\n1, 2\n", "'units: ms, nm'"},
      {"# Einheiten: ms\n1, 2\n", "'Einheiten: ms'"},
      {"# lengths in (nm)\n1, 2\n", "'lengths in (nm)'"},
      {"time [ms], indentation [nm]\n1, 2, 3\n", "with a title each"},
      {"time [ms], indentation [nm], psd [m4]\n1, 2\n", "with a title each"},
      {",time,indentation\n0,1,2\n", "''"},
  }));
  INFO(text);
  CHECK_THROWS_WITH(read(scratch, text), Contains("table.txt") && Contains(part));
}
