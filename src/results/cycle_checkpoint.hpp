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

/// What decides every bit of a simulated cycle, as names and texts: grid, surface, material,
/// motion, steps, tolerances, arithmetic. The version of the program is compared with them.
using CycleSettings = std::vector<std::pair<std::string, std::string>>;

/// Short fingerprint of a field's bits, for settings.
std::string fingerprint(const Field& values);

/// The arguments of a cycle apart from its contact. What decides that must be added, such as the
/// fingerprint of the heights.
CycleSettings cycle_settings(const Grid2D& grid, const Material& material,
                             const Oscillation& motion, double mean_indentation,
                             const CycleOptions& options);

/// Writes states of cycles, at most one of each kind of body, to an HDF5 file, replacing the last
/// one; the file is complete at any time.
/// throws  IoError for what the system refuses
void write_cycle_checkpoint(const std::filesystem::path& file, std::span<const CycleState> states,
                            const CycleSettings& settings, const Provenance& provenance);

/// The states of that file, bit for bit: stuck, frictional, coupled, as far as they are there.
/// throws  InvalidInput naming the file for what is not a checkpoint or is damaged, by a checksum
///         of the states, and naming the setting where one differs
std::vector<CycleState> read_cycle_checkpoint(const std::filesystem::path& file,
                                              const CycleSettings& settings);

}  // namespace salebra
