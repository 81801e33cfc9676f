// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/law/fit.hpp>  // a fit has one face, and is no problem
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <string>
#include <vector>

/// What commands answer beside the structs of the library.
namespace salebra::cli {

struct ContactPressures {
  double pressure = 0, max_pressure = 0;  ///< nominal and largest, Pa
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
  double mean = 0;  ///< m
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

/// A bearing curve at each percent of the surface.
struct BearingTable {
  std::vector<double> area_fraction, height;  ///< 1, m
};

constexpr void describe(auto&& visit, std::type_identity<BearingTable>) {
  using enum Dimension;
  using S = BearingTable;
  visit(&S::area_fraction, Quantity{"area_fraction", dimensionless, "part of the surface above"});
  visit(&S::height, Quantity{"height", length, "height"});
}

/// A stretched surface, and the correlation lengths where it has them, m.
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

/// l for each way to weight the loads, m.
struct DecayLengths {
  double spacing = 0, equal = 0, force = 0;
};

constexpr void describe(auto&& visit, std::type_identity<DecayLengths>) {
  using S = DecayLengths;
  visit(&S::spacing, Kept{"spacing", "by the gap that each stands for"});
  visit(&S::equal, Kept{"equal", "all alike"});
  visit(&S::force, Kept{"force", "by the square of the force"});
}

/// What a fit owes to its weights and its window.
struct FitChoices {
  FitWeights weights = FitWeights::spacing;
  DecayLengths decay_length_by_weights;
  WindowSensitivity window_sensitivity;
};

constexpr void describe(auto&& visit, std::type_identity<FitChoices>) {
  using enum Dimension;
  using S = FitChoices;
  visit(&S::weights, Quantity{"weights", dimensionless, "what a sample counts"});
  visit(&S::decay_length_by_weights, Quantity{"decay_length_by_weights", length,
                                              "decay length for each way to weight the loads"});
  visit(&S::window_sensitivity, Part{"window_sensitivity", "fits to parts of the window"});
}

}  // namespace salebra::cli
