// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of summit ensembles, Greenwood-Williamson models and their sampling.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <salebra/base/spectral_moments.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/asperity/interacting_summits.hpp>

#include "bindings.hpp"
#include "interop/choice.hpp"
#include "interop/citations.hpp"
#include "interop/described.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

void bind_ensemble(nb::module_& m) {
  described_class<SummitEnsemble>(
      m, "SummitEnsemble",
      R"(A statistical ensemble of equal spherical caps whose heights z are distributed as φ(z).

Parameters
----------
summit_density : float
    η, 1/m².
radius : float
    R, m.
summit_rms : float
    σ_s, m: standard deviation (Gaussian), decay length (exponential); not used with a table.
mean_height : float
    Height of the plane z = 0 above the mean plane of the surface, m.
distribution : {"gaussian", "exponential", "tabulated"}
    Gaussian: z = 0 is the mean plane of the summits; exponential: the plane of the lowest ones.
rms_height : float
    h_rms of the surface, m, where there is one.
table : list of (float, float)
    (z, φ) of a tabulated density, heights increasing.
)")
      .def(
          "__init__",
          [](SummitEnsemble* self, double summit_density, double radius, double summit_rms,
             double mean_height, const Choice<SummitDistribution>& distribution, double rms_height,
             const std::vector<std::pair<double, double>>& table) {
            SummitEnsemble ensemble{
                summit_density, radius, summit_rms, mean_height, distribution.value("distribution"),
                rms_height,     {}};
            for (const auto& [height, phi] : table) ensemble.table.push_back({height, phi});
            new (self) SummitEnsemble(std::move(ensemble));
          },
          nb::kw_only(), nb::arg("summit_density"), nb::arg("radius"), nb::arg("summit_rms") = 0.0,
          nb::arg("mean_height") = 0.0, nb::arg("distribution") = "gaussian",
          nb::arg("rms_height") = ForceSample::unknown,
          nb::arg("table") = std::vector<std::pair<double, double>>{});
  m.def(
      "summit_ensemble",
      [](const SpectralMoments& moments) {
        cite({"nayak1971", "mccool1986"});
        SummitEnsemble ensemble =
            summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
        ensemble.rms_height = moments.rms_height();
        return ensemble;
      },
      nb::arg("moments"),
      R"(The ensemble of a Gaussian isotropic surface from its profile moments.

.. math:: \eta = \frac{m_4}{6\sqrt3\pi m_2},\quad R = \tfrac38\sqrt{\pi/m_4},\quad \sigma_s^2 = (1-0.8968/\alpha)m_0,\quad
          \bar z = 4\sqrt{m_0/(\pi\alpha)}

Nayak, doi:10.1115/1.3451608; McCool, doi:10.1016/0043-1648(86)90045-1.
)");
  m.def(
      "summit_ensemble",
      [](const SummitStatistics& statistics, double mean_plane) {
        return summit_ensemble(statistics, mean_plane);
      },
      nb::arg("statistics"), nb::arg("mean_plane") = 0.0,
      "The ensemble with the statistics of counted summits: density, mean radius, and mean and "
      "standard "
      "deviation of the heights. mean_plane: mean height of the surface, m.");
}

void bind_models(nb::module_& m) {
  described_class<AsperityContact>(
      m, "AsperityContact", "Force, area and stiffness, summed over the summits in contact.");
  nb::class_<AsperityModel> bound(
      m, "AsperityModel", nb::dynamic_attr(),
      "A smooth rigid plane at separation s from the plane z = 0 of an ensemble of summits.");
  described_property(
      bound, [](const AsperityModel& self) { return self.common().nominal_area; },
      Kept{"nominal_area", "nominal area A0", Dimension::length_squared});
  described_property(
      bound, [](const AsperityModel& self) { return self.common().first_touch; },
      Kept{"first_touch", "separation s where δ = 0", Dimension::length});
  bound
      .def(
          "at",
          [](const AsperityModel& self, double separation) {
            return unlocked([&] { return self.at(separation); });
          },
          nb::arg("separation"), "Force, area and stiffness at a separation, m.")
      .def(
          "separation_of",
          [](const AsperityModel& self, double force) {
            return unlocked([&] { return self.separation_of(force); });
          },
          nb::arg("force"), "Separation s, m, at which the summits carry a force > 0, N.")
      .def("indentation", &AsperityModel::indentation, nb::arg("separation"),
           "δ = first_touch − s, m.")
      .def("mean_gap", &AsperityModel::mean_gap, nb::arg("separation"),
           "ū = s + mean_height, from the *undeformed* mean plane of the surface, m.")
      .def_prop_ro("name", [](const AsperityModel& self) { return self.common().name; });
  nb::class_<StatisticalSummits, AsperityModel>(
      m, "StatisticalSummits", R"(Greenwood and Williamson, doi:10.1098/rspa.1966.0242.

.. math::
    F = \tfrac43E^*\sqrt R\,\eta A_0\!\int_s^\infty\!(z-s)^{3/2}\varphi\,dz,\quad
    A_c = \pi R\eta A_0\!\int_s^\infty\!(z-s)\varphi\,dz,\quad
    K = 2E^*\sqrt R\,\eta A_0\!\int_s^\infty\!(z-s)^{1/2}\varphi\,dz

Parameters
----------
ensemble : SummitEnsemble
material : Material
nominal_area : float
    A0, m².
)")
      .def(
          "__init__",
          [](StatisticalSummits* self, const SummitEnsemble& ensemble, const Material& material,
             double nominal_area) {
            cite({"greenwood_williamson1966"});
            new (self) StatisticalSummits(ensemble, material, nominal_area);
          },
          nb::arg("ensemble"), nb::arg("material"), nb::arg("nominal_area"));
  nb::class_<DeterministicSummits, AsperityModel>(
      m, "DeterministicSummits", R"(Each summit of one surface with its own height and radius.

.. math:: F = \sum_i\tfrac43E^*\sqrt{R_i}\,(z_i-s)^{3/2}

s is measured from the mean of the summit heights.

Parameters
----------
summits : SummitList
material : Material
nominal_area : float
    A0, m².
mean_plane : float
    Mean height of the surface, m, with the same zero as the heights of the summits.
rms_height : float
    m
shape : {"circular", "elliptical"}
    A sphere of the mean curvature, or Hertz's elliptical contact.
)")
      .def(
          "__init__",
          [](DeterministicSummits* self, const SummitList& summits, const Material& material,
             double nominal_area, double mean_plane, double rms_height,
             const Choice<SummitShape>& shape) {
            cite({"greenwood_williamson1966"});
            require_whole(summits, "a model of its summits");
            new (self) DeterministicSummits(summits.summits, material, nominal_area, mean_plane,
                                            rms_height, shape.value("shape"));
          },
          nb::arg("summits"), nb::arg("material"), nb::arg("nominal_area"), nb::kw_only(),
          nb::arg("mean_plane") = 0.0, nb::arg("rms_height") = ForceSample::unknown,
          nb::arg("shape") = "circular");
  nb::class_<InteractingSummits, AsperityModel>(
      m, "InteractingSummits",
      R"(The summits of a periodic surface, each pressed down by all the others.

.. math:: P_i = \tfrac43E^*\sqrt{R_i}\,\delta_i^{3/2},\qquad \delta_i = z_i - s - \sum_jG(x_i-x_j)P_j

Ciavarella et al. (2006), doi:10.1016/j.jmps.2006.05.006. One state takes seconds for 10⁵ summits; Ctrl-C stops it.
)")
      .def(
          "__init__",
          [](InteractingSummits* self, const SummitList& summits, const Material& material,
             const Grid2D& grid, double mean_plane, double rms_height,
             const Choice<SummitShape>& shape, double tolerance, int max_iterations) {
            cite({"greenwood_williamson1966", "ciavarella2006"});
            require_whole(summits, "a model of its summits");
            new (self)
                InteractingSummits(summits.summits, material, grid, mean_plane, rms_height,
                                   shape.value("shape"), {tolerance, max_iterations, signals()});
          },
          nb::arg("summits"), nb::arg("material"), nb::arg("grid"), nb::kw_only(),
          nb::arg("mean_plane") = 0.0, nb::arg("rms_height") = ForceSample::unknown,
          nb::arg("shape") = "circular", nb::arg("tolerance") = 1e-10,
          nb::arg("max_iterations") = 100);
  nb::class_<GreenwoodTripp, AsperityModel>(
      m, "GreenwoodTripp",
      "Contact of two rough surfaces by Greenwood and Tripp (1970), "
      "doi:10.1243/PIME_PROC_1970_185_069_02. Both ensembles must be Gaussian.")
      .def(
          "__init__",
          [](GreenwoodTripp* self, const SummitEnsemble& first, const SummitEnsemble& second,
             const Material& material, double nominal_area) {
            cite({"greenwood_tripp1970"});
            new (self) GreenwoodTripp(first, second, material, nominal_area);
          },
          nb::arg("first"), nb::arg("second"), nb::arg("material"), nb::arg("nominal_area"));
  m.def(
      "curve_at_separations",
      [](const AsperityModel& model, const Values& separations) {
        return unlocked([&] { return curve_at_separations(model, separations.values); });
      },
      nb::arg("model"), nb::arg("separations"),
      "Samples at the given separations, m, from the lowest force to the highest.");
  m.def(
      "curve_at_pressures",
      [](const InteractingSummits& model, const Values& pressures,
         const ProgressArgument& progress) {
        return interruptible(progress, [&](const Progress& told) {
          return curve_at_pressures(model, pressures.values, told);
        });
      },
      nb::arg("model"), nb::arg("pressures"), nb::kw_only(), nb::arg("progress") = false,
      "For interacting summits, each load starts from the state of the previous load. If "
      "`progress` "
      "stops the call, the finished samples are returned. A load without a solution has converged "
      "= "
      "False.");
  m.def(
      "curve_at_pressures",
      [](const AsperityModel& model, const Values& pressures) {
        return unlocked([&] { return curve_at_pressures(model, pressures.values); });
      },
      nb::arg("model"), nb::arg("pressures"),
      "Samples at the given pressures, > 0, Pa, from the lowest force to the highest.");
  nb::class_<GreenwoodWilliamsonLaw, ContactLaw>(
      m, "GreenwoodWilliamsonLaw",
      "F(δ) of an ensemble of summits, exactly: without table and fit. The material needs G*.")
      .def(
          "__init__",
          [](GreenwoodWilliamsonLaw* self, std::shared_ptr<AsperityModel> model) {
            new (self)
                GreenwoodWilliamsonLaw(std::shared_ptr<const AsperityModel>(std::move(model)));
          },
          nb::arg("model"));
}

void bind_sampling(nb::module_& m) {
  m.def(
      "draw_summits",
      [](const SummitEnsemble& ensemble, int count, double size, std::uint64_t seed,
         int realisation) {
        return SummitList{draw_summits(ensemble, count, size, seed, realisation), size * size};
      },
      nb::arg("ensemble"), nb::arg("count"), nb::arg("size"), nb::arg("seed"),
      nb::arg("realisation") = 0,
      "Draws random summits of an ensemble on a square of side `size`, m.");
  auto curve = described_class<MonteCarloCurve>(
      m, "MonteCarloCurve", "Force curve of surfaces of finite size: means over realisations.");
  curve.def("interval", &MonteCarloCurve::interval, nb::arg("standard_deviation"),
            "Half-width of the 95 % interval of the mean of a quantity with this standard "
            "deviation.");
  const auto deviation = [&curve](double AsperityContact::*member, const Kept& line) {
    remember_unit(curve, line.name, line.dimension);
    column_property(curve, line.name.data(), &MonteCarloCurve::deviation, member,
                    described_text(line).c_str());
  };
  deviation(&AsperityContact::force,
            {"force_deviation", "standard deviation of F over the realisations", Dimension::force});
  deviation(&AsperityContact::contact_area,
            {"contact_area_deviation", "standard deviation of A_c", Dimension::length_squared});
  deviation(&AsperityContact::normal_stiffness,
            {"normal_stiffness_deviation", "standard deviation of K", Dimension::stiffness});
  m.def(
      "monte_carlo_curve",
      [](const SummitEnsemble& ensemble, const Material& material, double nominal_area,
         const Values& separations, int realisations, std::uint64_t seed) {
        cite({"greenwood_williamson1966"});
        return unlocked([&] {
          return monte_carlo_curve(ensemble, material, nominal_area, separations.values,
                                   {realisations, seed});
        });
      },
      nb::arg("ensemble"), nb::arg("material"), nb::arg("nominal_area"), nb::arg("separations"),
      nb::kw_only(), nb::arg("realisations") = 100, nb::arg("seed") = 1,
      "Presses random realisations of an ensemble, each with round(ηA0) summits; separations in "
      "m.");
}

}  // namespace

void bind_greenwood_williamson(nb::module_& m) {
  bind_ensemble(m);
  bind_models(m);
  bind_sampling(m);
}

}  // namespace salebra::python
