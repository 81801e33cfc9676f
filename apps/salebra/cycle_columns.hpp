// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/io/result_file.hpp>
#include <vector>

/// What results on a grid and records of a cycle, with friction or without, have in common in a file.
namespace salebra::cli {

inline void write_axes(ResultGroup& group, const Grid2D& grid) {
  group.coordinate("x", positions(grid.nx, grid.dx()), "m", "position along x");
  group.coordinate("y", positions(grid.ny, grid.dy()), "m", "position along y");
}

/// One quantity of all samples of a cycle.
template <class Cycle, class Sample>
std::vector<double> column(const Cycle& cycle, double Sample::*quantity) {
  std::vector<double> values;
  for (const Sample& sample : cycle.samples) values.push_back(sample.*quantity);
  return values;
}

/// Adds quantities over time, which is the coordinate of all.
template <class Sample, class Cycle>
class CycleColumns {
 public:
  CycleColumns(ResultGroup& group, const Cycle& cycle) : group_(group), cycle_(cycle) {
    group_.coordinate("time", column(cycle_, &Sample::t), "1", "time in periods");
    add("indentation", &Sample::indentation, "m", "indentation");
    add("tangential", &Sample::tangential, "m", "tangential displacement");
    add("tangential_force", &Sample::tangential_force, "N", "tangential force");
    add("force", &Sample::normal_force, "N", "normal force");
    add("work", &Sample::work, "J", "work of the tangential force since the start");
    add("contact_area", &Sample::contact_area, "m^2", "contact area");
  }
  void add(const char* name, double Sample::*quantity, const char* units, const char* text) {
    group_.dataset(name, column(cycle_, quantity), {"time"}, units, text);
  }

 private:
  ResultGroup& group_;
  const Cycle& cycle_;
};

}  // namespace salebra::cli
