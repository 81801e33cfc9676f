// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space.hpp>

namespace salebra {

/// mixed: transforms in float, residuals and acceptance in double.
enum class Precision { mixed, full };

struct NormalContactOptions {
  /// Stop at e_c = Σp(g − g_min)/(Σp · h_rms) < tolerance, checked densely in double precision; 1e-14 … 1e-1.
  double tolerance = 1e-10;
  int max_iterations = 1000;  ///< on the finest level, >= 1
  Boundary boundary = Boundary::periodic;
  Precision precision = Precision::mixed;
  Progress on_progress = {};
};

/// Result of a normal contact. Unless converged, the numbers describe the last iterate and must not be used as the answer.
struct NormalContactState {
  Field pressure;  ///< (nx, ny), Pa, >= 0
  Field gap;       ///< (nx, ny), m, >= 0 up to the tolerance
  double mean_pressure = 0;          ///< Pa
  double force = 0;                  ///< N
  double mean_gap = 0;               ///< ū: mean of gap over all cells, m
  double indentation = 0;            ///< max h − mean h − ū for periodic, rigid approach for free boundaries; from first touch, m
  double contact_area_fraction = 0;  ///< cells with p > 0 over all cells
  double elastic_energy = 0;         ///< ½∫p u dA with zero-mean u (periodic), J
  double residual = 0;               ///< e_c reached
  int iterations = 0;                ///< on the finest level
  int fft_count = 0;                 ///< forward-and-backward pairs of the finest level, both precisions
  bool converged = false;
  bool interrupted = false;  ///< the progress callback said stop
};

/// Frictionless contact of a rigid rough surface with an elastic half-space, for a given nominal pressure:
///     minimise ½p·Gp − p·h, p >= 0, mean p = nominal_pressure;  û(q) = 2 p̂(q)/(E*|q|), û(0) = 0 (periodic).
/// contact_modulus   E* > 0, Pa;   nominal_pressure > 0, Pa
/// throws            InvalidInput before any work; non-convergence is returned, not thrown
NormalContactState press_to_pressure(const Surface& surface, double contact_modulus,
                                     double nominal_pressure,
                                     const NormalContactOptions& options = {});

/// The same contact for a given mean gap ū in (0, max h − mean h): the inverse of press_to_pressure.
NormalContactState press_to_mean_gap(const Surface& surface, double contact_modulus,
                                     double mean_gap, const NormalContactOptions& options = {});

/// The same contact for a given indentation δ > 0 from first touch, δ = max h + level of the plane; for periodic boundaries
/// δ = max h − mean h − ū, which must leave ū > 0. Free boundaries: the rigid approach.
NormalContactState press_to_indentation(const Surface& surface, double contact_modulus,
                                        double indentation,
                                        const NormalContactOptions& options = {});

/// Normal stiffness K = dF/dδ of the contact set {p > 0} of a state, by one linear solve with the set held: N/m.
double normal_stiffness(const NormalContactState& state, const Grid2D& grid,
                        double contact_modulus, const NormalContactOptions& options = {});

}  // namespace salebra
