// SPDX-License-Identifier: GPL-3.0-or-later
// JSON of a figure, from its description, and text without markup.
#include <salebra/figures/figure.hpp>

#include "figure_object.hpp"
#include "results/columns.hpp"

namespace salebra::figures {
namespace {

template <class Value>
Json json_of_value(const Value& value) {
  if constexpr (Described<Value>) {
    Json object = Json::object();
    describe(
        [&](auto member, const auto& line) {
          using Member = std::remove_cvref_t<decltype(value.*member)>;
          if constexpr (detail::is_optional<Member>) {
            if (value.*member) object[line.name] = json_of_value(*(value.*member));
          } else {
            object[line.name] = json_of_value(value.*member);
          }
        },
        std::type_identity<Value>{});
    return object;
  } else if constexpr (detail::is_list<Value>) {
    Json list = Json::array();
    for (const auto& item : value) list.push_back(json_of_value(item));
    return list;
  } else if constexpr (std::is_same_v<Value, Field>) {
    Json columns = Json::array();
    for (Index i = 0; i < value.rows(); ++i) {
      Json column = Json::array();
      for (Index j = 0; j < value.cols(); ++j) column.push_back(value(i, j));
      columns.push_back(std::move(column));
    }
    return columns;
  } else {
    return detail::json_value(value);
  }
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

Json figure_object(const Figure& figure) { return json_of_value(with_limits(figure)); }

std::string figure_json(const Figure& figure) { return figure_object(figure).dump(2) + "\n"; }

}  // namespace salebra::figures
