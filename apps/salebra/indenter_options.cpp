// SPDX-License-Identifier: GPL-3.0-or-later
// Options that describe an axisymmetric indenter.
#include "indenter_options.hpp"

#include <algorithm>
#include <salebra/base/error.hpp>
#include <utility>

#include "io/number_table.hpp"
#include "shape.hpp"

namespace salebra::cli {

void IndenterOptions::add_to(Command& app, const std::vector<std::string>& others) {
  std::vector<std::string> words = others;
  using enum Shape;
  for (const Shape shape : {cone, paraboloid, power, sphere, cylinder, rounded_cylinder})
    words.push_back(option_word(shape));
  words.emplace_back("table");
  const std::string group = "Law";
  add_choice(app, "--law", law, words,
             others.empty()
                 ? "shape of the indenter"
                 : "force law F(indentation): a formula, or the law of an indenter of this shape")
      ->group(group);
  add_quantity(app, "--angle", angle, Dimension::angle,
               "cone: angle between its flank and the plane")
      ->group(group);
  add_quantity(app, "--radius", radius, Dimension::length,
               "paraboloid, sphere: radius of curvature; cylinder, rounded-cylinder: radius of the "
               "flat face")
      ->group(group);
  add_quantity(app, "--exponent", exponent, Dimension::dimensionless,
               "power: exponent N of f = B r^N")
      ->group(group);
  add_quantity(app, "--coefficient", coefficient, Dimension::dimensionless,
               "power: coefficient B of f = B r^N, m^(1-N)")
      ->group(group);
  add_quantity(app, "--edge-radius", edge_radius, Dimension::length,
               "rounded-cylinder: radius of curvature outside the flat face")
      ->group(group);
  app.add_option("--table", table,
                 "table: file with two columns in m, radius and height, from the axis outwards")
      ->file(FileUse::input)
      ->group(group);
}

std::vector<std::pair<std::string, const std::optional<double>*>> IndenterOptions::known() const {
  return {{"--angle", &angle},
          {"--radius", &radius},
          {"--exponent", &exponent},
          {"--coefficient", &coefficient},
          {"--edge-radius", &edge_radius}};
}

std::string IndenterOptions::in_words() const {
  return law + (radius ? ", R = " + format_quantity(*radius, Dimension::length, 4) : "");
}

void IndenterOptions::require_only(const std::vector<std::string>& wanted,
                                   const std::string& chosen) const {
  for (const auto& [option, value] : known())
    require_that(!*value || std::ranges::find(wanted, option) != wanted.end(), option,
                 "given, but " + chosen + " has none; leave it out");
  require_that(table.empty() || std::ranges::find(wanted, "--table") != wanted.end(), "--table",
               "given, but " + chosen + " has none; leave it out");
}

std::shared_ptr<const IndenterProfile> IndenterOptions::indenter() const {
  const std::string chosen = "--law " + law;
  const auto values = [&](const std::vector<std::string>& wanted) {
    require_only(wanted, chosen);
    std::vector<double> found;
    for (const std::string& name : wanted)
      for (const auto& [option, value] : known())
        if (option == name) found.push_back(required(*value, option, chosen + " needs it"));
    return found;
  };
  if (law == "table") {
    require_only({"--table"}, chosen);
    require_that(!table.empty(), "--table", "not given, but --law table needs it");
    const auto columns =
        read_number_table(table, {{"r", Dimension::length, {"radius", "x"}},
                                  {"f", Dimension::length, {"profile", "height", "z", "shape"}}})
            .columns;
    return std::make_shared<const TabulatedProfile>(columns[0], columns[1]);
  }
  switch (*parse_enum<Shape>(law)) {
    case Shape::cone:
      return cone_profile(values({"--angle"})[0]);
    case Shape::paraboloid:
      return paraboloid_profile(values({"--radius"})[0]);
    case Shape::sphere:
      return sphere_profile(values({"--radius"})[0]);
    case Shape::cylinder:
      return flat_punch_profile(values({"--radius"})[0]);
    case Shape::rounded_cylinder: {
      const auto both = values({"--radius", "--edge-radius"});
      return rounded_punch_profile(both[0], both[1]);
    }
    default: {
      const auto both = values({"--coefficient", "--exponent"});
      return power_profile(both[0], both[1]);
    }
  }
}

}  // namespace salebra::cli
