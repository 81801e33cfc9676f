// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that files and answers of study, compare and sweep call each quantity what its description says.
#include <catch2/catch.hpp>
#include <map>
#include <salebra/io/result_file.hpp>
#include <salebra/results/damping.hpp>
#include <salebra/results/spectrum.hpp>
#include <salebra/study/study.hpp>

#include "run_program.hpp"
#include "study/study_text.hpp"

using namespace salebra;
using nlohmann::json;

namespace {

struct Meaning {
  std::string units, long_name;
};
using Meanings = std::map<std::string, Meaning>;

template <class... Structs>
Meanings columns_of() {
  Meanings all;
  const auto add = [&](const auto&, const Quantity& quantity) {
    all[std::string(quantity.name)] = {std::string(si_unit(quantity.dimension)),
                                       std::string(quantity.long_name)};
  };
  (for_each_column<Structs>(add), ...);
  return all;
}

/// The group of a file, or the object of an answer, and the structs whose columns it has.
const std::map<std::string, Meanings> groups{
    {"surface", columns_of<Realisation>()},
    {"curve", columns_of<ForceSample>()},
    {"local", columns_of<LocalDecayLength>()},
    {"fit", columns_of<ModelResult>()},
    {"damping", columns_of<DampingPoint>()},
    {"spots", columns_of<SpotStatistics>()},
    {"convergence", columns_of<ModelResult>()},
    {"comparison", columns_of<ForceSample, DampingPoint>()},
    {"ensemble", columns_of<SelfAffineParameters, Grid2D, ModelResult>()}};

/// Axes and verdicts, which belong to no struct.
const std::set<std::string> beside{"model",         "realisation",  "pressure", "midpoint",
                                   "min_cells",     "surfaces",     "point",    "realisations",
                                   "deviation_min", "deviation_max"};

void check_group(const ResultReader& reader, const std::string& path, const std::string& group) {
  const Meanings& columns = groups.at(group);
  int known = 0;
  for (const std::string& dataset : reader.datasets(path)) {
    INFO(path << '/' << dataset);
    if (beside.contains(dataset)) continue;
    std::string name = dataset, end;
    for (const std::string part : {"mean", "low", "high"}) {
      if (columns.contains(dataset) || !name.ends_with("_" + part)) continue;
      name.resize(name.size() - part.size() - 1);
      end = ", " + part;
      break;
    }
    if (name.starts_with("ensemble_")) name = name.substr(9);
    REQUIRE(columns.contains(name));
    const Meaning& meaning = columns.at(name);
    const std::string where = path + "/" + dataset;
    CHECK(reader.text_attribute(where, "units") == (group == "comparison" ? "1" : meaning.units));
    CHECK(reader.text_attribute(where, "long_name") ==
          (group == "comparison" ? name + " over that of boundary elements" : meaning.long_name) +
              end);
    ++known;
  }
  CHECK(known > 0);
}

void check_keys(const json& object, const Meanings& columns) {
  for (const auto& [key, value] : object.items()) {
    INFO(key);
    CHECK((columns.contains(key) || key == "corrected_area_slope"));
  }
}

}  // namespace

TEST_CASE("Every dataset of a comparison has the name, unit and meaning of its description",
          "[names]") {
  const ProgramTest test;
  std::string text = study_text("seeds = [3, 4]");
  text.replace(text.find("hurst = 0.8\n"), 12, "");
  test.write("grid.toml", text + "[ensemble]\nhurst = [0.5, 0.8]\n");
  const auto run = test.run("compare grid.toml --no-stick --no-report --json -o grid.h5");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const ResultReader reader(test.folder() / "grid.h5");
  check_group(reader, "ensemble", "ensemble");
  for (const std::string& group : reader.groups("points/1"))
    if (group != "picture" && group != "premises") check_group(reader, "points/1/" + group, group);
  // Of the answer the same, with a mean and its limits for each.
  const json point = run.json()["points"][1];
  check_keys(point["spots"], groups.at("spots"));
  for (const StudyModel& model : contact_models()) {
    INFO(model.name);
    json found = point["models"][model.name];
    CHECK(found["title"] == model.title);
    check_keys(found["curve"], groups.at("curve"));
    check_keys(found["damping"], groups.at("damping"));
    check_keys(found["over_bem"], groups.at("comparison"));
    for (const char* part : {"title", "curve", "damping", "over_bem"}) found.erase(part);
    check_keys(found, groups.at("fit"));
    CHECK(found.size() > 20);
  }
}

TEST_CASE("Every column of a sweep has the name and unit of its description", "[names]") {
  const ProgramTest test;
  REQUIRE(test.run("generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff "
                   "125um --rms-height 1um -o rough.h5")
              .status == 0);
  const auto run = test.run(
      "sweep rough.h5 --contact-modulus 1GPa --poisson 0.3 --pressures 10kPa:1MPa:4 --stiffness "
      "--json -o curve.csv");
  REQUIRE(run.status == 0);
  const Meanings& columns = groups.at("curve");
  check_keys(run.json()["curve"], columns);
  std::string titles = test.read("curve.csv");
  titles = titles.substr(titles.find("\npressure [") + 1);
  titles.resize(titles.find('\n'));
  int known = 0;
  for (const auto& [name, meaning] : columns)
    known += titles.find(name + " [" + meaning.units + "]") != std::string::npos;
  // All but the separation, which boundary elements do not have, and `converged`, which has no unit.
  CHECK(known == int(columns.size()) - 2);
}
