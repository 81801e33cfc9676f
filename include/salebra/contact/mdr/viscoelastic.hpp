// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <salebra/base/describe.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <span>
#include <vector>

/// Axisymmetric contact of a linearly viscoelastic half-space with a rigid indenter, by the method
/// of dimensionality reduction.
///     const auto result = viscoelastic_indentation(law, prony, time, indentation);
namespace salebra {

/// One term G exp(−t/τ) of a Prony series.
struct PronyTerm {
  double modulus = 0;          ///< G > 0, Pa
  double relaxation_time = 0;  ///< τ > 0, s
};

constexpr void describe(auto&& visit, std::type_identity<PronyTerm>) {
  using enum Dimension;
  using S = PronyTerm;
  visit(&S::modulus, Kept{"modulus", "shear modulus of the term", pressure});
  visit(&S::relaxation_time, Quantity{"relaxation_time", Dimension::time, "relaxation time"});
}

/// Shear relaxation modulus of an isotropic material, G(t) = G∞ + Σ G_i exp(−t/τ_i): a series with
/// one term is the standard linear solid, a series without terms is an elastic solid. Poisson's
/// ratio does not depend on time.
struct PronySeries {
  double relaxed_modulus = 0;  ///< G∞ > 0, Pa
  std::vector<PronyTerm> terms;

  /// Returns the series of one viscoelastic body against a rigid one, from E* and G* of the relaxed
  /// state: Poisson's ratio ν follows from 1 − ν = g/(2 − g), g = G*/E*, and G∞ = E*(1 − ν)/2.
  static PronySeries of_body(const Material& relaxed, std::vector<PronyTerm> terms);

  double unrelaxed_modulus() const;  ///< G(0) = G∞ + Σ G_i, Pa
  /// Complex shear modulus G' + iG'' = G∞ + Σ G_i iωτ_i/(1 + iωτ_i), Pa.
  std::complex<double> complex_modulus(double angular_frequency) const;
  /// Throws InvalidInput, whose message names the term, unless all moduli and relaxation times are
  /// finite and > 0.
  void validate() const;
};

constexpr void describe(auto&& visit, std::type_identity<PronySeries>) {
  using enum Dimension;
  using S = PronySeries;
  visit(&S::relaxed_modulus,
        Quantity{"relaxed_modulus", pressure, "shear modulus after a long time"});
  visit(&S::terms, Kept{"terms", "moduli and relaxation times"});
  visit(&S::unrelaxed_modulus,
        Quantity{"unrelaxed_modulus", pressure, "shear modulus after a short time"});
}

/// Force and contact radius along an indentation path, and the state of the springs of the elastic
/// foundation at the end of the path.
struct ViscoelasticIndentation {
  std::vector<double> force;            ///< F at the samples, N
  std::vector<double> contact_radius;   ///< a at the samples, m; 0 without contact
  std::vector<double> spring_position;  ///< x of each spring, m, increasing
  std::vector<double>
      spring_load;  ///< q_z(x) of both sides at the last sample, N/m; 0 outside the contact
  std::vector<double>
      spring_displacement;  ///< w(x) at the last sample, m, > δ − g(x) outside the contact
};

constexpr void describe(auto&& visit, std::type_identity<ViscoelasticIndentation>) {
  using enum Dimension;
  using S = ViscoelasticIndentation;
  visit(&S::force, Kept{"force", "normal force at the samples", Dimension::force});
  visit(&S::contact_radius, Kept{"contact_radius", "contact radius at the samples", length});
  visit(&S::spring_position, Kept{"spring_position", "position of the springs", length});
  visit(&S::spring_load,
        Kept{"spring_load", "load of both sides on a spring at the last sample over its width",
             stiffness});
  visit(&S::spring_displacement,
        Kept{"spring_displacement", "displacement of the springs at the last sample", length});
}

/// Indents an undisturbed body at rest along an indentation path δ(t), linear between the samples.
/// Each spring of the elastic foundation has the load q per length, the displacement w and internal
/// variables y_i, which obey
///     q = E*∞ [w + Σ (G_i/G∞) y_i],    y_i' = w' − y_i/τ_i.
/// In contact w = δ − g(x), with the image g of the indenter, and q >= 0; a spring separates when q
/// falls to 0, then recovers with q = 0, and touches again when δ − g(x) reaches w. This is exact
/// for every path and any axisymmetric profile with increasing image g, if all terms of the Prony
/// series are positive (docs/theory.md, section 9). For a growing contact it agrees with the
/// correspondence principle of Lee and Radok (1960), for one loading and unloading with the
/// solution of Ting (1966).
/// law          law of the relaxed body, E* = 2G∞/(1 − ν); of the series only the ratios G_i/G∞ are
///              used
/// time         s, strictly increasing
/// indentation  m, one value per time, at least two; at δ < 0 the indenter is above the body; δ > 0
///              at the first sample is reached instantly
/// springs      number of springs over the largest contact radius; errors are of second order in
///              the time step and in the spring width
/// throws       InvalidInput for arguments that violate these conditions, and if δ leaves the
///              profile
/// cost         samples × springs × terms of the series
ViscoelasticIndentation viscoelastic_indentation(const IndenterLaw& law, const PronySeries& prony,
                                                 std::span<const double> time,
                                                 std::span<const double> indentation,
                                                 int springs = 400);

}  // namespace salebra
