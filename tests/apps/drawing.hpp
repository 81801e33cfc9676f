// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "run_program.hpp"

/// What the program gives gnuplot to draw: a program of that name in the test's folder keeps the
/// script in its place. Values are in the units of the axes, with their SI prefixes, and logarithms
/// along logarithmic axes.
class Drawing {
 public:
  /// `salebra ARGUMENTS --plot drawn.svg` in the folder of the test, which must work.
  Drawing(const ProgramTest& test, const std::string& arguments);

  /// The program's answer, for arguments with --json.
  nlohmann::json answer() const { return result_.json(); }
  const std::string& script() const { return script_; }
  /// Column of a curve: 0 x, 1 y, 2 and 3 the limits of its band. Panels count from 1, curves of a
  /// panel from 0, as the script has it.
  std::vector<double> column(int panel, int curve, std::size_t number) const;
  /// Rows of the map of a panel, the lowest first.
  std::vector<std::vector<double>> image(int panel) const;

 private:
  std::vector<std::vector<double>> block(const std::string& name) const;
  ProgramTest::Result result_;
  std::string script_;
};
