// SPDX-License-Identifier: GPL-3.0-or-later
// Configurations of all combinations of varied parameters, and short descriptions of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/configuration.hpp>

namespace salebra {
namespace {

/// Replaces the list of configurations by copies of it, one for each value, in which
/// change(configuration, value) was made. Without values the list stays as it is.
template <class Value, class Change>
void vary(std::vector<StudyConfiguration>& configurations, const std::vector<Value>& values,
          Change change) {
  if (values.empty()) return;
  std::vector<StudyConfiguration> varied;
  for (const StudyConfiguration& configuration : configurations)
    for (const Value& value : values) {
      varied.push_back(configuration);
      change(std::get<GeneratedSurfaces>(varied.back().surfaces), value);
    }
  configurations = std::move(varied);
}

constexpr double max_points = 1e4, max_bytes = 256e6;

/// Throws if there are too many combinations. Counts them before any is made: three lists of 2000
/// values have 8e9 combinations.
void require_countable(const StudyConfiguration& configuration) {
  const ParameterLists& lists = configuration.ensemble;
  double points = 1;
  for (const std::size_t values :
       {lists.hurst.size(), lists.rolloff.size(), lists.short_cutoff.size(), lists.size_x.size(),
        lists.points.size()})
    points *= double(std::max<std::size_t>(values, 1));
  const auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  const double each = double(sizeof configuration + configuration.text.size() +
                             8 * (surfaces.seeds.size() + configuration.pressures.size()));
  if (points > 1 && (points > max_points || points * each > max_bytes))
    throw InvalidInput(
        "ensemble",
        fmt::format("its lists make {:.0f} combinations with {:.3g} MB of settings; at most {:.0f} "
                    "combinations and {:.0f} MB are allowed; split the study",
                    points, points * each / 1e6, max_points, max_bytes / 1e6));
}

Index scaled(Index count, double factor, double size) {
  const double wanted = double(count) * factor;
  const auto whole = Index(std::llround(wanted));
  require(
      whole >= 2 && std::abs(wanted - double(whole)) < 1e-6 * wanted, "size_x", size,
      fmt::format(
          "m would need {} points for cells of the same size; use a size that gives a whole number",
          wanted));
  return whole;
}

}  // namespace

std::vector<StudyConfiguration> parameter_combinations(const StudyConfiguration& configuration) {
  const ParameterLists lists = configuration.ensemble;
  std::vector<StudyConfiguration> points{configuration};
  points.front().ensemble = {};
  if (lists.empty()) return points;
  require(std::holds_alternative<GeneratedSurfaces>(configuration.surfaces), "ensemble",
          "parameters", "apply only to generated surfaces; a measured surface cannot be varied");
  require_countable(configuration);
  vary(points, lists.hurst, [](GeneratedSurfaces& s, double value) { s.spectrum.hurst = value; });
  vary(points, lists.rolloff,
       [](GeneratedSurfaces& s, double value) { s.spectrum.rolloff = value; });
  vary(points, lists.short_cutoff,
       [](GeneratedSurfaces& s, double value) { s.spectrum.short_cutoff = value; });
  vary(points, lists.size_x, [](GeneratedSurfaces& s, double value) {
    const double factor = value / s.grid.lx;
    s.grid = {scaled(s.grid.nx, factor, value), scaled(s.grid.ny, factor, value), value,
              s.grid.ly * factor};
  });
  vary(points, lists.points, [](GeneratedSurfaces& s, Index value) {
    s.grid.ny = scaled(s.grid.ny, double(value) / double(s.grid.nx), s.grid.lx);
    s.grid.nx = value;
  });
  for (const StudyConfiguration& point : points) {
    const auto& surfaces = std::get<GeneratedSurfaces>(point.surfaces);
    surfaces.spectrum_of_all()->require_carried_by(surfaces.grid);
  }
  return points;
}

std::string describe_point(const ParameterLists& varied, const StudyConfiguration& point) {
  if (varied.empty()) return "";
  const auto& surfaces = std::get<GeneratedSurfaces>(point.surfaces);
  const auto length = [](double value) { return format_quantity(value, Dimension::length); };
  std::vector<std::string> parts;
  if (!varied.hurst.empty()) parts.push_back(fmt::format("H = {}", surfaces.spectrum.hurst));
  if (!varied.rolloff.empty()) parts.push_back("roll-off " + length(*surfaces.spectrum.rolloff));
  if (!varied.short_cutoff.empty())
    parts.push_back("cut-off " + length(surfaces.spectrum.short_cutoff));
  if (!varied.size_x.empty()) parts.push_back("size " + length(surfaces.grid.lx));
  if (!varied.points.empty() || !varied.size_x.empty())
    parts.push_back(fmt::format("{} x {} points", surfaces.grid.nx, surfaces.grid.ny));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace salebra
