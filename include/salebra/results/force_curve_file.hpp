// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/io/result_file.hpp>
#include <string>

namespace salebra {

/// Writes a curve into a group: the coordinate is `pressure`, or `force` where no pressure is
/// known, or else the index `sample`; a dataset for each quantity of ForceSample that any sample
/// has, `converged`, and the attributes model, nominal_area, rms_height.
void write_force_curve(ResultGroup& group, const ForceCurve& curve);

/// Reads it back from that group, or the first model's curve (the boundary elements') from that
/// group of a study of one surface.
/// Throws InvalidInput if it holds no curve, or those of several surfaces.
ForceCurve read_force_curve(const ResultReader& reader, const std::string& group = "curve");

/// A file with one curve: .h5 and .hdf5 with the group `curve`, .csv and .txt as text in the form
/// that read_force_curve takes.
/// Throws as write_surface does.
void write_force_curve(const std::filesystem::path& file, const ForceCurve& curve,
                       const Provenance& provenance = {}, const WriteOptions& options = {});

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
