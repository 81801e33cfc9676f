// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <salebra/base/communicator.hpp>
#include <salebra/base/describe.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/progress.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/stop_check.hpp"

/// How long calls run: other Python threads go on, Ctrl-C stops them within a second, and progress
/// is told.
namespace salebra::python {

namespace nb = nanobind;

/// ProgressReport with a text of its own.
struct Report {
  std::string stage;
  double fraction = 0;
  int step = 0;
  double residual = 0;
};

constexpr void describe(auto&& visit, std::type_identity<Report>) {
  visit(&Report::stage, Kept{"stage", "such as 'contact', 'sweep', 'realisation'"});
  visit(&Report::fraction,
        Kept{"fraction", "done of this stage, 0 … 1; a guess where the end is not known"});
  visit(&Report::step, Kept{"step", "iterations or items done"});
  visit(&Report::residual, Kept{"residual", "of an iteration; 0 where there is none"});
}

/// The argument `progress`: False, True for a bar of tqdm, or a function of a ProgressReport that
/// returns False to stop.
struct ProgressArgument {
  nb::object value = nb::bool_(false);
};

/// Makes a Progress of the argument. A Python error in it, Ctrl-C included, stops the work and is
/// raised by rethrow().
class ProgressBridge {
 public:
  /// The first of several processes shows a bar.
  explicit ProgressBridge(const ProgressArgument& argument, const Communicator& communicator = {});
  ProgressBridge(const ProgressBridge&) = delete;
  ProgressBridge& operator=(const ProgressBridge&) = delete;
  ~ProgressBridge();

  /// Call it without the interpreter's lock.
  Progress progress();
  void rethrow();
  bool failed() const { return error_.has_value(); }
  /// Nothing is left to tell: the bar is closed, at its end where the work was done.
  void finish(bool done);

 private:
  bool tell(const ProgressReport& report);

  nb::object tell_;
  nb::object close_;
  std::optional<nb::python_error> error_;
  std::chrono::steady_clock::time_point last_{};
};

/// work(Progress) without the interpreter's lock. Collective over `ranks`: where a Python error
/// stopped the work in one process, the others throw Interrupted.
template <class Work>
auto interruptible(const ProgressArgument& argument, Work&& work, const Communicator& communicator = {}) {
  ProgressBridge bridge(argument, communicator);
  std::exception_ptr failure;
  std::optional<decltype(work(Progress{}))> result;
  {
    nb::gil_scoped_release unlocked;
    try {
      result.emplace(std::forward<Work>(work)(bridge.progress()));
      if (!communicator.all_agree(!bridge.failed()))
        throw Interrupted("another process has stopped the work");
    } catch (...) {
      failure = std::current_exception();
    }
  }
  bridge.finish(!failure);
  bridge.rethrow();
  if (failure) std::rethrow_exception(failure);
  return std::move(*result);
}

/// A Progress for what a call without an argument `progress` leads to: Ctrl-C leaves the library as
/// the Python exception that it is.
Progress signals();

/// A UserWarning where the user called; throws what a filter of warnings makes of it.
void warn_user(const std::string& text);

/// work() without the interpreter's lock, for what reports no progress. Ctrl-C stops its loops, which
/// ask stop_if_asked(), and is raised.
template <class Work>
auto unlocked(Work&& work) {
  return interruptible({}, [&](const Progress& progress) {
    const detail::StopCheck check([&] { return !progress({}); });
    if constexpr (std::is_void_v<decltype(work())>) {
      std::forward<Work>(work)();
      return std::monostate();
    } else {
      return std::forward<Work>(work)();
    }
  });
}

}  // namespace salebra::python

namespace nanobind::detail {

template <>
struct type_caster<salebra::python::ProgressArgument> {
  NB_TYPE_CASTER(salebra::python::ProgressArgument,
                 const_name("bool | collections.abc.Callable[[") +
                     const_name<salebra::python::Report>() + const_name("], object]"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept {
    if (!source.is_none() && !PyBool_Check(source.ptr()) && !PyCallable_Check(source.ptr()))
      return false;
    value.value = borrow(source);
    return true;
  }
  static handle from_cpp(const salebra::python::ProgressArgument& argument, rv_policy,
                         cleanup_list*) noexcept {
    return object(argument.value).release();
  }
};

}  // namespace nanobind::detail
