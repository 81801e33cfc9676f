// SPDX-License-Identifier: GPL-3.0-or-later
// A command's answer as HDF5: scalars, arrays, groups and texts from JSON.
#include "answer_file.hpp"

#include <limits>
#include <salebra/io/result_file.hpp>
#include <salebra/results/quantity.hpp>
#include <vector>

namespace salebra::cli {
double number_of(const Json& value) {
  if (value.is_boolean()) return value.truth() ? 1 : 0;
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.number();
}

Quantity quantity_of(const std::string& name, const std::string& object) {
  return find_quantity(is_quantity(object) ? object : name);
}

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

void write_answer(const Session& session, const std::string& group, const Json& object) {
  if (!session.has_output()) return;
  ResultFile file(session.output(), session.provenance(), session.write_options());
  write_answer(file, group, object);
  file.commit();
}

}  // namespace salebra::cli
