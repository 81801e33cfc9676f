// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of tables of numbers whose possible columns are known, and of the titles of columns.
#include "number_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <salebra/base/error.hpp>

#include "input_file.hpp"
#include "loaded_surface.hpp"
#include "text_numbers.hpp"

namespace salebra {
namespace detail {

ColumnTitle column_title(const std::filesystem::path& file, std::string_view title) {
  if (title.size() > 1 && title.front() == '"' && title.back() == '"')
    title = trimmed(title.substr(1, title.size() - 2));
  const auto bracket = title.find_first_of("[(");
  if (bracket != std::string_view::npos) {
    const auto close = title.find_last_of("])");
    if (close == std::string_view::npos || close < bracket)
      refuse(file, "has a column title '" + std::string(title) + "' without a closing bracket");
    if (const auto rest = trimmed(title.substr(close + 1)); !rest.empty())
      refuse(file, "has a column title '" + std::string(title) + "' with '" + std::string(rest) +
                       "' behind its unit; remove that");
    return {trimmed(title.substr(0, bracket)),
            trimmed(title.substr(bracket + 1, close - bracket - 1))};
  }
  const auto slash = title.find('/');
  if (slash == std::string_view::npos) return {title, {}};
  return {trimmed(title.substr(0, slash)), trimmed(title.substr(slash + 1))};
}

std::vector<std::string_view> titles_of(std::string_view line) {
  const bool marked = line.find_first_of(",;") != std::string_view::npos;
  const auto tabbed = line.find('\t') != std::string_view::npos;
  std::vector<std::string_view> titles;
  std::size_t begin = 0, next = 0;
  int depth = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const char symbol = i < line.size() ? line[i] : '\n';
    if (symbol == '[' || symbol == '(') ++depth;
    if (symbol == ']' || symbol == ')') --depth;
    // `next` becomes the index of the next character that is no blank.
    for (next = std::max(next, i); next < line.size() && line[next] == ' ';) ++next;
    const bool before_unit = next < line.size() && (line[next] == '[' || line[next] == '(');
    const bool ends = symbol == '\n' || (depth == 0 && (marked   ? symbol == ',' || symbol == ';'
                                                        : tabbed ? symbol == '\t'
                                                                 : symbol == ' ' && !before_unit));
    if (!ends) continue;
    const std::string_view title = trimmed(line.substr(begin, i - begin));
    if (!title.empty() || marked) titles.push_back(title);
    begin = i + 1;
  }
  return titles;
}

double factor_of(const std::filesystem::path& file, const ColumnTitle& title, Dimension dimension) {
  if (title.unit.empty() || (title.unit == "-" && dimension == Dimension::dimensionless)) return 1;
  const std::string number = "1 " + std::string(title.unit);
  try {
    return parse_quantity(number, dimension, title.name);
  } catch (const InvalidInput&) {
  }
  try {
    // A wavenumber q = 2π/λ may have the unit 1/m, too, instead of rad/m.
    if (dimension == Dimension::wavenumber)
      return parse_quantity(number, Dimension::inverse_length, title.name);
  } catch (const InvalidInput&) {
  }
  refuse(file, "gives the column " + std::string(title.name) + " in '" + std::string(title.unit) +
                   "', which is not a unit of this quantity; write " +
                   std::string(si_unit(dimension)));
}

void UnitsOfTitles::add(const ColumnTitle& title, Dimension dimension) {
  if (dimension == Dimension::dimensionless) return;
  (title.unit.empty() ? without_ : with_) = title.name;
  if (!with_.empty() && !without_.empty())
    refuse(file_, "names a unit of its column " + with_ + " but none for " + without_ +
                      "; name both, or none if all are in SI units");
}

}  // namespace detail

namespace {

using detail::refuse;

/// For each column of the file, the requested column to which its title belongs.
struct Titles {
  std::vector<std::size_t>
      positions;  ///< index of the requested column, for each column of the file
  std::vector<double> factors;
  bool has_units = false;
};

std::optional<std::size_t> place_of(std::string_view name,
                                    const std::vector<TableColumn>& columns) {
  std::string word(name);
  for (char& symbol : word)
    if (symbol >= 'A' && symbol <= 'Z') symbol = static_cast<char>(symbol - 'A' + 'a');
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == word ||
        std::ranges::find(columns[i].also, word) != columns[i].also.end())
      return i;
  return {};
}

Titles read_titles(const std::filesystem::path& file, std::string_view line,
                   const std::vector<TableColumn>& columns) {
  Titles titles;
  detail::UnitsOfTitles units(file);
  for (const std::string_view text : detail::titles_of(line)) {
    const detail::ColumnTitle title = detail::column_title(file, text);
    const auto position = place_of(title.name, columns);
    std::vector<std::string_view> names;
    for (const TableColumn& column : columns) names.push_back(column.name);
    if (!position)
      refuse(file, fmt::format("has a column '{}', which is not one of {}; correct its title", text,
                               fmt::join(names, ", ")));
    if (std::ranges::find(titles.positions, *position) != titles.positions.end())
      refuse(file, fmt::format("has two columns {}", columns[*position].name));
    titles.positions.push_back(*position);
    titles.factors.push_back(detail::factor_of(file, title, columns[*position].dimension));
    units.add(title, columns[*position].dimension);
  }
  titles.has_units = units.has_units();
  return titles;
}

/// Whether a comment is the line of titles: its first word is the title of a requested column.
bool names_columns(std::string_view comment, const std::vector<TableColumn>& columns) {
  const auto titles = detail::titles_of(comment);
  return titles.size() > 1 && comment.find(':') == std::string_view::npos &&
         place_of(titles.front().substr(0, titles.front().find_first_of(" [(/")), columns);
}

/// Refuses a comment that seems to state units, since they would be ignored.
void require_no_units(const std::filesystem::path& file, std::string_view comment) {
  if (comment.find_first_of("[(") != std::string_view::npos ||
      comment.find("nit") != std::string_view::npos ||
      comment.find("inheit") != std::string_view::npos)
    refuse(file, "has a comment '" + std::string(comment.substr(0, 60)) +
                     "', whose unit would be ignored; write titles such as 'time [ms]', or remove "
                     "the comment");
}

}  // namespace

NumberTable read_number_table(const std::filesystem::path& file,
                              const std::vector<TableColumn>& columns, std::size_t least) {
  const std::string content = detail::file_content(detail::InputFile(file));
  if (least == 0) least = columns.size();
  std::vector<std::vector<double>> table;
  std::optional<Titles> titles;
  detail::NumberReader reader(file);
  std::vector<double> values;
  detail::Lines lines(detail::require_text(file, content));
  for (std::string_view raw; lines.next(raw);) {
    std::string_view line = detail::trimmed(raw);
    if (line.empty()) continue;
    const std::string position = file.string() + ", line " + std::to_string(lines.number());
    if (const bool comment = line.front() == '#'; comment || !detail::starts_with_number(line)) {
      if (comment) line = detail::trimmed(line.substr(1));
      if (comment && (titles || reader.started() || !names_columns(line, columns))) {
        require_no_units(file, line);
        continue;
      }
      if (titles || reader.started()) throw InvalidInput(position, "holds no numbers; remove it");
      titles = read_titles(file, line, columns);
      continue;
    }
    values.clear();
    reader.append(line, lines.number(), values);
    if (table.empty()) {
      const std::size_t count = titles ? titles->positions.size() : values.size();
      table.resize(std::clamp(count, least, columns.size()));
    }
    if (values.size() != table.size() || (titles && titles->positions.size() != table.size()))
      throw InvalidInput(position, "holds " + std::to_string(values.size()) +
                                       " values; give the same " + std::to_string(table.size()) +
                                       " in each line" + (titles ? ", with a title each" : ""));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t column = titles ? titles->positions[i] : i;
      if (column >= table.size())
        refuse(file, fmt::format("lacks the column {}", columns[table.size() - 1].name));
      table[column].push_back(titles ? values[i] * titles->factors[i] : values[i]);
    }
  }
  if (!reader.started()) throw InvalidInput(file.string(), "holds no numbers");
  return {std::move(table), titles && titles->has_units};
}

}  // namespace salebra
