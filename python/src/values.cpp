// SPDX-License-Identifier: GPL-3.0-or-later
// Pickle, copies and == of grids and surfaces; pictures and tables of results; and the function by
// which salebra._calls replaces constructors.
#include "interop/values.hpp"

#include <nanobind/stl/string.h>

#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/generators/profile.hpp>
#include <salebra/study/study.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/scale_dependence.hpp>

#include "bindings.hpp"
#include "interop/curves.hpp"
#include "interop/damping.hpp"
#include "interop/surface.hpp"
#include "surface/psd_convention.hpp"

namespace salebra::python {

nb::tuple pickled(const std::string& bytes) {
  return nb::make_tuple(std::string(version()), nb::bytes(bytes.data(), bytes.size()));
}

std::string_view unpickled(const nb::tuple& state) {
  if (nb::len(state) != 2 || nb::cast<std::string>(state[0]) != version())
    throw InvalidInput("pickle", "was written by another version than salebra " +
                                     std::string(version()) +
                                     "; write results to files to keep them");
  const auto bytes = nb::borrow<nb::bytes>(state[1]);
  return {bytes.c_str(), bytes.size()};
}

namespace {

// Lets classes whose columns have one length behave as tables and as sequences of rows, by
// salebra._show.
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
              "The columns as a pandas.DataFrame in SI units, listed in its `attrs[\"units\"]`. "
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
  auto grid = nb::borrow<nb::class_<Grid2D>>(nb::type<Grid2D>());
  value_methods(grid);
  auto surface = nb::borrow<nb::class_<BoundSurface>>(nb::type<BoundSurface>());
  value_methods(
      surface, [](const BoundSurface& self) -> const Surface& { return self.surface; },
      [](BoundSurface* self, Surface&& given) { new (self) BoundSurface(std::move(given)); });

  table_classes<ForceCurve, LocalDecayLength, ContactSpots, SummitList, RadialSpectrum, ProfilePsd,
                ConvertedPsd, Correlation, ScaleDependence, HeightHistogram, Profile,
                MonteCarloCurve, AsperityDamping, TrajectoryDamping, CycleResult, SampledMotion,
                SliderMotion, BoundDampingCurve, CurveOf<EnsembleMean>, CurveOf<StatedMean>,
                CurveOf<DampingPoint>, CurveOf<SpotStatistics>, CurveOf<FlowFactors>,
                CurveOf<ViscoelasticCycle>>();

  m.def(
      "_answer_constructor",
      [](nb::handle type, const std::string& name) {
        // The Python function is looked up at each call: if it were kept here, it would outlive the
        // interpreter.
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
