// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <array>
#include <salebra/base/error.hpp>
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

/// Enumerations of the library are texts in Python, such as boundary="free"; stubs tell them as typing.Literal.
namespace salebra::python {

namespace nb = nanobind;

/// The texts of an enumeration, and their type in stubs.
template <class Enum>
struct Texts;

/// A text that ought to name a value of the enumeration.
template <class Enum>
struct Choice {
  std::string text;

  /// Throws InvalidInput that names the field and what it may be.
  Enum value(std::string_view field) const {
    std::string allowed;
    for (const auto& [value, name] : Texts<Enum>::values) {
      if (name == text) return value;
      allowed += (allowed.empty() ? "" : ", ") + std::string(name);
    }
    throw InvalidInput(std::string(field) + ": '" + text + "' is none of " + allowed +
                       "; choose one of them");
  }
};

template <class Enum>
std::string text_of(Enum value) {
  for (const auto& [candidate, name] : Texts<Enum>::values)
    if (candidate == value) return std::string(name);
  return {};
}

#define SALEBRA_TEXTS(Enum, literal, ...)                                               \
  template <>                                                                           \
  struct Texts<Enum> {                                                                  \
    static constexpr auto Name = nb::detail::const_name("typing.Literal[" literal "]"); \
    static constexpr auto values =                                                      \
        std::to_array<std::pair<Enum, std::string_view>>({__VA_ARGS__});                \
  }

SALEBRA_TEXTS(Boundary, "'periodic', 'free'", {Boundary::periodic, "periodic"},
              {Boundary::free, "free"});
SALEBRA_TEXTS(Precision, "'mixed', 'full'", {Precision::mixed, "mixed"}, {Precision::full, "full"});
SALEBRA_TEXTS(Axis, "'x', 'y'", {Axis::x, "x"}, {Axis::y, "y"});
SALEBRA_TEXTS(Detrend, "'none', 'mean', 'plane', 'quadratic'", {Detrend::none, "none"},
              {Detrend::mean, "mean"}, {Detrend::plane, "plane"},
              {Detrend::quadratic, "quadratic"});
SALEBRA_TEXTS(Window, "'default', 'none', 'hann', 'blackman', 'radial_hann'",
              {Window::automatic, "default"}, {Window::none, "none"}, {Window::hann, "hann"},
              {Window::blackman, "blackman"}, {Window::radial_hann, "radial_hann"});
SALEBRA_TEXTS(PsdConvention, "'salebra', 'surface_topography', 'gwyddion', 'tamaas', 'rfgen'",
              {PsdConvention::salebra, "salebra"},
              {PsdConvention::surface_topography, "surface_topography"},
              {PsdConvention::gwyddion, "gwyddion"}, {PsdConvention::tamaas, "tamaas"},
              {PsdConvention::rfgen, "rfgen"});
SALEBRA_TEXTS(Rms, "'height', 'slope'", {Rms::height, "height"}, {Rms::slope, "slope"});
SALEBRA_TEXTS(Exact, "'heights', 'spectrum'", {Exact::heights, "heights"},
              {Exact::spectrum, "spectrum"});
SALEBRA_TEXTS(SummitDistribution, "'gaussian', 'exponential', 'tabulated'",
              {SummitDistribution::gaussian, "gaussian"},
              {SummitDistribution::exponential, "exponential"},
              {SummitDistribution::tabulated, "tabulated"});
SALEBRA_TEXTS(SummitShape, "'circular', 'elliptical'", {SummitShape::circular, "circular"},
              {SummitShape::elliptical, "elliptical"});
SALEBRA_TEXTS(FitWeights, "'spacing', 'equal', 'force'", {FitWeights::spacing, "spacing"},
              {FitWeights::equal, "equal"}, {FitWeights::force, "force"});
SALEBRA_TEXTS(Hold, "'indentation', 'force'", {Hold::indentation, "indentation"},
              {Hold::force, "force"});
SALEBRA_TEXTS(Amplitude, "'small', 'finite'", {Amplitude::small, "small"},
              {Amplitude::finite, "finite"});
SALEBRA_TEXTS(SeamCheck, "'window', 'free'", {SeamCheck::window, "window"},
              {SeamCheck::free, "free"});

#undef SALEBRA_TEXTS

}  // namespace salebra::python

namespace nanobind::detail {

template <class Enum>
struct type_caster<salebra::python::Choice<Enum>> {
  NB_TYPE_CASTER(salebra::python::Choice<Enum>, salebra::python::Texts<Enum>::Name)

  bool from_python(handle source, uint32_t flags, cleanup_list* cleanup) noexcept {
    make_caster<std::string> text;
    if (!text.from_python(source, flags, cleanup)) return false;
    value.text = std::move(text.value);
    return true;
  }
  static handle from_cpp(const salebra::python::Choice<Enum>& choice, rv_policy policy,
                         cleanup_list* cleanup) noexcept {
    return make_caster<std::string>::from_cpp(choice.text, policy, cleanup);
  }
};

}  // namespace nanobind::detail
