// SPDX-License-Identifier: GPL-3.0-or-later
// Pickle, copies and == of every class that is a value, and the door through which salebra._calls
// sees constructors.
#include <nanobind/stl/string.h>

#include <memory>
#include <salebra/base/version.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <salebra/contact/tangential/sliding_contact.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/damping/level_quadrature.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/profile.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/verification.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/peaks.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>

#include "bindings.hpp"
#include "interop/archive.hpp"
#include "interop/running.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

nb::bytes pickled(const std::string& bytes) { return nb::bytes(bytes.data(), bytes.size()); }

/// The bytes of a pickle that this version wrote.
std::string_view unpickled(const nb::tuple& state) {
  if (nb::len(state) != 2 || nb::cast<std::string>(state[0]) != version())
    throw InvalidInput("pickle", "was written by another version than salebra " +
                                     std::string(version()) +
                                     "; write results to files to keep them");
  const auto bytes = nb::borrow<nb::bytes>(state[1]);
  return {bytes.c_str(), bytes.size()};
}

/// Values of the class T of the library, which Python knows as Bound; made(T&&, Bound*) puts one
/// there.
template <class Bound, class Value, class Make>
void value_class(Value value, Make make) {
  auto bound = nb::borrow<nb::class_<Bound>>(nb::type<Bound>());
  bound.def(
      "__getstate__",
      [value](const Bound& self) {
        require_whole_if_spread(self, "a pickle");
        return nb::make_tuple(std::string(version()), pickled(bytes_of(value(self))));
      },
      nb::sig("def __getstate__(self) -> tuple[str, bytes]"));
  using T = std::remove_cvref_t<decltype(value(std::declval<const Bound&>()))>;
  bound.def(
      "__setstate__",
      [make](Bound* self, const nb::tuple& state) { make(self, value_of<T>(unpickled(state))); },
      nb::sig("def __setstate__(self, state: tuple[str, bytes], /) -> None"));
  bound.def(
      "__eq__",
      [value](const Bound& self, nb::handle other) {
        const Bound* known = nullptr;
        return nb::try_cast(other, known) && known != nullptr &&
               (known == &self || bytes_of(value(self)) == bytes_of(value(*known)));
      },
      nb::arg("other").none(), nb::sig("def __eq__(self, other: object, /) -> bool"));
}

template <class... T>
void value_classes() {
  (value_class<T>([](const T& self) -> const T& { return self; },
                  [](T* self, T&& value) { new (self) T(std::move(value)); }),
   ...);
}

// Pictures, by salebra._plots.
template <class... Bound>
void drawn_classes() {
  const auto define = []<class T>(std::type_identity<T>) {
    auto bound = nb::borrow<nb::class_<T>>(nb::type<T>());
    if (!nb::hasattr(bound, "plot")) plot_method(bound);
  };
  (define(std::type_identity<Bound>{}), ...);
}

// Tables: what has columns of one length is a list of its rows too, by salebra._show.
template <class... Bound>
void table_classes() {
  const auto define = []<class T>(std::type_identity<T>) {
    auto bound = nb::borrow<nb::class_<T>>(nb::type<T>());
    const auto ask = [](const char* function) {
      return [function](nb::handle_t<T> self) {
        return nb::module_::import_("salebra._show").attr(function)(self);
      };
    };
    bound.def("to_dataframe", ask("to_dataframe"),
              nb::sig("def to_dataframe(self) -> pandas.DataFrame"),
              "The columns as a pandas.DataFrame in SI units, which its `attrs[\"units\"]` names. "
              "Needs pandas.");
    if (!nb::hasattr(bound, "__len__"))
      bound.def("__len__", ask("length"), nb::sig("def __len__(self) -> int"));
    if (!nb::hasattr(bound, "__getitem__"))
      bound.def("__iter__", ask("rows"),
                nb::sig("def __iter__(self) -> collections.abc.Iterator[typing.Any]"),
                "The rows, each a named tuple of the columns.");
  };
  (define(std::type_identity<Bound>{}), ...);
}

}  // namespace

void bind_values(nb::module_& m) {
  value_classes<SpectralMoments, HeightStatistics, Summit, SummitList, SummitStatistics, Peak,
                ArealParameters, PowerSpectrum, RadialSpectrum, ProfilePsd, ConvertedPsd,
                HurstEstimate, IntervalEstimate, SelfAffineFit, CorrelationMap, Correlation,
                ScaleDependence, ReliabilityLimit, CoreParameters, HeightHistogram, Profile,
                Anisotropy, Forecast>();
  value_classes<ForceCurve, PressureWindow, ExponentialFit, ExponentialTest, WindowSensitivity,
                LocalDecayLength, ElasticBody, Material, BoundContact, ContactSpot, ContactSpots,
                FirstLoading, StickStiffness, PunchStiffness, PartialSlipReport, RoughnessShell,
                PerssonTheory::Asymptote, SummitEnsemble, AsperityContact, MonteCarloCurve>();
  value_classes<EqualFrequency, Drag, TwoFrequencies, SampledMotion, BoundDamping, ContactFacts,
                Premise, LargestMotion, Premises, LossWithSlip, JointLoss, SteadySliding, Slider,
                SliderMotion, SliderStability, SliderThreshold, SurfaceDamping, OscillatorDecay,
                DamperMap, FrictionMap, RegimeMap, StressMap, AsperityDamping, TrajectoryDamping,
                PronySeries, ViscoelasticIndentation, ViscoelasticDamping, ContactSetAt,
                CycleResult, LevelQuadratureResult>();
  value_classes<StudyConfiguration, DampingPoint, SpotStatistics, SurfacePicture, ModelResult,
                Realisation, EnsembleMean, StudyFlag, StudyResult, Check, Report>();
  value_class<Grid2D>([](const Grid2D& self) { return self; },
                      [](Grid2D* self, Grid2D&& grid) { new (self) Grid2D(grid); });
  value_class<BoundSurface>(
      [](const BoundSurface& self) -> const Surface& { return self.surface; },
      [](BoundSurface* self, Surface&& surface) { new (self) BoundSurface(std::move(surface)); });

  drawn_classes<ForceCurve, ExponentialFit, ContactSpots, SummitList, PowerSpectrum, CorrelationMap,
                ConvertedPsd, Profile, MonteCarloCurve, AsperityDamping, TrajectoryDamping,
                ViscoelasticDamping, ViscoelasticIndentation, ContactSetAt, SampledMotion,
                SliderMotion, SpotStatistics, SurfacePicture, ModelResult, Realisation, StudyResult,
                BearingCurve>();
  table_classes<ForceCurve, LocalDecayLength, ContactSpots, SummitList, RadialSpectrum, ProfilePsd,
                ConvertedPsd, Correlation, ScaleDependence, HeightHistogram, Profile,
                MonteCarloCurve, AsperityDamping, TrajectoryDamping, CycleResult, SampledMotion,
                SliderMotion>();

  m.def(
      "_answer_constructor",
      [](nb::handle type, const std::string& name) {
        // The function is looked up at each call: one held here would outlive the interpreter.
        nb::delattr(type, "__init__");
        nb::cpp_function_def(
            [name](nb::handle self, const nb::args& arguments, const nb::kwargs& keywords) {
              nb::module_::import_("salebra._calls")
                  .attr("construct")(name, self, arguments, keywords);
            },
            nb::scope(type), nb::name("__init__"), nb::is_method());
      },
      nb::arg("type"), nb::arg("name"),
      "Lets salebra._calls.construct(name, self, arguments, keywords) make the objects of a "
      "class.");
}

}  // namespace salebra::python
