// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <salebra/base/describe.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/io/result_file.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace salebra {

/// Additional column of a curve file, with one value per sample.
struct CurveColumn {
  Quantity quantity;
  std::vector<double> values;
};

/// Converts described structs, one for each sample of a curve, to additional columns. Columns
/// without any value are omitted; a boolean true becomes 1.
template <Described T>
std::vector<CurveColumn> columns_beside(const std::vector<T>& of_samples) {
  std::vector<CurveColumn> columns;
  for_each_column<T>([&](const auto& access, const Quantity& quantity) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(access(of_samples[0]))>>) {
      std::vector<double> values;
      for (const T& one : of_samples) values.push_back(static_cast<double>(access(one)));
      if (std::ranges::any_of(values, [](double value) { return !std::isnan(value); }))
        columns.push_back({quantity, std::move(values)});
    }
  });
  return columns;
}

/// Writes a curve into a group. The coordinate is `pressure`, or `force` if no pressure is known,
/// or else the index `sample`. It has a dataset for each quantity of ForceSample with a value,
/// `converged`, the additional columns, and the attributes model, nominal_area, rms_height.
void write_force_curve(ResultGroup& group, const ForceCurve& curve,
                       const std::vector<CurveColumn>& beside = {});

/// Reads a curve from a group that write_force_curve() wrote, or the curve of the first model
/// (boundary elements) from the group `curve` of a study of one surface. Throws InvalidInput if the
/// group has no curve, or curves of several surfaces.
ForceCurve read_force_curve(const ResultReader& reader, const std::string& group = "curve");

/// Read the curves of the first model (boundary elements) for all surfaces of a study, or the
/// single curve of any other group or file. Throw InvalidInput if there is no curve.
std::vector<ForceCurve> read_force_curves(const ResultReader& reader,
                                          const std::string& group = "curve");
std::vector<ForceCurve> read_force_curves(const std::filesystem::path& file);

/// Writes a file with one curve, e.g. `write_force_curve("curve.csv", curve)`: .h5 and .hdf5 with
/// the group `curve`, .csv and .txt as text that read_force_curve can read. Throws wherever
/// write_surface does.
void write_force_curve(const std::filesystem::path& file, const ForceCurve& curve,
                       const Provenance& provenance = {}, const WriteOptions& options = {},
                       const std::vector<CurveColumn>& beside = {});

/// Throws InvalidInput for a file name whose extension write_force_curve() does not know.
void require_curve_name(const std::filesystem::path& file);

/// Reads a curve from an HDF5 file (group `curve`) or from text, e.g.
/// `read_force_curve("curve.csv")`. Text is a table whose first line names the columns, after the
/// members of ForceSample, each with a unit in brackets or parentheses unless it is SI:
///     # nominal_area: 1 mm^2
///     pressure [MPa], mean_gap [nm], normal_stiffness [N/um], converged
///     0.1, 350, 12, 1
/// Values are separated by blanks, ';' or ','; an empty field or nan is unknown; columns with other
/// names are ignored. Lines that start with "# model:", "# nominal_area:" or "# rms_height:" may
/// precede the table. If the nominal area is known, force is computed from pressure or pressure
/// from force. Samples are sorted by increasing force.
/// throws   InvalidInput, whose message names the file (and line), for a table without rows,
///          without a force or pressure, without an indentation, mean gap or separation, or with a
///          unit of another dimension
ForceCurve read_force_curve(const std::filesystem::path& file);

}  // namespace salebra
