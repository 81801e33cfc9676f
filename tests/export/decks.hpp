// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <memory>
#include <salebra/export/deck.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// Contacts whose law has a closed form, and a reader of decks that shares nothing with their
/// writers: it reads the numbers of each line.
namespace salebra::testing {

constexpr double decay_length = 100e-9, force0 = 10, area0 = 1e-6, modulus_ratio = 0.8;

inline DeckContact exponential() {
  DeckContact contact = deck_contact(ExponentialContact{decay_length, modulus_ratio, {force0}});
  contact.nominal_area = area0;
  return contact;
}

/// F = F0 (1 − ū/h)³ of a curve with mean gaps from 0.1 h to 0.8 h, times `factor`.
inline ForceCurve cubic_curve(double factor = 1, double height = 1e-6) {
  ForceCurve curve{.model = "cubic", .nominal_area = area0, .rms_height = height, .samples = {}};
  for (int i = 0; i <= 200; ++i) {
    const double rest = 0.2 + 0.7 * i / 200, force = factor * force0 * rest * rest * rest;
    const double stiffness = 3 * force / (rest * height);
    curve.samples.push_back({.mean_gap = (1 - rest) * height,
                             .force = force,
                             .pressure = force / area0,
                             .normal_stiffness = stiffness,
                             .tangential_stiffness = modulus_ratio * stiffness});
  }
  return curve;
}

inline DeckContact cubic(double factor = 1) {
  return deck_contact(CurveContact{cubic_curve(factor),
                                   DeckContact::unknown,
                                   {ControlQuantity::pressure, {force0 / area0 / 8}},
                                   "curve"});
}

/// Thermal conductivities of two bodies, W/(m K), and the contact modulus, Pa.
inline const std::vector<double> conductivity{50, 400};
constexpr double contact_modulus = 115e9;

/// h of the cubic law at a pressure, W/(m² K): K/A = 3 p/(rest h_rms), rest = (p A/F0)^(1/3).
inline double conductance(double pressure) {
  const double rest = std::cbrt(pressure * area0 / force0);
  return 2 * (3 * pressure / (rest * 1e-6)) / (contact_modulus * (1 / 50. + 1 / 400.));
}

/// Rows of numbers after the first line with `start`, up to a line without numbers. Characters that
/// belong to no number separate numbers.
inline std::vector<std::vector<double>> rows_after(const std::string& text,
                                                   const std::string& start) {
  std::istringstream lines(text.substr(text.find(start)));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<double> row;
    for (char& symbol : line)
      if (std::string("0123456789+-.e").find(symbol) == std::string::npos) symbol = ' ';
    std::istringstream words(line);
    for (std::string word; words >> word;)
      if (word.find_first_of("0123456789") != std::string::npos) row.push_back(std::stod(word));
    if (row.empty()) break;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace salebra::testing
