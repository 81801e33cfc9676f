// SPDX-License-Identifier: GPL-3.0-or-later
// Text header that Gwyddion's formats GSF and GXYZF share.
#include "gwyddion_header.hpp"

#include <charconv>
#include <cmath>
#include <salebra/base/grid.hpp>

#include "loaded_surface.hpp"
#include "text_numbers.hpp"

namespace salebra::detail {

std::size_t read_gwyddion_header(const std::filesystem::path& file, std::string_view content,
                                 std::size_t alignment, const HeaderEntry& entry) {
  const std::size_t end = content.find('\0');
  if (end == std::string_view::npos) refuse(file, "ends within its header; it is truncated");
  Lines lines(content.substr(0, end));
  std::string_view line;
  lines.next(line);
  while (lines.next(line)) {
    const auto equals = line.find('=');
    if (equals != std::string_view::npos)
      entry(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
  }
  return end + alignment - end % alignment;
}

template <class Number>
Number positive_entry(const std::filesystem::path& file, std::string_view key,
                      std::string_view value) {
  Number number{};
  const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (status != std::errc{} || end != value.data() + value.size() || !(number > 0) ||
      !std::isfinite(static_cast<double>(number)))
    refuse(file, "has the entry " + std::string(key) + " = '" + std::string(value.substr(0, 20)) +
                     "' in its header, which is no number > 0");
  return number;
}

template Index positive_entry(const std::filesystem::path&, std::string_view, std::string_view);
template double positive_entry(const std::filesystem::path&, std::string_view, std::string_view);

}  // namespace salebra::detail
