// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/suggestion.hpp"

#include <catch2/catch.hpp>

using namespace salebra;

TEST_CASE("A misspelt name is told from the right one by its nearest neighbour", "[suggestion]") {
  const std::vector<std::string> keys{"points", "size_x",     "size_y",    "hurst",
                                      "seeds",  "rms_height", "rms_slope", "short_cutoff"};
  CHECK(nearest_name("pionts", keys) == "points");  // a swap is one edit
  CHECK(nearest_name("hursts", keys) == "hurst");   // one letter too many
  CHECK(nearest_name("short-cutoff", keys) == "short_cutoff");
  CHECK(nearest_name("rms_hight", keys) == "rms_height");  // one letter missing
  CHECK(nearest_name("seds", keys) == "seeds");
  CHECK(nearest_name("rms", keys) == "rms_height");  // a beginning: the first name that continues
                                                     // it
}

TEST_CASE("Another word for a name comes before names that are near", "[suggestion]") {
  for (const char* word : {"--force", "--load"}) {
    CHECK(did_you_mean(word, {"--overwrite", "--pressure", "--normal-force", "--loading"}) ==
          " (did you mean --normal-force or --pressure?)");
    CHECK(did_you_mean(word, {"--overwrite", "--pressures"}) == " (did you mean --pressures?)");
  }
  CHECK(did_you_mean("--force", {"--overwrite", "--quiet"}) == " (did you mean --overwrite?)");
  CHECK(did_you_mean("--E", {"--young", "--contact-modulus"}) ==
        " (did you mean --contact-modulus or --young?)");
  CHECK(nearest_name("roughness", {"statistics", "init"}) == "statistics");
  CHECK(did_you_mean("friction", {"friction"}).empty());
}

TEST_CASE("An old name is answered with the new one, of an option as of a key", "[suggestion]") {
  CHECK(nearest_name("predicted", {"work_per_cycle", "small_amplitude_work"}) ==
        "small_amplitude_work");
  CHECK(nearest_name("ellipsoid", {"cone", "elliptic-paraboloid"}) == "elliptic-paraboloid");
  CHECK(nearest_name("--predicted-finite", {"--points", "--work-by-force"}) == "--work-by-force");
  CHECK(nearest_name("closed_form", {"points"}).empty());  // the new name is unknown here
}

TEST_CASE("Where no name is near, none is suggested", "[suggestion]") {
  const std::vector<std::string> keys{"points", "hurst", "seeds"};
  CHECK(nearest_name("temperature", keys).empty());
  CHECK(nearest_name("", keys).empty());
  CHECK(nearest_name("pt", keys).empty());
  CHECK(nearest_name("hurst", {"hurst"}).empty());  // correctly spelt
  CHECK(nearest_name("hurst", {}).empty());
  CHECK(did_you_mean("temperature", keys).empty());
  CHECK(did_you_mean("hirst", keys) == " (did you mean hurst?)");
}
