// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <salebra/damping/contact_element.hpp>
#include <salebra/export/deck.hpp>
#include <string>
#include <vector>

namespace salebra::detail {

/// One law of a deck, per nominal area, on the clearances of the deck. All numbers of a deck are in
/// its units.
struct DeckLaw {
  std::string name;  ///< mean, low, high
  std::string what;  ///< "surface 3, the lowest of 8"
  std::vector<double> pressure, normal_stiffness;
  std::vector<double> tangential_stiffness = {};  ///< empty: not known
  double stick_slope = DeckContact::unknown;      ///< K_t/A at the position
  double elastic_slip = DeckContact::unknown;     ///< μp over it
};

/// Stiffness and force of a slider; it slips at their quotient.
struct Slider {
  double stiffness = 0, slider_force = 0;
};

struct Deck {
  const DeckProblem& problem;
  std::vector<std::string> header = {};  ///< lines, without the marks of comments
  std::vector<double> clearance = {};    ///< from the farthest to the closest
  std::vector<DeckLaw> laws = {};        ///< the mean, and of several surfaces low and high
  std::vector<Slider> sliders = {};      ///< from the one that slips first on
  std::shared_ptr<const LawSprings> springs = {};
  double exponential_pressure = DeckContact::unknown;  ///< at clearance 0, of one exponential law
  double exponential_length = DeckContact::unknown;    ///< l of it

  bool has_friction() const;
};

/// How a format marks a comment, and what would end one or be obeyed in it.
struct CommentStyle {
  std::string_view mark;  ///< before each line
  std::vector<std::string_view> forbidden = {};
};

/// A sentence as lines of a comment, none longer than what the programs read. It may hold what a file
/// says and what a file is called, hence control characters and what the style forbids are escaped:
/// whatever the sentence holds, the other program takes nothing of it for a command.
std::string comment(std::string_view sentence, const CommentStyle& style);

/// The clearance at which piecewise linear tables start without a pressure, the same for all laws of
/// a deck: no closer than where the tangent at the farthest row meets zero, so that they stay convex.
double first_clearance(const Deck& deck);

enum class DeckContent { table, sliders, springs };

/// What a format holds, and how it is written. A format is a function and a row.
struct DeckWriter {
  DeckFormat format;
  std::string (*write)(const Deck&);
  DeckContent content = DeckContent::table;
  int max_rows = 100000;
};
const DeckWriter& writer_of(DeckFormat format);

/// Sliders of contacts at their positions (deck.hpp), SI.
struct SliderSet {
  std::vector<Slider> sliders;
  double stiffness = 0, force = 0;  ///< of all together
  double resolved = 0;              ///< T/(μF) up to which levels within the law slip
  double loss_error = 0;            ///< relative, at the smallest force
};
SliderSet jenkins_sliders(const std::vector<DeckContact>& contacts, double friction_coefficient,
                          int count, double min_force);

}  // namespace salebra::detail
