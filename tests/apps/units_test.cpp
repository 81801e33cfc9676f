// SPDX-License-Identifier: GPL-3.0-or-later
// Every table of the program says what its JSON twin says: the same numbers, each with the unit of
// its quantity.
#include <algorithm>
#include <catch2/catch.hpp>
#include <salebra/base/units.hpp>
#include <sstream>
#include <vector>

#include "run_program.hpp"

using Catch::Contains;

using nlohmann::ordered_json;
using salebra::Dimension;

namespace {

/// What a name in an answer measures, independently of the program's own list. A name with a dot is
/// a member of that object alone.
Dimension meaning(const std::string& object, const std::string& name) {
  using enum Dimension;
  static const std::vector<std::pair<Dimension, Names>> meanings{
      {length,
       words(
           "size_x size_y s_filter l_filter Ra Rq Rz Rsm Ra_deviation Rq_deviation Rz_deviation "
           "Rsm_deviation mean rms_height mean_height mean_radius radius summit_rms Sa Sq Sp Sv Sz "
           "Sal Sk Spk Svk pixel_limit tip_limit resolution wavelength rolloff.value rolloff.low "
           "rolloff.high short_cutoff.value short_cutoff.low short_cutoff.high mean_gap separation "
           "indentation tangential normal_amplitude stabilising_amplitude contact_radius "
           "decay_length decay_length_low decay_length_high decay_length_min decay_length_max "
           "decay_length_at_min_gap decay_length_at_max_gap decay_length_by_weights.spacing "
           "decay_length_by_weights.equal decay_length_by_weights.force")},
      {length_squared, words("moment0 contact_area_min contact_area_max")},
      {inverse_length_squared, words("moment4 summit_density Spd")},
      {angle, words("Std direction lay_angle lay_angle_error")},
      {inverse_length, words("Spc")},
      {pressure, words("pressure pressure_min pressure_max max_pressure reference_pressure")},
      {force, words("force max_force mean_force tangential_force")},
      {energy,
       words("elastic_energy work_per_cycle work_per_cycle_without_slip error_estimate "
             "work_by_intervals work_by_intervals_error "
             "work_by_whole_cells work_by_force predicted_exponential predicted_exponential_finite "
             "work small_amplitude_work relaxation_work slip_work work_per_cycle_error dissipated "
             "stored_energy_change normal_work gap_work")},
      {Dimension::time, words("seconds time decay_time")},
      {stiffness,
       words("normal_stiffness tangential_stiffness contact_stiffness storage_stiffness")},
      {stiffness_per_area, words("normal_stiffness_per_area tangential_stiffness_per_area")},
      {force_curvature, words("force_curvature")},
      {power, words("power slow_limit_power")},
      {damping, words("damping_constant damping_constant_without_slip")},
      {frequency, words("frequency")},
      {angular_frequency, words("angular_frequency natural_frequency")},
      {dimensionless,
       words("rms_slope_along rms_slope_across lay_ratio lay_ratio_low lay_ratio_high Str_max "
             "asked_over_lattice balance contact_time friction_coefficient contact_area_fraction "
             "damping_ratio "
             "dundurs force_change frequency_ratio high kurtosis logarithmic_decrement loss_factor "
             "low moment2 nayak over_stick quality_factor r_squared ratio ratio_exponential "
             "ratio_exponential_finite ratio_finite residual rms_slope significance skewness Sdq "
             "Sdr Sku Smr1 Smr2 Ssk stiffness_ratio Str tangential_force_change time_in_periods "
             "value work_change work_over_elastic_energy decay_length_over_rms_height "
             "relaxation_share "
             "slip_share")}};
  for (const std::string& wanted : {object + "." + name, name})
    for (const auto& [dimension, names] : meanings)
      if (names.contains(wanted)) return dimension;
  INFO(object << "." << name);
  FAIL_CHECK("has no unit in this test");
  return dimensionless;
}

/// What the program prints, line by line, against its JSON answer.
class Twin {
 public:
  explicit Twin(const std::string& text) : text_(text) {}

  void check(const ordered_json& object, const std::string& name = "", std::size_t indent = 0) {
    // Lists follow the lines of their object, those of one length in a table.
    std::vector<std::vector<std::pair<std::string, ordered_json>>> tables;
    for (const auto& [key, value] : object.items()) {
      INFO(name << "." << key);
      if (key == "warnings") continue;  // the text has them on standard error
      const bool words = value.is_array() && !value.empty() && value[0].is_string();
      if (value.is_object()) {
        CHECK(line() == std::string(indent, ' ') + key);
        check(value, key, indent + 2);
      } else if (value.is_array() && !value.empty() && value[0].is_object()) {
        CHECK(line() == std::string(indent, ' ') + key);
        std::vector<std::pair<std::string, ordered_json>> columns;
        for (const auto& [column, ignored] : value[0].items()) {
          columns.emplace_back(column, ordered_json::array());
          for (const auto& row : value) columns.back().second.push_back(row.at(column));
        }
        check_table(columns, key);
      } else if (value.is_array() && !words) {
        const auto alike = std::ranges::find_if(tables, [&, length = value.size()](const auto& t) {
          return t[0].second.size() == length;
        });
        (alike == tables.end() ? tables.emplace_back() : *alike).emplace_back(key, value);
      } else {
        const std::string found = line(), start = std::string(indent, ' ') + key + "  ";
        REQUIRE_THAT(found, Catch::StartsWith(start));
        const std::string text = found.substr(found.find_first_not_of(' ', start.size()));
        if (words)
          for (const auto& word : value)
            CHECK_THAT(", " + text + ",", Contains(", " + word.get<std::string>() + ","));
        else
          check_cell(text, value, name, key);
      }
    }
    for (const auto& table : tables) check_table(table, name);
  }

  /// Everything of the text has been compared.
  bool at_end() { return text_.peek() == EOF; }

 private:
  std::string line() {
    std::string found;
    REQUIRE(std::getline(text_, found));
    return found;
  }

  // Columns are at least two blanks apart; one blank stands before a unit.
  static std::vector<std::string> cells(const std::string& row) {
    std::vector<std::string> found;
    for (std::size_t begin = row.find_first_not_of(' '); begin != std::string::npos;) {
      const std::size_t end = std::min(row.find("  ", begin), row.size());
      found.push_back(row.substr(begin, end - begin));
      begin = row.find_first_not_of(' ', end);
    }
    return found;
  }

  void check_table(const std::vector<std::pair<std::string, ordered_json>>& columns,
                   const std::string& object) {
    std::vector<std::string> heading;
    for (const auto& [key, values] : columns) heading.push_back(key);
    REQUIRE(cells(line()) == heading);
    for (std::size_t row = 0; row < columns[0].second.size(); ++row) {
      const std::vector<std::string> found = cells(line());
      REQUIRE(found.size() == columns.size());
      for (std::size_t k = 0; k < columns.size(); ++k)
        check_cell(found[k], columns[k].second[row], object, columns[k].first);
    }
  }

  static void check_cell(const std::string& text, const ordered_json& value,
                         const std::string& object, const std::string& name) {
    INFO(object << "." << name << ": '" << text << "'");
    if (value.is_null()) {
      CHECK(text == "n/a");
    } else if (value.is_boolean()) {
      CHECK(text == (value.get<bool>() ? "yes" : "no"));
    } else if (value.is_string()) {
      CHECK(text == value.get<std::string>());
    } else if (value.is_number_integer()) {
      CHECK(text == value.dump());
    } else {
      const double number = salebra::parse_quantity(text, meaning(object, name), name);
      // Four digits, and wall times are of two runs.
      if (name != "seconds")
        CHECK(number == Approx(value.get<double>()).epsilon(5.1e-4).margin(1e-300));
    }
  }

  std::istringstream text_;
};

/// The table alone: assumptions are told in words below it.
std::string without_assumptions(std::string text) {
  for (const char* first : {"\n\nWithout slip up to ", "\n\nValidity: "})
    if (const std::size_t begin = text.find(first); begin != std::string::npos)
      text.resize(begin + 1);
  return text;
}

}  // namespace

TEST_CASE("Every table has the numbers of its JSON twin, in the unit of their quantity",
          "[program][units]") {
  const ProgramTest test;
  const std::string body = " --contact-modulus 10GPa --poisson 0.3 ";
  const std::string rough =
      "generate --points 64 --size-x 4um --hurst 0.8 --rolloff 2um --short-cutoff 0.5um "
      "--rms-height 10nm --seed 18446744073709551615 ";
  test.done(rough + "-o rough.h5");
  test.done("contact rough.h5 --pressure 2:60MPa:10 --stiffness --stick -o curve.h5" + body);
  const std::string law = " --law exponential --normal-force 2 --decay-length 100nm --poisson 0.3 ";
  const std::string drag = " --drag-velocity 1mm/s --frequency 20kHz ";
  const std::string shape = "oscillate --shape paraboloid --points 32 --steps 16 " + body;
  // What --json holds beside the answer in words.
  const Names tables = words(
      "local psd profile_psd_x profile_psd_y correlation correlation_x correlation_y scale_x "
      "scale_y bearing height_counts height_histogram histogram");
  for (const std::string& command : std::vector<std::string>{
           rough, "generate --shape sphere --radius 2um --points 32 --size-x 1um",
           std::string("statistics rough.h5 --tip-radius 10nm --all"),
           "contact rough.h5 --pressure 20MPa --stiffness" + body,
           "contact rough.h5 --pressure 2:60MPa:4 --stiffness --stick" + body,
           "contact rough.h5 --model gw_deterministic --pressure 2:60MPa:5" + body,
           std::string("fit curve.h5"), "damping --normal-amplitude 5nm" + law + drag,
           "damping --normal-amplitude 1:50nm:4" + law + drag,
           "damping --normal-amplitude 5nm --friction-coefficient 0.3" + law + drag,
           "damping --mode two-frequencies --normal-amplitude 1nm --tangential-amplitude 1nm "
           "--phase 40deg --frequency 20kHz --tangential-frequency 1kHz" +
               law,
           "damping --law paraboloid --radius 10mm --indentation 1um" + body,
           "damping --law paraboloid --radius 10mm --indentation 1um --normal-amplitude 300nm "
           "--friction-coefficient 0.3" +
               drag + body,
           "damping --normal-amplitude 20nm --frequency 20kHz --mass 10g --spring-stiffness 1kN/m" +
               law,
           "damping --normal-amplitude 20nm --frequency 1:100kHz:3 --falling-slope 5" + law,
           "damping --frequency 1:100kHz:3 --falling-slope 5" + law, shape,
           shape + "--method intervals --relative-error 5% --decay-length 1um",
           shape + "--friction 0.5 --coupled"}) {
    const auto json = test.run(command + " --json --quiet"), text = test.run(command + " --quiet");
    INFO(command << "\n" << json.err << text.out);
    REQUIRE(json.status == 0);
    REQUIRE(text.status == 0);
    ordered_json answer = ordered_json::parse(json.out);
    for (const std::string& table : tables) answer.erase(table);
    for (const char* key : {"assumptions", "validity", "verdicts"}) answer.erase(key);
    answer.erase("max_motion");
    answer.erase("regime");
    Twin twin(without_assumptions(text.out));
    twin.check(answer);
    // The words of fit and the tables of statistics follow.
    CHECK((twin.at_end() || command.starts_with("fit") || command.starts_with("statistics")));
  }
}

TEST_CASE("A damper's map names amplitude and frequency of each constant", "[damper][units]") {
  const ProgramTest test;
  const std::string command =
      "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
      "--normal-amplitude 1:50nm:3 --frequency 1:100kHz:3 --falling-slope 5";
  const auto answer = ordered_json::parse(test.run(command + " --json").out);
  const auto text = test.done(command);
  ordered_json map = ordered_json::array();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      map.push_back({{"normal_amplitude", answer["normal_amplitude"][i]},
                     {"angular_frequency", answer["angular_frequency"][j]},
                     {"damping_constant", answer["damping_constant"][i][j]}});
  const std::string tables = without_assumptions(text.out);
  const std::size_t border = tables.find("\n\n");
  REQUIRE(border != std::string::npos);
  Twin pairs(tables.substr(0, border + 1)), least(tables.substr(border + 2));
  pairs.check({{"map", map}});
  CHECK(pairs.at_end());
  least.check({{"angular_frequency", answer["angular_frequency"]},
               {"stabilising_amplitude", answer["stabilising_amplitude"]}});
  CHECK(least.at_end());
}
