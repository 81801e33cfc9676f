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

/// How long calls run: other Python threads continue, Ctrl-C stops the call within a second, and
/// progress is reported.
namespace salebra::python {

namespace nb = nanobind;

/// A ProgressReport that owns its text `stage`.
struct Report {
  std::string stage;
  double fraction = 0;
  int step = 0;
  double residual = 0;
};

constexpr void describe(auto&& visit, std::type_identity<Report>) {
  visit(&Report::stage,
        Kept{"stage", "name of the stage, such as 'contact', 'sweep', 'realisation'"});
  visit(&Report::fraction,
        Kept{"fraction", "done fraction of the stage, 0 … 1; an estimate if the end is unknown"});
  visit(&Report::step, Kept{"step", "iterations or items done"});
  visit(&Report::residual, Kept{"residual", "residual of an iteration; 0 if there is none"});
}

/// The argument `progress`: False, True for a progress bar of tqdm, or a function of a
/// ProgressReport that returns False to stop the call.
struct ProgressArgument {
  nb::object value = nb::bool_(false);
};

/// Makes a Progress callback of the argument `progress`. A Python error in the user's function, or
/// Ctrl-C, stops the work; rethrow() then raises it.
class ProgressBridge {
 public:
  /// communicator: of the processes that compute together; only the first of them shows a bar.
  explicit ProgressBridge(const ProgressArgument& argument, const Communicator& communicator = {});
  ProgressBridge(const ProgressBridge&) = delete;
  ProgressBridge& operator=(const ProgressBridge&) = delete;
  ~ProgressBridge();

  /// The callback. The caller must not hold the interpreter's lock.
  Progress progress();
  void rethrow();
  bool failed() const { return error_.has_value(); }
  /// Closes the bar, at 100 % if the work was done.
  void finish(bool done);

 private:
  bool tell(const ProgressReport& report);

  nb::object tell_;
  nb::object close_;
  std::optional<nb::python_error> error_;
  std::chrono::steady_clock::time_point last_{};
};

/// Runs work(Progress) without the interpreter's lock. All processes of the communicator must call:
/// if a Python error stops the work in one process, the others throw Interrupted.
template <class Work>
auto interruptible(const ProgressArgument& argument, Work&& work,
                   const Communicator& communicator = {}) {
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

/// A Progress callback for calls without an argument `progress`. On Ctrl-C it throws, and Python
/// raises KeyboardInterrupt.
Progress signals();

/// Issues a UserWarning that refers to the line of the user. Throws if the user's warning filters
/// turn it into an error.
void warn_user(const std::string& text);

/// Runs work() without the interpreter's lock and without progress reports. Ctrl-C stops loops of
/// the library that call stop_if_asked(), and raises KeyboardInterrupt.
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
