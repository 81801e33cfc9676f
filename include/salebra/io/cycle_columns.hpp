// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <salebra/damping/cycle.hpp>
#include <vector>

namespace salebra {

/// One quantity of the samples of a cycle: its name in every file and in Python, and its meaning.
struct CycleColumn {
  const char* name;
  double CycleSample::*value;
  const char* units;
  const char* long_name;
};

/// The time first.
inline constexpr std::array cycle_columns{
    CycleColumn{"time", &CycleSample::t, "1", "time in periods"},
    CycleColumn{"indentation", &CycleSample::indentation, "m", "indentation"},
    CycleColumn{"tangential", &CycleSample::tangential, "m", "tangential displacement"},
    CycleColumn{"tangential_force", &CycleSample::tangential_force, "N", "tangential force"},
    CycleColumn{"normal_force", &CycleSample::normal_force, "N", "normal force"},
    CycleColumn{"work", &CycleSample::work, "J",
                "work of the tangential force since the start of the period"},
    CycleColumn{"dissipated", &CycleSample::dissipated, "J",
                "energy dissipated since the start of the period"},
    CycleColumn{"contact_area", &CycleSample::contact_area, "m^2", "contact area"},
    CycleColumn{"slip_area", &CycleSample::slip_area, "m^2", "area of cells at their limit"},
    CycleColumn{"tangential_stiffness", &CycleSample::tangential_stiffness, "N/m",
                "tangential stiffness in full stick; undefined with friction"}};

/// One quantity over the samples.
inline std::vector<double> column(const CycleResult& cycle, double CycleSample::*value) {
  std::vector<double> values;
  for (const CycleSample& sample : cycle.samples) values.push_back(sample.*value);
  return values;
}

}  // namespace salebra
