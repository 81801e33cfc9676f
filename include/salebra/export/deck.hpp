// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/export/unit_system.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <vector>

/// Contact laws as input files ("decks") of other programs (docs/howto/decks.md lists formats and
/// their manuals).
namespace salebra {

enum class DeckFormat {
  csv,
  json,
  calculix,
  abaqus,
  ansys,
  code_aster,
  moose,
  elmer,
  jenkins,
  c_header,
  fmu
};
template <>
struct EnumNames<DeckFormat> {
  static constexpr auto values = std::to_array<std::pair<DeckFormat, std::string_view>>(
      {{DeckFormat::csv, "csv"},
       {DeckFormat::json, "json"},
       {DeckFormat::calculix, "calculix"},
       {DeckFormat::abaqus, "abaqus"},
       {DeckFormat::ansys, "ansys"},
       {DeckFormat::code_aster, "code_aster"},
       {DeckFormat::moose, "moose"},
       {DeckFormat::elmer, "elmer"},
       {DeckFormat::jenkins, "jenkins"},
       {DeckFormat::c_header, "c_header"},
       {DeckFormat::fmu, "fmu"}});
};

/// Selects one of several surfaces for a deck. `mean` is the mean of the surfaces. `low` and `high`
/// are single surfaces, ranked by their force at a given clearance: 2.5 % of the surfaces have a
/// smaller force than `low`, and 2.5 % a larger force than `high`.
enum class DeckCase { mean, low, high };
template <>
struct EnumNames<DeckCase> {
  static constexpr auto values = std::to_array<std::pair<DeckCase, std::string_view>>(
      {{DeckCase::mean, "mean"}, {DeckCase::low, "low"}, {DeckCase::high, "high"}});
};

/// A law with the additional data that a deck needs.
struct DeckContact {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::shared_ptr<const ContactLaw> law;
  double nominal_area = unknown;  ///< A, m²
  double sample_area = unknown;  ///< area of the sample that the law was scaled from, m²; NaN: not
                                 ///< scaled
  /// Indentation δ at which K_t (the stick slope) and the Jenkins sliders are computed, m; NaN: not
  /// given.
  double indentation = unknown;
  double lowest = unknown,
         highest = unknown;         ///< range of δ in decks, m; NaN: the full range of the law
  double clearance_origin = 0;      ///< clearance = clearance_origin − δ, m
  std::string clearance_from = {};  ///< reference of the clearance, as text
  double decay_length = unknown;    ///< l of an exponential law, m; NaN for other laws
  bool knows_tangential_stiffness = true;  ///< false: G* and K_t are unknown
};

/// Prepares a law for decks. `indentation` is DeckContact::indentation, m, by default 0 for an
/// exponential law. The clearance is −δ.
DeckContact deck_contact(std::shared_ptr<const ContactLaw> law,
                         std::optional<double> indentation = {});

/// Computes the law of a contact and prepares it for decks. G*/E* of a curve may be NaN if it has
/// K_t, or if none is needed. A law without a table is used from 0.001 to 10 times the force of its
/// operating point.
///     clearance   mean gap ū for a curve; −δ for a curve without mean gap and for an indenter; −δ
///                 for an exponential law, with δ = 0 at the first of its forces
/// Throws wherever solve(ContactProblem) does, and for several operating points.
DeckContact deck_contact(ContactProblem problem, const Context& context = {});

struct DeckProblem {
  std::vector<DeckContact> contacts;  ///< one, or one per surface of the same kind
  DeckFormat format = DeckFormat::csv;
  UnitSystem units = {};
  double friction_coefficient = DeckContact::unknown;  ///< μ > 0; NaN: decks without friction
  /// Nominal area of the part, m². Laws of contacts with a known nominal area are scaled to this
  /// area; any other law is taken as the law of the part. NaN: no scaling.
  double nominal_area = DeckContact::unknown;
  /// Nominal pressures in decks, Pa; empty: the full range of the contacts.
  std::optional<std::pair<double, double>> pressure_window = {};
  int rows = 200;                ///< rows of a table, 4 to 100000; at most 198 for CalculiX, 19 for
                                 ///< Ansys
  DeckCase of = DeckCase::mean;  ///< for elmer, jenkins, c_header and fmu; other formats have all
                                 ///< cases
  /// Jenkins sliders, 2 to 100000; in a C header and an FMU: springs, 8 to 4096.
  int sliders = 200;
  double min_force = 0.01;       ///< smallest T/(μF) at which the loss of the sliders is accurate
  std::string name = "contact";  ///< prefix of every name in a C header; name of an FMU
  /// Thermal conductivity κ of the bodies, W/(m K), as in Conduction; empty: no conductance in decks.
  std::vector<double> conductivity = {};
  double contact_modulus = DeckContact::unknown;  ///< E*, Pa; only for the conductance
  std::string source = {};                        ///< source of the contacts, written into the deck
  std::string comment = {};                       ///< additional sentence, written into the deck
  Provenance provenance = {};
};

struct DeckSolution {
  std::string text;  ///< the deck; of an FMU the bytes of its ZIP archive
  int surfaces = 0;  ///< number of surfaces used
  /// Largest relative error of the pressure when it is interpolated linearly between the rows of
  /// the mean law; below the lowest load of a curve the error is relative to the pressure there.
  double interpolation_error = DeckContact::unknown;
  double tangential_stiffness = DeckContact::unknown;  ///< total K_t of the Jenkins sliders, N/m
  double slip_force = DeckContact::unknown;            ///< total μF, N
  /// Largest relative error of the loss of the Jenkins sliders: at tangential forces from
  /// DeckProblem::min_force to 0.999 of μF, and at displacements beyond, where all slides.
  double loss_error = DeckContact::unknown;
  std::string platform = {};  ///< of the shared library in an FMU; empty: it has sources only
};

constexpr void describe(auto&& visit, std::type_identity<DeckSolution>) {
  using enum Dimension;
  using S = DeckSolution;
  visit(&S::text, Kept{"text", "the deck"});
  visit(&S::surfaces, Quantity{"surfaces", dimensionless, "number of surfaces"});
  visit(&S::interpolation_error,
        Quantity{"interpolation_error", dimensionless, "error of straight lines between rows"});
  visit(&S::tangential_stiffness, quantity::tangential_stiffness);
  visit(&S::slip_force, Kept{"slip_force", "tangential force at which all slips", force});
  visit(&S::loss_error, Quantity{"loss_error", dimensionless,
                                 "largest error of the loss from the smallest force on"});
  visit(&S::platform, Kept{"platform", "platform of the shared library in an FMU"});
}

/// Writes the text of a deck:
///     const DeckSolution deck = solve(DeckProblem{.contacts = {deck_contact(law)},
///                                              .format = DeckFormat::abaqus});
/// Tables list the pressure p = F/A over clearance, monotone and convex: a row that lies up to 1 %
/// above the straight line between other rows is moved to that line. Jenkins sliders: with ρ =
/// K_t/K at δ, the spring of stiffness K_t' dζ at depth ζ slips at displacements above x = (μ/ρ)(δ
/// − ζ), so the curve of first tangential loading T(x) has the slope T' = K_t(δ − ρx/μ), as in
/// joint_loss(). Each slider represents the springs that begin to slip between two displacements,
/// with their total stiffness and force: T and T' are exact at these displacements, and so are the
/// total K_t and μF. The error of the loss is of second order in the number of sliders. A C header
/// implements the steps of ContactElement without dependencies, with springs over the range of
/// clearances of the deck; without a coefficient of friction the contact is in full stick. An FMU is a
/// co-simulation unit of FMI 3.0 that takes these steps; its shared library is compiled by the
/// program `cc`, if there is one. The thermal conductance h = 2K/[A E*(1/κ_1 + 1/κ_2)] is a table over
/// the pressure, from h = 0 at p = 0.
/// throws  InvalidInput for a force that does not grow with approach, a curve that is not convex, a
///         missing area, K_t, operating point, E* or coefficient of friction that the format needs, a
///         conductivity for a format without conductance,
///         surfaces without a common range, and numbers out of range
/// cost    about ten evaluations of each law for each row or slider
DeckSolution solve(const DeckProblem& problem);

}  // namespace salebra
