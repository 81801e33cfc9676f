// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/force_curve.hpp>
#include <salebra/contact/material.hpp>
#include <vector>

namespace salebra {

enum class SummitDistribution { gaussian, exponential };

/// A statistical ensemble of equal spherical caps.
struct SummitEnsemble {
  double density = 0;      ///< η, 1/m²
  double radius = 0;       ///< R, m
  double summit_rms = 0;   ///< σ_s: standard deviation (Gaussian), decay length (exponential) of summit heights, m
  double mean_height = 0;  ///< mean summit height above the mean plane of the surface, m
  SummitDistribution distribution = SummitDistribution::gaussian;
};

}  // namespace salebra
