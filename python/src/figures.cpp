// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of figures: their data, and the methods figure() and plot() of results.
#include <nanobind/stl/variant.h>

#include <cmath>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/generators/profile.hpp>
#include <salebra/study/sensitivity.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/scale_dependence.hpp>

#include "bindings.hpp"
#include "interop/contact.hpp"
#include "interop/curves.hpp"
#include "interop/damping.hpp"
#include "interop/described.hpp"
#include "interop/path.hpp"
#include "surface/psd_convention.hpp"

namespace salebra::python {
namespace {

using figures::Axis;
using namespace figures;

template <class Result>
Figure drawn(const Result& result) {
  return figure_of(result);
}

Figure drawn(const BoundSurface& surface) { return figure_of(surface.surface); }
Figure drawn(const BoundContact& contact) { return figure_of(contact.grid, contact); }
Figure drawn(const MonteCarloCurve& curve) {
  return figure_of(curve.mean, std::optional<ExponentialFit>());
}

Figure drawn(const ConvertedPsd& spectrum) {
  const auto axis = [](const char* label, const std::string& unit) {
    return Axis{.label = label, .unit = unit == "1" ? "" : unit, .logarithmic = true};
  };
  return {.kind = "converted_psd",
          .panels = {{.x = axis("wave number", spectrum.wavenumber_unit),
                      .y = axis("power spectral density", spectrum.psd_unit),
                      .curves = {{.x = spectrum.wavenumber, .y = spectrum.psd}}}}};
}

Figure drawn(const SurfacePicture& picture) { return figure_of(picture, std::vector<double>()); }

/// Results that do not have their loop: from a pickle, or of a simulation of cells.
[[noreturn]] Figure without_contact(const char* name) {
  throw InvalidInput(name,
                     "does not know the contact law that its figure needs, which pickles and "
                     "simulations of cells do not keep; compute it of a law");
}
Figure drawn(const JointLoss&) { return without_contact("JointLoss"); }
Figure drawn(const SteadySliding&) { return without_contact("SteadySliding"); }

Figure drawn(const BoundDampingCurve& curve) {
  Figure figure = figure_of(curve.coordinate, curve.values,
                            std::vector<DampingResult>(curve.results.begin(), curve.results.end()));
  figure.caption += curve.setting;
  state_validity(figure, assumptions_of(curve.results), follow_slip(curve.results));
  return figure;
}

Figure drawn(const CurveOf<DampingPoint>& curve) { return figure_of(curve.results); }

Figure drawn(const CurveOf<ViscoelasticCycle>& curve) {
  Figure figure = figure_of(curve.coordinate, curve.values, curve.results);
  figure.caption += curve.setting;
  state_validity(figure, std::span<const AssumptionVerdict>());
  return figure;
}

/// Means with their 95 % limits or, without limits, with their numerical errors; and a panel for each
/// number that other results of a curve have.
template <class Item>
Figure drawn(const CurveOf<Item>& curve) {
  Figure figure{.kind = "curve"};
  const auto add = [&](std::string_view name, const auto& number) {
    Curve points{.x = curve.values, .style = Style::line_and_points};
    for (const Item& one : curve.results) points.y.push_back(number(one));
    if (std::ranges::any_of(points.y, [](double value) { return std::isfinite(value); }))
      figure.panels.push_back(curve_figure(curve.coordinate, name, std::move(points)).panels[0]);
  };
  if constexpr (requires(Item one) { one.mean; }) {
    add(curve.quantity, [](const Item& one) { return one.mean; });
    for (Panel& panel : figure.panels) {
      Curve& points = panel.curves[0];
      for (const Item& one : curve.results) {
        double low = one.low, high = one.high;
        if constexpr (requires { one.error; })
          if (!std::isfinite(low)) low = one.mean - one.error, high = one.mean + one.error;
        points.low.push_back(low);
        points.high.push_back(high);
      }
      points.style = Style::points;
    }
  } else {
    salebra::for_each_number<Item>(
        [&](const NumberOf<Item>& number, const auto& line) { add(line.name, number); });
  }
  require(!figure.panels.empty(), "curve", curve.results.size(),
          "results, none of which has a number: there is nothing to draw");
  return figure;
}

/// Defines figure() and plot() of these classes.
template <class... Bound>
void drawn_classes() {
  (
      [] {
        auto bound = nb::borrow<nb::class_<Bound>>(nb::type<Bound>());
        figure_methods(bound, [](const Bound& self) { return drawn(self); });
      }(),
      ...);
}

void bind_laws() {
  using Fit = std::variant<bool, ExponentialFit>;
  auto curve = nb::borrow<nb::class_<ForceCurve>>(nb::type<ForceCurve>());
  curve.def(
      "figure",
      [](const ForceCurve& self, const Fit& fit) {
        if (const auto* given = std::get_if<ExponentialFit>(&fit))
          return with_limits(figure_of(self, *given));
        std::optional<ExponentialFit> found;
        try {
          if (std::get<bool>(fit)) found = fit_exponential(self, {});
        } catch (const InvalidInput&) {
          // Too few points in the window: the curve is drawn alone.
        }
        Figure figure = figure_of(self, found);
        if (found)
          figure.caption += " The interval of the decay length is the 95 % interval of the fit.";
        return with_limits(std::move(figure));
      },
      nb::arg("fit") = true,
      "The curve and an exponential law fitted to it, as data. fit=False: no law; an "
      "ExponentialFit is drawn instead.");
  figure_methods(curve, nullptr);
  auto law = nb::borrow<nb::class_<ContactLaw>>(nb::type<ContactLaw>());
  law.def(
         "figure",
         [](const ContactLaw& self, const std::variant<double, Values>& indentation) {
           if (const auto* several = std::get_if<Values>(&indentation))
             return with_limits(figure_of(self, several->values));
           const auto* indenter = dynamic_cast<const IndenterLaw*>(&self);
           require_that(indenter != nullptr, "indentation",
                        "is one number, which draws an IndenterLaw; give an array for F(δ)");
           return with_limits(figure_of(*indenter, std::get<double>(indentation)));
         },
         nb::arg("indentation"),
         "F(δ) at several indentations, m; the contact of an IndenterLaw at one indentation: "
         "profile, springs, pressure and force.")
      .def(
          "plot",
          [](nb::handle self, nb::args arguments, nb::kwargs keywords) {
            return call_python("salebra._plots", "plot_law", self, arguments, keywords);
          },
          nb::sig("def plot(self, indentation: numpy.typing.ArrayLike, ax: matplotlib.axes.Axes | "
                  "None = None, panel: int | str = 0, **kwargs: typing.Any) -> "
                  "matplotlib.axes.Axes"),
          "Draws a panel of figure(indentation), F(δ) at several indentations, m.");
}

void bind_data(nb::module_& m) {
  described_class<Axis>(m, "Axis", "An axis: quantity, label, SI unit, and limits, if any.");
  described_class<SecondAxis>(m, "SecondAxis", "A second scale of an axis.");
  described_class<Curve>(m, "Curve", "Points, with a band or with error bars.");
  described_class<Image>(m, "Image", "A map of values in colours.");
  described_class<ReferenceLine>(m, "ReferenceLine", "A thin line across a panel.");
  described_class<ShadedRange>(m, "ShadedRange", "A shaded range of an axis.");
  described_class<Panel>(m, "Panel", "One pair of axes with what is drawn on it.");
  const auto ask = [](const char* function, nb::handle self, auto&&... arguments) {
    return nb::module_::import_("salebra._plots").attr(function)(self, arguments...);
  };
  described_class<Figure>(m, "Figure", "What is drawn of a result, as data in SI units.")
      .def("json", &figure_json, "The figure as JSON, as the program writes it.")
      .def(
          "plot",
          [ask](nb::handle_t<Figure> self, std::optional<double> width, bool caption) {
            return ask("plot_figure", self, width, true, caption);
          },
          nb::arg("width") = nb::none(), nb::kw_only(), nb::arg("caption") = true,
          nb::sig("def plot(self, width: float | None = None, *, caption: bool = True) -> "
                  "matplotlib.figure.Figure"),
          "Draws all panels with matplotlib. width: of a figure for a journal, such as \"85mm\". "
          "caption=False: without the caption, which the journal sets.")
      .def(
          "save",
          [ask](nb::handle_t<Figure> self, const std::filesystem::path& file,
                std::optional<double> width, bool overwrite,
                bool caption) { ask("save_figure", self, file, width, overwrite, caption); },
          nb::arg("file"), nb::arg("width") = nb::none(), nb::kw_only(),
          nb::arg("overwrite") = false, nb::arg("caption") = true,
          "Writes a picture, .svg, .pdf or .png, with text as text, or the numbers, .json.");
}

}  // namespace

void bind_figures(nb::module_& parent) {
  nb::module_ m = parent.def_submodule("_figures");
  bind_data(m);
  drawn_classes<BoundSurface, BoundContact, ExponentialFit, LocalDecayLength, ContactSpots,
                SpotStatistics, SummitList, PowerSpectrum, RadialSpectrum, ProfilePsd, ConvertedPsd,
                CorrelationMap, Correlation, ScaleDependence, HeightHistogram, BearingCurve,
                Profile, MonteCarloCurve, AsperityDamping, SampledMotion, TrajectoryDamping,
                ViscoelasticDamping, ViscoelasticIndentation, ViscoelasticPath, ContactSetAt,
                CycleResult, JointLoss, SteadySliding, SliderMotion, StressMap, FrictionMap,
                RegimeMap, DamperMap, SurfacePicture, ModelResult, Realisation, StudyResult,
                StudySolution, StudySensitivity, BoundDampingCurve, CurveOf<DampingPoint>,
                CurveOf<EnsembleMean>, CurveOf<StatedMean>, CurveOf<SpotStatistics>,
                CurveOf<FlowFactors>, CurveOf<ViscoelasticCycle>>();
  bind_laws();
}

}  // namespace salebra::python
