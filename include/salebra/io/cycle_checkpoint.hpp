// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/frictional_cycle.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <utility>
#include <vector>

namespace salebra {

/// What decides every bit of a simulated cycle, as names and texts: grid, surface, material, motion, steps, tolerances, version.
using CycleSettings = std::vector<std::pair<std::string, std::string>>;

/// Short fingerprint of a field's bits, for settings.
std::string fingerprint(const Field& values);

/// What a cycle is given beside its levels. What decides those must be added, such as the fingerprint of the heights.
CycleSettings cycle_settings(const Grid2D& grid, const Material& material,
                             const Oscillation& motion, double mean_indentation,
                             const CycleOptions& options);
CycleSettings cycle_settings(const Grid2D& grid, const Material& material,
                             const Oscillation& motion, double mean_indentation,
                             const FrictionalCycleOptions& options);

/// Writes a state of simulate_cycle() to an HDF5 file, replacing the last one; the file is complete at any time.
/// friction   the state of a simulate_frictional_cycle() that follows it; nullptr: not there yet
/// throws  IoError for what the system refuses
void write_cycle_checkpoint(const std::filesystem::path& file, const CycleState& state,
                            const CycleSettings& settings, const Provenance& provenance,
                            const FrictionalCycleState* friction = nullptr);

/// The state of that file, bit for bit.
/// throws  InvalidInput naming the file for what is not a checkpoint, and naming the setting where one differs
CycleState read_cycle_checkpoint(const std::filesystem::path& file, const CycleSettings& settings);

/// The state of the cycle with friction in a file that read_cycle_checkpoint() accepts, bit for bit; none where that cycle had
/// not begun.
/// throws  InvalidInput naming the file for what is not a checkpoint
std::optional<FrictionalCycleState> read_friction_checkpoint(const std::filesystem::path& file);

/// The same for a simulate_frictional_cycle() that follows no other. Write and throw as those of simulate_cycle() do.
void write_friction_checkpoint(const std::filesystem::path& file, const FrictionalCycleState& state,
                               const CycleSettings& settings, const Provenance& provenance);
FrictionalCycleState read_friction_checkpoint(const std::filesystem::path& file,
                                              const CycleSettings& settings);

}  // namespace salebra
