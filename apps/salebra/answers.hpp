// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/law/fit.hpp>  // analysis/ has no problem for fits
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <string>
#include <vector>

/// Described structs of which commands make their answers and that the library does not have.
namespace salebra::cli {

struct ContactPressures {
  double pressure = 0, max_pressure = 0;  ///< nominal and largest contact pressure, Pa
};

constexpr void describe(auto&& visit, std::type_identity<ContactPressures>) {
  using enum Dimension;
  using S = ContactPressures;
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::max_pressure,
        Quantity{"max_pressure", Dimension::pressure, "largest contact pressure"});
}

struct SurfacePoints {
  bool periodic = false;
  Index undefined_points = 0, filled_points = 0;
  double mean = 0;  ///< mean height, m
};

constexpr void describe(auto&& visit, std::type_identity<SurfacePoints>) {
  using enum Dimension;
  using S = SurfacePoints;
  visit(&S::periodic, Quantity{"periodic", dimensionless, "whether the surface repeats itself"});
  visit(&S::undefined_points,
        Quantity{"undefined_points", dimensionless, "points without a height"});
  visit(&S::filled_points,
        Quantity{"filled_points", dimensionless, "points whose height was filled in"});
  visit(&S::mean, Quantity{"mean", length, "mean height"});
}

/// A bearing curve: at each percent of the area, the height above which this part of the surface
/// lies.
struct BearingTable {
  std::vector<double> area_fraction, height;  ///< 1 and m
};

constexpr void describe(auto&& visit, std::type_identity<BearingTable>) {
  using enum Dimension;
  using S = BearingTable;
  visit(&S::area_fraction, Quantity{"area_fraction", dimensionless, "part of the surface above"});
  visit(&S::height, Quantity{"height", length, "height"});
}

/// Anisotropy of a surface, with its correlation lengths in m if they are known.
struct Lay : Anisotropy {
  std::optional<double> correlation_length, correlation_length_along, correlation_length_across;
};

constexpr void describe(auto&& visit, std::type_identity<Lay>) {
  using enum Dimension;
  using S = Lay;
  describe(visit, std::type_identity<Anisotropy>{});
  visit(&S::correlation_length, Quantity{"correlation_length", length, "correlation length"});
  visit(&S::correlation_length_along,
        Quantity{"correlation_length_along", length, "correlation length along the lay"});
  visit(&S::correlation_length_across,
        Quantity{"correlation_length_across", length, "correlation length across the lay"});
}

/// Decay length l of a curve for three ways to weight its loads, m.
struct DecayLengths {
  double spacing = 0, equal = 0, force = 0;
};

constexpr void describe(auto&& visit, std::type_identity<DecayLengths>) {
  using S = DecayLengths;
  visit(&S::spacing, Kept{"spacing", "weighted by the range of gap of each sample"});
  visit(&S::equal, Kept{"equal", "equal weights"});
  visit(&S::force, Kept{"force", "weighted by the square of the force"});
}

/// How the decay length depends on the weights and on the window of the fit.
struct FitChoices {
  FitWeights weights = FitWeights::spacing;
  DecayLengths decay_length_by_weights;
  WindowSensitivity window_sensitivity;
};

constexpr void describe(auto&& visit, std::type_identity<FitChoices>) {
  using enum Dimension;
  using S = FitChoices;
  visit(&S::weights, Quantity{"weights", dimensionless, "weight of a sample"});
  visit(&S::decay_length_by_weights, Quantity{"decay_length_by_weights", length,
                                              "decay length for each way to weight the loads"});
  visit(&S::window_sensitivity, Part{"window_sensitivity", "fits to parts of the window"});
}

}  // namespace salebra::cli
