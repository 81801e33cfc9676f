// SPDX-License-Identifier: GPL-3.0-or-later
#include <hdf5.h>
#include <hdf5_hl.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

void write_example(const std::filesystem::path& file) {
  ResultFile results(file, {.command_line = "salebra study a.toml"});
  ResultGroup group = results.group("damping");
  group.coordinate("force", std::vector{1.0, 2.0, 4.0}, "N", "normal force");
  group.labels("model", {"bem", "größe"}, "contact model");
  group.index("seed", 2, "number of the realisation");
  std::vector<double> values(12);
  std::iota(values.begin(), values.end(), 0.5);
  group.dataset("damping_constant", values, {"seed", "model", "force"}, "N s/m",
                "damping constant");
  group.dataset("count", std::vector<std::int64_t>{3, 4}, {"seed"}, "1", "count");
  group.flags("converged", {true, false, true}, {"force"}, "converged");
  group.scalar("decay_length", 1e-7, "m", "decay length");
  group.attribute("note", "a note");
  Field field(2, 3);
  field << 1, 2, 3, 4, 5, 6;
  group.dataset("map", field, "seed", "force", "m", "map");
  results.group("empty/nested");
  results.commit();
}

}  // namespace

TEST_CASE("Results are read back as they were written", "[result file]") {
  const Scratch scratch;
  write_example(scratch / "results.h5");
  const ResultReader reader(scratch / "results.h5");
  CHECK(reader.groups() == std::vector<std::string>{"damping", "empty"});
  CHECK(reader.groups("empty") == std::vector<std::string>{"nested"});
  CHECK(reader.datasets("damping").size() == 8);
  CHECK(reader.has("damping/force"));
  CHECK_FALSE(reader.has("fit/force"));
  CHECK(reader.shape("damping/damping_constant") == std::vector<Index>{2, 2, 3});
  CHECK(reader.numbers("damping/damping_constant").at(7) == 7.5);
  CHECK(reader.number("damping/decay_length") == 1e-7);
  CHECK(reader.numbers("damping/count") == std::vector{3.0, 4.0});
  CHECK(reader.numbers("damping/converged") == std::vector{1.0, 0.0, 1.0});
  CHECK(reader.labels("damping/model") == std::vector<std::string>{"bem", "größe"});
  CHECK(reader.field("damping/map")(1, 0) == 4);
  CHECK(reader.text_attribute("damping", "note") == "a note");
  CHECK(reader.attributes("damping") == std::vector<std::string>{"note"});
  // Attributes of a dimension scale and of a dataset on it, without HDF5's own references.
  for (const char* name : {"damping/force", "damping/damping_constant"})
    CHECK(reader.attributes(name) == std::vector<std::string>{"long_name", "units"});
  CHECK(reader.attributes("damping/converged") ==
        std::vector<std::string>{"dtype", "long_name", "units"});
  CHECK(reader.holds_labels("damping/model"));
  CHECK_FALSE(reader.holds_labels("damping/force"));
  CHECK(reader.coordinates("damping/damping_constant") ==
        std::vector<std::string>{"seed", "model", "force"});
  CHECK_THROWS_WITH(reader.numbers("damping/absent"), Contains("results.h5") && Contains("absent"));
  CHECK_THROWS_AS(reader.number("damping/force"), InvalidInput);
  CHECK_THROWS_AS(reader.numbers("damping/model"), InvalidInput);
  CHECK_THROWS_AS(reader.groups("fit"), InvalidInput);
  CHECK_THROWS_AS(reader.attributes("fit"), InvalidInput);
  CHECK_THROWS_AS(reader.holds_labels("fit"), InvalidInput);
  CHECK_THROWS_AS(ResultReader(scratch / "absent.h5"), InvalidInput);
}

TEST_CASE("A file larger than what its maker keeps in memory is read back as it was written",
          "[result file]") {
  // Pages of 64 kB are written to the disk a megabyte at a time; lists of a megabyte or more are
  // written directly, and their ends share pages with data before and after. Lists of all lengths
  // and the attributes between them change pages that are already on the disk.
  const Scratch scratch;
  ResultFile results(scratch / "large.h5", {});
  const auto values = [](std::size_t k, std::size_t count) {
    std::vector<double> list(count);
    for (std::size_t i = 0; i < count; ++i) list[i] = std::sin(double(i + 31 * k));
    return list;
  };
  constexpr std::size_t lengths[] = {3, 131072, 1000, 150001, 9000, 40000};
  std::vector<ResultGroup> groups;
  for (std::size_t k = 0; k < 24; ++k) {
    groups.push_back(results.group("group" + std::to_string(k)));
    groups[k].coordinate("x", values(k, lengths[k % 6]), "m", "position");
    groups[k].dataset("y", values(k + 1, lengths[k % 6]), {"x"}, "m", "height");
    groups[k / 2].attribute("note" + std::to_string(k), std::string(2000, char('a' + k)));
  }
  results.commit();
  const ResultReader reader(scratch / "large.h5");
  for (std::size_t k = 0; k < 24; ++k) {
    const std::string group = "group" + std::to_string(k);
    CHECK(reader.numbers(group + "/x") == values(k, lengths[k % 6]));
    CHECK(reader.numbers(group + "/y") == values(k + 1, lengths[k % 6]));
    CHECK(reader.text_attribute("group" + std::to_string(k / 2), "note" + std::to_string(k)) ==
          std::string(2000, char('a' + k)));
  }
}

TEST_CASE("Datasets hang on HDF5 dimension scales and carry units and names", "[result file]") {
  // The HDF5 library itself must report what xarray and h5netcdf rely on.
  const Scratch scratch;
  write_example(scratch / "results.h5");
  const hid_t file = H5Fopen((scratch / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(file >= 0);
  const hid_t set = H5Dopen2(file, "damping/damping_constant", H5P_DEFAULT);
  const char* names[] = {"seed", "model", "force"};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const hid_t scale =
        H5Dopen2(file, ("damping/" + std::string(names[axis])).c_str(), H5P_DEFAULT);
    CHECK(H5DSis_scale(scale) > 0);
    CHECK(H5DSis_attached(set, scale, axis) > 0);
    H5Dclose(scale);
  }
  CHECK(H5Aexists(set, "units") > 0);
  CHECK(H5Aexists(set, "long_name") > 0);
  CHECK(H5Tequal(H5Dget_type(set), H5T_IEEE_F64LE) > 0);
  H5Dclose(set);
  H5Fclose(file);
}

TEST_CASE("A dataset without unit, coordinate or the right shape is refused", "[result file]") {
  const Scratch scratch;
  ResultFile results(scratch / "results.h5", {});
  ResultGroup group = results.group("curve");
  const std::vector<double> three{1, 2, 3};
  group.coordinate("pressure", three, "Pa", "pressure");
  CHECK_THROWS_WITH(group.dataset("force", three, {"area"}, "N", "force"), Contains("area"));
  CHECK_THROWS_WITH(group.dataset("force", std::vector{1.0}, {"pressure"}, "N", "force"),
                    Contains("3"));
  CHECK_THROWS_WITH(group.dataset("force", three, {"pressure"}, "", "force"), Contains("units"));
  CHECK_THROWS_WITH(group.coordinate("pressure", three, "Pa", "pressure"), Contains("already"));
  group.dataset("force", three, {"pressure"}, "N", "force");
  CHECK_THROWS_WITH(group.dataset("gap", three, {"force"}, "m", "gap"),
                    Contains("not a coordinate"));
  results.commit();
  CHECK_THROWS_AS(group.scalar("late", 1, "m", "late"), InvalidInput);
  CHECK_THROWS_AS(results.group("late"), InvalidInput);
}

TEST_CASE("A truncated result file is refused", "[result file]") {
  const Scratch scratch;
  write_example(scratch / "results.h5");
  std::filesystem::resize_file(scratch / "results.h5",
                               std::filesystem::file_size(scratch / "results.h5") - 1);
  CHECK_THROWS_WITH(ResultReader(scratch / "results.h5"), Contains("results.h5"));
}
