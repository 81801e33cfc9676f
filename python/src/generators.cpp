// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of spectra, random surfaces and profiles.
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <salebra/figures/figures.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/generators/profile.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/generators/random_phase.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/processes.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

/// Defines the constructor of self-affine spectra, of surfaces or of profiles.
template <class Class>
void self_affine_constructor(Class& bound) {
  bound.def(
      "__init__",
      [](typename Class::Type* self, double hurst, std::optional<double> long_cutoff,
         std::optional<double> rolloff, double short_cutoff, std::optional<double> rms_height,
         std::optional<double> rms_slope) {
        new (self) typename Class::Type(
            {hurst, long_cutoff, rolloff, short_cutoff, rms_height, rms_slope});
      },
      nb::kw_only(), nb::arg("hurst") = 0.8, nb::arg("long_cutoff") = nb::none(),
      nb::arg("rolloff") = nb::none(), nb::arg("short_cutoff"), nb::arg("rms_height") = nb::none(),
      nb::arg("rms_slope") = nb::none());
}

void bind_spectra(nb::module_& m) {
  nb::class_<Spectrum> spectrum(m, "Spectrum", nb::dynamic_attr(),
                                R"(Power spectral density of a random surface.

.. math:: C(q) = (2\pi)^{-2}\int\langle h(0)h(x)\rangle e^{-iq\cdot x}\,d^2x, \qquad h_{rms}^2 = \int C\,d^2q

The mode of wave vector q = 2π(i/lx, j/ly) has the mean power C(q)·(2π)²/(lx ly).
)");
  described_property(
      spectrum, &Spectrum::highest_wavenumber,
      Kept{"highest_wavenumber", "C vanishes beyond this wave number", Dimension::wavenumber});
  spectrum
      .def("density", &Spectrum::density, nb::arg("qx"), nb::arg("qy"),
           "C(q), m⁴; qx, qy in rad/m.")
      .def_prop_ro("moments", &Spectrum::moments, "Moments of the continuum.")
      .def(
          "lattice_moments",
          [](const Spectrum& self, const Grid2D& grid, const ProgressArgument& progress) {
            return interruptible(
                progress, [&](const Progress& told) { return self.lattice_moments(grid, told); });
          },
          nb::arg("grid"), nb::kw_only(), nb::arg("progress") = false,
          "Mean moments of surfaces on this grid: sums over the modes that the grid resolves.")
      .def("__repr__", &Spectrum::description);
  nb::class_<IsotropicSpectrum, Spectrum> radial(m, "IsotropicSpectrum",
                                                 "A spectrum that depends only on ``|q|``.");
  number_method(radial, "radial_density", "q", &IsotropicSpectrum::radial_density,
                "C, m⁴, at wave numbers > 0, rad/m; a number or an array.");
  nb::class_<SelfAffineSpectrum, IsotropicSpectrum> self_affine(
      m, "SelfAffineSpectrum",
      R"(Self-affine spectrum with a plateau.

.. math::
    C = C_0 \;(q_L \le q < q_r), \qquad C = C_0\,(q/q_r)^{-2(1+H)} \;(q_r \le q \le q_s), \qquad C = 0 \text{ elsewhere}

C0 gives the *continuum* the requested rms height (or slope); :meth:`lattice_moments` are those of a surface on a grid.

Parameters
----------
hurst : float
    H, 0 < H <= 1.
long_cutoff : float, optional
    Longest wavelength 2π/q_L, m; none: every wave that fits the surface.
rolloff : float, optional
    2π/q_r <= long_cutoff, m; none: no plateau.
short_cutoff : float
    Shortest wavelength 2π/q_s, m.
rms_height : float, optional
    m; exactly one of rms_height and rms_slope.
rms_slope : float, optional
    ``√⟨|∇h|²⟩``.
)");
  auto bound = nb::borrow<nb::class_<SelfAffineSpectrum>>(self_affine);
  described_property(bound, &SelfAffineSpectrum::plateau,
                     Kept{"plateau", "C0", Dimension::length_to_the_fourth});
  self_affine_constructor(self_affine);
  nb::class_<TabulatedSpectrum, IsotropicSpectrum>(
      m, "TabulatedSpectrum",
      "A spectrum from a table, with straight lines of ln C over ln q between its points and 0 "
      "outside "
      "them.\n\n"
      "wavenumbers: > 0, increasing, rad/m; densities: > 0, m⁴.")
      .def(
          "__init__",
          [](TabulatedSpectrum* self, Values wavenumbers, Values densities) {
            new (self)
                TabulatedSpectrum(std::move(wavenumbers.values), std::move(densities.values));
          },
          nb::arg("wavenumbers"), nb::arg("densities"));
  nb::class_<FunctionSpectrum, IsotropicSpectrum>(
      m, "FunctionSpectrum",
      "Any function ``C(|q|)`` in m⁴ between two wave numbers, rad/m, and 0 outside them. A Python "
      "function is slow, with one call for each wave; :class:`TabulatedSpectrum` is fast.")
      .def(nb::init<std::function<double(double)>, double, double, std::string>(),
           nb::arg("density"), nb::arg("lowest"), nb::arg("highest"), nb::arg("name") = "function");
  nb::class_<Anisotropy> stretch(m, "Anisotropy",
                                 "Stretch of an isotropic surface: correlation lengths along·ℓ and "
                                 "across·ℓ; `angle` from the x "
                                 "axis to the direction of `along`, rad.");
  value_methods(stretch);
  stretch
      .def(
          "__init__",
          [](Anisotropy* self, double along, double across, double angle) {
            new (self) Anisotropy{along, across, angle};
          },
          nb::kw_only(), nb::arg("along") = 1.0, nb::arg("across") = 1.0, nb::arg("angle") = 0.0)
      .def_ro("along", &Anisotropy::along)
      .def_ro("across", &Anisotropy::across)
      .def_ro("angle", &Anisotropy::angle, "rad")
      .def_prop_ro("peklenik", &Anisotropy::peklenik, "γ = along/across.");
  nb::class_<AnisotropicSpectrum, Spectrum>(m, "AnisotropicSpectrum",
                                            "The spectrum of an isotropic surface that is "
                                            "stretched along two perpendicular directions; the "
                                            "rms height stays the same.")
      .def(
          "__init__",
          [](AnisotropicSpectrum* self, std::shared_ptr<IsotropicSpectrum> isotropic,
             const Anisotropy& anisotropy) {
            new (self) AnisotropicSpectrum(std::move(isotropic), anisotropy);
          },
          nb::arg("isotropic"), nb::arg("anisotropy"));
  m.def("gaussian_correlation_spectrum", &gaussian_correlation_spectrum, nb::arg("rms_height"),
        nb::arg("correlation_length"), "⟨h(0)h(r)⟩ = rms_height² exp(−r²/ℓ²), lengths in m.");
  m.def("exponential_correlation_spectrum", &exponential_correlation_spectrum,
        nb::arg("rms_height"), nb::arg("correlation_length"), nb::arg("short_cutoff"),
        "⟨h(0)h(r)⟩ = rms_height² exp(−r/ℓ), down to the shortest wavelength; lengths in m.");
}

void bind_forecast(nb::module_& m) {
  described_class<Forecast>(m, "Forecast", "Forecast for a surface that will be generated.");
  m.def(
      "forecast",
      [](const Grid2D& grid, const Spectrum& spectrum, const ProgressArgument& progress) {
        return interruptible(progress,
                             [&](const Progress& told) { return forecast(grid, spectrum, told); });
      },
      nb::arg("grid"), nb::arg("spectrum"), nb::kw_only(), nb::arg("progress") = false,
      "Moments, scatter, memory and warnings of a surface before it is made.");
}

/// Binds the generator make(grid, spectrum, seed, further…, progress, communicator) as a Python
/// function, which several processes may call together. further: arguments between `seed` and the
/// keywords.
template <class Make, class... Further, class... Argument>
void maker(nb::module_& m, const char* name, std::type_identity<void(Further...)>, Make make,
           const char* description, Argument... arguments) {
  m.def(
      name,
      [make](const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Further... further,
             const ProcessesArgument& comm, const ProgressArgument& progress) {
        cite({"salmon2011"});
        const Communicator communicator = comm.communicator();
        const auto made = [&](const Progress& told) {
          return make(grid, spectrum, seed, further..., told, communicator);
        };
        return new_surface(interruptible(progress, made, communicator));
      },
      nb::arg("grid"), nb::arg("spectrum"), nb::arg("seed"), arguments..., nb::kw_only(),
      nb::arg("comm") = nb::none(), nb::arg("progress") = false, description);
}

void bind_makers(nb::module_& m) {
  const std::type_identity<void()> no_more;
  maker(m, "filtered_noise", no_more, &filtered_noise,
        R"(A periodic Gaussian random surface with a given spectrum, by filtering white noise.

.. math:: h(x) = \sum_q a(q) e^{iq\cdot x}, \qquad \langle|a(q)|^2\rangle = C(q)\,(2\pi)^2/(l_x l_y)

The surface is an exact Gaussian process: rms height and slope vary with the seed. Amplitudes are keyed by (seed, i, j): the bits do not
depend on the number of threads, and all grids of one size have the same long waves.

Parameters
----------
grid : Grid2D
spectrum : Spectrum
seed : int
    Any value >= 0.
comm : mpi4py.MPI.Intracomm, optional
    Processes that generate the surface together: each makes this call and has the rows `surface.rows`, with the same bits as a single
    process. Needs a build with MPI.
progress : bool or callable
    True: a bar of tqdm; a function of a :class:`ProgressReport` that returns False to stop.

Raises
------
InvalidInput
    If the grid does not resolve the spectrum.
Interrupted
    If `progress` returned False in any process.
)");
  maker(
      m, "random_phase", no_more, &random_phase,
      R"(A periodic surface in which only the phases are random: ``|a(q)|² = C(q)·(2π)²/(lx ly)`` exactly.

For each seed, rms height, slope and all moments equal :meth:`Spectrum.lattice_moments`. Arguments and errors as for
:func:`filtered_noise`.
)");
  maker(
      m, "exact_rms", std::type_identity<void(const Choice<Rms>&)>{},
      [](const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, const Choice<Rms>& which,
         const Progress& told, const Communicator& communicator) {
        return exact_rms(grid, spectrum, seed, which.value("which"), told, communicator);
      },
      "A random-phase surface, scaled to the rms height (or slope) of the continuum, "
      "`spectrum.moments`.",
      nb::arg("which") = "height");
  m.def(
      "scale_to_rms",
      [](const BoundSurface& surface, const Choice<Rms>& which, double target) {
        const Rms chosen = which.value("which");
        return new_surface(
            unlocked([&] { return scale_to_rms(Surface(surface.surface), chosen, target); }));
      },
      nb::arg("surface"), nb::arg("which"), nb::arg("target"),
      "Subtracts the mean of a surface and scales it to this rms height (m) or rms slope.");
  m.def(
      "composite_surface",
      [](const BoundSurface& first, const BoundSurface& second) {
        return new_surface(
            unlocked([&] { return composite_surface(first.surface, second.surface); }));
      },
      nb::arg("first"), nb::arg("second"),
      "One rough surface equivalent to two: h = h₁ + h₂, where each height points out of its own "
      "body.");
  m.def(
      "crop_surface",
      [](const BoundSurface& surface, Index first_x, Index first_y, Index nx, Index ny) {
        return new_surface(
            unlocked([&] { return crop_surface(surface.surface, first_x, first_y, nx, ny); }));
      },
      nb::arg("surface"), nb::arg("first_x"), nb::arg("first_y"), nb::arg("nx"), nb::arg("ny"),
      "The part of nx × ny cells that starts at (first_x, first_y). It is not periodic. In a "
      "periodic "
      "surface it may cross the edge.");
}

void bind_non_gaussian(nb::module_& m) {
  nb::class_<HeightDistribution> bound(
      m, "HeightDistribution", nb::dynamic_attr(),
      "A distribution of heights; location and scale do not matter.");
  number_method(
      bound, "quantile", "u",
      [](const HeightDistribution& self, double u) { return self.quantile(u); },
      "Height below which a fraction u of the surface lies, 0 < u < 1.");
  bound.def_ro("name", &HeightDistribution::name);
  m.def("gaussian_heights", &gaussian_heights, "Normal heights.");
  m.def("weibull_heights", &weibull_heights, nb::arg("shape"),
        "Weibull: u = 1 − exp(−x^shape), shape > 0.");
  m.def(
      "johnson_heights",
      [](double skewness, double kurtosis) {
        cite({"johnson1949"});
        return johnson_heights(skewness, kurtosis);
      },
      nb::arg("skewness"), nb::arg("kurtosis"),
      "The member of Johnson's system with this skewness and kurtosis (3 for a Gaussian), "
      "doi:10.1093/biomet/36.1-2.149.");
  m.def(
      "sampled_heights", [](Values given) { return sampled_heights(std::move(given.values)); },
      nb::arg("heights"),
      "The distribution of given heights, such as those of a measured surface.");

  struct BoundNonGaussian : NonGaussianSurface {
    nb::object made;
  };
  nb::class_<BoundNonGaussian> made(m, "NonGaussianSurface",
                                    "A surface and how its iteration ended.");
  figure_methods(made, [](const BoundNonGaussian& self) {
    return figures::figure_of(nb::cast<const BoundSurface&>(self.made).surface);
  });
  describe(
      [&]<class Member>(Member NonGaussianSurface::*member, const auto& line) {
        if constexpr (!std::is_same_v<Member, Surface>) described_property(made, member, line);
      },
      std::type_identity<NonGaussianSurface>{});
  made.def_ro("surface", &BoundNonGaussian::made, nb::sig("def surface(self) -> Surface"))
      .def(
          "__getstate__",
          [](const BoundNonGaussian& self) {
            return nb::make_tuple(self.made, self.iterations, self.spectrum_mismatch,
                                  std::string(name_of(self.termination)));
          },
          nb::sig("def __getstate__(self) -> tuple[Surface, int, float, str]"))
      .def(
          "__setstate__",
          [](BoundNonGaussian* self, const nb::tuple& state) {
            new (self) BoundNonGaussian{};
            self->made = state[0];
            self->iterations = nb::cast<int>(state[1]);
            self->spectrum_mismatch = nb::cast<double>(state[2]);
            self->termination = parse_enum<Termination>(nb::cast<std::string>(state[3])).value();
          },
          nb::sig("def __setstate__(self, state: tuple[Surface, int, float, str], /) -> None"))
      .def(
          "__eq__",
          [](nb::handle self, nb::handle other) {
            return self.type().is(other.type()) &&
                   self.attr("__getstate__")().equal(other.attr("__getstate__")());
          },
          nb::arg("other").none(), nb::sig("def __eq__(self, other: object, /) -> bool"));
  m.def(
      "non_gaussian",
      [](const Grid2D& grid, const Spectrum& spectrum, const HeightDistribution& distribution,
         std::uint64_t seed, const Choice<Exact>& exact, int max_iterations, double tolerance,
         const ProgressArgument& progress) {
        cite({"schreiber1996", "salmon2011"});
        NonGaussianOptions options{exact.value("exact"), max_iterations, tolerance, {}};
        NonGaussianSurface result = interruptible(progress, [&](Progress told) {
          options.on_progress = std::move(told);
          return non_gaussian(grid, spectrum, distribution, seed, options);
        });
        nb::object surface =
            nb::cast(new_surface(std::move(result.surface)), nb::rv_policy::take_ownership);
        return BoundNonGaussian{std::move(result), std::move(surface)};
      },
      nb::arg("grid"), nb::arg("spectrum"), nb::arg("distribution"), nb::arg("seed"), nb::kw_only(),
      nb::arg("exact") = "heights", nb::arg("max_iterations") = 200, nb::arg("tolerance") = 1e-3,
      nb::arg("progress") = false,
      R"(A periodic surface with a given spectrum and a given height distribution.

The method is the iterated amplitude-adjusted Fourier transform, doi:10.1103/PhysRevLett.77.635. In turn, it replaces the heights by those
of the distribution in the same order, and the amplitudes of the modes by those of the spectrum with the same phases.

Parameters
----------
exact : {"heights", "spectrum"}
    Which of the two the result has exactly.
max_iterations : int
tolerance : float
    Stop when an iteration reduces the mismatch by less than this fraction.
progress : bool or callable
    True: a bar of tqdm; a function of a :class:`ProgressReport` that returns False to stop.
)");
}

void bind_profiles(nb::module_& m) {
  described_class<Profile>(m, "Profile",
                           "A periodic line of heights: point k lies at x = k·length/n.");
  nb::class_<ProfileSpectrum>(m, "ProfileSpectrum", nb::dynamic_attr(),
                              "Power spectral density C₁(q) of a random profile, h_rms² = ∫C₁ dq.")
      .def("density", &ProfileSpectrum::density, nb::arg("q"), "``C₁(|q|)``, m³.")
      .def_prop_ro("moments", &ProfileSpectrum::moments)
      .def("__repr__", &ProfileSpectrum::description);
  nb::class_<SelfAffineProfileSpectrum, ProfileSpectrum> self_affine(
      m, "SelfAffineProfileSpectrum",
      "Self-affine profile: C₁ = C0 from q_L to q_r, C0 (q/q_r)^{−(1+2H)} up to q_s. Parameters as "
      "SelfAffineSpectrum.");
  self_affine_constructor(self_affine);
  m.def("filtered_noise_profile", &filtered_noise_profile, nb::arg("points"), nb::arg("length"),
        nb::arg("spectrum"), nb::arg("seed"), "A Gaussian random profile.");
  m.def("random_phase_profile", &random_phase_profile, nb::arg("points"), nb::arg("length"),
        nb::arg("spectrum"), nb::arg("seed"),
        "A profile in which every mode has exactly its target power.");
}

}  // namespace

void bind_generators(nb::module_& m) {
  bind_spectra(m);
  bind_forecast(m);
  bind_makers(m);
  bind_non_gaussian(m);
  bind_profiles(m);
}

}  // namespace salebra::python
