// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "run_program.hpp"

TEST_CASE("Measured surfaces are read as another program reads them", "[info]") {
  const std::filesystem::path folder = SALEBRA_SURFACES;
  const ProgramTest test;
  const auto reference = nlohmann::json::parse(std::ifstream(folder / "reference.json"));
  int compared = 0;
  for (const auto& [name, expected] : reference.items()) {
    const auto result = test.run("info " + (folder / name).string() + " --detrend none --json");
    INFO(name << ": " << result.err);
    REQUIRE(result.status == 0);
    const auto found = result.json();
    CHECK(found["nx"] == expected["nx"]);
    CHECK(found["ny"] == expected["ny"]);
    CHECK(found["undefined_points"] == expected["undefined_points"]);
    // Both sides sum some 10⁵ doubles and multiply by the unit in different places.
    CHECK(found["size_x"].get<double>() ==
          Approx(expected["size_x_m"].get<double>()).epsilon(1e-12));
    CHECK(found["size_y"].get<double>() ==
          Approx(expected["size_y_m"].get<double>()).epsilon(1e-12));
    const double rms_height = expected["rms_height_m"];
    CHECK(found["rms_height"].get<double>() == Approx(rms_height).epsilon(1e-10));
    CHECK(found["mean"].get<double>() ==
          Approx(expected["mean_m"].get<double>()).margin(1e-10 * rms_height));
    ++compared;
  }
  CHECK(compared == 10);
}
