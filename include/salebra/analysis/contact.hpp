// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/operating_point.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/assumptions.hpp>
#include <string>
#include <variant>
#include <vector>

/// The contact of a problem: a law, or what a law is computed from, and the operating point.
namespace salebra {

/// Connection to the caller while a problem is solved.
struct Context {
  Progress on_progress = {};
  /// Called at every evaluation of a law, so that all searches and quadratures over it stop,
  /// whether or not they report progress: true throws Interrupted. Empty: never.
  std::function<bool()> stopped = {};
};

/// F = F0 exp(δ/l) about the first of its forces; F'' = F/l² whatever F0 is.
struct ExponentialContact {
  double decay_length = 0;   ///< l > 0, m
  double modulus_ratio = 0;  ///< G*/E* > 0
  std::vector<double> normal_force = {};
};

/// An axisymmetric indenter, load-controlled or at given indentations.
struct IndenterContact {
  std::shared_ptr<const IndenterProfile> profile;
  Material material;
  OperatingPoints at;
};

/// A computed or measured curve, at any control quantity that it has.
struct CurveContact {
  ForceCurve curve;
  double modulus_ratio = 0;  ///< G*/E* > 0, used where the curve has no K_t
  OperatingPoints at;
  std::string source = {};  ///< name of the curve in messages: its file
};

/// A surface; its law comes from a sweep of thirteen contacts about each pressure.
struct SurfaceContact {
  Surface surface;
  Material material;
  std::vector<double> pressure = {};  ///< nominal, Pa
  /// Hardness for a plastic first loading to the largest pressure and by an oscillation about it,
  /// Pa. None: elastic.
  std::optional<double> hardness = {};
  double normal_amplitude = 0;  ///< of that oscillation, m
};

using ContactProblem =
    std::variant<ExponentialContact, IndenterContact, CurveContact, SurfaceContact>;

/// The law of a contact, its operating points, and the data behind it.
struct ContactSolution {
  std::unique_ptr<const ContactLaw> law;
  std::vector<OperatingPoint> points;              ///< operating points on the law
  std::optional<ForceCurve> curve = {};            ///< curve behind the law
  std::optional<Surface> surface = {};             ///< swept surface, residual after first loading
  std::optional<FirstLoading> first_loading = {};  ///< first loading that left the residual surface
  std::vector<std::string> warnings = {};            ///< warnings: the input is valid but suspicious

  /// Index of the sample of the curve whose load is nearest to the first operating point.
  std::size_t load() const;
  double nominal_area() const { return curve ? curve->nominal_area : 0; }  ///< m²; 0: not known
  /// Adds to the contact parameters, at a mean and at the deepest indentation, those that the law,
  /// the curve and the first loading determine.
  ContactParameters parameters_at(ContactParameters parameters, double indentation, double deepest) const;
  /// Checks a loss that includes slip and finite amplitude: the assumptions of slip, slow motion
  /// and small amplitude hold without a value, and the others are checked.
  Assumptions assumptions_beside_slip(double indentation, const Oscillation& motion,
                                const ContactParameters& known) const;
};

/// Computes the law and the operating points of a contact.
///
///     ContactSolution contact = solve(SurfaceContact{surface, material, {1e6, 5e6}});
///
/// throws  InvalidInput for values that are not > 0, operating points beyond a curve, and as the
///         laws, after_first_loading() and sweep_pressures() do; NotConverged, Interrupted
/// cost    for a surface some thirteen contacts in full stick for each pressure, and the first
///         loading
ContactSolution solve(ContactProblem problem, const Context& context = {});

/// Returns the law alone, for a motion with its own indentations; operating points are ignored.
/// Throws InvalidInput for a surface, which has none before a sweep.
std::unique_ptr<const ContactLaw> law_of(const ContactProblem& problem,
                                         const Context& context = {});

/// A contact at rest.
struct LawState {
  double force = 0;                 ///< F, N
  double indentation = 0;           ///< δ, m
  double normal_stiffness = 0;      ///< K, N/m
  double tangential_stiffness = 0;  ///< K_t, N/m
};

constexpr void describe(auto&& visit, std::type_identity<LawState>) {
  using S = LawState;
  visit(&S::force, quantity::force);
  visit(&S::indentation, quantity::indentation);
  visit(&S::normal_stiffness, quantity::normal_stiffness);
  visit(&S::tangential_stiffness, quantity::tangential_stiffness);
}

/// An axisymmetric contact at rest.
struct IndenterState : LawState {
  double contact_radius = 0;   ///< a, m
  double force_curvature = 0;  ///< F'', N/m²
};

constexpr void describe(auto&& visit, std::type_identity<IndenterState>) {
  using S = IndenterState;
  describe(visit, std::type_identity<LawState>{});
  visit(&S::contact_radius, Quantity{"contact_radius", Dimension::length, "contact radius"});
  visit(&S::force_curvature, quantity::force_curvature);
}

/// Returns the state of a law at an indentation, m. Throws as the law.
LawState state_of(const ContactLaw& law, double indentation);
IndenterState state_of(const IndenterLaw& law, double indentation);

/// Mean summit of a surface with adhesion.
struct MeanSummit {
  double tabor = ForceSample::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<MeanSummit>) {
  visit(&MeanSummit::tabor,
        Quantity{"tabor", Dimension::dimensionless, "Tabor's parameter of the mean summit"});
}

/// Returns Tabor's parameter for the mean summit radius from the moments of the surface [Nayak
/// (1971)]; unknown where they are not those of a random surface, and without adhesion.
MeanSummit mean_summit(const Surface& surface, const Adhesion& adhesion, double contact_modulus);

/// Replaces the surface by the residual surface of the first loading and returns that loading;
/// without a hardness it does nothing.
/// contact  boundary, tolerance and progress
/// throws   NotConverged, Interrupted, and as after_first_loading()
std::optional<FirstLoading> load_first(Surface& surface, const std::optional<double>& hardness,
                                       double contact_modulus, double nominal_pressure,
                                       NormalContactOptions contact, double normal_amplitude = 0);

/// Warns about a table of radii beyond 1 m, most likely in another unit, or so coarse that omitting
/// every other point changes the indentation at this contact radius by more than 5 %.
std::vector<std::string> warnings_of_profile(const IndenterProfile& profile, double contact_radius);

}  // namespace salebra
