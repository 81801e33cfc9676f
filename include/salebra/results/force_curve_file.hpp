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

/// What a file has of each sample beside the quantities of ForceSample.
struct CurveColumn {
  Quantity quantity;
  std::vector<double> values;
};

/// The numbers of described structs, one for each sample, that any of them has; a truth is 1.
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

/// Writes a curve into a group: the coordinate is `pressure`, or `force` where no pressure is
/// known, or else the index `sample`; a dataset for each quantity of ForceSample that any sample
/// has, `converged`, the columns beside, and the attributes model, nominal_area, rms_height.
void write_force_curve(ResultGroup& group, const ForceCurve& curve,
                       const std::vector<CurveColumn>& beside = {});

/// Reads it back from that group, or the first model's curve (the boundary elements') from that
/// group of a study of one surface.
/// Throws InvalidInput if it holds no curve, or those of several surfaces.
ForceCurve read_force_curve(const ResultReader& reader, const std::string& group = "curve");

/// The curves of all surfaces of a study, of the first model; of any other group or file its one.
/// Throws InvalidInput if it holds none.
std::vector<ForceCurve> read_force_curves(const ResultReader& reader,
                                          const std::string& group = "curve");
std::vector<ForceCurve> read_force_curves(const std::filesystem::path& file);

/// A file with one curve: .h5 and .hdf5 with the group `curve`, .csv and .txt as text in the form
/// that read_force_curve takes.
/// Throws as write_surface does.
void write_force_curve(const std::filesystem::path& file, const ForceCurve& curve,
                       const Provenance& provenance = {}, const WriteOptions& options = {},
                       const std::vector<CurveColumn>& beside = {});

/// Throws InvalidInput for a name by which write_force_curve() knows no format.
void require_curve_name(const std::filesystem::path& file);

/// Reads a curve from an HDF5 file (group `curve`) or from text. Text is a table whose first line
/// names the columns, after the members of ForceSample, each with a unit in brackets or parentheses
/// unless it is SI:
///     # nominal_area: 1 mm^2
///     pressure [MPa], mean_gap [nm], normal_stiffness [N/um], converged
///     0.1, 350, 12, 1
/// Values are separated by blanks, ';' or ','; an empty field or nan is unknown; columns of other
/// names are passed over. Lines "# model: …", "# nominal_area: …", "# rms_height: …" may precede.
/// Force and pressure give each other where the nominal area is known. Samples are put in the order
/// of rising force.
/// throws   InvalidInput naming the file (and line) for a table without a force or pressure,
///          without an indentation, mean gap or separation, with a unit of another dimension, or of
///          no rows
ForceCurve read_force_curve(const std::filesystem::path& file);

}  // namespace salebra
