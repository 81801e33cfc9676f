// SPDX-License-Identifier: GPL-3.0-or-later
// Options that describe an axisymmetric indenter.
#include "indenter_options.hpp"

#include <salebra/base/error.hpp>
#include <salebra/io/number_table.hpp>
#include <utility>
#include <vector>

namespace salebra::cli {

void IndenterOptions::add_to(Command& app) {
  const std::string group = "Indenter";
  add_choice(app, "--profile", profile,
             {"cone", "parabola", "power", "sphere", "flat", "rounded", "table"}, "shape")
      ->required()
      ->group(group);
  add_quantity(app, "--angle", angle, Dimension::angle, "cone: of its flank to the plane")
      ->group(group);
  add_quantity(app, "--radius", radius, Dimension::length, "parabola, sphere")->group(group);
  add_quantity(app, "--exponent", exponent, Dimension::dimensionless, "power: N of f = B r^N")
      ->group(group);
  add_quantity(app, "--coefficient", coefficient, Dimension::dimensionless,
               "power: B of f = B r^N, m^(1-N)")
      ->group(group);
  add_quantity(app, "--flat-radius", flat_radius, Dimension::length, "flat, rounded: of the end")
      ->group(group);
  add_quantity(app, "--edge-radius", edge_radius, Dimension::length, "rounded: of the edge")
      ->group(group);
  app.add_option("--table", table,
                 "table: file with two columns in m, radius and height, from the axis outwards")
      ->file(FileUse::input)
      ->group(group);
}

std::shared_ptr<const IndenterProfile> IndenterOptions::indenter() const {
  const std::vector<std::pair<std::string, const std::optional<double>*>> known{
      {"--angle", &angle},
      {"--radius", &radius},
      {"--exponent", &exponent},
      {"--coefficient", &coefficient},
      {"--flat-radius", &flat_radius},
      {"--edge-radius", &edge_radius}};
  auto only = [&](const std::vector<std::string>& wanted) {
    std::vector<double> values;
    for (const std::string& name : wanted)
      for (const auto& [option, value] : known)
        if (option == name)
          values.push_back(required(*value, option, "--profile " + profile + " needs it"));
    for (const auto& [option, value] : known)
      require_that(!*value || std::ranges::find(wanted, option) != wanted.end(), option,
                   "given, but --profile " + profile + " has none; leave it out");
    require_that(table.empty() || profile == "table", "--table",
                 "given, but --profile is " + profile + "; leave it out");
    return values;
  };
  if (profile == "cone") return cone_profile(only({"--angle"})[0]);
  if (profile == "parabola") return paraboloid_profile(only({"--radius"})[0]);
  if (profile == "sphere") return sphere_profile(only({"--radius"})[0]);
  if (profile == "flat") return flat_punch_profile(only({"--flat-radius"})[0]);
  if (profile == "power") {
    const auto values = only({"--exponent", "--coefficient"});
    return power_profile(values[1], values[0]);
  }
  if (profile == "rounded") {
    const auto values = only({"--flat-radius", "--edge-radius"});
    return rounded_punch_profile(values[0], values[1]);
  }
  only({});
  if (table.empty()) throw InvalidInput("--table", "not given, but --profile table needs it");
  const auto columns = read_number_table(table, 2);
  return std::make_shared<const TabulatedProfile>(columns[0], columns[1]);
}

std::string IndenterOptions::advice_for_ranges() const {
  if (profile == "cone" || profile == "parabola" || profile == "power")
    return "use salebra damping --law " + profile + ", which takes ranges";
  return "run it once for each value";
}

}  // namespace salebra::cli
