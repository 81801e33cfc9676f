// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities with units and SI prefixes: parsing, formatting, lists and geometric ranges.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <utility>

namespace salebra {
namespace {

struct Prefix {
  std::string_view symbol;
  int exponent;
};
// The function plain() has replaced the micro sign and other letters by ASCII before a prefix is
// looked up.
constexpr std::array prefixes{Prefix{"f", -15}, Prefix{"p", -12}, Prefix{"n", -9}, Prefix{"u", -6},
                              Prefix{"m", -3},  Prefix{"c", -2},  Prefix{"k", 3},  Prefix{"M", 6},
                              Prefix{"G", 9},   Prefix{"T", 12}};

/// One spelling of a unit: head + prefix + stem + tail. The factor of the prefix is raised to
/// `power`.
struct Spelling {
  Dimension dimension;
  std::string_view head;
  std::string_view stem;
  std::string_view tail;
  double factor = 1;  ///< value in SI units without a prefix
  int power = 1;      ///< power of the prefix; 0 if the unit takes none
};

constexpr double degree = std::numbers::pi / 180;
using enum Dimension;
/// Units as plain() returns them, with digits for powers.
constexpr std::array spellings{
    Spelling{dimensionless, "", "1", "", 1, 0},
    Spelling{dimensionless, "", "%", "", 0.01, 0},
    Spelling{length, "", "m", ""},
    Spelling{length_squared, "", "m", "2", 1, 2},
    Spelling{length_cubed, "", "m", "3", 1, 3},
    Spelling{length_to_the_fourth, "", "m", "4", 1, 4},
    Spelling{inverse_length, "1/", "m", "", 1, -1},
    Spelling{inverse_length, "", "m", "-1", 1, -1},
    Spelling{inverse_length_squared, "1/", "m", "2", 1, -2},
    Spelling{inverse_length_squared, "/", "m", "2", 1, -2},
    Spelling{inverse_length_squared, "", "m", "-2", 1, -2},
    Spelling{wavenumber, "rad/", "m", "", 1, -1},
    Spelling{pressure, "", "Pa", ""},
    Spelling{pressure, "", "hPa", "", 1e2, 0},
    Spelling{pressure, "", "bar", "", 1e5},
    Spelling{pressure, "", "psi", "", 6894.757293168361, 0},
    Spelling{pressure, "", "ksi", "", 6894757.293168361, 0},
    Spelling{pressure, "N/", "m", "2", 1, -2},
    Spelling{pressure, "", "N", "/m2"},
    Spelling{pressure, "", "N", "/cm2", 1e4},
    Spelling{pressure, "", "N", "/mm2", 1e6},
    Spelling{inverse_pressure, "1/", "Pa", "", 1, -1},
    Spelling{inverse_pressure, "", "Pa", "-1", 1, -1},
    Spelling{force, "", "N", ""},
    Spelling{force, "", "kgf", "", 9.80665, 0},
    Spelling{force, "", "gf", "", 9.80665e-3, 0},
    Spelling{force, "", "lbf", "", 4.4482216152605, 0},
    Spelling{stiffness, "", "N", "/m"},
    Spelling{stiffness, "", "N", "/mm", 1e3},
    Spelling{stiffness, "", "N", "/um", 1e6},
    Spelling{stiffness_per_area, "", "Pa", "/m"},
    Spelling{stiffness_per_area, "", "Pa", "/um", 1e6},
    Spelling{stiffness_per_area, "", "Pa", "/nm", 1e9},
    Spelling{force_curvature, "", "N", "/m2"},
    Spelling{damping, "", "N", " s/m"},
    Spelling{damping, "", "N", "s/m"},
    Spelling{mass, "", "g", "", 1e-3},
    Spelling{mass_density, "", "g", "/m3", 1e-3},
    Spelling{mass_density, "", "g", "/cm3", 1e3},
    Spelling{angle, "", "rad", ""},
    Spelling{angle, "", "deg", "", degree, 0},
    Spelling{frequency, "", "Hz", ""},
    Spelling{frequency, "", "1/s", "", 1, 0},
    Spelling{frequency, "", "rpm", "", 1. / 60, 0},
    Spelling{angular_frequency, "", "rad/s", ""},
    Spelling{angular_frequency, "", "1/s", "", 1, 0},
    Spelling{velocity, "", "m", "/s"},
    Spelling{velocity, "", "m", "/min", 1. / 60},
    Spelling{Dimension::time, "", "s", ""},
    Spelling{Dimension::time, "", "sec", ""},
    Spelling{Dimension::time, "", "min", "", 60, 0},
    Spelling{Dimension::time, "", "h", "", 3600, 0},
    Spelling{energy, "", "J", ""},
    Spelling{energy_per_area, "", "J", "/m2"},
    Spelling{energy_per_area, "", "N", "/m"},
    Spelling{power, "", "W", ""},
    Spelling{resistivity, "", "ohm", " m"},
    Spelling{resistivity, "", "ohm", "m"},
    Spelling{resistivity, "", "ohm", " cm", 1e-2},
    Spelling{thermal_conductivity, "", "W", "/(m K)"},
    Spelling{thermal_conductivity, "", "W", "/mK"},
    Spelling{thermal_conductivity, "", "W", "/m/K"},
    Spelling{conductance_per_area, "", "S", "/m2"},
    Spelling{Dimension::thermal_conductance, "", "W", "/(m2 K)"},
};

/// A full name of a unit, in lower case.
struct Named {
  Dimension dimension;
  std::string_view name;
  double factor = 1;
  int exponent = 0;
  bool takes_prefix = false;  ///< accepts a prefix such as "micro"
};
constexpr std::array names{
    Named{length, "meter", 1, 0, true},
    Named{length, "metre", 1, 0, true},
    Named{length, "metro", 1, 0, true},
    Named{length, "micron", 1, -6},
    Named{length, "mikron", 1, -6},
    Named{length, "angstrom", 1, -10},
    Named{length, "angstroem", 1, -10},
    Named{length, "inch", 254, -4, true},
    Named{length, "in", 254, -4},
    Named{length, "mil", 254, -7},
    Named{length, "thou", 254, -7},
    Named{length, "uin", 254, -10},
    Named{pressure, "pascal", 1, 0, true},
    Named{pressure, "bar", 1e5, 0, true},
    Named{force, "newton", 1, 0, true},
    Named{mass, "gram", 1, -3, true},
    Named{mass, "gramm", 1, -3, true},
    Named{angle, "radian", 1, 0, true},
    Named{angle, "degree", degree},
    Named{frequency, "hertz", 1, 0, true},
    Named{Dimension::time, "second", 1, 0, true},
    Named{Dimension::time, "sekunde", 1, 0, true},
    Named{Dimension::time, "minute", 60},
    Named{Dimension::time, "hour", 3600},
    Named{energy, "joule", 1, 0, true},
    Named{power, "watt", 1, 0, true},
    Named{dimensionless, "percent", 1, -2},
};
constexpr std::array prefix_names{Prefix{"femto", -15}, Prefix{"pico", -12}, Prefix{"piko", -12},
                                  Prefix{"nano", -9},   Prefix{"micro", -6}, Prefix{"mikro", -6},
                                  Prefix{"milli", -3},  Prefix{"mili", -3},  Prefix{"centi", -2},
                                  Prefix{"zenti", -2},  Prefix{"kilo", 3},   Prefix{"mega", 6},
                                  Prefix{"giga", 9},    Prefix{"tera", 12}};

/// Units written in wrong case that have only one meaning: MM means millimetre, because nobody
/// measures in megametres, while mpa may be a megapascal or a millipascal and is not listed.
struct OtherCase {
  Dimension dimension;
  std::string_view written;
  std::string_view unit;
};
constexpr std::array other_cases{OtherCase{length, "MM", "mm"},
                                 OtherCase{length, "UM", "um"},
                                 OtherCase{length, "Um", "um"},
                                 OtherCase{length, "uM", "um"},
                                 OtherCase{length, "NM", "nm"},
                                 OtherCase{length, "CM", "cm"},
                                 OtherCase{pressure, "PA", "Pa"},
                                 OtherCase{pressure, "pa", "Pa"},
                                 OtherCase{pressure, "MPA", "MPa"},
                                 OtherCase{pressure, "GPA", "GPa"},
                                 OtherCase{pressure, "gpa", "GPa"},
                                 OtherCase{pressure, "KPA", "kPa"},
                                 OtherCase{pressure, "kpa", "kPa"},
                                 OtherCase{pressure, "KPa", "kPa"},
                                 OtherCase{pressure, "PSI", "psi"},
                                 OtherCase{pressure, "KSI", "ksi"},
                                 OtherCase{force, "KN", "kN"},
                                 OtherCase{frequency, "HZ", "Hz"},
                                 OtherCase{frequency, "hz", "Hz"},
                                 OtherCase{frequency, "KHZ", "kHz"},
                                 OtherCase{frequency, "KHz", "kHz"},
                                 OtherCase{frequency, "khz", "kHz"},
                                 OtherCase{frequency, "MHZ", "MHz"},
                                 OtherCase{frequency, "GHZ", "GHz"},
                                 OtherCase{frequency, "ghz", "GHz"},
                                 OtherCase{frequency, "RPM", "rpm"},
                                 OtherCase{angle, "DEG", "deg"},
                                 OtherCase{angle, "RAD", "rad"},
                                 OtherCase{Dimension::time, "SEC", "sec"}};

struct About {
  Dimension dimension;
  std::string_view unit;
  std::string_view example;
  bool takes_prefix;  ///< whether printed numbers get a prefix
};
constexpr std::array abouts{
    About{dimensionless, "1", "0.1", false},
    About{length, "m", "10um", true},
    About{length_squared, "m^2", "1um2", false},
    About{length_cubed, "m^3", "1e-18", false},
    About{length_to_the_fourth, "m^4", "1e-24", false},
    About{inverse_length, "1/m", "1/um", false},
    About{inverse_length_squared, "1/m^2", "1/um2", false},
    About{pressure, "Pa", "115GPa", true},
    About{inverse_pressure, "1/Pa", "1e-9", false},
    About{force, "N", "1mN", true},
    About{stiffness, "N/m", "1kN/m", true},
    About{stiffness_per_area, "Pa/m", "1GPa/um", false},
    About{force_curvature, "N/m^2", "1N/m^2", false},
    About{damping, "N s/m", "1Ns/m", true},
    About{mass, "kg", "1kg", false},
    About{mass_density, "kg/m^3", "7.8g/cm3", false},
    About{angle, "rad", "90deg", false},
    About{wavenumber, "rad/m", "1e6", false},
    About{frequency, "Hz", "20kHz", true},
    About{angular_frequency, "rad/s", "1e5rad/s", false},
    About{velocity, "m/s", "1mm/s", true},
    About{Dimension::time, "s", "1ms", true},
    About{energy, "J", "1nJ", true},
    About{energy_per_area, "J/m^2", "50mJ/m2", false},
    About{Dimension::power, "W", "1uW", true},
    About{resistivity, "ohm m", "17nohm m", true},
    About{thermal_conductivity, "W/(m K)", "400W/mK", false},
    About{conductance_per_area, "S/m^2", "1e10", false},
    About{Dimension::thermal_conductance, "W/(m^2 K)", "1e5", false},
};

const About& about(Dimension dimension) {
  return *std::ranges::find(abouts, dimension, &About::dimension);
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Represents factor · 10^exponent in SI units. Factor and exponent are kept separate because 10
/// divided by 1e6 is exactly 1e-5, but 10 times 1e-6 is not.
struct Scale {
  double factor = 1;
  int exponent = 0;

  double operator()(double number) const {
    const double power_of_ten = std::pow(10.0, std::abs(exponent));
    return factor * (exponent < 0 ? number / power_of_ten : number * power_of_ten);
  }
};

std::optional<Scale> scale_of(std::string_view unit, const Spelling& spelling) {
  if (!unit.starts_with(spelling.head)) return {};
  unit.remove_prefix(spelling.head.size());
  if (!unit.ends_with(spelling.tail)) return {};
  unit.remove_suffix(spelling.tail.size());
  if (!unit.ends_with(spelling.stem)) return {};
  unit.remove_suffix(spelling.stem.size());
  if (unit.empty()) return Scale{spelling.factor, 0};
  if (spelling.power == 0) return {};
  for (const Prefix& prefix : prefixes) {
    if (prefix.symbol == unit) return Scale{spelling.factor, prefix.exponent * spelling.power};
  }
  return {};
}

/// Mm is refused: no length here is in megametres, so the user means millimetres.
bool has_prefix(Dimension dimension, int exponent) { return dimension != length || exponent <= 3; }

/// Normalises a unit to ASCII with digits for powers: several code points look like a mu, an
/// angstrom or an ohm.
std::string plain(std::string_view unit) {
  using Sign = std::pair<std::string_view, std::string_view>;
  constexpr Sign alone[]{{"\u00c5", "angstrom"},
                         {"\u212b", "angstrom"},
                         {"A\u030a", "angstrom"},
                         {"\u00b5", "micron"},
                         {"\u03bc", "micron"}};
  for (const auto& [sign, name] : alone)
    if (sign == unit) return std::string(name);
  constexpr Sign signs[]{{"\u00b5", "u"},   {"\u03bc", "u"},  {"\u00c5", "A"}, {"A\u030a", "A"},
                         {"\u00e5", "a"},   {"\u00f6", "o"},  {"\u00f3", "o"}, {"\u00e8", "e"},
                         {"\u00b9", "1"},   {"\u00b2", "2"},  {"\u00b3", "3"}, {"\u2074", "4"},
                         {"\u207b", "-"},   {"\u2212", "-"},  {"**", ""},      {"^", ""},
                         {"*", " "},        {"\u00b7", " "},  {"\u22c5", " "}, {"\u03a9", "ohm"},
                         {"\u2126", "ohm"}, {"\u00b0", "deg"}};
  std::string text;
  while (!unit.empty()) {
    const auto sign = std::ranges::find_if(
        signs, [&](const Sign& known) { return unit.starts_with(known.first); });
    const bool known = sign != std::end(signs);
    text += known ? sign->second : unit.substr(0, 1);
    unit.remove_prefix(known ? sign->first.size() : 1);
  }
  return text;
}

/// Finds the scale of a unit from its name in lower case, singular or plural.
std::optional<Scale> scale_of_name(std::string_view name, Dimension dimension) {
  for (const Named& unit : names) {
    if (unit.dimension != dimension) continue;
    std::string_view rest = name;
    int exponent = unit.exponent;
    if (unit.takes_prefix)
      for (const Prefix& prefix : prefix_names)
        if (rest.starts_with(prefix.symbol)) {
          rest.remove_prefix(prefix.symbol.size());
          exponent += prefix.exponent;
          break;
        }
    if (!rest.starts_with(unit.name)) continue;
    rest.remove_prefix(unit.name.size());
    const std::string_view plural = unit.name.ends_with("ch") ? "es"
                                    : unit.name == "sekunde"  ? "n"
                                                              : "s";
    if (rest.empty() || (rest == plural && unit.name.size() > 2))
      return Scale{unit.factor, exponent};
  }
  return {};
}

std::optional<Scale> scale_of(std::string_view written, Dimension dimension) {
  const std::string unit = plain(written);
  for (const Spelling& spelling : spellings) {
    if (spelling.dimension != dimension) continue;
    if (const auto scale = scale_of(unit, spelling);
        scale && has_prefix(dimension, scale->exponent))
      return scale;
  }
  for (const OtherCase& other : other_cases)
    if (other.dimension == dimension && other.written == unit)
      return scale_of(other.unit, dimension);
  std::string name = unit;
  for (char& symbol : name)
    if (symbol >= 'A' && symbol <= 'Z') symbol = static_cast<char>(symbol - 'A' + 'a');
  return scale_of_name(name, dimension);
}

struct Written {
  double number;
  std::string_view unit;
};

Written split(std::string_view text, Dimension dimension, std::string_view field) {
  std::string_view rest = trim(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double number = 0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  require(status == std::errc{} && std::isfinite(number), field, "'" + std::string(text) + "'",
          fmt::format("is not a finite number; write for example {}", about(dimension).example));
  return {number, trim(rest.substr(std::size_t(end - rest.data())))};
}

Scale unit_scale(std::string_view unit, Dimension dimension, std::string_view text,
                 std::string_view field) {
  if (unit.empty()) return {};
  require(unit.front() != ',', field, "'" + std::string(text) + "'",
          "has a decimal comma; write a decimal point, as in 0.3");
  const auto scale = scale_of(unit, dimension);
  require(scale.has_value(), field, "'" + std::string(text) + "'",
          fmt::format("has a unit that is not known here, '{}'; write for example {}", unit,
                      about(dimension).example));
  return *scale;
}

double value_of(const Written& written, Dimension dimension, std::string_view text,
                std::string_view field) {
  const double value = unit_scale(written.unit, dimension, text, field)(written.number);
  require_squarable(value, text, field);
  return value;
}

std::vector<std::string_view> split_at(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (auto at = text.find(separator); at != std::string_view::npos; at = text.find(separator)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  parts.push_back(text);
  return parts;
}

/// Refuses "10,20,50MPa", which may mean 10, 20 and 50 MPa, and "1,5MPa", which many users type for
/// 1.5 MPa.
void require_units_at_all_or_none(std::string_view text, const std::vector<Written>& list,
                                  Dimension dimension, std::string_view field) {
  // Zero needs a unit too, although it is the same in every unit: 0,5um may mean half a micrometre.
  const auto bare = [](const Written& written) { return written.unit.empty(); };
  const auto first = std::ranges::find_if_not(list, bare);
  if (first == list.end() || std::ranges::none_of(list, bare)) return;
  std::string with_units, without;
  for (const Written& written : list) {
    const std::string_view unit = bare(written) ? first->unit : written.unit;
    const char* comma = &written == &list.front() ? "" : ",";
    with_units += fmt::format("{}{}{}", comma, written.number, unit);
    without += fmt::format("{}{:.6g}", comma,
                           unit_scale(written.unit, dimension, text, field)(written.number));
  }
  const std::string_view si = si_unit(dimension);
  require(false, field, "'" + std::string(text) + "'",
          fmt::format("has a unit on only some of its numbers; write {} or, {}, {}", with_units,
                      si == "1" ? "without a unit" : fmt::format("in {}", si), without) +
              (list.size() == 2 ? "; a decimal comma is written as a point" : ""));
}

std::vector<double> geometric(std::string_view text, Dimension dimension, std::string_view field) {
  const auto parts = split_at(text, ':');
  const std::string quoted = "'" + std::string(text) + "'";
  require(parts.size() == 3, field, quoted, "is not a range; write from:to:count");
  const Written to_written = split(parts[1], dimension, field);
  Written from_written = split(parts[0], dimension, field);
  require(from_written.unit.empty() || !to_written.unit.empty(), field, quoted,
          fmt::format("has a unit only on its first number; write {}:{}{}:{}", trim(parts[0]),
                      trim(parts[1]), from_written.unit, trim(parts[2])));
  if (from_written.unit.empty()) from_written.unit = to_written.unit;
  const double from = value_of(from_written, dimension, text, field);
  const double to = value_of(to_written, dimension, text, field);
  const std::string_view count_text = trim(parts[2]);
  int count = 0;
  const auto [end, status] =
      std::from_chars(count_text.data(), count_text.data() + count_text.size(), count);
  require(status == std::errc{} && end == count_text.data() + count_text.size() && count >= 2 &&
              count <= 1'000'000,
          field, quoted, "needs a count from 2 to 1000000; write from:to:count");
  require(from > 0 && to > 0 && from != to, field, quoted,
          "must run between two different numbers > 0, because its steps are logarithmic; write a "
          "list a,b,c instead");
  std::vector<double> values;
  const double step = std::log(to / from) / (count - 1);
  for (int i = 0; i < count - 1; ++i) values.push_back(from * std::exp(step * i));
  values.push_back(to);
  return values;
}

}  // namespace

std::string_view si_unit(Dimension dimension) { return about(dimension).unit; }

void require_squarable(double value, std::string_view text, std::string_view field) {
  const double size = std::abs(value);
  require(value == 0 || (size >= 1e-150 && size <= 1e150), field, "'" + std::string(text) + "'",
          "must be 0, or from 1e-150 to 1e150 in SI units; check the number and its unit");
}

double parse_quantity(std::string_view text, Dimension dimension, std::string_view field) {
  return value_of(split(text, dimension, field), dimension, text, field);
}

std::vector<double> parse_values(std::string_view text, Dimension dimension,
                                 std::string_view field) {
  if (text.find(':') != std::string_view::npos) return geometric(text, dimension, field);
  std::vector<Written> list;
  for (const std::string_view part : split_at(text, ','))
    list.push_back(split(part, dimension, field));
  require_units_at_all_or_none(text, list, dimension, field);
  std::vector<double> values;
  for (const Written& written : list) values.push_back(value_of(written, dimension, text, field));
  return values;
}

std::string format_quantity(double value, Dimension dimension, int digits) {
  if (std::isnan(value)) return "n/a";
  // Stiffness per area has a unit of its own, with two prefixes.
  if (dimension == stiffness_per_area)
    return fmt::format("{:.{}g} GPa/\u00b5m", value / 1e15, digits);
  const std::string_view unit = si_unit(dimension);
  if (!about(dimension).takes_prefix || value == 0 || std::isinf(value)) {
    return unit == "1" ? fmt::format("{:.{}g}", value, digits)
                       : fmt::format("{:.{}g} {}", value, digits, unit);
  }
  constexpr std::array engineering{
      Prefix{"f", -15}, Prefix{"p", -12}, Prefix{"n", -9}, Prefix{"\u00b5", -6}, Prefix{"m", -3},
      Prefix{"", 0},    Prefix{"k", 3},   Prefix{"M", 6},  Prefix{"G", 9},       Prefix{"T", 12}};
  // Round to the shown digits first, so that 999.96 nm reads 1 µm. strtod is used because std::stod
  // refuses subnormal numbers.
  const double rounded =
      std::strtod(fmt::format("{:.{}e}", std::abs(value), digits - 1).c_str(), nullptr);
  const int exponent = static_cast<int>(std::floor(std::log10(rounded) + 1e-12));
  const Prefix* best = &engineering.front();
  for (const Prefix& prefix : engineering) {
    if (prefix.exponent <= exponent && has_prefix(dimension, prefix.exponent)) best = &prefix;
  }
  if (exponent < best->exponent || exponent > best->exponent + 5) {
    return fmt::format("{:.{}g} {}", value, digits, unit);
  }
  return fmt::format("{:.{}g} {}{}", value / std::pow(10.0, best->exponent), digits, best->symbol,
                     unit);
}

}  // namespace salebra
