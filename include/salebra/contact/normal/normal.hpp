// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/half_space/contact_set.hpp>
#include <salebra/contact/half_space/material.hpp>

namespace salebra {

/// mixed: transforms in float, residuals and acceptance in double.
enum class Precision { mixed, full };

template <>
struct Words<Precision> {
  static constexpr auto values = std::to_array<std::pair<Precision, std::string_view>>(
      {{Precision::mixed, "mixed"}, {Precision::full, "full"}});
};

/// Where a contact shall stand: exactly one of these.
struct Target {
  std::optional<double> pressure = {};  ///< nominal, > 0, below the hardness, Pa
  /// ū in (0, max h − mean h), m. Periodic and elastic contacts only: a free one has no mean gap,
  /// and hardness makes the gap depend on more than the approach.
  std::optional<double> mean_gap = {};
  /// Rigid approach from first touch, > 0, m; below max h − mean h for periodic contacts.
  std::optional<double> indentation = {};
  std::optional<double> force = {};  ///< > 0, N: the pressure times the nominal area
};

struct NormalContactOptions {
  /// Stop at e_c = Σp(g − g_min)/(Σp · h_rms) < tolerance, checked densely in double precision;
  /// 1e-14 … 1e-1. For a flat punch h_rms is replaced by the indentation, or by pressure·√area/E*.
  double tolerance = 1e-10;
  int max_iterations = 1000;  ///< on the finest level, >= 1
  Boundary boundary = Boundary::periodic;
  Precision precision = Precision::mixed;
  /// Largest pressure that the bodies carry, Pa: perfectly plastic cells saturate there and sink in
  /// without further load.
  double hardness = std::numeric_limits<double>::infinity();
  /// Start of the iteration, of the shape of the heights, Pa, >= 0, instead of one from coarser
  /// grids. It must outlive the call.
  const Field* initial_pressure = nullptr;
  Progress on_progress = {};
  /// Called between iterations on the finest grid with the present pressure, of the shape of the
  /// heights, Pa, from which a later call may start: by every process at the same iteration, of a
  /// sweep by several threads. Results keep their bits. It throws on all or on none.
  std::function<void(const Field& pressure)> on_checkpoint = {};
  double checkpoint_every = 600;  ///< s of the root's clock, >= 0; 0: after each iteration
};

/// Result of a normal contact. Unless converged, the numbers describe the last iterate and must not
/// be used as the answer.
struct NormalContactState {
  Field contact_pressure;    ///< (nx, ny) or the rows of this process, Pa, >= 0
  Field gap;                 ///< the same, m, >= 0 up to the tolerance; 0 where pressure saturates
  double mean_pressure = 0;  ///< Pa
  double force = 0;          ///< N
  double mean_gap = 0;       ///< ū: mean of gap over all cells, m
  double indentation =
      0;  ///< rigid approach from first touch, m; periodic and elastic: max h − mean h − ū
  double contact_area_fraction = 0;  ///< cells with p > 0 over all cells
  double elastic_energy = 0;         ///< ½∫p u dA with zero-mean u (periodic), J
  double residual = 0;               ///< e_c reached
  int iterations = 0;                ///< on the finest level
  int fft_count = 0;     ///< forward-and-backward pairs of the finest level, both precisions
  int ladder_count = 0;  ///< applications of the near-field ladder there, each in place of a pair
  Termination termination = Termination::iteration_limit;
  Communicator ranks = {};  ///< the processes that hold the fields, as those of the surface

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<NormalContactState>) {
  using enum Dimension;
  using S = NormalContactState;
  visit(&S::contact_pressure,
        Quantity{"contact_pressure", Dimension::pressure, "contact pressure"});
  visit(&S::gap, Quantity{"gap", length, "gap of the deformed surfaces"});
  visit(&S::mean_pressure, Kept{"mean_pressure", "nominal pressure", Dimension::pressure});
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::indentation, Quantity{"indentation", length, "indentation"});
  visit(&S::contact_area_fraction,
        Quantity{"contact_area_fraction", dimensionless, "contact area over nominal area"});
  visit(&S::elastic_energy, Quantity{"elastic_energy", energy, "elastic energy"});
  visit(&S::residual, Quantity{"residual", dimensionless, "residual of the contact"});
  visit(&S::iterations, Quantity{"iterations", dimensionless, "iterations of the solver"});
  visit(&S::fft_count,
        Quantity{"fft_count", dimensionless, "Fourier transforms of the solver, in pairs"});
  visit(&S::ladder_count,
        Quantity{"ladder_count", dimensionless, "applications of the near-field ladder"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Quantity{"converged", dimensionless, "whether the contact converged"});
  visit(&S::ranks, Kept{});
}

/// Cells with p > 0.
ContactSet contact_set(const NormalContactState& state);

/// Frictionless contact of a rigid rough surface with an elastic half-space, for a given nominal
/// pressure:
///     minimise ½p·Gp − p·h, 0 <= p <= hardness, mean p = nominal pressure;  û(q) = 2 p̂(q)/(E*|q|), û(0) = 0 (periodic)
/// by nested conjugate gradients on the contact set with a preconditioner that needs no transform;
/// or the same contact by its force, mean gap or indentation. It departs from the usual constrained
/// CG of Polonsky and Keer (1999) in that CG is not restarted when the set changes. On large grids
/// of which the contact and its neighbourhood are a small part, the iterations apply a ladder of
/// stencils in place of G, and exact transforms only renew the gap. A surface may be spread over
/// several processes: the call is then collective, and all numbers have the same bits as in one
/// process.
/// contact_modulus   E* > 0, Pa
/// throws            InvalidInput before any work; non-convergence is returned, not thrown
/// cost              15 to 100 iterations of one transform pair each, or of one application of the
///                   ladder and 5 to 7 pairs in all; at a mean gap 3 to 20 times as many where more
///                   than 0.99 of the cells touch; 50 to 75 bytes a cell with heights and result,
///                   the more the larger the contact (docs/performance.md)
NormalContactState press(const Surface& surface, double contact_modulus, const Target& target,
                         const NormalContactOptions& options = {});

/// Normal stiffness K = dF/dδ of the contact set {0 < p < hardness} of a state, by one linear solve
/// with the set held: N/m. punch_pressure, where given, receives dp/dδ of the cells, Pa/m (left
/// alone where K is not found by a solve). +infinity for a periodic cell in full contact, NaN where
/// the solve did not converge within max_iterations or was interrupted. Cost: as many iterations as
/// the contact took, with one transform pair each, or on the ladder with three pairs in all.
double normal_stiffness(const NormalContactState& state, const Grid2D& grid, double contact_modulus,
                        const NormalContactOptions& options = {}, Field* punch_pressure = nullptr);

}  // namespace salebra
