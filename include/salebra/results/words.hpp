// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/half_space/half_space.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/surface/axis.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/psd_convention.hpp>
#include <salebra/surface/spectrum.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The one table of the words of enumerations: in study files, files and Python as they are here,
/// in options with "-" for "_".
namespace salebra {

template <class Enum>
struct Words;  ///< values: pairs of a value and its word

template <>
struct Words<Boundary> {
  static constexpr auto values = std::to_array<std::pair<Boundary, std::string_view>>(
      {{Boundary::periodic, "periodic"}, {Boundary::free, "free"}});
};
template <>
struct Words<Precision> {
  static constexpr auto values = std::to_array<std::pair<Precision, std::string_view>>(
      {{Precision::mixed, "mixed"}, {Precision::full, "full"}});
};
template <>
struct Words<Axis> {
  static constexpr auto values =
      std::to_array<std::pair<Axis, std::string_view>>({{Axis::x, "x"}, {Axis::y, "y"}});
};
template <>
struct Words<Detrend> {
  static constexpr auto values = std::to_array<std::pair<Detrend, std::string_view>>(
      {{Detrend::none, "none"},
       {Detrend::mean, "mean"},
       {Detrend::plane, "plane"},
       {Detrend::quadratic, "quadratic"},
       {Detrend::lines, "lines"},
       {Detrend::median_differences, "median_differences"}});
};
template <>
struct Words<Window> {
  static constexpr auto values =
      std::to_array<std::pair<Window, std::string_view>>({{Window::automatic, "default"},
                                                          {Window::none, "none"},
                                                          {Window::hann, "hann"},
                                                          {Window::blackman, "blackman"},
                                                          {Window::radial_hann, "radial_hann"}});
};
template <>
struct Words<PsdConvention> {
  static constexpr auto values = std::to_array<std::pair<PsdConvention, std::string_view>>(
      {{PsdConvention::salebra, "salebra"},
       {PsdConvention::surface_topography, "surface_topography"},
       {PsdConvention::gwyddion, "gwyddion"},
       {PsdConvention::tamaas, "tamaas"},
       {PsdConvention::rfgen, "rfgen"}});
};
template <>
struct Words<Rms> {
  static constexpr auto values = std::to_array<std::pair<Rms, std::string_view>>(
      {{Rms::height, "height"}, {Rms::slope, "slope"}});
};
template <>
struct Words<Exact> {
  static constexpr auto values = std::to_array<std::pair<Exact, std::string_view>>(
      {{Exact::heights, "heights"}, {Exact::spectrum, "spectrum"}});
};
template <>
struct Words<SummitDistribution> {
  static constexpr auto values = std::to_array<std::pair<SummitDistribution, std::string_view>>(
      {{SummitDistribution::gaussian, "gaussian"},
       {SummitDistribution::exponential, "exponential"},
       {SummitDistribution::tabulated, "tabulated"}});
};
template <>
struct Words<SummitShape> {
  static constexpr auto values = std::to_array<std::pair<SummitShape, std::string_view>>(
      {{SummitShape::circular, "circular"}, {SummitShape::elliptical, "elliptical"}});
};
template <>
struct Words<FitWeights> {
  static constexpr auto values =
      std::to_array<std::pair<FitWeights, std::string_view>>({{FitWeights::spacing, "spacing"},
                                                              {FitWeights::equal, "equal"},
                                                              {FitWeights::force, "force"}});
};
template <>
struct Words<Hold> {
  static constexpr auto values = std::to_array<std::pair<Hold, std::string_view>>(
      {{Hold::indentation, "indentation"}, {Hold::force, "force"}});
};
template <>
struct Words<Amplitude> {
  static constexpr auto values = std::to_array<std::pair<Amplitude, std::string_view>>(
      {{Amplitude::small, "small"}, {Amplitude::finite, "finite"}});
};
template <>
struct Words<SeamCheck> {
  static constexpr auto values = std::to_array<std::pair<SeamCheck, std::string_view>>(
      {{SeamCheck::window, "window"}, {SeamCheck::free, "free"}});
};

/// The word of a value.
template <class Enum>
std::string_view word_of(Enum value) {
  return std::ranges::find(Words<Enum>::values, value, &std::pair<Enum, std::string_view>::first)
      ->second;
}

/// The words of an enumeration, in its order.
template <class Enum>
std::vector<std::string> words_of() {
  std::vector<std::string> all;
  for (const auto& [value, word] : Words<Enum>::values) all.emplace_back(word);
  return all;
}

/// The value of a word, of which '-' and '_' are the same; nothing where no value has it.
template <class Enum>
std::optional<Enum> value_of(std::string word) {
  std::ranges::replace(word, '-', '_');
  for (const auto& [value, known] : Words<Enum>::values)
    if (known == word) return value;
  return {};
}

}  // namespace salebra
