// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/damping/cycle_state.hpp>
#include <salebra/io/provenance.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace salebra {

/// All settings on which the bits of a simulated cycle depend, as pairs of name and text: grid,
/// surface, material, motion, steps, tolerances, arithmetic. A checkpoint is only read if these
/// settings and the version of the program are the same.
using CycleSettings = std::vector<std::pair<std::string, std::string>>;

/// Short checksum text of the bits of a field, used as a setting.
std::string fingerprint(const Field& values);

/// The settings of a cycle except those that describe its contact. The caller adds these, for
/// example the fingerprint of the heights.
CycleSettings cycle_settings(const Grid2D& grid, const Body& body, const Oscillation& motion,
                             double mean_indentation, const CycleOptions& options);

/// Writes states of cycles, at most one for each kind of body (stuck, frictional, coupled), to an
/// HDF5 file. The file replaces the previous one in one step, so a complete file exists at any
/// time.
/// throws  IoError if a system call fails
void write_cycle_checkpoint(const std::filesystem::path& file, std::span<const CycleState> states,
                            const CycleSettings& settings, const Provenance& provenance);

/// Reads the states in a checkpoint bit for bit. Each kind of body (stuck, frictional, coupled) has
/// at most one state.
/// throws  InvalidInput that names the file if it is not a checkpoint or a checksum shows that it
///         is damaged, and that names the setting if one differs
std::vector<CycleState> read_cycle_checkpoint(const std::filesystem::path& file,
                                              const CycleSettings& settings);

}  // namespace salebra
