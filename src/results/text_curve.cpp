// SPDX-License-Identifier: GPL-3.0-or-later
// Reader and writer of force curves as text tables whose column titles contain units.
#include "text_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/results/quantity.hpp>

#include "base/printable.hpp"
#include "io/loaded_surface.hpp"
#include "io/number_table.hpp"
#include "io/text_numbers.hpp"

namespace salebra::detail {
namespace {

/// A column of the table: the quantity, and the factor that converts its values to SI units.
struct Column {
  double ForceSample::*member = nullptr;
  bool converged = false;
  double factor = 1;
};

/// Reads a column title such as "mean_gap [nm]", "mean_gap (nm)" or "mean_gap". A title that is no
/// quantity of a curve is skipped if it has no unit, or if it is another quantity of salebra.
Column column_of(const std::filesystem::path& file, std::string_view text, UnitsOfTitles& units) {
  const ColumnTitle title = column_title(file, text);
  if (title.name == "converged") return {.converged = true};
  for (const CurveQuantity& known : curve_quantities())
    if (known.quantity.name == title.name) {
      units.add(title, known.quantity.dimension);
      return {.member = known.member, .factor = factor_of(file, title, known.quantity.dimension)};
    }
  if (!title.unit.empty() && !is_quantity(title.name))
    refuse(file,
           "has a column '" + std::string(text) +
               "', which is not a quantity of a curve; name it as salebra does, or remove it");
  return {};
}

void read_comment(const std::filesystem::path& file, std::string_view line, ForceCurve& curve) {
  line.remove_prefix(1);
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view key = trimmed(line.substr(0, colon)),
                         value = trimmed(line.substr(colon + 1));
  try {
    if (key == "model") curve.model = value;
    if (key == "adhesive") curve.adhesive = true;
    if (key == "body") curve.body = value;
    if (key == "nominal_area")
      curve.nominal_area = parse_quantity(value, Dimension::length_squared, key);
    if (key == "rms_height") curve.rms_height = parse_quantity(value, Dimension::length, key);
  } catch (const InvalidInput& error) {
    refuse(file, error.what());
  }
}

void complete_and_sort(const std::filesystem::path& file, ForceCurve& curve) {
  for (ForceSample& sample : curve.samples) {
    if (curve.nominal_area > 0 && std::isnan(sample.force))
      sample.force = sample.pressure * curve.nominal_area;
    if (curve.nominal_area > 0 && std::isnan(sample.pressure))
      sample.pressure = sample.force / curve.nominal_area;
  }
  // Refuses a column that has values in some rows only.
  const auto refuse_gap = [&](std::initializer_list<double ForceSample::*> members) {
    for (const auto& [quantity, member] : curve_quantities()) {
      if (std::ranges::find(members, member) == members.end()) continue;
      const auto unknown = [member = member](const ForceSample& sample) {
        return std::isnan(sample.*member);
      };
      const auto row = std::ranges::find_if(curve.samples, unknown);
      if (row != curve.samples.end() && !std::ranges::all_of(curve.samples, unknown))
        refuse(file, fmt::format("holds 'nan' for {} in row {} of its numbers; remove that row",
                                 quantity.name, row - curve.samples.begin() + 1));
    }
  };
  const auto has = [&](double ForceSample::*member) {
    return std::ranges::none_of(
        curve.samples, [&](const ForceSample& sample) { return std::isnan(sample.*member); });
  };
  const auto load = has(&ForceSample::pressure) ? &ForceSample::pressure : &ForceSample::force;
  if (!has(load)) {
    refuse_gap({&ForceSample::pressure, &ForceSample::force});
    refuse(file, "has no column pressure or force; name one in the first line");
  }
  if (!has(&ForceSample::mean_gap) && !has(&ForceSample::indentation) &&
      !has(&ForceSample::separation)) {
    refuse_gap({&ForceSample::mean_gap, &ForceSample::indentation, &ForceSample::separation});
    refuse(file, "has no column mean_gap, indentation or separation; name one in the first line");
  }
  std::ranges::stable_sort(curve.samples, {}, load);
}

}  // namespace

ForceCurve read_text_curve(const std::filesystem::path& file, std::string_view content) {
  ForceCurve curve;
  std::vector<Column> columns;
  NumberReader reader(file);
  std::vector<double> values;
  Lines lines(require_text(file, content));
  for (std::string_view raw; lines.next(raw);) {
    std::string_view line = trimmed(raw);
    if (line.empty()) continue;
    const bool numbers = starts_with_number(line) || (reader.started() && line.front() != '#');
    if (!numbers) {
      if (line.front() == '#' && (line.find(':') != std::string_view::npos || !columns.empty())) {
        read_comment(file, line, curve);
        continue;
      }
      if (!columns.empty())
        refuse(file, "line " + std::to_string(lines.number()) + " holds no numbers");
      if (line.front() == '#') line = trimmed(line.substr(1));
      UnitsOfTitles units(file);
      for (const std::string_view title : titles_of(line))
        columns.push_back(column_of(file, title, units));
      continue;
    }
    if (columns.empty())
      refuse(file,
             "does not name its columns; begin with a line such as 'pressure [Pa], mean_gap [m]'");
    values.clear();
    reader.append(line, lines.number(), values);
    // The row ended with an empty field, for which the reader has added no value.
    if (values.size() + 1 == columns.size() && reader.symbol())
      values.push_back(ForceSample::unknown);
    if (values.size() != columns.size())
      refuse(file, "line " + std::to_string(lines.number()) + " holds " +
                       std::to_string(values.size()) + " values where the first line names " +
                       std::to_string(columns.size()) + " columns");
    ForceSample& sample = curve.samples.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].member) sample.*columns[i].member = values[i] * columns[i].factor;
      if (columns[i].converged) sample.converged = values[i] != 0;
    }
  }
  if (curve.samples.empty())
    refuse(file, "contains no samples of a curve; name a table or HDF5 file");
  complete_and_sort(file, curve);
  return curve;
}

std::string text_of(const ForceCurve& curve, const std::vector<CurveColumn>& beside,
                    const Provenance& provenance) {
  std::string text = fmt::format("# program: salebra {}\n# created: {}\n", version(),
                                 provenance.created.empty() ? utc_now() : provenance.created);
  if (!provenance.command_line.empty())
    text += "# command_line: " + printable_line(provenance.command_line) + "\n";
  if (!curve.model.empty()) text += "# model: " + printable_line(curve.model) + "\n";
  if (curve.nominal_area > 0) text += fmt::format("# nominal_area: {} m^2\n", curve.nominal_area);
  if (!std::isnan(curve.rms_height)) text += fmt::format("# rms_height: {} m\n", curve.rms_height);
  if (curve.adhesive) text += "# adhesive: yes\n";
  if (!curve.body.empty()) text += "# body: " + printable_line(curve.body) + "\n";
  std::vector<CurveColumn> columns;
  for (const auto& [quantity, member] : curve_quantities())
    if (CurveColumn column{quantity, curve.column(member)};
        !std::ranges::all_of(column.values, [](double value) { return std::isnan(value); }))
      columns.push_back(std::move(column));
  columns.insert(columns.end(), beside.begin(), beside.end());
  for (const CurveColumn& column : columns)
    text += fmt::format("{} [{}],", column.quantity.name, si_unit(column.quantity.dimension));
  text += "converged\n";
  for (std::size_t row = 0; row < curve.samples.size(); ++row) {
    for (const CurveColumn& column : columns) {
      const double value = column.values[row];
      text += std::isnan(value) ? "nan," : fmt::format("{},", value);
    }
    text += curve.samples[row].converged ? "1\n" : "0\n";
  }
  return text;
}

}  // namespace salebra::detail
