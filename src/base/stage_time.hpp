// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace salebra::detail {

/// What the processor time of a computation is spent on.
enum class Stage { other, surfaces, statistics, contacts, stiffness, stick, oscillation, results };

inline constexpr std::array<std::string_view, 8> stage_names{"other",
                                                             "surfaces",
                                                             "statistics",
                                                             "contacts",
                                                             "normal stiffness",
                                                             "tangential stiffness",
                                                             "oscillation and damping",
                                                             "means, files and page"};

/// While an object of this class exists, the processor time of its thread counts for a stage, and
/// so does the time of threads that take part in its parallel loops. An inner stage interrupts the
/// outer one:
///     const StageTime time(Stage::contacts);
/// Cost: 1 µs.
class StageTime {
 public:
  explicit StageTime(Stage stage);
  ~StageTime();
  StageTime(const StageTime&) = delete;
  StageTime& operator=(const StageTime&) = delete;

  /// The stage of the calling thread.
  static Stage current();

 private:
  Stage before_;
};

/// Processor time of each stage since the program began, s, over all threads.
std::array<double, stage_names.size()> stage_seconds();

}  // namespace salebra::detail
