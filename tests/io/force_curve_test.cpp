// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

TEST_CASE("A force curve survives its file, unknown quantities and all", "[curve file]") {
  const Scratch scratch;
  const std::string name = GENERATE("curve.h5", "curve.csv");
  ForceCurve curve{"bem", 2e-6, 1.5e-8, {}};
  for (int i = 1; i <= 3; ++i) {
    ForceSample sample;
    sample.pressure = std::exp(i) * 1e5;
    sample.force = sample.pressure * curve.nominal_area;
    sample.mean_gap = 1e-7 / i;
    if (i != 2) sample.normal_stiffness = 1.0 / 3.0 * i;
    sample.converged = i != 3;
    curve.samples.push_back(sample);
  }
  write_force_curve(scratch / name, curve, {.command_line = "salebra sweep"});
  const ForceCurve read = read_force_curve(scratch / name);
  CHECK(read.model == "bem");
  CHECK(read.nominal_area == curve.nominal_area);
  CHECK(read.rms_height == curve.rms_height);
  REQUIRE(read.samples.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(read.samples[i].pressure == curve.samples[i].pressure);
    CHECK(read.samples[i].force == curve.samples[i].force);
    CHECK(read.samples[i].mean_gap == curve.samples[i].mean_gap);
    CHECK(std::isnan(read.samples[i].indentation));
    CHECK(std::isnan(read.samples[i].tangential_stiffness));
    CHECK(read.samples[i].converged == curve.samples[i].converged);
  }
  CHECK(std::isnan(read.samples[1].normal_stiffness));
  CHECK(read.samples[2].normal_stiffness == 1.0);
  CHECK_THROWS_WITH(write_force_curve(scratch / name, curve), Contains("exists"));
}

TEST_CASE("The file of a study of one surface holds a force curve, of several it does not",
          "[curve file]") {
  const Scratch scratch;
  const Index surfaces = GENERATE(1, 2);
  const std::vector<double> pressures{1e6, 2e6, 4e6, 8e6};
  std::vector<double> gaps;  // of two models
  for (Index i = 0; i < 2 * surfaces * 4; ++i) gaps.push_back(1e-6 / double(i + 1));
  {
    ResultFile file(scratch / "study.h5", {}, {});
    ResultGroup surface = file.group("surface");
    surface.index("realisation", std::size_t(surfaces), "number");
    surface.dataset("rms_height", std::vector<double>(std::size_t(surfaces), 3e-8), {"realisation"},
                    "m", "rms height");
    surface.attribute("size_x", 2e-3);
    surface.attribute("size_y", 1e-3);
    ResultGroup curve = file.group("curve");
    curve.labels("model", {"bem", "gw"}, "contact model");
    curve.index("realisation", std::size_t(surfaces), "number");
    curve.coordinate("pressure", pressures, "Pa", "pressure");
    curve.dataset("mean_gap", gaps, {"model", "realisation", "pressure"}, "m", "mean gap");
    file.commit();
  }
  if (surfaces > 1) {
    CHECK_THROWS_WITH(read_force_curve(scratch / "study.h5"), Contains("2 surfaces"));
    const std::vector<ForceCurve> all = read_force_curves(scratch / "study.h5");
    REQUIRE(all.size() == 2);
    for (std::size_t i = 0; i < 8; ++i) {
      const ForceSample& sample = all[i / 4].samples.at(i % 4);
      CHECK(sample.mean_gap == gaps[i]);
      CHECK(sample.pressure == pressures[i % 4]);
    }
    CHECK(all[1].nominal_area == Approx(2e-6).epsilon(1e-15));
    return;
  }
  const ForceCurve read = read_force_curve(scratch / "study.h5");
  CHECK(read.model == "bem");
  CHECK(read.nominal_area == Approx(2e-6).epsilon(1e-15));
  CHECK(read.rms_height == 3e-8);
  REQUIRE(read.samples.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(read.samples[i].pressure == pressures[i]);
    CHECK(read.samples[i].mean_gap == gaps[i]);
  }
}

TEST_CASE("A curve in a table is read with its units, in the order of rising force",
          "[curve file]") {
  const Scratch scratch;
  const std::string text = GENERATE(
      "# nominal_area: 2 mm^2\npressure [MPa], mean_gap [nm], note\n2, 100, 7\n1, 150, 8\n",
      "# nominal_area: 2e-6 m^2\r\npressure (MPa);mean_gap "
      "(nm);note\r\n2,0;100,0;7\r\n1,0;150,0;\r\n",
      "# nominal_area: 2 mm2\n# pressure [MPa] mean_gap [nm] note\n2 100 7\n\n# a remark\n1 150 "
      "8\n",
      "# nominal_area: 2 mm2\nmean_gap/nm\tpressure [MPa]\n100\t2\n150\t1\n");
  INFO(text);
  const ForceCurve curve = read_force_curve(scratch.file("curve.csv", text));
  REQUIRE(curve.samples.size() == 2);
  CHECK(curve.samples[0].pressure == Approx(1e6).epsilon(1e-14));
  CHECK(curve.samples[0].mean_gap == Approx(150e-9).epsilon(1e-14));
  CHECK(curve.samples[0].force == Approx(2).epsilon(1e-14));
  CHECK(curve.samples[1].mean_gap == Approx(100e-9).epsilon(1e-14));
}

TEST_CASE("A curve of HDF5 is converted from the units that it states", "[curve file]") {
  const Scratch scratch;
  const std::vector<double> values{1, 2};
  for (const char* units : {"Pa", "MPa", "V"}) {
    const auto file = scratch / (std::string(units) + ".h5");
    ResultFile results(file, {}, {});
    ResultGroup curve = results.group("curve");
    curve.coordinate("pressure", values, units, "nominal pressure");
    curve.dataset("mean_gap", values, {"pressure"}, "m", "mean gap");
    curve.attribute("nominal_area", 1e-6);
    results.commit();
  }
  CHECK(read_force_curve(scratch / "Pa.h5").samples[1].pressure == 2);
  CHECK(read_force_curve(scratch / "MPa.h5").samples[1].pressure == 2e6);
  CHECK_THROWS_WITH(read_force_curve(scratch / "V.h5"),
                    Contains("curve/pressure in 'V', which is not a unit like Pa"));
}

TEST_CASE("A table that is no curve is refused with the reason", "[curve file]") {
  const Scratch scratch;
  const auto refused = [&](const std::string& text, const std::string& why) {
    INFO(text);
    CHECK_THROWS_WITH(read_force_curve(scratch.file("curve.csv", text)),
                      Contains("curve.csv") && Contains(why));
  };
  refused("1, 2\n3, 4\n", "name its columns");
  refused("pressure [MPa], mean_gap [s]\n1, 2\n", "mean_gap");
  refused("pressure [MPa], mean_gap [nm]\n1\n2\n3,\n", "");
  refused("pressure [MPa], mean_gap [nm]\n1, 2, 3\n", "line 2");
  refused("pressure [MPa], mean_gap [nm]\n1, two\n", "two");
  refused("pressure [MPa], gap\n1, 2\n", "mean_gap");
  refused("pressure [MPa], depth [nm], mean_gap [nm]\n1, 2, 3\n", "'depth [nm]'");
  refused("pressure [MPa], mean_gap\n1, 2\n", "none for mean_gap");
  refused("mean_gap [nm]\n1\n2\n", "pressure or force");
  refused("pressure [MPa], mean_gap [nm]\n1, 3\nnan, 2\n3, 1\n", "'nan' for pressure in row 2");
  refused("pressure [MPa], mean_gap [nm\n1, 2\n", "bracket");
  refused("pressure [MPa], mean_gap [nm]\n", "no samples");
  refused("", "empty");
  CHECK_THROWS_WITH(read_force_curve(scratch / "absent.csv"), Contains("absent.csv"));
}
