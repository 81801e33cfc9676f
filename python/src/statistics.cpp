// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of spectra, Hurst exponent, correlation and bearing curve.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/profile_fit.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/spectrum.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"
#include "surface/psd_convention.hpp"

namespace salebra::python {
namespace {

void bind_spectra(nb::module_& m) {
  auto power =
      described_class<PowerSpectrum>(m, "PowerSpectrum",
                                     R"(Two-dimensional power spectral density of a surface.

.. math:: C(q) = (2\pi)^{-2}\int\langle h(0)h(x)\rangle e^{-iq\cdot x}\,d^2x, \qquad h_{rms}^2 = \int C\,d^2q

on the half-spectrum of wave vectors (i, j), j = 0 … ny/2. If the surface is distributed over processes, each has some of the columns j.
)");
  result_methods(power);
  m.def(
      "power_spectrum",
      [](const BoundSurface& surface, const Choice<Window>& window) {
        const Window chosen = window.value("window");
        return unlocked([&] { return power_spectrum(surface.surface, chosen); });
      },
      nb::arg("surface"), nb::arg("window") = "default",
      R"(Power spectral density of a surface; exact on the modes of a periodic one: Σ C d²q = h_rms².

Parameters
----------
surface : Surface
    Without undefined points; subtract the tilt before.
window : {"default", "none", "hann", "blackman", "welch", "radial_hann"}
    "default": none for a periodic surface, "hann" for any other.
)");

  auto radial = described_class<RadialSpectrum>(m, "RadialSpectrum",
                                                "C averaged over rings of wave vectors.");
  result_methods(radial);
  m.def("radial_spectrum", &radial_spectrum, nb::arg("spectrum"), nb::arg("bins_per_octave") = 4,
        "Averages C over rings whose limits have the ratio 2^(1/bins_per_octave).");

  auto profile = described_class<ProfilePsd>(
      m, "ProfilePsd", "Power spectral density of profiles, C₁(q) = ∫C dq_y, h_rms² = ∫C₁ dq.");
  result_methods(profile);
  m.def(
      "profile_psd",
      [](const BoundSurface& surface, const Choice<Axis>& axis, const Choice<Window>& window) {
        const Axis along = axis.value("axis");
        const Window chosen = window.value("window");
        return unlocked([&] { return profile_psd(surface.surface, along, chosen); });
      },
      nb::arg("surface"), nb::arg("axis") = "x", nb::arg("window") = "default",
      "Mean power spectral density of all profiles along an axis.");

  described_class<ConvertedPsd>(
      m, "ConvertedPsd",
      "A power spectral density in the convention of another program, with its units.");
  m.def(
      "converted",
      [](const RadialSpectrum& spectrum, const Grid2D& grid,
         const Choice<PsdConvention>& convention) {
        return converted(spectrum, grid, convention.value("convention"));
      },
      nb::arg("spectrum"), nb::arg("grid"), nb::arg("convention"),
      R"(A spectrum in the convention of another program.

convention: "salebra" C(q), m⁴, h_rms² = 2π∫qC dq; "surface_topography" (2π)²C; "gwyddion" 2πqC, m³; "tamaas" (2π/L)²C over integer
wave numbers, m²; "rfgen" (2π/dx)²C over cycles in a sample, m².
)");
  m.def(
      "converted",
      [](const ProfilePsd& spectrum, const Choice<PsdConvention>& convention) {
        return converted(spectrum, convention.value("convention"));
      },
      nb::arg("spectrum"), nb::arg("convention"));
}

void bind_hurst(nb::module_& m) {
  described_class<HurstEstimate>(m, "HurstEstimate",
                                 "Hurst exponent of the self-affine range, with its 95 % interval; "
                                 "NaN if there is no such range.");
  m.def("estimate_hurst", &estimate_hurst, nb::arg("spectrum"), nb::arg("shortest_wavelength") = 0,
        "Hurst exponent by maximum quasi-likelihood over the power-law part of a "
        ":class:`PowerSpectrum`, C ∝ q^{−2(1+H)}.");
  described_class<IntervalEstimate>(m, "IntervalEstimate",
                                    "A value with its 95 % interval; NaN if unknown.");
  described_class<ProfileFit>(
      m, "ProfileFit", "A line profile, and an isotropic surface that can have this profile.");
  m.def(
      "fit_profile",
      [](const BoundSurface& profile, double shortest_wavelength) {
        return unlocked([&] { return fit_profile(profile.surface, shortest_wavelength); });
      },
      nb::arg("profile"), nb::arg("shortest_wavelength") = 0,
      "Rq, slope and the isotropic self-affine surface of a line profile: a surface of one row, as "
      ":func:`read_surface` with ``profiles=True`` returns it.");
  described_class<SelfAffineFit>(m, "SelfAffineFit", "The self-affine model of a surface.");
  described_class<DirectionalSelfAffineFit>(m, "DirectionalSelfAffineFit",
                                            "The self-affine laws across and along a lay.");
  m.def("fit_self_affine", nb::overload_cast<const PowerSpectrum&, double>(&fit_self_affine),
        nb::arg("spectrum"), nb::arg("shortest_wavelength") = 0,
        "Hurst exponent, roll-off and shortest wavelength of a :class:`PowerSpectrum`.");
  m.def("fit_self_affine",
        nb::overload_cast<const PowerSpectrum&, const SurfaceLay&, double>(&fit_self_affine),
        nb::arg("spectrum"), nb::arg("lay"), nb::arg("shortest_wavelength") = 0,
        "The same across and along a lay, that of :func:`surface_lay`. The :class:`PowerSpectrum` "
        "needs a window.");
}

void bind_correlation(nb::module_& m) {
  described_class<CorrelationMap>(
      m, "CorrelationMap",
      R"(Autocorrelation and structure function over distance vectors up to half the surface.

.. math:: A(r) = \langle(h(x)-\bar h)(h(x+r)-\bar h)\rangle, \qquad S(r) = \langle(h(x+r)-h(x))^2\rangle

Row nx/2 + i and column j hold r = (i·dx, j·dy), j >= 0.
)");
  m.def("correlation_map", &of_surface<correlation_map>, nb::arg("surface"),
        "Correlation of a surface, without its undefined points.");
  auto correlation = described_class<Correlation>(
      m, "Correlation", "Autocorrelation and structure function over distance.");
  result_methods(correlation);
  m.def(
      "profile_correlation",
      [](const CorrelationMap& map_, const Choice<Axis>& axis) {
        return profile_correlation(map_, axis.value("axis"));
      },
      nb::arg("map"), nb::arg("axis") = "x",
      "Correlation along one axis: the mean over all profiles.");
  m.def("radial_correlation", &radial_correlation, nb::arg("map"), nb::arg("bins_per_octave") = 4,
        "Correlation over distance: the mean over all directions, in rings.");

  auto scale = described_class<ScaleDependence>(
      m, "ScaleDependence",
      "Slope and curvature along one axis, over the distance used in the finite differences, "
      "doi:10.1016/j.apsadv.2021.100190.");
  result_methods(scale);
  m.def(
      "scale_dependence",
      [](const BoundSurface& surface, const Choice<Axis>& axis) {
        cite({"sanner2022"});
        const Axis along = axis.value("axis");
        return unlocked([&] { return scale_dependence(surface.surface, along); });
      },
      nb::arg("surface"), nb::arg("axis") = "x",
      "Slope and curvature over scale, doi:10.1016/j.apsadv.2021.100190.");

  described_class<ReliabilityLimit>(
      m, "ReliabilityLimit",
      "Wavelengths below which a measured surface shows the instrument rather than the surface.");
  m.def(
      "short_wavelength_limit",
      [](const BoundSurface& surface, std::optional<double> tip_radius,
         std::optional<double> resolution, double safety_factor) {
        cite({"sanner2022"});
        return unlocked([&] {
          return short_wavelength_limit(surface.surface, {tip_radius, resolution, safety_factor});
        });
      },
      nb::arg("surface"), nb::kw_only(), nb::arg("tip_radius") = nb::none(),
      nb::arg("resolution") = nb::none(), nb::arg("safety_factor") = 0.5,
      "Shortest reliable wavelength for a tip radius (m) or a lateral resolution (m).");
}

void bind_bearing(nb::module_& m) {
  nb::class_<BearingCurve> bearing(m, "BearingCurve", nb::dynamic_attr(),
                                   "Abbott and Firestone's bearing curve c(p): the height above "
                                   "which a fraction p of the surface lies.");
  number_method(bearing, "height", "area_fraction", &BearingCurve::height,
                "c(p), m; ISO 25178-2 Smc(p).");
  number_method(bearing, "area_fraction", "height", &BearingCurve::area_fraction,
                "The fraction of the surface above a height, m; ISO 25178-2 Smr(c).");
  bearing
      .def(
          "__init__",
          [](BearingCurve* self, const BoundSurface& surface) {
            new (self) BearingCurve(surface.surface);
          },
          nb::arg("surface"))
      .def("integral", &BearingCurve::integral, nb::arg("start"), nb::arg("stop"), "∫ c dp, m.")
      .def_prop_ro(
          "heights",
          [](nb::handle_t<BearingCurve> self) {
            return view(nb::cast<const BearingCurve&>(nb::handle(self)).heights(), self);
          },
          "Heights in decreasing order, m.");
  described_class<CoreParameters>(m, "CoreParameters",
                                  "Core, peaks and valleys of a bearing curve by ISO 25178-2.");
  m.def("core_parameters", &core_parameters, nb::arg("curve"), "Sk, Spk, Svk, Smr1, Smr2.");
  auto histogram = described_class<HeightHistogram>(
      m, "HeightHistogram",
      "Density of heights in bins of equal width, at the middles of the bins.");
  result_methods(histogram);
  m.def("height_histogram", &height_histogram, nb::arg("curve"), nb::arg("bins") = 0,
        "Histogram of the heights. bins = 0: bins of width 2·(interquartile range)/N^(1/3), "
        "doi:10.1007/BF01025868.");
}

}  // namespace

void bind_statistics(nb::module_& m) {
  bind_spectra(m);
  bind_hurst(m);
  bind_correlation(m);
  bind_bearing(m);
}

}  // namespace salebra::python
