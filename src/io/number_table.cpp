// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of numbers from text files with a fixed number of columns.
#include "number_table.hpp"

#include <salebra/base/error.hpp>
#include <string>

#include "input_file.hpp"
#include "loaded_surface.hpp"
#include "text_numbers.hpp"

namespace salebra {

std::vector<std::vector<double>> read_number_table(const std::filesystem::path& file,
                                                   std::size_t columns, std::size_t most) {
  const std::string content = detail::file_content(detail::InputFile(file));
  std::vector<std::vector<double>> table(columns);
  detail::NumberReader reader(file);
  std::vector<double> values;
  detail::Lines lines(detail::require_text(file, content));
  bool titled = false;
  for (std::string_view raw; lines.next(raw);) {
    const std::string_view line = detail::trimmed(raw);
    if (line.empty() || line.front() == '#') continue;
    const std::string place = file.string() + ", line " + std::to_string(lines.number());
    if (!detail::starts_with_number(line)) {
      if (titled || reader.started()) throw InvalidInput(place, "holds no numbers; remove it");
      titled = true;
      continue;
    }
    values.clear();
    reader.append(line, lines.number(), values);
    const bool first = table.front().empty();
    if (first && values.size() > columns && values.size() <= most) {
      columns = values.size();
      table.resize(columns);
    }
    if (values.size() != columns)
      throw InvalidInput(place, "holds " + std::to_string(values.size()) +
                                    " values; give the same " + std::to_string(columns) +
                                    " in each line");
    for (std::size_t i = 0; i < columns; ++i) table[i].push_back(values[i]);
  }
  if (!reader.started()) throw InvalidInput(file.string(), "holds no numbers");
  return table;
}

}  // namespace salebra
