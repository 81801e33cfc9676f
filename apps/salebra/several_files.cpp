// SPDX-License-Identifier: GPL-3.0-or-later
// One command on several surfaces: expansion of folders and patterns, table, failures.
#include "several_files.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <new>
#include <salebra/base/error.hpp>

#include "base/printable.hpp"
#include "base/undefined_points.hpp"
#include "io/sidecar.hpp"
#include "io/text_file.hpp"
#include "option_words.hpp"
#include "result_tables.hpp"
#include "study/estimate.hpp"
#include "terminal.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

namespace fs = std::filesystem;

bool is_pattern(const std::string& name) {
  std::error_code error;
  return name.find_first_of("*?[{") != name.npos && !fs::exists(name, error);
}

bool is_folder(const std::string& name) {
  std::error_code error;
  return fs::is_directory(name, error);
}

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    fs::path array = path;  // "heights.npy" of the sidecar "heights.npy.json"
    array.replace_extension();
    const bool sidecar = fs::exists(array, error) && detail::sidecar_of(array) == path;
    if (entry.is_regular_file(error) && !path.filename().string().starts_with('.') && !sidecar)
      files.push_back(path.string());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> files_like(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), GLOB_BRACE, nullptr, &found) == 0)
    for (std::size_t k = 0; k < found.gl_pathc; ++k)
      if (!is_folder(found.gl_pathv[k])) files.emplace_back(found.gl_pathv[k]);
  globfree(&found);
  return files;
}

}  // namespace

bool are_several(const std::vector<std::string>& names) {
  return names.size() > 1 || std::ranges::any_of(names, [](const std::string& name) {
           return is_folder(name) || is_pattern(name);
         });
}

std::vector<std::string> files_of(const std::vector<std::string>& names, const std::string& field) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    std::vector<std::string> more{name};
    if (is_folder(name)) {
      more = files_in(name);
      require(!more.empty(), field, name, "is a folder without files that can be read");
    } else if (is_pattern(name)) {
      more = files_like(name);
      require(!more.empty(), field, name, "matches no file; check the folder and the pattern");
    }
    for (std::string& file : more)
      if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
  }
  return files;
}

void add_table_file(Command& command, std::string& file) {
  command
      .add_option("--csv", file,
                  "table to write, in SI units, with a row for each file (and load); only files "
                  "that failed have a text in its last column")
      ->file(FileUse::output);
}

void require_options_of_one(const Session& session,
                            const std::vector<std::pair<bool, const char*>>& others) {
  session.require_one_process("a table of several files");
  for (const auto& [given, option] :
       {std::pair(session.has_output(), "--output"), {session.has_plot(), "--plot"}})
    require_that(!given, option,
                 "takes one surface, not a table of several; --csv alone writes that table");
  for (const auto& [given, option] : others) require_that(!given, option, takes_one_surface);
}

Json member(const Json& answer, const std::string& path, std::size_t load) {
  if (const std::size_t dot = path.find('.'); dot != path.npos) {
    const std::string head = path.substr(0, dot);
    return answer.contains(head) && answer[head].is_object()
               ? member(answer[head], path.substr(dot + 1), load)
               : Json();
  }
  if (!answer.contains(path)) return {};
  const Json& found = answer[path];
  if (!found.is_array()) return found;
  return load < found.size() ? found[load] : Json();
}

FileColumn column(const std::string& heading, const std::string& path, const std::string& name,
                  bool averaged) {
  const std::size_t dot = path.rfind('.');
  const std::string object = dot == path.npos ? "" : path.substr(0, dot);
  return {
      .heading = heading,
      .name = name,
      .value = [path](const Json& answer, std::size_t load) { return member(answer, path, load); },
      .dimension =
          quantity_of(path.substr(dot + 1), object.substr(object.rfind('.') + 1)).dimension,
      .averaged = averaged};
}

std::string one_direction(const std::string& direction) {
  require(direction != "both", "--direction", direction,
          "gives two directions; a table of several surfaces takes one");
  return direction.empty() || direction == "auto" ? "0deg" : direction;
}

void add_damping_columns(FileTable& table, const std::string& path,
                         const std::function<double(const Json& answer, std::size_t load)>& area) {
  // A study has an object with mean and error, a single loss has numbers.
  const auto number = [path](const Json& answer, const char* name, std::size_t load) {
    const Json whole = member(answer, path + name, load);
    const Json found = whole.is_object() ? member(whole, "mean", load) : whole;
    return found.is_number() ? found.number() : std::nan("");
  };
  const auto add = [&](const std::string& heading, const std::string& name, const char* of,
                       const std::string& unit, double scale,
                       const std::function<double(const Json&, std::size_t, double)>& value) {
    table.columns.push_back({.heading = heading,
                             .name = name,
                             .value = [=](const Json& answer, std::size_t load) -> Json {
                               const double found = value(answer, load, number(answer, of, load));
                               return std::isnan(found) ? Json() : Json(found);
                             },
                             .averaged = unit != "1",
                             .scale = scale,
                             .unit = unit});
  };
  const auto per_area = [area](const Json& answer, std::size_t load, double constant) {
    return constant / area(answer, load);
  };
  table.note =
      "n/a: the error is larger than the number, because too few cells touch and separate; a finer "
      "map, a larger load or, in a study, --relative-error may help.";
  const std::string si = "N s/m^3";
  add("γ/A0, N s/m per mm²", "damping_constant_per_area", "damping_constant", si, 1e-6, per_area);
  add("error, %", "damping_constant_relative_error", "damping_constant_error", "1", 100,
      [number](const Json& answer, std::size_t load, double error) {
        return error / std::abs(number(answer, "damping_constant", load));
      });
  add("by slip, %", "slip_share", "slip_share", "1", 100,
      [](const Json&, std::size_t, double share) { return share; });
  add("no slip", "damping_constant_without_slip_per_area", "damping_constant_without_slip", si,
      1e-6, per_area);
  table.columns.push_back(column("direction", path + "direction", "direction", false));
}

namespace {

double number_in(const Json& value) { return value.is_number() ? value.number() : std::nan(""); }

std::string cell(const FileColumn& column, const Json& value) {
  if (value.is_string()) return value.text();
  if (value.is_boolean()) return value.truth() ? "yes" : "no";
  const double number = number_in(value);
  if (!std::isfinite(number)) return "n/a";
  if (value.is_number_integer()) return value.dump();
  return format_quantity(column.scale * number, column.dimension, 3);
}

/// Mean, standard deviation between the files and 95 % interval of the mean; NaN if a file has no
/// value.
struct Spread {
  double mean = std::nan(""), deviation = std::nan("");
  EnsembleMean interval = {};
};

Spread spread_of(const FileColumn& column, const std::vector<const FileAnswer*>& files,
                 std::size_t load) {
  std::vector<double> values;
  for (const FileAnswer* file : files)
    values.push_back(number_in(column.value(file->answer, load)));
  const auto count = static_cast<double>(values.size());
  Spread spread{.mean = 0, .deviation = 0};
  for (const double value : values) spread.mean += value / count;
  for (const double value : values) spread.deviation += std::pow(value - spread.mean, 2);
  spread.deviation = std::sqrt(spread.deviation / (count - 1));
  if (std::isfinite(spread.mean)) spread.interval = student_mean(values);
  return spread;
}

class FilesAnswer {
 public:
  FilesAnswer(const FileTable& table, const std::vector<FileAnswer>& answers)
      : table_(table), answers_(answers) {
    for (const FileAnswer& one : answers)
      if (one.failure.empty()) good_.push_back(&one);
    for (const FileColumn& column : table.columns)
      if (!column.heading.empty() && known(column)) shown_.push_back(&column);
  }

  std::size_t failed() const { return answers_.size() - good_.size(); }

  std::string text() const {
    std::string text = good_.empty() ? "" : to_table(rows(), 2, true);
    if (!table_.note.empty() && lacks_numbers()) text += wrapped(table_.note, 78) + "\n";
    if (failed() == 0) return text;
    text += fmt::format("{}{} of {} files failed\n", text.empty() ? "" : "\n", failed(),
                        answers_.size());
    for (const FileAnswer& one : answers_)
      if (!one.failure.empty())
        text += fmt::format("  {}: {}\n", shown_name(one.file), without_name(one));
    return text;
  }

  Json json() const {
    Json list = Json::array();
    for (const FileAnswer& one : answers_) {
      Json object{{"file", one.file}};
      if (one.failure.empty())
        object.add(one.answer);
      else
        object["error"] = one.failure;
      list.push_back(std::move(object));
    }
    return list;
  }

  std::string csv(const Session& session) const {
    std::string text = "# " + printable_line(session.provenance().command_line) + "\n";
    std::string head = "file";
    for (const FileColumn& column : table_.columns) {
      if (column.name.empty()) continue;
      text += fmt::format("# {} in {}\n", column.name,
                          column.unit.empty() ? si_unit(column.dimension) : column.unit);
      head += "," + column.name;
    }
    text += head + ",error\n";
    for (const FileAnswer& one : answers_)
      for (std::size_t load = 0; load < (one.failure.empty() ? table_.loads : 1); ++load) {
        text += quoted(one.file);
        for (const FileColumn& column : table_.columns)
          if (!column.name.empty()) text += "," + csv_cell(column, one, load);
        text += "," + (one.failure.empty() ? "" : quoted(one.failure)) + "\n";
      }
    return text;
  }

 private:
  bool known(const FileColumn& column) const {
    return std::ranges::any_of(good_, [&](const FileAnswer* file) {
      for (std::size_t load = 0; load < table_.loads; ++load)
        if (!column.value(file->answer, load).is_null()) return true;
      return false;
    });
  }

  /// Whether the first column that is averaged has no number for a file.
  bool lacks_numbers() const {
    const auto column = std::ranges::find_if(
        table_.columns, [](const FileColumn& one) { return one.averaged && !one.heading.empty(); });
    return std::ranges::any_of(good_, [&](const FileAnswer* file) {
      for (std::size_t load = 0; load < table_.loads; ++load)
        if (column->value(file->answer, load).is_null()) return true;
      return false;
    });
  }

  static std::string quoted(const std::string& text) {
    std::string quoted = "\"";
    for (const char symbol : printable_line(text))
      quoted += symbol == '"' ? "\"\"" : std::string(1, symbol);
    return quoted + "\"";
  }

  static std::string csv_cell(const FileColumn& column, const FileAnswer& file, std::size_t load) {
    const Json value = file.failure.empty() ? column.value(file.answer, load) : Json();
    if (value.is_null() || (value.is_number() && std::isnan(value.number()))) return "";
    if (value.is_number() && std::isinf(value.number())) return value.number() > 0 ? "inf" : "-inf";
    return value.is_string() ? quoted(value.text()) : value.dump();
  }

  /// Files of one folder are shown without it.
  std::string shown_name(const std::string& file) const {
    const fs::path folder = fs::path(answers_.front().file).parent_path();
    const bool alike = std::ranges::all_of(answers_, [&](const FileAnswer& one) {
      return fs::path(one.file).parent_path() == folder;
    });
    return printable_line(alike ? fs::path(file).filename().string() : file);
  }

  /// The reason of a failure without the name of the file, which stands in front of it.
  static std::string without_name(const FileAnswer& one) {
    const std::string name = one.file + ": ";
    return printable_line(one.failure.starts_with(name) ? one.failure.substr(name.size())
                                                        : one.failure);
  }

  /// The first column: the file and, if there are loads, the load, which the parts of a wide table
  /// repeat.
  std::vector<std::string> labels() const {
    std::vector<std::string> names{"file"}, loads{table_.load_heading};
    const auto load_of = [&](const FileAnswer* file, std::size_t load) {
      return has_loads() ? cell(*shown_.front(), shown_.front()->value(file->answer, load)) : "";
    };
    for (const FileAnswer* file : good_)
      for (std::size_t load = 0; load < table_.loads; ++load) {
        names.push_back(shown_name(file->file));
        loads.push_back(load_of(file, load));
      }
    for (std::size_t load = 0; load < table_.loads; ++load)
      for (const std::string& name : summary_names()) {
        names.push_back(name);
        loads.push_back(load_of(good_.front(), load));
      }
    if (!has_loads()) return names;
    std::size_t widest = 0, longest = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
      widest = std::max(widest, columns_of(names[k]));
      longest = std::max(longest, columns_of(loads[k]));
    }
    for (std::size_t k = 0; k < names.size(); ++k)
      names[k] +=
          std::string(widest - columns_of(names[k]) + 2 + longest - columns_of(loads[k]), ' ') +
          loads[k];
    return names;
  }

  bool has_loads() const {
    return !shown_.empty() && shown_.front()->heading == table_.load_heading;
  }

  /// The rows below those of the files.
  std::vector<std::string> summary_names() const {
    std::vector<std::string> names{fmt::format("mean of {}", good_.size()), "spread"};
    if (table_.interval) names.insert(names.end(), {"mean, 95 % from", "to"});
    return names;
  }
  std::vector<std::string> summary(const FileColumn& column, std::size_t load) const {
    const Spread found = spread_of(column, good_, load);
    std::vector<std::string> cells;
    for (const double value :
         {found.mean, found.deviation, found.interval.low, found.interval.high})
      cells.push_back(column.averaged ? cell(column, value) : "");
    return cells;
  }

  std::vector<std::vector<std::string>> rows() const {
    std::vector<std::vector<std::string>> rows(1);
    const std::vector<const FileColumn*> columns(shown_.begin() + (has_loads() ? 1 : 0),
                                                 shown_.end());
    for (const FileColumn* column : columns) rows[0].push_back(column->heading);
    for (const FileAnswer* file : good_)
      for (std::size_t load = 0; load < table_.loads; ++load) {
        auto& row = rows.emplace_back();
        for (const FileColumn* column : columns)
          row.push_back(cell(*column, column->value(file->answer, load)));
      }
    for (std::size_t load = 0; load < table_.loads && good_.size() > 1; ++load) {
      const std::size_t first = rows.size();
      rows.resize(first + summary_names().size());
      for (const FileColumn* column : columns) {
        const std::vector<std::string> cells = summary(*column, load);
        for (std::size_t k = first; k < rows.size(); ++k) rows[k].push_back(cells[k - first]);
      }
    }
    const std::vector<std::string> first = labels();
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].insert(rows[k].begin(), first[k]);
    return rows;
  }

  const FileTable& table_;
  const std::vector<FileAnswer>& answers_;
  std::vector<const FileAnswer*> good_;
  std::vector<const FileColumn*> shown_;
};

}  // namespace

void answer_files(const std::vector<std::string>& files, const FileTable& table, Session& session,
                  const std::function<void(const std::string& file)>& run) {
  if (!table.csv.empty()) require_output(table.csv, session.write_options());
  std::vector<FileAnswer> answers;
  std::exception_ptr first, interruption;
  for (const std::string& file : files) {
    // A table that is replaced in the folder of the surfaces is none of them.
    if (same_file(file, table.csv)) continue;
    FileAnswer one{.file = file, .answer = {}, .failure = {}};
    try {
      one.answer = session.answer_of(file, [&] { run(file); });
    } catch (const Interrupted&) {
      interruption = std::current_exception();
      break;
    } catch (const UndefinedPoints& error) {
      one.failure = std::string(error.what()) + " (--fill)";
      if (!first) first = std::current_exception();
    } catch (const InvalidInput& error) {
      one.failure = in_options(with_option(error));
      if (!first) first = std::current_exception();
    } catch (const Error& error) {
      one.failure = in_options(error.what());
      if (!first) first = std::current_exception();
    } catch (const std::bad_alloc&) {
      one.failure = file + ": memory is not sufficient";
      if (!first) first = std::current_exception();
    }
    answers.push_back(std::move(one));
  }
  if (answers.empty() && interruption) std::rethrow_exception(interruption);
  require(!answers.empty(), "--csv", table.csv, "is the only file; name the surfaces");
  // A mistake in the options fails every file; it is reported once.
  if (!interruption && !answers.front().failure.empty() &&
      std::ranges::all_of(
          answers, [&](const FileAnswer& one) { return one.failure == answers.front().failure; }))
    std::rethrow_exception(first);
  const FilesAnswer found(table, answers);
  if (!table.csv.empty() && found.failed() < answers.size())
    write_text_file(table.csv, found.csv(session), session.write_options());
  session.answer(found.json(), found.text());
  if (interruption) std::rethrow_exception(interruption);
  if (found.failed() == answers.size())
    throw InvalidInput(fmt::format("{} files", answers.size()), "none could be used");
  if (found.failed() > 0)
    throw Error(fmt::format("{} of {} files failed; the others are complete", found.failed(),
                            answers.size()));
}

}  // namespace salebra::cli
