// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/damping/contact_element.hpp>
#include <salebra/export/deck.hpp>
#include <string>
#include <vector>

namespace salebra::detail {

/// One law of a deck per nominal area, with one value at each clearance of the deck. All numbers of
/// a deck are in its units.
struct DeckLaw {
  std::string name;  ///< "mean", "low" or "high"
  std::string what;  ///< which contacts it describes, such as "surface 3, the lowest of 8"
  std::vector<double> pressure, normal_stiffness;
  std::vector<double> tangential_stiffness = {};  ///< empty if not known
  std::vector<double> conductance = {};           ///< thermal, W/(m² K) in SI; empty if not wanted
  double stick_slope = DeckContact::unknown;      ///< K_t per nominal area at the operating point
  double normal_slope = DeckContact::unknown;     ///< K per nominal area there
  /// μp/stick_slope, with the pressure p at the operating point.
  double elastic_slip = DeckContact::unknown;
};

/// A spring in series with a Coulomb slider; it slips from the displacement slider_force/stiffness
/// on.
struct Slider {
  double stiffness = 0, slider_force = 0;
};

struct Deck {
  const DeckProblem& problem;
  std::vector<std::string> header = {};  ///< sentences at the top, without comment marks
  std::vector<double> clearance = {};    ///< from the farthest to the closest
  std::vector<DeckLaw> laws = {};        ///< the mean; for several surfaces also low and high
  std::vector<Slider> sliders = {};      ///< in the order in which they slip
  std::shared_ptr<const LawSprings> springs = {};
  double start = 0;          ///< indentation at which an FMU starts
  std::string library = {};  ///< the shared library of an FMU, if there is one
  /// Pressure at clearance 0, if the deck has one exponential law.
  double exponential_pressure = DeckContact::unknown;
  double exponential_length = DeckContact::unknown;  ///< decay length l of this law

  bool has_friction() const;
  bool has_conductance() const { return !problem.conductivity.empty(); }
};

/// How a format marks a comment, and which strings would end the comment or act as commands in it.
struct CommentStyle {
  std::string_view mark;  ///< at the beginning of each line
  std::vector<std::string_view> forbidden = {};
};

/// Writes a sentence as comment lines, none longer than the other programs read. The sentence may
/// quote a file and its name. Control characters and the strings that the style forbids are
/// therefore escaped, so that no part of the sentence can act as a command of the other program.
std::string comment(std::string_view sentence, const CommentStyle& style);

/// The clearance at which piecewise linear tables begin with pressure 0, the same for all laws of a
/// deck: that of first touch if the table begins there. It is at least the clearance at which the tangent at the farthest row reaches 0, so that
/// the tables stay convex.
double first_clearance(const Deck& deck);

enum class DeckContent { table, sliders, springs };

/// A format of decks: what it contains, and the function that writes it. A new format needs one
/// function and one entry of this type.
struct DeckWriter {
  DeckFormat format;
  std::string (*write)(const Deck&);
  DeckContent content = DeckContent::table;
  int max_rows = 100000;
  bool takes_conductance = false;
};
const DeckWriter& writer_of(DeckFormat format);

/// Sliders that represent the mean of contacts at their operating points (deck.hpp), in SI units.
struct SliderSet {
  std::vector<Slider> sliders;
  double stiffness = 0, force = 0;  ///< sums over all sliders, N/m and N
  double resolved =
      0;  ///< tangential force, over μF, beyond which one slider holds all that sticks
  double loss_error = 0;  ///< largest relative error of the loss per cycle, from min_force on
};
SliderSet jenkins_sliders(const std::vector<DeckContact>& contacts, double friction_coefficient,
                          int count, double min_force);

}  // namespace salebra::detail
