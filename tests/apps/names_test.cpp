// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for every command: options, files and answers call each quantity what its description
// says, a file has the numbers of its answer and replaces no other, a loss has its assumptions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <regex>
#include <salebra/analysis/damping.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/export/deck.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/assumption_verdicts.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <sstream>

#include "../../apps/salebra/answers.hpp"
#include "../../apps/salebra/options.hpp"
#include "results/columns.hpp"
#include "run_program.hpp"
#include "study/cost.hpp"
#include "study/study_text.hpp"

using namespace salebra;
using nlohmann::json;

namespace {

struct Meaning {
  std::string units, long_name;
};
using Meanings = std::map<std::string, Meaning>;

template <class... Structs>
Meanings meanings_of() {
  Meanings all;
  for (const std::vector<Column>* columns : {&columns_of<Structs>()...})
    for (const Column& column : *columns)
      if (!column.per_area)
        all[column.name] = {std::string(si_unit(column.dimension)), column.long_name};
  return all;
}

/// The group of a file, or the object of an answer, and the structs whose columns it has.
const std::map<std::string, Meanings> groups{
    {"surface", meanings_of<Realisation>()},
    {"curve", meanings_of<ForceSample>()},
    {"local", meanings_of<LocalDecayLength>()},
    {"fit", meanings_of<ModelResult, LawDescription>()},
    {"damping", meanings_of<DampingPoint, DeviationRange>()},
    {"solution", meanings_of<DampingPoint, StudySolution>()},
    {"spots", meanings_of<SpotStatistics>()},
    {"flow", meanings_of<FlowFactors>()},
    {"adhesion", meanings_of<AdhesionSample, AdhesiveCycleNumbers, ForceSample>()},
    {"convergence", meanings_of<ModelResult>()},
    {"comparison", meanings_of<ForceSample, DampingPoint>()},
    {"ensemble", meanings_of<SelfAffineParameters, Grid2D, ModelResult>()}};

/// Axes and verdicts, which belong to no struct.
const std::set<std::string> beside{"model",    "realisation",  "pressure",
                                   "midpoint", "min_cells",    "surfaces",
                                   "point",    "realisations", "regime"};

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

/// What counts or names, and so has no unit: axes of files, and what an answer has beside its
/// quantities; and contact_scale, the unit of relative pressures, which StudyResult describes.
const std::set<std::string> indices{"sample",    "component",   "realisation", "midpoint",
                                    "min_cells", "surfaces",    "point",       "nx",
                                    "ny",        "mapped_load", "step",        "contact_scale"};
const std::set<std::string> counts{"realisations", "seed"};

/// Columns of problems and of the program, which the library's glossary does not have.
const Meanings& columns_of_program() {
  static const Meanings all =
      meanings_of<Cost, PointCost, DampingProblem, PathProblem, DampingSolution, DamperSolution,
                  DeckSolution, cli::MotionOptions, cli::ContactPressures, MeanSummit,
                  cli::SurfacePoints, cli::BearingTable, cli::Lay, cli::FitChoices>();
  return all;
}
/// These and those of studies, whose descriptions stand beside their structs.
const Meanings& other_columns() {
  static const Meanings all = [] {
    Meanings found = columns_of_program();
    found.merge(meanings_of<Realisation, ModelResult, DampingPoint, SpotStatistics, SurfacePicture,
                            AdhesionSample, DeviationRange, StudyTheories, StudySolution>());
    return found;
  }();
  return all;
}
bool is_listed(const std::string& name) {
  return is_quantity(name) || other_columns().contains(name);
}
Meaning meaning_of(const std::string& name) {
  if (!is_quantity(name)) return other_columns().at(name);
  const Quantity quantity = find_quantity(name);
  return {std::string(si_unit(quantity.dimension)), std::string(quantity.long_name)};
}

/// Names of 0.1 that are now another, whole or their beginnings.
bool is_old(const std::string& name) {
  static const std::regex old(
      "curvature|customary|coefficient|law_density|(least|greatest)_.*|.*_percent_of.*|law_"
      "deviation_percent|released_energy|closed_form|predicted(_finite)?|small_work_per_cycle|"
      "small_damping_constant");
  return std::regex_match(name, old);
}

std::string stem(const std::string& name) {
  // A sample of surfaces always has a mean and its limits; "decay_length_low" of one curve is a
  // quantity of its own.
  const bool sample = name.starts_with("ensemble_");
  const std::string whole = sample ? name.substr(9) : name;
  for (const std::string part : {"_mean", "_low", "_high"})
    if ((sample || !is_listed(whole)) && whole.ends_with(part))
      return whole.substr(0, whole.size() - part.size());
  return whole;
}

/// Numbers for which an assumption stands, whose unit is its own.
const std::set<std::string>& assumption_keys() {
  static const std::set<std::string> keys = [] {
    std::set<std::string> all;
    for (const AssumptionName& name : assumption_names()) all.emplace(name.name);
    return all;
  }();
  return keys;
}

/// Every dataset has the name, unit and meaning of the table, every number in an attribute the name
/// of one.
void check_file(const ResultReader& reader, const std::string& path = "") {
  for (const std::string& dataset : reader.datasets(path.empty() ? "/" : path)) {
    const std::string where = path + "/" + dataset;
    INFO(where);
    CHECK_FALSE(is_old(dataset));
    if (indices.contains(dataset) || path.ends_with("assumptions") || reader.holds_labels(where))
      continue;
    const std::string parent = path.substr(path.rfind('/') + 1);
    // "hurst" has value, low and high; "psd" and "contact" are groups too.
    const bool part =
        is_listed(parent) && parent != "psd" && parent != "contact" && parent != "intervals";
    const std::string name = part ? parent : stem(dataset);
    REQUIRE(is_listed(name));
    const Meaning meaning = meaning_of(name);
    CHECK(reader.text_attribute(where, "units") == meaning.units);
    CHECK_THAT(reader.text_attribute(where, "long_name").value_or(""),
               Catch::StartsWith(meaning.long_name));
  }
  for (const std::string& group : reader.groups(path.empty() ? "/" : path)) {
    const std::string inner = path + "/" + group;
    if (inner == "/comparison") continue;  // ratios to boundary elements, above
    for (const std::string& name : reader.attributes(inner)) {
      INFO(inner << "@" << name);
      CHECK_FALSE(is_old(name));
      if (reader.number_attribute(inner, name)) CHECK((is_listed(name) || indices.contains(name)));
    }
    check_file(reader, inner);
  }
}

/// Every number stands under the name of a quantity, or is a part of one, as in "hurst": {"value":
/// …, "low": …}.
void check_numbers(const json& object, const std::string& parent) {
  for (const auto& [key, value] : object.items()) {
    INFO(parent << "." << key);
    CHECK_FALSE(is_old(key));
    const bool numbers =
        value.is_number() || (value.is_array() && !value.empty() && value[0].is_number());
    if (numbers)
      CHECK((is_listed(key) || is_listed(parent) || assumption_keys().contains(parent) ||
             indices.contains(key) || counts.contains(key) || parent == "waves"));
    if (value.is_object()) check_numbers(value, key);
    if (value.is_array())
      for (const json& item : value)
        if (item.is_object()) check_numbers(item, key);
  }
}

/// Lists of numbers in a file by the last of their names; numbers of attributes are lists of one.
using NumbersByName = std::multimap<std::string, std::vector<double>>;

void add_numbers(const ResultReader& reader, const std::string& path, NumbersByName& numbers) {
  for (const std::string& name : reader.datasets(path))
    if (!reader.holds_labels(path + "/" + name))
      numbers.emplace(name, reader.numbers(path + "/" + name));
  for (const std::string& group : reader.groups(path)) {
    const std::string inner = (path == "/" ? "" : path) + "/" + group;
    for (const std::string& name : reader.attributes(inner))
      if (const auto value = reader.number_attribute(inner, name))
        numbers.emplace(name, std::vector{*value});
    add_numbers(reader, inner, numbers);
  }
}

/// Where the file has a name of the answer, one of its lists is that of the answer; how many are.
int compare_numbers(const json& object, const NumbersByName& numbers) {
  int compared = 0;
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) compared += compare_numbers(value, numbers);
    std::vector<double> expected;
    for (const json& one : value.is_array() ? value : json::array({value}))
      if (one.is_number()) expected.push_back(one);
    const auto [begin, end] = numbers.equal_range(key);
    if (begin == end || expected.empty() ||
        expected.size() != std::max<std::size_t>(value.size(), 1))
      continue;
    INFO(key);
    CHECK(std::any_of(begin, end, [&](const auto& entry) { return entry.second == expected; }));
    ++compared;
  }
  return compared;
}

/// Any damping constant or loss per cycle in it, by the name of its key.
bool has_loss(const json& answer) {
  if (answer.is_array()) return std::ranges::any_of(answer, has_loss);
  if (!answer.is_object()) return false;
  for (const auto& [key, value] : answer.items())
    if (key != "adhesion_work_per_cycle" &&
        (key.find("damping_constant") != std::string::npos || key == "relaxation_damping" ||
         key == "contact_power" || key.find("work_per_cycle") != std::string::npos ||
         has_loss(value)))
      return true;
  return false;
}

/// Every assumption has its verdicts, which do not contradict the limits beside them.
void check_assumptions(const json& object) {
  REQUIRE(object.contains("assumptions"));
  std::set<std::string> names;
  for (const auto& [name, assumption] : object["assumptions"].items()) {
    INFO(name << ' ' << assumption.dump());
    names.insert(name);
    CHECK(keys(assumption) == "value limit_5_percent limit_20_percent onset verdict needs");
    CHECK(assumption["value"].is_array() == assumption["verdict"].is_array());
    const auto listed = [](const json& one) { return one.is_array() ? one : json::array({one}); };
    const json verdicts = listed(assumption["verdict"]), values = listed(assumption["value"]),
               limits = listed(assumption["limit_5_percent"]);
    const bool large_is_good = name == "slip_of_opening_springs" || name == "slow_motion";
    for (std::size_t k = 0; k < verdicts.size(); ++k) {
      CHECK(words("holds doubtful broken unknown").contains(verdicts[k]));
      const json& limit = limits[limits.size() > 1 ? k : 0];
      if (values[k].is_null() || limit.is_null()) continue;
      CHECK((verdicts[k] == "holds") == (large_is_good ? values[k] >= limit : values[k] <= limit));
    }
  }
  CHECK(names == assumption_keys());
}

/// The unit that an option's line of help begins with; numbers, words and lists of them are told in
/// capitals: NUMBER, NX[,NY], INT:INT.
std::string unit_of(const std::string& type) {
  if (std::regex_search(type, std::regex("^[A-Z]{2}"))) return "1";
  std::string longest;
  for (int k = 0; k <= int(Dimension::power); ++k) {
    const std::string unit(si_unit(Dimension(k)));
    if (unit.size() > longest.size() && (type + " ").starts_with(unit + " ")) longest = unit;
  }
  return longest;
}

void check_keys(const json& object, const Meanings& columns) {
  for (const auto& [key, value] : object.items()) {
    INFO(key);
    CHECK((columns.contains(key) || key == "corrected_area_slope" || key.ends_with("_per_area")));
  }
}

}  // namespace

TEST_CASE("Every dataset of a comparison has the name, unit and meaning of its description",
          "[names]") {
  const ProgramTest test;
  std::string text = study_text("seeds = [3, 4]");
  text.replace(text.find("hurst = 0.8\n"), 12, "");
  test.write("grid.toml", text + "[ensemble]\nhurst = [0.5, 0.8]\n");
  const auto run = test.answer("compare grid.toml --no-stick --no-report -o grid.h5");
  const ResultReader reader(test.folder() / "grid.h5");
  check_group(reader, "ensemble", "ensemble");
  for (const std::string& group : reader.groups("points/1"))
    if (group != "picture" && group != "assumptions")
      check_group(reader, "points/1/" + group, group);
  // The answer has the same, with a mean and its limits for each.
  const json point = run["points"][1];
  check_keys(point["spots"], groups.at("spots"));
  for (const StudyModel& model : contact_models()) {
    if (is_adhesive(model.id)) continue;
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

TEST_CASE(
    "Every dataset of a study with adhesion has the name, unit and meaning of its description",
    "[names][adhesion]") {
  const ProgramTest test;
  test.write("sticky.toml", adhesive_study_text());
  test.done("compare sticky.toml --no-stick --no-report -o sticky.h5");
  const ResultReader reader(test.folder() / "sticky.h5");
  for (const std::string& group : reader.groups("/"))
    if (group != "picture") check_group(reader, group, group);
}

TEST_CASE("Every column of a sweep has the name and unit of its description", "[names]") {
  const ProgramTest test;
  test.done(
      "generate --points 32 --size-x 1mm --hurst 0.8 --rolloff 0.5mm --short-cutoff 125um "
      "--rms-height 1um -o rough.h5");
  const auto run = test.answer(
      "contact rough.h5 --contact-modulus 1GPa --poisson 0.3 --pressure 10kPa:1MPa:4 --stiffness "
      "-o curve.csv");
  const Meanings& columns = groups.at("curve");
  check_keys(run["curve"], columns);
  std::string titles = test.read("curve.csv");
  titles = titles.substr(titles.find("\npressure [") + 1);
  titles.resize(titles.find('\n'));
  int known = 0;
  for (const auto& [name, meaning] : columns)
    known += titles.find(name + " [" + meaning.units + "]") != std::string::npos;
  // All but the separation, which boundary elements do not have, `converged`, which has no unit, and
  // the direction, which K_t without stick solves does not have.
  CHECK(known == int(columns.size()) - 3);
}

TEST_CASE("Every number that the program writes has the name, unit and meaning of the table",
          "[names][assumptions]") {
  const ProgramTest test;
  test.write("study.toml", study_text("seeds = [3, 4]"));
  std::string shell;
  std::ifstream runs(SALEBRA_TABLES "/runs.txt");
  std::set<std::string> commands, with_loss;
  int compared = 0, files = 0;
  for (std::string line; std::getline(runs, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (!line.starts_with("salebra ")) {
      shell += line + "; ";
      continue;
    }
    INFO(line);
    const std::string run = line.substr(8) + " --json --quiet",
                      command = run.substr(0, run.find(' '));
    const json answer = test.done(run, shell).json();
    commands.insert(command);
    check_numbers(answer, "");
    if (has_loss(answer)) {
      with_loss.insert(command);
      check_assumptions(answer);
    }
    static const std::regex named(" (?:-o|--plot) (\\S+)");
    for (std::sregex_iterator found(run.begin(), run.end(), named), end; found != end; ++found) {
      const std::string file = (*found)[1];
      INFO(file);
      REQUIRE(test.files().contains(file));
      // Another time it is in the way, which is seen before any work.
      check_refused(test.run(run, shell), ": exists");
      // Files of these hold much behind their answers, under the same names: tables compare them.
      if (!file.ends_with(".h5") || words("compare oscillate study").contains(command)) continue;
      NumbersByName numbers;
      add_numbers(ResultReader(test.folder() / file), "/", numbers);
      compared += compare_numbers(answer, numbers);
    }
  }
  for (const std::string& file : test.files()) {
    if (!file.ends_with(".h5")) continue;
    INFO(file);
    check_file(ResultReader(test.folder() / file));
    ++files;
  }
  CHECK(files >= 20);
  CHECK(compared > 100);
  CHECK(with_loss == words("compare damping joint oscillate sliding study viscoelastic"));
  // A command that is new has a run, unless it prints no numbers. Its name stands behind the column
  // of headings.
  commands.merge(Names(words("verify report init twin completion")));
  std::istringstream help(test.run("--help").out);
  for (std::string line, first; std::getline(help, line);)
    if (line.size() > 9 && std::istringstream(line.substr(9)) >> first &&
        test.run(first + " --help").status == 0) {
      INFO(first);
      CHECK(commands.contains(first));
    }
}

TEST_CASE("Every option that is a quantity has its unit", "[names]") {
  const ProgramTest test;
  const std::regex line("\\n  --([a-z0-9-]+) (VALUES in )?(.+?)(  |\\n)");
  int known = 0;
  for (const char* command : {"generate", "statistics", "contact", "fit", "damping", "sliding",
                              "joint", "viscoelastic", "oscillate", "study", "compare"}) {
    const std::string help = test.run(std::string(command) + " --help").out;
    for (std::sregex_iterator found(help.begin(), help.end(), line), end; found != end; ++found) {
      std::string name = (*found)[1];
      std::ranges::replace(name, '-', '_');
      INFO(command << " --" << name);
      // The coefficient of a power law has no other name.
      CHECK((!is_old(name) || name == "coefficient"));
      const auto listed = [&] { return is_quantity(name) || columns_of_program().contains(name); };
      if (!listed() && name.ends_with('s')) name.pop_back();
      // A direction is a word or an angle.
      if (!listed() || name == "direction") continue;
      CHECK(unit_of((*found)[3]) == meaning_of(name).units);
      ++known;
    }
  }
  CHECK(known > 100);
}
