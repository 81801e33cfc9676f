// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a command's result in HDF5, JSON, CSV and text.
#include "result_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/analysis/damping.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity.hpp>

#include "answers.hpp"
#include "base/printable.hpp"
#include "io/text_file.hpp"
#include "options.hpp"
#include "study/cost.hpp"
#include "text.hpp"

namespace salebra::cli {

Quantity quantity_of(const std::string& name, const std::string& object) {
  for (const std::string& one : {object, name}) {
    if (is_quantity(one)) return find_quantity(one);
    if (const Column* own = find_column<ContactPressures, SurfacePoints, BearingTable, Lay,
                                        FitChoices, MotionOptions, DampingProblem, PathProblem,
                                        DampingSolution, DamperSolution, Cost>(one))
      return {own->name, own->dimension, own->long_name};
  }
  // The limits of a number have its unit.
  for (const auto& [end, meaning] :
       {std::pair<std::string_view, const char*>{"_low", "lower 95 % limit"},
        {"_high", "upper 95 % limit"}})
    if (name.ends_with(end) && is_quantity(name.substr(0, name.size() - end.size()))) {
      const Quantity of = find_quantity(name.substr(0, name.size() - end.size()));
      return {of.name, of.dimension, meaning};
    }
  return find_quantity(name);
}

namespace {

/// Converts JSON to a number: 1 or 0 for a boolean, NaN for null.
double number_of(const Json& value) {
  if (value.is_boolean()) return value.truth() ? 1 : 0;
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.number();
}

/// Writes a JSON object as an HDF5 group: a scalar for each number, a dataset with the coordinate
/// `sample` for each array, a group for each object, and an attribute for each text.
void write_answer(ResultFile& file, const std::string& path, const Json& object) {
  ResultGroup group = file.group(path);
  bool has_samples = false;
  for (const auto& [name, value] : object.items()) {
    const Quantity quantity = quantity_of(name, path.substr(path.rfind('/') + 1));
    const std::string unit(si_unit(quantity.dimension)), long_name(quantity.long_name);
    if (value.is_object()) {
      write_answer(file, path + "/" + name, value);
    } else if (value.is_string()) {
      group.attribute(name, value.text());
    } else if (value.is_array()) {
      std::vector<double> values;
      for (const Json& item : value.elements()) values.push_back(number_of(item));
      if (!has_samples) group.index("sample", values.size(), "number of the case");
      has_samples = true;
      group.dataset(name, values, {"sample"}, unit, long_name);
    } else {
      group.scalar(name, number_of(value), unit, long_name);
    }
  }
}

enum class Kind { hdf5, json, csv };

Kind kind_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".h5" || extension == ".hdf5") return Kind::hdf5;
  if (extension == ".json") return Kind::json;
  require(extension == ".csv", "--output", file.string(),
          "does not end in the extension of a table; use .h5, .json or .csv");
  return Kind::csv;
}

/// Name of the file for a table next to the file of --output: "scan.csv" and "psd" give
/// "scan.psd.csv".
std::filesystem::path beside(std::filesystem::path file, const std::string& table) {
  return file.replace_extension(table + ".csv");
}

void append_lines(std::string& text, const Json& object, const std::string& path) {
  for (const auto& [name, value] : object.items()) {
    const std::string full = path.empty() ? name : path + "." + name;
    const Quantity quantity = quantity_of(name, path.substr(path.rfind('.') + 1));
    if (value.is_object())
      append_lines(text, value, full);
    else if (!value.is_array())
      text += fmt::format("{},{},{},\"{}\"\n", full, value.is_null() ? "nan" : value.dump(),
                          value.is_number_float() ? si_unit(quantity.dimension) : "",
                          quantity.long_name);
  }
}

std::string comment(const Session& session, const ResultTable& table) {
  std::string text = fmt::format("# {}, salebra {}\n# {}\n", table.name, version(),
                                 printable_line(session.provenance().command_line));
  if (!table.note.empty()) text += "# " + printable_line(table.note) + "\n";
  for (const ResultColumn& column : table.columns)
    text += fmt::format("# {} in {}: {}\n", column.name, column.units(), column.long_name());
  return text;
}

std::string to_csv(const Session& session, const ResultTable& table) {
  std::string text = comment(session, table);
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    text += (k > 0 ? "," : "") + table.columns[k].name;
  text += '\n';
  for (std::size_t row = 0; row < table.columns.front().values.size(); ++row) {
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      text += fmt::format("{}{}", k > 0 ? "," : "", table.columns[k].values[row]);
    text += '\n';
  }
  return text;
}

}  // namespace

ResultTable table_of(const std::string& name, const Json& columns) {
  ResultTable table{.name = name, .columns = {}};
  for (const auto& [key, list] : columns.items()) {
    std::vector<double> values;
    for (const Json& item : list.elements()) values.push_back(number_of(item));
    if (!std::ranges::all_of(values, [](double value) { return std::isnan(value); }))
      table.columns.push_back({key, std::move(values)});
  }
  return table;
}

void require_tables(Session& session, const std::vector<std::string>& tables) {
  if (!session.has_output()) return;
  if (kind_of(session.output()) != Kind::csv) return;
  for (const std::string& table : tables) {
    session.writes("--output", beside(session.output(), table));
    require_output(beside(session.output(), table), session.write_options());
  }
}

namespace {

void write_files(const Session& session, const std::string& group, const Json& answer,
                 const std::vector<ResultTable>& tables) {
  const std::filesystem::path file = session.output();
  switch (kind_of(file)) {
    case Kind::hdf5: {
      ResultFile results(file, session.provenance(), session.write_options());
      write_answer(results, group, answer);
      for (const ResultTable& table : tables) {
        ResultGroup location = results.group(table.name);
        const ResultColumn& first = table.columns.front();
        location.coordinate(first.name, first.values, first.units(), first.long_name());
        for (std::size_t k = 1; k < table.columns.size(); ++k) {
          const ResultColumn& column = table.columns[k];
          location.dataset(column.name, column.values, {first.name}, column.units(),
                           column.long_name());
        }
        if (!table.note.empty()) location.attribute("note", table.note);
      }
      results.commit();
      break;
    }
    case Kind::json:
      write_text_file(file, with_tables(answer, tables).dump(2) + "\n", session.write_options());
      break;
    case Kind::csv: {
      std::string text = "name,value,unit,meaning\n";
      append_lines(text, answer, "");
      write_text_file(file, text, session.write_options());
      for (const ResultTable& table : tables)
        write_text_file(beside(file, table.name), to_csv(session, table), session.write_options());
      break;
    }
  }
}

}  // namespace

void write_tables(const Session& session, const std::string& group, const Json& answer,
                  const std::vector<ResultTable>& tables) {
  collectively(session.communicator(), [&] {
    if (session.has_output() && session.communicator().is_root())
      write_files(session, group, answer, tables);
  });
}

Json with_tables(Json answer, const std::vector<ResultTable>& tables) {
  for (const ResultTable& table : tables) {
    Json object, units;
    for (const ResultColumn& column : table.columns) {
      object[column.name] = column.values;
      units[column.name] = column.units();
    }
    object["units"] = units;
    if (!table.note.empty()) object["note"] = table.note;
    answer[table.name] = object;
  }
  return answer;
}

std::string to_text(const ResultTable& table) {
  std::vector<std::vector<std::string>> rows(table.columns.front().values.size() + 1);
  for (const ResultColumn& column : table.columns) {
    rows.front().push_back(
        column.units() == "1" ? column.name : fmt::format("{} [{}]", column.name, column.units()));
    for (std::size_t k = 0; k < column.values.size(); ++k)
      rows[k + 1].push_back(fmt::format("{:.5g}", column.values[k]));
  }
  return "\n" + table.name + (table.note.empty() ? "" : ": " + table.note) + "\n" + to_table(rows);
}

}  // namespace salebra::cli
