// SPDX-License-Identifier: GPL-3.0-or-later
// Writes and reads force curves in HDF5 groups and files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "base/printable.hpp"
#include "io/atomic_file.hpp"
#include "io/input_file.hpp"
#include "io/loaded_surface.hpp"
#include "text_curve.hpp"

namespace salebra {
namespace {

bool known(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

bool complete(const std::vector<double>& values) {
  return std::ranges::none_of(values, [](double value) { return std::isnan(value); });
}

/// Names the direction of K_t, if it comes from stick solves. Files of salebra 1.0 and 2.0 do not
/// name it; it is x. K_t = (G*/E*)K, whose ratio is the same at all loads, has no direction.
ForceCurve with_direction(ForceCurve curve) {
  if (curve.model != "bem" || known(curve.column(&ForceSample::direction))) return curve;
  double low = HUGE_VAL, high = 0;
  for (const ForceSample& sample : curve.samples)
    if (const double ratio = sample.tangential_stiffness / sample.normal_stiffness;
        std::isfinite(ratio)) {
      low = std::min(low, ratio);
      high = std::max(high, ratio);
    }
  if (high > (1 + 1e-6) * low)
    for (ForceSample& sample : curve.samples) sample.direction = 0;
  return curve;
}

}  // namespace

void write_force_curve(ResultGroup& group, const ForceCurve& curve,
                       const std::vector<CurveColumn>& beside) {
  std::string coordinate;
  for (const auto& [meaning, member] : detail::curve_quantities()) {
    const std::vector<double> values = curve.column(member);
    if (!known(values)) continue;
    const std::string name(meaning.name), units(si_unit(meaning.dimension)),
        long_name(meaning.long_name);
    if (coordinate.empty()) {
      // A curve of several directions has each load several times.
      const bool orders =
          (meaning.dimension == Dimension::pressure || meaning.dimension == Dimension::force) &&
          by_direction(curve).size() == 1;
      if (orders && complete(values)) {
        group.coordinate(name, values, units, long_name);
        coordinate = name;
        continue;
      }
      group.index("sample", values.size(), "number of the sample");
      coordinate = "sample";
    }
    group.dataset(name, values, {coordinate}, units, long_name);
  }
  require(!coordinate.empty(), "curve", curve.samples.size(), "samples contain no known quantity");
  for (const auto& [quantity, values] : beside)
    group.dataset(std::string(quantity.name), values, {coordinate},
                  std::string(si_unit(quantity.dimension)), std::string(quantity.long_name));
  std::vector<bool> converged;
  for (const ForceSample& sample : curve.samples) converged.push_back(sample.converged);
  for_each_column<ForceSample>([&](const auto&, const Quantity& quantity) {
    if (quantity.name == "converged")
      group.flags("converged", converged, {coordinate}, std::string(quantity.long_name));
  });
  group.attribute("model", curve.model);
  group.attribute("nominal_area", curve.nominal_area);
  group.attribute("rms_height", curve.rms_height);
  if (curve.adhesive) group.attribute("adhesive", "yes");
  if (!curve.body.empty()) group.attribute("body", curve.body);
}

std::vector<ForceCurve> read_force_curves(const ResultReader& reader, const std::string& group) {
  ForceCurve curve;
  curve.model = reader.text_attribute(group, "model").value_or("");
  curve.nominal_area = reader.number_attribute(group, "nominal_area").value_or(0);
  curve.rms_height = reader.number_attribute(group, "rms_height").value_or(ForceSample::unknown);
  curve.adhesive = reader.text_attribute(group, "adhesive").has_value();
  curve.body = reader.text_attribute(group, "body").value_or("");
  std::optional<std::size_t> length;  // number of samples; empty until the first column is read
  std::size_t surfaces = 1;
  bool study = false;
  const auto column = [&](const std::string& name) {
    std::vector<double> values = reader.numbers(group + "/" + name);
    const std::vector<Index> shape = reader.shape(group + "/" + name);
    std::size_t rows = values.size();
    if (shape.size() == 3) {  // files of a study: (model, realisation, pressure)
      if (shape[0] < 1 || shape[1] < 1 || (study && surfaces != std::size_t(shape[1])))
        detail::refuse(reader.file(), "has no surface, or too few, in " + group);
      study = true;
      surfaces = static_cast<std::size_t>(shape[1]);
      rows = static_cast<std::size_t>(shape[2]);
      values.resize(surfaces * rows);
    }
    if (rows == 0) detail::refuse(reader.file(), "has no values in " + group + "/" + name);
    if (rows != length.value_or(rows))
      detail::refuse(reader.file(), "has datasets of different length in " + group);
    length = rows;
    return values;
  };
  using Column = std::pair<double ForceSample::*, std::vector<double>>;
  std::vector<Column> columns;
  for (const auto& [quantity, member] : detail::curve_quantities())
    if (const std::string name(quantity.name); reader.has(group + "/" + name)) {
      columns.emplace_back(member, column(name));
      const std::string_view si = si_unit(quantity.dimension);
      const auto units = reader.text_attribute(group + "/" + name, "units").value_or("");
      if (units.empty() || units == si) continue;
      double factor = 0;
      try {
        factor = parse_quantity("1 " + units, quantity.dimension, "units");
      } catch (const InvalidInput&) {
        detail::refuse(reader.file(), fmt::format("has {}/{} in '{}', which is not a unit like {}",
                                                  group, name, printable_line(units), si));
      }
      for (double& value : columns.back().second) value *= factor;
    }
  if (!length)
    detail::refuse(reader.file(),
                   "contains no force curve in its group " + group +
                       (reader.has("heights") ? ", but a surface; press it first" : ""));
  const std::vector<double> converged =
      reader.has(group + "/converged") ? column("converged") : std::vector<double>{1};
  if (study) {
    if (const auto models = reader.labels(group + "/model"); !models.empty())
      curve.model = models.front();
    curve.nominal_area = reader.number_attribute("surface", "size_x").value_or(0) *
                         reader.number_attribute("surface", "size_y").value_or(0);
  }
  curve.samples.resize(*length);
  std::vector<ForceCurve> curves(surfaces, curve);
  // A column that is the same for all surfaces, such as the pressure, is stored once and used for
  // each.
  for (std::size_t i = 0; i < surfaces * *length; ++i) {
    ForceSample& sample = curves[i / *length].samples[i % *length];
    for (const auto& [member, values] : columns) sample.*member = values[i % values.size()];
    sample.converged = converged[i % converged.size()] != 0;
  }
  if (study && reader.has("surface/rms_height"))
    if (const auto heights = reader.numbers("surface/rms_height"); heights.size() == surfaces)
      for (std::size_t i = 0; i < surfaces; ++i) curves[i].rms_height = heights[i];
  std::ranges::transform(curves, curves.begin(), with_direction);
  return curves;
}

ForceCurve read_force_curve(const ResultReader& reader, const std::string& group) {
  std::vector<ForceCurve> curves = read_force_curves(reader, group);
  if (curves.size() != 1)
    detail::refuse(reader.file(), "contains the curves of " + std::to_string(curves.size()) +
                                      " surfaces in " + group +
                                      "; give the file of a study of one surface");
  return std::move(curves.front());
}

std::vector<ForceCurve> read_force_curves(const std::filesystem::path& file) {
  const detail::InputFile input(file);
  if (input.is_hdf5()) return read_force_curves(ResultReader(file));
  return {with_direction(detail::read_text_curve(file, detail::file_content(input)))};
}

void write_force_curve(const std::filesystem::path& file, const ForceCurve& curve,
                       const Provenance& provenance, const WriteOptions& options,
                       const std::vector<CurveColumn>& beside) {
  require_curve_name(file);
  const std::string extension = file.extension().string();
  if (extension == ".h5" || extension == ".hdf5") {
    ResultFile results(file, provenance, options);
    ResultGroup group = results.group("curve");
    write_force_curve(group, curve, beside);
    results.commit();
  } else {
    detail::AtomicFile output(file, options);
    output.write(detail::text_of(curve, beside, provenance));
    output.commit();
  }
}

void require_curve_name(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".h5" && extension != ".hdf5" && extension != ".csv" && extension != ".txt")
    throw InvalidInput(file.string(), "has the extension '" + extension +
                                          "', which is not a format of a curve; use .h5 or .csv");
}

ForceCurve read_force_curve(const std::filesystem::path& file) {
  const detail::InputFile input(file);
  if (input.is_hdf5()) return read_force_curve(ResultReader(file));
  return with_direction(detail::read_text_curve(file, detail::file_content(input)));
}

}  // namespace salebra
