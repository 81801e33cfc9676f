// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "run_program.hpp"

TEST_CASE("Measured surfaces are read as another program reads them", "[info]") {
  const std::filesystem::path folder = std::filesystem::path(SALEBRA_SHARED) / "surfaces";
  if (!std::filesystem::exists(folder / "reference.json")) return;
  const ProgramTest test;
  const auto reference = nlohmann::json::parse(std::ifstream(folder / "reference.json"));
  int compared = 0;
  for (const auto& [name, expected] : reference.items()) {
    // Formats that only the Python package reads.
    if (name.ends_with(".sur")) continue;
    const auto result = test.run("info " + (folder / name).string() + " --detrend none --json");
    INFO(name << ": " << result.err);
    if (result.status == 2 && (name.ends_with(".x3p") || name.ends_with(".nc"))) continue;
    REQUIRE(result.status == 0);
    const auto found = result.json();
    CHECK(found["nx"] == expected["nx"]);
    CHECK(found["ny"] == expected["ny"]);
    CHECK(found["undefined_points"] == expected["undefined_points"]);
    // NetCDF's size is stored in single precision by the program that wrote the file.
    CHECK(found["size_x"].get<double>() ==
          Approx(expected["size_x_m"].get<double>()).epsilon(1e-7));
    CHECK(found["size_y"].get<double>() ==
          Approx(expected["size_y_m"].get<double>()).epsilon(1e-7));
    const double rms_height = expected["rms_height_m"];
    CHECK(found["rms_height"].get<double>() == Approx(rms_height).epsilon(1e-6));
    CHECK(found["mean"].get<double>() ==
          Approx(expected["mean_m"].get<double>()).margin(1e-6 * rms_height));
    ++compared;
  }
  CHECK(compared >= 6);
}
