// SPDX-License-Identifier: GPL-3.0-or-later
#include "answer_file.hpp"

#include <limits>
#include <salebra/base/quantity.hpp>
#include <salebra/io/result_file.hpp>
#include <vector>

namespace salebra::cli {
namespace {

double number(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

void write(ResultFile& file, const std::string& path, const Json& object) {
  ResultGroup group = file.group(path);
  bool has_samples = false;
  for (const auto& [name, value] : object.items()) {
    const Quantity quantity = find_quantity(name);
    const std::string unit(si_unit(quantity.dimension)), long_name(quantity.long_name);
    if (value.is_object()) {
      write(file, path + "/" + name, value);
    } else if (value.is_string()) {
      group.attribute(name, value.get<std::string>());
    } else if (value.is_array()) {
      std::vector<double> values;
      for (const Json& item : value) values.push_back(number(item));
      if (!has_samples) group.index("sample", values.size(), "number of the case");
      has_samples = true;
      group.dataset(name, values, {"sample"}, unit, long_name);
    } else {
      group.scalar(name, number(value), unit, long_name);
    }
  }
}

}  // namespace

void write_answer(const Session& session, const std::string& group, const Json& object) {
  if (!session.has_output()) return;
  ResultFile file(session.output(), session.provenance(), session.write_options());
  write(file, group, object);
  file.commit();
}

}  // namespace salebra::cli
