// SPDX-License-Identifier: GPL-3.0-or-later
// Texts with heights as instruments write them, drawn by seed: each is read right, or refused.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>

#include "io/loaded_surface.hpp"

using namespace salebra;

namespace {

/// Draws from lists, the same on every machine.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  bool chance(double share) { return static_cast<double>(engine_()) < share * 4294967296.; }
  template <typename Value, std::size_t size>
  Value of(const Value (&list)[size]) {
    return list[below(static_cast<int>(size))];
  }

 private:
  std::mt19937 engine_;
};

struct Unit {
  const char* word;
  double metres;
};

constexpr Unit units[]{
    {"m", 1},          {"mm", 1e-3},        {"um", 1e-6},          {"\u00b5m", 1e-6},
    {"\u03bcm", 1e-6}, {"nm", 1e-9},        {"microns", 1e-6},     {"micrometers", 1e-6},
    {"micron", 1e-6},  {"mm", 1e-3},        {"millimeters", 1e-3}, {"\u00c5", 1e-10},
    {"MM", 1e-3},      {"Angstrom", 1e-10}, {"UM", 1e-6},          {"V", 0},
    {"a.u.", 0}};

constexpr const char* x_titles[]{"X",
                                 "x",
                                 "X-Axis",
                                 "X Position",
                                 "Position X",
                                 "X-Achse",
                                 "Axe X",
                                 "X-Koordinate",
                                 "Coordonn\u00e9e X",
                                 "X coordinate",
                                 "X-jiku",
                                 "yoko",
                                 "Strecke X",
                                 "Ost"};
constexpr const char* y_titles[]{"Y",
                                 "y",
                                 "Y-Axis",
                                 "Y Position",
                                 "Position Y",
                                 "Y-Achse",
                                 "Axe Y",
                                 "Y-Koordinate",
                                 "Coordonn\u00e9e Y",
                                 "Y coordinate",
                                 "Y-jiku",
                                 "tate",
                                 "Strecke Y",
                                 "Nord"};
constexpr const char* way_titles[]{
    "X",          "Position", "Distance",      "Weg",        "Strecke",  "Track",
    "Messweg",    "Tastweg",  "Abscissa",      "Abszisse",   "Abscisse", "Lateral",
    "kyori",      "ichi",     "Length",        "L\u00e4nge", "Longueur", "nagasa",
    "Verfahrweg", "Parcours", "Scan position", "Travel",     "Lauf",     "Chemin"};
constexpr const char* z_titles[]{
    "Z",          "Height",      "H\u00f6he",     "Hoehe",         "Hauteur",
    "takasa",     "Amplitude",   "Profile",       "Profil",        "R",
    "P",          "Value",       "Wert",          "Valeur",        "Altitude",
    "Topography", "Topographie", "Rauheit",       "Rugosit\u00e9", "arasa",
    "Roughness",  "Elevation",   "Height Sensor", "Z-Achse",       "Profilh\u00f6he",
    "Messwert",   "Auslenkung",  "Ordinate",      "kodo",          "Relief"};
constexpr const char* index_titles[]{"Index", "No.",   "Nr.", "#",       "Punkt",
                                     "Point", "bango", "n",   "lfd. Nr."};
constexpr const char* other_titles[]{"Intensity", "Intensit\u00e4t", "Intensit\u00e9", "kido",
                                     "Error",     "Quality",         "Kontrast",       "Reflet"};

/// Lines that say nothing about the heights, as far as a person can tell.
constexpr const char* distractors[]{"Date: 2026-03-17",
                                    "Datum: 17.03.2026 10:30",
                                    "Date : 17/03/2026",
                                    "Time: 10:30:05",
                                    "Serial number: 104523",
                                    "Seriennummer: A-1045",
                                    "Num\u00e9ro de s\u00e9rie : 1045",
                                    "Magnification: 50",
                                    "Vergr\u00f6\u00dferung: 50x",
                                    "Grossissement : 20",
                                    "bairitsu: 100",
                                    "Objective: 50x",
                                    "Voltage: 5 kV",
                                    "Spannung: 15 V",
                                    "Tension : 15 kV",
                                    "Operator: M. Huber",
                                    "Bediener: Anna",
                                    "Version 3.2.1",
                                    "Software version: 4.1",
                                    "hizuke: 2026/03/17",
                                    "Speed: 0.5 mm/s",
                                    "Vitesse: 0,5 mm/s",
                                    "Temperature: 21 \u00b0C",
                                    "Sample: part 7",
                                    "Probe: 12",
                                    "Cutoff: 0.8 mm",
                                    "Tip radius: 2 \u00b5m",
                                    "Messkraft: 0.75 mN",
                                    "Comment: polished",
                                    "kion: 20 \u00b0C",
                                    "Pr\u00fcfer: KL",
                                    "Laser wavelength: 405 nm",
                                    "Exposure: 12 ms"};

struct Case {
  std::string text, said;
  bool clear = true;  ///< a person would read it
  bool profile = false;
  int nx = 0, ny = 1;
  double size_x = 0, size_y = 0;
  std::vector<double> heights;  ///< m, y fastest; NaN where undefined
};

class Writer {
 public:
  explicit Writer(unsigned seed) : draw_(seed) {}

  Case write() {
    comma_ = draw_.chance(0.3);
    separator_ = comma_ ? draw_.of({';', '\t', ' '}) : draw_.of({';', '\t', ' ', ','});
    const int kind = draw_.below(3);
    result_.profile = kind == 0;
    result_.nx = 5 + draw_.below(12);
    result_.ny = result_.profile ? 1 : 4 + draw_.below(10);
    lateral_ = units[draw_.below(13)];
    vertical_ = draw_.chance(0.03) ? units[15 + draw_.below(2)] : units[draw_.below(15)];
    if (vertical_.metres == 0) result_.clear = false;
    mark_ = draw_.of(marks);
    if (separator_ == ' ' && *mark_ == '\0') mark_ = "nan";
    step_x_ = (1 + draw_.below(40)) * draw_.of({0.05, 0.1, 0.25, 1.});
    step_y_ = draw_.chance(0.5) ? step_x_ : (1 + draw_.below(40)) * 0.1;
    result_.size_x = step_x_ * result_.nx * lateral_.metres;
    result_.size_y = step_y_ * result_.ny * lateral_.metres;
    for (int i = 0; i < result_.nx * result_.ny; ++i) {
      const int size = draw_.of({2000, 2000000});
      values_.push_back((draw_.below(2 * size) - size + 0.5) * 2e-3);
      if (!result_.profile && draw_.chance(0.01))
        values_.back() = std::numeric_limits<double>::quiet_NaN();
      result_.heights.push_back(values_.back() * vertical_.metres);
    }
    for (int k = draw_.below(4); k > 0; --k) lines_ += key(draw_.of(distractors));
    if (kind == 2)
      matrix();
    else
      table();
    encode();
    return std::move(result_);
  }

 private:
  static constexpr const char* marks[]{"nan", "NaN", "***", "-9999", "1e38", "", "NA", "-1.#IND"};

  std::string number(double value, int digits = 10) {
    if (std::isnan(value)) return mark_;
    std::string text = fmt::format("{:.{}g}", value, digits);
    if (comma_) std::ranges::replace(text, '.', ',');
    return text;
  }

  std::string key(const std::string& line) {
    return draw_.chance(0.5) ? "# " + line + "\n" : line + "\n";
  }

  std::string with_unit(const std::string& name, const std::string& unit) {
    switch (bracket_) {
      case 0:
        return name + " [" + unit + "]";
      case 1:
        return name + " (" + unit + ")";
      case 2:
        return name + "/" + unit;
      case 3:
        return name + "[" + unit + "]";
      default:
        return name + " in " + unit;
    }
  }

  void table() {
    const bool titled_units = draw_.chance(0.85);
    bracket_ = draw_.below(5);
    std::vector<std::string> titles;
    std::vector<int> order;  // 0 x, 1 y, 2 z, 3 index, 4 other
    if (draw_.chance(0.2)) order.push_back(3);
    const int shuffle = draw_.chance(0.25) ? draw_.below(3) : 0;
    if (result_.profile) {
      if (shuffle)
        order.insert(order.end(), {2, 0});
      else
        order.insert(order.end(), {0, 2});
    } else if (shuffle == 0) {
      order.insert(order.end(), {0, 1, 2});
    } else if (shuffle == 1) {
      order.insert(order.end(), {1, 0, 2});
    } else {
      order.insert(order.end(), {2, 0, 1});
    }
    if (draw_.chance(0.15)) order.push_back(4);
    for (const int column : order) {
      const std::string name = column == 0
                                   ? (result_.profile ? draw_.of(way_titles) : draw_.of(x_titles))
                               : column == 1 ? draw_.of(y_titles)
                               : column == 2 ? draw_.of(z_titles)
                               : column == 3 ? draw_.of(index_titles)
                                             : draw_.of(other_titles);
      titles.push_back(column > 2 || !titled_units
                           ? name
                           : with_unit(name, column == 2 ? vertical_.word : lateral_.word));
    }
    if (!titled_units) {
      lines_ += key(fmt::format("{} {} {}", draw_.of({"XY unit", "Lateral units", "Einheit XY"}),
                                draw_.of({":", "="}), lateral_.word));
      lines_ += key(fmt::format(
          "{}: {}",
          draw_.of({"Z unit", "Value units", "Einheit H\u00f6he", "Height unit", "Unit\u00e9 Z"}),
          vertical_.word));
    }
    if (draw_.chance(0.2))
      lines_ += key(fmt::format("{}: {}",
                                draw_.of({"Points", "Number of points", "Anzahl Punkte",
                                          "Nombre de points", "tensu", "Messpunkte"}),
                                result_.nx * result_.ny));
    if (draw_.chance(0.15))
      lines_ += key(fmt::format("{}: {} {}", draw_.of({"Z range", "Max height", "Rz"}), number(1.5),
                                vertical_.metres ? vertical_.word : "um"));
    if (draw_.chance(0.05)) {
      lines_ += key(fmt::format(
          "{}: 2.5", draw_.of({"Z scale", "Faktor", "Multiplikator", "keisu", "Sensitivity"})));
      result_.clear = false;
      scaled_ = true;
    }
    std::string text;
    const std::string between(1, separator_);
    const std::string join = separator_ == ' ' ? "  " : between;
    for (std::size_t i = 0; i < titles.size(); ++i) text += (i ? join : "") + titles[i];
    if (draw_.chance(0.95) || shuffle || order.front() == 3 || order.back() == 4 || titled_units)
      lines_ += text + "\n";
    int line = 0;
    for (int ix = 0; ix < result_.nx; ++ix)
      for (int iy = 0; iy < result_.ny; ++iy, ++line) {
        for (std::size_t i = 0; i < order.size(); ++i) {
          if (i) lines_ += separator_;
          lines_ += order[i] == 0   ? number(step_x_ * ix)
                    : order[i] == 1 ? number(step_y_ * iy)
                    : order[i] == 2 ? number(values_[std::size_t(ix * result_.ny + iy)])
                    : order[i] == 3 ? std::to_string(line)
                                    : std::to_string(100 + draw_.below(900));
        }
        lines_ += '\n';
      }
  }

  void matrix() {
    const bool pixels = draw_.chance(0.4), german = draw_.chance(0.4);
    const auto line = [&](const std::string& name, double value, const Unit& unit) {
      lines_ += key(fmt::format("{}{} {} {}", name, draw_.of({":", " =", " :", ";"}), number(value),
                                unit.word));
    };
    if (pixels) {
      const char* names[][2]{{"Pixel size X", "Pixel size Y"},
                             {"Pixelgr\u00f6\u00dfe X", "Pixelgr\u00f6\u00dfe Y"},
                             {"dx", "dy"},
                             {"Step X", "Step Y"},
                             {"X spacing", "Y spacing"},
                             {"Pas X", "Pas Y"},
                             {"Punktabstand X", "Punktabstand Y"},
                             {"kankaku X", "kankaku Y"}};
      const auto& [x, y] = names[draw_.below(8)];
      line(x, step_x_, lateral_);
      line(y, step_y_, lateral_);
    }
    if (!pixels || draw_.chance(0.2)) {
      const char* names[][2]{
          {"Width", "Height"},    {"Breite", "H\u00f6he"},        {"Size X", "Size Y"},
          {"Largeur", "Hauteur"}, {"X Range", "Y Range"},         {"X size", "Y size"},
          {"haba", "takasa"},     {"Scan size X", "Scan size Y"}, {"Ausdehnung X", "Ausdehnung Y"}};
      const auto& [x, y] = names[draw_.below(9)];
      line(x, step_x_ * result_.nx, lateral_);
      line(y, step_y_ * result_.ny, lateral_);
    }
    lines_ +=
        key(fmt::format("{}: {}",
                        draw_.of({"Value units", "Z unit", "Einheit H\u00f6he", "Unit\u00e9 Z",
                                  "Height unit", "Z units", "Einheit Z", "tani Z"}),
                        vertical_.word));
    if (draw_.chance(0.2)) {
      lines_ += key(fmt::format("{}: {}", german ? "Spalten" : "Columns", result_.nx));
      lines_ += key(fmt::format("{}: {}", german ? "Zeilen" : "Rows", result_.ny));
    }
    if (draw_.chance(0.1)) {
      lines_ += key("Height: 1.6 \u00b5m");  // a range of heights beside sizes: ambiguous
      result_.clear = false;
    }
    if (std::string_view(mark_) == "-9999" && draw_.chance(0.7))
      lines_ += key("NODATA_value -9999");
    const bool numbered = draw_.chance(0.1) && separator_ != ' ';
    if (numbered) {
      for (int ix = 0; ix < result_.nx; ++ix) lines_ += separator_ + std::to_string(ix);
      lines_ += '\n';
    }
    for (int iy = 0; iy < result_.ny; ++iy) {
      if (numbered) lines_ += std::to_string(iy) + separator_;
      for (int ix = 0; ix < result_.nx; ++ix) {
        if (ix) lines_ += separator_;
        lines_ += number(values_[std::size_t(ix * result_.ny + iy)]);
      }
      lines_ += '\n';
    }
  }

  void encode() {
    const std::string end = draw_.of({"\n", "\n", "\r\n", "\r"});
    std::string text = draw_.chance(0.1) ? "\xef\xbb\xbf" : "";
    for (const char symbol : lines_)
      if (symbol == '\n')
        text += end;
      else
        text += symbol;
    result_.text = text;
  }

  Draw draw_;
  Case result_;
  std::string lines_;
  bool comma_ = false, scaled_ = false;
  char separator_ = ' ';
  Unit lateral_{}, vertical_{};
  const char* mark_ = "nan";
  double step_x_ = 0, step_y_ = 0;
  int bracket_ = 0;
  std::vector<double> values_;
};

/// What is wrong with a surface that was read; empty where it is right.
std::string mistake(const Case& drawn, const detail::ReadSurface& read) {
  const Surface& surface = read.surface;
  const auto off = [](double a, double b) { return std::abs(a - b) > 1e-6 * std::abs(b); };
  if (surface.grid.nx != drawn.nx || surface.grid.ny != drawn.ny) return "points";
  if (off(surface.grid.lx, drawn.size_x)) return "size_x";
  if (!drawn.profile && off(surface.grid.ly, drawn.size_y)) return "size_y";
  for (int ix = 0; ix < drawn.nx; ++ix)
    for (int iy = 0; iy < drawn.ny; ++iy) {
      const double expected = drawn.heights[std::size_t(ix * drawn.ny + iy)],
                   found = surface.heights(ix, iy);
      if (std::isnan(expected) ? !std::isnan(found)
                               : !(std::abs(found - expected) <= 1e-6 * std::abs(expected)))
        return "heights";
    }
  return "";
}

}  // namespace

TEST_CASE("Drawn files of instruments are read right or refused", "[text]") {
  // SALEBRA_TEXT_FILES=100000 draws more; the night does.
  const char* const more = std::getenv("SALEBRA_TEXT_FILES");
  const int files = more ? std::atoi(more) : 5000;
  int right = 0, refused = 0, wrong = 0, clear = 0, clear_right = 0;
  std::map<std::string, int> reasons;
  for (int seed = 0; seed < files; ++seed) {
    const Case drawn = Writer(static_cast<unsigned>(seed)).write();
    clear += drawn.clear;
    ReadOptions options;
    options.profiles = true;
    std::string what, error;
    try {
      what = mistake(
          drawn,
          detail::completed("drawn.txt", detail::read_content("drawn.txt", drawn.text), options));
    } catch (const InvalidInput& refusal) {
      error = refusal.what();
    }
    if (!error.empty()) {
      ++refused;
      if (drawn.clear) ++reasons[error.substr(0, 110)];
      CHECK(error.find('\n') == error.npos);
    } else if (what.empty()) {
      ++right;
      clear_right += drawn.clear;
    } else {
      ++wrong;
      WARN("seed " << seed << ": " << what << "\n"
                   << drawn.text.substr(0, 500) << "\n"
                   << drawn.text.substr(drawn.text.size() / 2, 100));
    }
  }
  if (more || std::getenv("SALEBRA_TEXT_REASONS")) {
    std::vector<std::pair<int, std::string>> sorted;
    for (const auto& [reason, count] : reasons) sorted.emplace_back(count, reason);
    std::ranges::sort(sorted, std::greater<>());
    for (std::size_t i = 0; i < std::min<std::size_t>(sorted.size(), 25); ++i)
      WARN(sorted[i].first << " " << sorted[i].second);
    WARN(files << " files: " << right << " right, " << refused << " refused, " << wrong
               << " wrong; of " << clear << " clear ones " << clear_right << " read");
  }
  CHECK(wrong == 0);
  // A person would read these: at least 85 %.
  CHECK(clear_right >= 0.85 * clear);
}
