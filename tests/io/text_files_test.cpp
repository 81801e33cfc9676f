// SPDX-License-Identifier: GPL-3.0-or-later
// Random texts with heights in the styles of instruments: each must be read correctly or refused.
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
#include "io/plain_content.hpp"

using namespace salebra;

namespace {

/// Draws random entries of lists, the same on every machine.
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

constexpr Unit units[]{{"m", 1},
                       {"mm", 1e-3},
                       {"um", 1e-6},
                       {"\u00b5m", 1e-6},
                       {"\u03bcm", 1e-6},
                       {"nm", 1e-9},
                       {"microns", 1e-6},
                       {"micrometers", 1e-6},
                       {"micron", 1e-6},
                       {"mm", 1e-3},
                       {"millimeters", 1e-3},
                       {"\u00c5", 1e-10},
                       {"MM", 1e-3},
                       {"Angstrom", 1e-10},
                       {"UM", 1e-6},
                       {"Mikrometer", 1e-6},
                       {"Nanometer", 1e-9},
                       {"inch", 0.0254},
                       {"nanometres", 1e-9},
                       {"micrometre", 1e-6},
                       {"cm", 1e-2},
                       {"Millimeter", 1e-3},
                       {"\u00b5m", 1e-6},
                       {"nm", 1e-9}};
constexpr Unit no_lengths[]{{"V", 0},   {"a.u.", 0}, {"mV", 0},      {"counts", 0},
                            {"deg", 0}, {"Grad", 0}, {"furlong", 0}, {"digits", 0}};

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
                                 "Ost",
                                 "X-Richtung",
                                 "X-Pos.",
                                 "Xpos",
                                 "Coord. X",
                                 "Position en X",
                                 "X zahyo",
                                 "X-Wert",
                                 "xdata",
                                 "Stage X",
                                 "X Abstand",
                                 "Easting"};
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
                                 "Nord",
                                 "Y-Richtung",
                                 "Y-Pos.",
                                 "Ypos",
                                 "Coord. Y",
                                 "Position en Y",
                                 "Y zahyo",
                                 "Y-Wert",
                                 "ydata",
                                 "Stage Y",
                                 "Y Abstand",
                                 "Northing"};
constexpr const char* way_titles[]{"X",
                                   "Position",
                                   "Distance",
                                   "Weg",
                                   "Strecke",
                                   "Track",
                                   "Messweg",
                                   "Tastweg",
                                   "Abscissa",
                                   "Abszisse",
                                   "Abscisse",
                                   "Lateral",
                                   "kyori",
                                   "ichi",
                                   "Length",
                                   "L\u00e4nge",
                                   "Longueur",
                                   "nagasa",
                                   "Verfahrweg",
                                   "Parcours",
                                   "Scan position",
                                   "Travel",
                                   "Lauf",
                                   "Chemin",
                                   "Lateral position",
                                   "Wegstrecke",
                                   "Distance parcourue",
                                   "D\u00e9placement",
                                   "sokutei ichi",
                                   "Horizontal distance",
                                   "X-Pos",
                                   "Stylus position",
                                   "Path length",
                                   "Along scan",
                                   "Scan length",
                                   "Bahnkoordinate",
                                   "ido kyori",
                                   "Longueur de mesure",
                                   "s"};
constexpr const char* z_titles[]{"Z",
                                 "Height",
                                 "H\u00f6he",
                                 "Hoehe",
                                 "Hauteur",
                                 "takasa",
                                 "Amplitude",
                                 "Profile",
                                 "Profil",
                                 "R",
                                 "P",
                                 "Value",
                                 "Wert",
                                 "Valeur",
                                 "Altitude",
                                 "Topography",
                                 "Topographie",
                                 "Rauheit",
                                 "Rugosit\u00e9",
                                 "arasa",
                                 "Roughness",
                                 "Elevation",
                                 "Height Sensor",
                                 "Z-Achse",
                                 "Profilh\u00f6he",
                                 "Messwert",
                                 "Auslenkung",
                                 "Ordinate",
                                 "kodo",
                                 "Relief",
                                 "Surface height",
                                 "z-Wert",
                                 "Oberfl\u00e4chenh\u00f6he",
                                 "Relative height",
                                 "Z data",
                                 "Hauteur Z",
                                 "Cote",
                                 "hyomen takasa",
                                 "Raw profile",
                                 "Primary profile",
                                 "Rohprofil",
                                 "H\u00f6henprofil",
                                 "Profil brut",
                                 "Deviation",
                                 "Abweichung",
                                 "\u00c9cart",
                                 "Levelled height",
                                 "Formabweichung",
                                 "Z-Daten",
                                 "takasa deta",
                                 "Altitude mesur\u00e9e",
                                 "Unfiltered height"};
constexpr const char* index_titles[]{"Index", "No.",        "Nr.",         "#",        "Punkt",
                                     "Point", "bango",      "n",           "lfd. Nr.", "Zeile",
                                     "Row",   "Sample no.", "Num\u00e9ro", "i",        ""};
constexpr const char* other_titles[]{
    "Intensity", "Intensit\u00e4t", "Intensit\u00e9",  "kido",  "Error",  "Quality",   "Kontrast",
    "Reflet",    "Brightness",      "Luminosit\u00e9", "Phase", "kiroku", "Luftdruck", "Helligkeit",
    "Score",     "Temperatur"};

/// Lines that a person would recognise as irrelevant to the heights.
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
                                    "Exposure: 12 ms",
                                    "Measured by: K. Sato",
                                    "Report no. 2231",
                                    "Lens: 20x/0.45",
                                    "Messdatum 03.11.2025",
                                    "Heure de mesure: 14h05",
                                    "Aufnahmezeit: 12 s",
                                    "Working distance: 4.7 mm",
                                    "Arbeitsabstand: 4,7 mm",
                                    "Stage temperature (\u00b0C): 22.4",
                                    "Humidity: 45 %rH",
                                    "Stylus force: 1 mN",
                                    "Probe radius: 5 \u00b5m",
                                    "Vitesse de balayage : 1 Hz",
                                    "Bias: -2.1 V",
                                    "Room: B-204",
                                    "Traverse speed = 0.1 mm/s",
                                    "Lc = 0.8 mm",
                                    "Ra: 0.42 \u00b5m",
                                    "Rz = 3,1 \u00b5m",
                                    "No. of averages: 8",
                                    "https://www.example.org/instrument?id=17",
                                    "Calibrated on 2025-10-01",
                                    "Part: 55-1023-A",
                                    "User ID: 17",
                                    "File created with ProfilSoft 7.2",
                                    "Focus position: 12.345 mm",
                                    "sokutei sokudo: 0.5 mm/s",
                                    "shokushin hankei: 2 \u00b5m",
                                    "Nb de moyennes : 4",
                                    "Op\u00e9rateur : J. Dupont",
                                    "Filter: Gau\u00df ISO 16610-21",
                                    "Gel\u00e4nde: Halle 3",
                                    "Batch 4471/B",
                                    "Camera: 1.3 MP",
                                    "Spot size: 8 \u00b5m",
                                    "=====================",
                                    "[Header]",
                                    "Licence no.: 99812"};

/// Lines that change the meaning of the numbers, and the word that a refusal must quote.
constexpr const char* changes[][2]{{"Z scale: 2.5", "scale"},
                                   {"Faktor: 2,5", "Faktor"},
                                   {"Multiplikator = 2.5", "Multiplikator"},
                                   {"keisu: 2.5", "keisu"},
                                   {"Sensitivity: 2.5", "Sensitivity"},
                                   {"Sensitivity: 12.5 nm/V", "Sensitivity"},
                                   {"Inverted: yes", "Inverted"},
                                   {"Height offset: 0.5 \u00b5m", "offset"},
                                   {"Heights are 1000 nm per unit", "nm per unit"},
                                   {"Calibration 0.125 \u00b5m/digit", "Calibration"},
                                   {"Z divided by 10", "divided"},
                                   {"Hoehen x 10 uebertrieben", "x 10"},
                                   {"\u00dcberh\u00f6hung: 50", "berh"},
                                   {"Exaggeration Z: 20", "Exaggeration"},
                                   {"1 LSB = 0.3 nm", "LSB"},
                                   {"baika: 10", "baika"},
                                   {"Resolution Z [nm/bit]: 0.15", "bit"}};

struct Case {
  std::string text;
  std::string said;     ///< the text with LF, in UTF-8
  bool clear = true;    ///< a person could read it
  std::string culprit;  ///< must be quoted if an unclear text is refused; empty: not prescribed
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
    quoted_ = draw_.chance(0.06);
    separator_ = comma_ && !quoted_ ? draw_.of({';', '\t', ' '}) : draw_.of({';', '\t', ' ', ','});
    const int kind = draw_.below(3);
    result_.profile = kind == 0;
    result_.nx = 5 + draw_.below(12);
    result_.ny = result_.profile ? 1 : 4 + draw_.below(10);
    if (quoted_ && separator_ == ' ') separator_ = ';';
    if (draw_.chance(0.1) && (separator_ != ' ') && (separator_ != ',' || quoted_))
      thousands_ = draw_.of({comma_ ? '.' : ',', '\'', ' '});
    lateral_ = draw_.of(units);
    vertical_ = draw_.chance(0.03) ? draw_.of(no_lengths) : draw_.of(units);
    if (vertical_.metres == 0) unclear(vertical_.word);
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
    if (draw_.chance(0.05)) {
      const auto& [line, word] = changes[draw_.below(static_cast<int>(std::size(changes)))];
      lines_ += key(line);
      unclear(word);
    }
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
    auto point = std::min(text.find('.'), text.size());
    if (comma_) std::ranges::replace(text, '.', ',');
    if (thousands_ && text.find('e') == text.npos)
      for (; point > (text.front() == '-' ? 4u : 3u); point -= 3)
        text.insert(point - 3, 1, thousands_);
    return quoted_ ? '"' + text + '"' : text;
  }

  /// Marks the text as unclear. The refusal must quote the culprit of the first call.
  void unclear(const std::string& culprit) {
    if (result_.clear)
      result_.culprit = culprit;
    else if (result_.culprit != culprit)
      result_.culprit.clear();
    result_.clear = false;
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
      case 4:
        return name + " / " + unit;
      case 5:
        return name + "_" + unit;
      case 6:
        return name + " {" + unit + "}";
      case 7:
        return name + (quoted_ ? ", " : " - ") + unit;
      case 8:
        return name;  // and the unit in the next line
      default:
        return name + " in " + unit;
    }
  }

  void table() {
    const bool titled_units = draw_.chance(0.85);
    bracket_ = draw_.below(10);
    if (bracket_ == 8 && separator_ == ' ') bracket_ = 0;
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
    const bool channels = draw_.chance(0.04);
    if (channels) order.push_back(5);
    for (const int column : order) {
      const std::string name =
          column == 0   ? (result_.profile ? draw_.of(way_titles) : draw_.of(x_titles))
          : column == 1 ? draw_.of(y_titles)
          : column == 2 ? draw_.of(z_titles)
          : column == 3 ? draw_.of(index_titles)
          : column == 5 ? draw_.of({"Height 2", "Z2", "H\u00f6he B", "Profile 2"})
                        : draw_.of(other_titles);
      titles.push_back(column == 3 || column == 4 || !titled_units
                           ? name
                           : with_unit(name, column < 2 ? lateral_.word : vertical_.word));
      if (column == 5) unclear(name.substr(name.size() - 1));
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
    std::string text;
    const std::string between(1, separator_);
    const std::string join = separator_ == ' ' ? "  " : between;
    if (separator_ == ' ' && titles.front().empty()) titles.front() = "Index";
    for (std::size_t i = 0; i < titles.size(); ++i)
      text += (i ? join : "") + (quoted_ ? '"' + titles[i] + '"' : titles[i]);
    if (draw_.chance(0.95) || shuffle || order.front() == 3 || order.back() == 4 || titled_units)
      lines_ += text + "\n";
    if (bracket_ == 8 && titled_units) {
      for (std::size_t i = 0; i < order.size(); ++i)
        lines_ += (i ? between : "") + (order[i] < 2                     ? lateral_.word
                                        : order[i] == 2 || order[i] == 5 ? vertical_.word
                                                                         : "");
      lines_ += '\n';
      // The program Origin writes a line of comments on the columns.
      if (draw_.chance(0.3)) lines_ += "Comments\n";
    }
    int line = 0;
    for (int ix = 0; ix < result_.nx; ++ix)
      for (int iy = 0; iy < result_.ny; ++iy, ++line) {
        for (std::size_t i = 0; i < order.size(); ++i) {
          if (i) lines_ += separator_;
          lines_ += order[i] == 0   ? number(step_x_ * ix)
                    : order[i] == 1 ? number(step_y_ * iy)
                    : order[i] == 2 ? number(values_[std::size_t(ix * result_.ny + iy)])
                    : order[i] == 3 ? std::to_string(line)
                    : order[i] == 5 ? number(0.5 + draw_.below(100))
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
      lines_ += key("Height: 1.6 \u00b5m");  // a range of heights, or a size: ambiguous
      unclear("Height: 1.6");
    }
    if (std::string_view(mark_) == "-9999" && draw_.chance(0.7))
      lines_ += key("NODATA_value -9999");
    const int blocks = draw_.chance(0.05) ? 2 : 1;
    const std::string head = draw_.of({"# Channel: Phase", "Channel 2", "", "# Kanal 2 [V]"});
    if (blocks == 2) unclear(head.empty() ? "" : head.substr(2));
    const bool numbered = draw_.chance(0.1) && separator_ != ' ';
    if (numbered) {
      for (int ix = 0; ix < result_.nx; ++ix) lines_ += separator_ + std::to_string(ix);
      lines_ += '\n';
    }
    for (int row = 0; row < blocks * result_.ny; ++row) {
      const int iy = row % result_.ny;
      if (row == result_.ny) lines_ += head + '\n';
      if (numbered) lines_ += std::to_string(iy) + separator_;
      for (int ix = 0; ix < result_.nx; ++ix) {
        if (ix) lines_ += separator_;
        lines_ += number(values_[std::size_t(ix * result_.ny + iy)]);
      }
      lines_ += '\n';
    }
  }

  void encode() {
    result_.said = lines_;
    const std::string end = draw_.of({"\n", "\n", "\r\n", "\r"});
    std::string text;
    for (const char symbol : lines_)
      if (symbol == '\n')
        text += end;
      else
        text += symbol;
    const double encoding = draw_.below(100);
    const bool latin = text.find("\u03bc") == text.npos;
    if (encoding < 10)
      result_.text = "\xef\xbb\xbf" + text;
    else if (encoding < 16)
      result_.text = "\xff\xfe" + wide(text, 0, 8);
    else if (encoding < 20)
      result_.text = "\xfe\xff" + wide(text, 8, 0);
    else if (encoding < 35 && latin)
      result_.text = narrow(text);
    else
      result_.text = text;
  }

  /// Code points of a UTF-8 text; all must be below U+0800.
  static std::vector<unsigned> code_points(const std::string& text) {
    std::vector<unsigned> points;
    for (const char symbol : text) {
      const auto byte = static_cast<unsigned char>(symbol);
      if ((byte & 0xc0) == 0x80)
        points.back() = (points.back() & 0x1fu) << 6 | (byte & 0x3fu);
      else
        points.push_back(byte);
    }
    return points;
  }

  static std::string narrow(const std::string& text) {
    std::string result;
    for (const unsigned point : code_points(text)) result += static_cast<char>(point);
    return result;
  }

  static std::string wide(const std::string& text, int first, int second) {
    std::string result;
    for (const unsigned point : code_points(text)) {
      result += static_cast<char>(point >> first & 0xff);
      result += static_cast<char>(point >> second & 0xff);
    }
    return result;
  }

  Draw draw_;
  Case result_;
  std::string lines_;
  bool comma_ = false, quoted_ = false;
  char separator_ = ' ', thousands_ = '\0';
  Unit lateral_{}, vertical_{};
  const char* mark_ = "nan";
  double step_x_ = 0, step_y_ = 0;
  int bracket_ = 0;
  std::vector<double> values_;
};

/// Describes what is wrong with a surface that was read; empty if it is correct.
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

/// Whether a refusal quotes what was not understood in the file, or names the option that is
/// missing for a clear file.
bool names_token(const Case& drawn, const std::string& error) {
  if (!drawn.culprit.empty() && error.find(drawn.culprit) != error.npos) return true;
  if (drawn.culprit.empty() && error.find('`') != error.npos) return true;
  if (error.find("the empty line") != error.npos ||
      error.find("no number in the corner") != error.npos)
    return true;
  if (error.find("XYZ points") != error.npos) return true;
  if (error.find(" line ") != error.npos && error.find(" holds ") != error.npos) return true;
  for (auto begin = error.find('\''); begin != error.npos;) {
    const auto end = error.find('\'', begin + 1);
    if (end == error.npos) return false;
    std::string quoted = error.substr(begin + 1, end - begin - 1);
    if (quoted.ends_with("\u2026")) quoted.resize(quoted.size() - 3);
    // A refusal escapes tabs like other control characters.
    for (auto tab = quoted.find("\\x09"); tab != quoted.npos; tab = quoted.find("\\x09"))
      quoted.replace(tab, 4, "\t");
    if (!quoted.empty() && drawn.said.find(quoted) != drawn.said.npos) return true;
    begin = error.find('\'', end + 1);
  }
  return false;
}

}  // namespace

TEST_CASE("Drawn files of instruments are read right or refused", "[text]") {
  // The nightly tests draw more: SALEBRA_TEXT_FILES=100000.
  const char* const more = std::getenv("SALEBRA_TEXT_FILES");
  const int files = more ? std::atoi(more) : 5000;
  int right = 0, refused = 0, wrong = 0, unnamed = 0, clear = 0, clear_right = 0;
  std::map<std::string, int> reasons;
  for (int seed = 0; seed < files; ++seed) {
    const Case drawn = Writer(static_cast<unsigned>(seed)).write();
    clear += drawn.clear;
    ReadOptions options;
    options.profiles = true;
    std::string what, error;
    try {
      const auto plain = detail::plain_content("drawn.txt", drawn.text);
      what = mistake(
          drawn, detail::completed("drawn.txt",
                                   detail::read_content("drawn.txt", plain ? *plain : drawn.text),
                                   options));
    } catch (const InvalidInput& refusal) {
      error = refusal.what();
    }
    if (!error.empty()) {
      ++refused;
      if (drawn.clear) ++reasons[error.substr(0, 160)];
      CHECK(error.find('\n') == error.npos);
      if (!names_token(drawn, error)) {
        ++unnamed;
        WARN("seed " << seed << ": '" << drawn.culprit << "' is not named: " << error << "\n"
                     << drawn.text.substr(0, 500));
      }
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
  CHECK(unnamed == 0);
  // At least 85 % of the texts that a person could read must be read.
  CHECK(clear_right >= 0.85 * clear);
}
