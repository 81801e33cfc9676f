// SPDX-License-Identifier: GPL-3.0-or-later
// Finds out from the numbers and titles of a text what its columns contain.
#include "text_columns.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "loaded_surface.hpp"

namespace salebra::detail {

bool is_monotone(const TextRows& rows, Index column) {
  if (rows.rows < 2) return false;
  const bool up = rows(1, column) > rows(0, column);
  for (Index row = 1; row < rows.rows; ++row) {
    const double change = rows(row, column) - rows(row - 1, column);
    if (!(up ? change > 0 : change < 0)) return false;
  }
  return true;
}

namespace {

/// The numbers of one row or one column, from an index `first` on.
struct Line {
  const TextRows& rows;
  bool along_row;
  Index at;
  Index first = 0;

  Index size() const { return (along_row ? rows.columns : rows.rows) - first; }
  double operator[](Index i) const { return along_row ? rows(at, i + first) : rows(i + first, at); }
};

/// The step of equally spaced numbers. Nothing if they are not equally spaced, or if there are
/// fewer than `least`, which may be equally spaced by chance.
std::optional<double> step_of(const Line& line, Index least) {
  const Index count = line.size();
  if (count < least) return {};
  const double step = (line[count - 1] - line[0]) / static_cast<double>(count - 1);
  if (step == 0 || !std::isfinite(step)) return {};
  // Relative tolerance of the steps, since coordinates are rounded to few digits.
  constexpr double rounding = 1e-3;
  for (Index i = 1; i < count; ++i)
    if (!(std::abs(line[i] - line[0] - static_cast<double>(i) * step) <= rounding * std::abs(step)))
      return {};
  return step;
}

bool counts(const Line& line, std::optional<double> step) {
  return step == 1. && (line[0] == 0 || line[0] == 1);
}

bool rises(const TextRows& rows, Index column) {
  for (Index row = 1; row < rows.rows; ++row)
    if (!(rows(row, column) > rows(row - 1, column))) return false;
  return true;
}

std::string quoted(const HeaderTitle& title) { return "'" + title.text + "'"; }

using namespace meaning;

constexpr Meaning heights = z | height | ordinate | values;
constexpr Meaning along = position | plane | length | step | width;

bool is_length(const std::string& unit) { return !unit.empty() && metres_in(unit).has_value(); }

enum class Role { x, y, position, height, skipped, index, unknown };

Role role_of(const HeaderTitle& title, bool of_profile) {
  const Meaning said = title.meaning;
  if (title.text.size() == 1 && of_profile)
    if (const std::string letter = plain_word(title.text.substr(0, 1));
        letter == "r" || letter == "p" || letter == "w")
      return Role::height;
  if (of_profile && !title.unit.empty() && title.text.size() > 2 && title.text[1] == ' ')
    if (const std::string letter = plain_word(title.text.substr(0, 1));
        letter == "r" || letter == "p" || letter == "w")
      return Role::height;
  if (said & unknown) return Role::unknown;
  const bool on_x = said & x, on_y = said & y;
  if ((said & heights) && !(said & (x | y | other | length | width | size | factor | alters)))
    return Role::height;
  if (on_x != on_y && !(said & ((heights & ~values) | other | factor | alters | size)))
    return on_x ? Role::x : Role::y;
  if ((said & other) || ((said & harmless) && !(said & along))) return Role::skipped;
  if ((said & along) && !(said & (heights | x | y | alters | factor))) return Role::position;
  if ((said & (index | points | rows | columns | count)) && title.unit.empty() &&
      !(said & (heights | along | x | y)))
    return Role::index;
  return Role::unknown;
}

}  // namespace

Margins margins_of(const TextRows& rows) {
  constexpr Index least = 4, certain = 8;
  Margins margins;
  if (rows.columns < 3 || rows.rows < 3) return margins;
  const Line row{rows, true, 0}, column{rows, false, 0};
  const Line row_behind{rows, true, 0, 1}, column_behind{rows, false, 0, 1};
  const bool no_corner = std::isnan(rows(0, 0));
  const auto along_x = step_of(row_behind, no_corner ? 2 : least),
             along_y = step_of(column_behind, no_corner ? 2 : least);
  const auto inner_x = step_of(Line{rows, true, 1, 1}, 2),
             inner_y = step_of(Line{rows, false, 1, 1}, 2);
  // The first row and the first column contain coordinates, or only number the columns and rows.
  if (along_x && along_y && (no_corner || (!inner_x && !inner_y && rows.columns > 3))) {
    margins.row = margins.column = true;
    if (!counts(row_behind, along_x) || !counts(column_behind, along_y)) {
      if (*along_x < 0 || *along_y < 0)
        margins.fault = "has decreasing coordinates in its first row or column; reverse the matrix";
      margins.step_x = along_x;
      margins.step_y = along_y;
    }
    return margins;
  }
  if (no_corner && (along_x || along_y))
    margins.fault =
        "has no number in the corner of an equally spaced row or column, which therefore cannot "
        "hold heights; remove that row or column";
  // Next case: only the first column numbers the rows, or only the first row numbers the columns.
  constexpr Index min_numbers = 5;
  const auto down = step_of(column, min_numbers);
  const auto next_down = step_of(Line{rows, false, 1}, least);
  const bool numbered_profile = rows.columns == 3 && rises(rows, 1) && !is_monotone(rows, 2) &&
                                counts(column, down) &&
                                !counts(Line{rows, false, 1}, step_of(Line{rows, false, 1}, least));
  if (down && (!next_down || numbered_profile)) {
    if (!counts(column, down)) {
      if (rows.rows < certain || rows.columns < least) return margins;
      margins.fault =
          "has a first column of equally spaced numbers, which do not look like heights; remove "
          "it, or name the columns";
      return margins;
    }
    margins.column = true;
  }
  const Line titles = margins.column ? row_behind : row;
  const auto across = step_of(titles, min_numbers);
  if (across && !step_of(Line{rows, true, 1, titles.first}, least)) {
    if (!counts(titles, across)) {
      if (titles.size() < certain) return margins;
      margins.fault =
          "has a first row of equally spaced numbers, which do not look like heights; remove it";
      return margins;
    }
    margins.row = true;
  }
  return margins;
}

std::optional<Columns> columns_of(const std::filesystem::path& file, const TextRows& rows,
                                  const TextHeader& header) {
  std::vector<HeaderTitle> titles = header.titles;
  constexpr std::size_t most = 12;
  const auto count = static_cast<std::size_t>(rows.columns);
  if (titles.empty()) return {};
  const std::string& quote = header.titles_quote;
  const auto numbers_of_rows = [&] {
    const Line column{rows, false, 0};
    return column.size() > 1 && counts(column, step_of(column, 2));
  };
  if (titles.size() + 1 == count) {
    const bool plain =
        std::ranges::all_of(titles, [](const auto& title) { return title.unit.empty(); });
    if (!numbers_of_rows() && plain && count > 3) return {};
    if (!numbers_of_rows())
      refuse(file, quote + ", names fewer columns than there are; name all or none");
    titles.insert(titles.begin(), HeaderTitle{index, "", "index"});
  }
  if (titles.front().text.empty() && count > 1 && numbers_of_rows())
    titles.front() = HeaderTitle{index, "", "index"};
  const bool silent = std::ranges::all_of(titles, [](const HeaderTitle& title) {
    return title.unit.empty() && (title.text.empty() || (title.meaning & unknown));
  });
  if (silent && (count > 3 || count == 1)) return {};
  constexpr Index min_of_profile = 4;
  if (count == 2 && rows.rows < min_of_profile &&
      std::ranges::all_of(titles, [](const auto& title) { return title.unit.empty(); }))
    return {};
  if (count > most) {
    if (std::ranges::all_of(titles, [](const auto& title) { return title.unit.empty(); }))
      return {};
    refuse(file, quote + ", names units of columns that are not known; name units for all columns");
  }
  std::vector<Role> roles;
  std::vector<Index> kept;
  Columns result;
  Index usable = 0;
  for (const HeaderTitle& title : titles) {
    const Role role = role_of(title, false);
    if (role != Role::index && role != Role::skipped) ++usable;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (titles[i].meaning & mask)
      refuse(file, quote + ", names a mask, " + quoted(titles[i]) +
                       "; write nan where points are undefined, and remove it");
    roles.push_back(role_of(titles[i], usable <= 2));
    if (roles[i] == Role::skipped)
      result.warnings.push_back("the column " + quoted(titles[i]) + " was not used");
    if (roles[i] != Role::skipped && roles[i] != Role::index) kept.push_back(static_cast<Index>(i));
  }
  const auto role = [&](Index i) { return roles[static_cast<std::size_t>(i)]; };
  const auto title = [&](Index i) -> const HeaderTitle& {
    return titles[static_cast<std::size_t>(i)];
  };
  const auto not_understood = [&](Index i) {
    refuse(file, quote + ", names the column " + quoted(title(i)) +
                     ", which is not known; name the columns x, y and z");
  };
  const auto several = [&](Index a, Index b) {
    refuse(file, quote + ", names several columns of heights, " + quoted(title(a)) + " and " +
                     quoted(title(b)) + "; keep one of them");
  };
  // If the title of the heights states a unit, then a column whose title states no unit of length
  // contains no heights.
  const auto is_other = [&](Index i, Index of_z) {
    return !title(of_z).unit.empty() && !is_length(title(i).unit);
  };
  // Index of the positions and of the heights of a line profile: positions that rise or fall,
  // heights, and otherwise only columns whose unit is no length.
  const auto profile_with_others = [&]() -> std::optional<std::pair<Index, Index>> {
    std::optional<Index> along_x, of_z;
    for (const Index i : kept) {
      if (role(i) == Role::y) return {};
      if (role(i) == Role::unknown) continue;
      auto& target = role(i) == Role::height ? of_z : along_x;
      if (target) return {};
      target = i;
    }
    if (!along_x || !of_z || !is_monotone(rows, *along_x)) return {};
    if (!std::ranges::all_of(
            kept, [&](Index i) { return role(i) != Role::unknown || is_other(i, *of_z); }))
      return {};
    return std::pair(*along_x, *of_z);
  };
  if (kept.empty()) refuse(file, quote + ", does not name a column of heights; name one z");
  if (kept.size() == 1) {
    const Role only = role(kept[0]);
    if (only == Role::x || only == Role::y || only == Role::position)
      refuse(file, quote + ", does not name a column of heights; name one z");
    result.z = kept[0];
  } else if (kept.size() == 2) {
    const auto is_position = [&](Index i) {
      return role(i) == Role::x || role(i) == Role::y || role(i) == Role::position;
    };
    const Index a = kept[0], b = kept[1];
    if (role(a) == Role::height && role(b) == Role::height) several(a, b);
    if (role(a) == Role::height || role(b) == Role::height) {
      result.z = role(a) == Role::height ? a : b;
    } else if (is_position(a) && is_position(b)) {
      // Titles of two positions: they are x and y of a plotted profile, so y contains the heights.
      if (role(a) == Role::y || role(b) != Role::y) not_understood(b);
      result.z = b;
    } else if (is_position(a) || is_position(b)) {
      result.z = is_position(a) ? b : a;
    } else {
      if (is_monotone(rows, a) == is_monotone(rows, b)) {
        if (silent) return {};
        not_understood(a);
      }
      result.z = is_monotone(rows, a) ? b : a;
    }
    result.x = *result.z == a ? b : a;
    if (!is_monotone(rows, *result.x))
      refuse(file, quote + ", names positions, " + quoted(title(*result.x)) +
                       ", which neither rise nor fall from line to line; sort the lines");
  } else if (const auto profile = profile_with_others()) {
    std::tie(result.x, result.z) = *profile;
    for (const Index i : kept)
      if (role(i) == Role::unknown)
        result.warnings.push_back("the column " + quoted(title(i)) + " was not used");
  } else {
    std::vector<Index> unclear;
    for (const Index i : kept) {
      auto& target = role(i) == Role::x ? result.x : role(i) == Role::y ? result.y : result.z;
      if (role(i) == Role::unknown || role(i) == Role::position) {
        unclear.push_back(i);
      } else if (target) {
        if (role(i) == Role::height) several(*target, i);
        not_understood(i);
      } else {
        target = i;
      }
    }
    const int known = result.x.has_value() + result.y.has_value() + result.z.has_value();
    if (known == 2 && unclear.size() == 1) {
      auto& target = !result.x ? result.x : !result.y ? result.y : result.z;
      if ((role(unclear[0]) == Role::position && &target == &result.z) ||
          (&target == &result.y && is_monotone(rows, *result.x)))
        not_understood(unclear[0]);
      target = unclear[0];
      unclear.clear();
    } else if (known < 3) {
      not_understood(unclear.empty() ? kept[0] : unclear[0]);
    }
    for (const Index i : unclear) {
      // A column that contains only zeros and ones may mark the valid points.
      bool both = true, zero = false, one = false;
      for (Index row = 0; row < rows.rows && both; ++row) {
        zero = zero || rows(row, i) == 0;
        one = one || rows(row, i) == 1;
        both = rows(row, i) == 0 || rows(row, i) == 1;
      }
      if (!is_other(i, *result.z) || (both && zero && one)) not_understood(i);
      result.warnings.push_back("the column " + quoted(title(i)) + " was not used");
    }
  }
  const auto unit_of = [&](std::optional<Index> column) {
    return column ? title(*column).unit : std::string();
  };
  result.x_unit = unit_of(result.x);
  result.y_unit = unit_of(result.y);
  result.z_unit = unit_of(result.z);
  constexpr Meaning downwards = ordinate;
  if ((title(*result.z).meaning & downwards)) {
    const std::string name = plain_word(title(*result.z).text);
    for (const char* depth : {"depth", "tiefe", "profondeur", "fukasa"})
      if (name.find(depth) != name.npos)
        result.warnings.push_back("the column " + quoted(title(*result.z)) +
                                  " is read as heights, positive out of the material");
  }
  return result;
}

}  // namespace salebra::detail
