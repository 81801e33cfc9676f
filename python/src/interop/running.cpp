// SPDX-License-Identifier: GPL-3.0-or-later
// Progress callbacks in Python, and signals, while the library computes without the interpreter's
// lock.
#include "interop/running.hpp"

namespace salebra::python {
namespace {

// Time between two checks for signals and progress. It is short for a person and long enough to
// cost nothing: to take the interpreter's lock may need 5 ms while another thread has it.
constexpr auto interval = std::chrono::milliseconds(100);

}  // namespace

ProgressBridge::ProgressBridge(const ProgressArgument& argument, const Communicator& communicator) {
  const nb::object& value = argument.value;
  if (value.is_none() || value.is(nb::bool_(false))) return;
  if (value.is(nb::bool_(true))) {
    if (!communicator.is_root()) return;
    nb::object bar = nb::module_::import_("salebra._progress").attr("Bar")();
    tell_ = bar.attr("tell");
    close_ = bar.attr("close");
  } else {
    tell_ = value;
  }
}

ProgressBridge::~ProgressBridge() = default;

Progress ProgressBridge::progress() {
  return [this](const ProgressReport& report) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < interval) return !error_.has_value();
    last_ = now;
    return tell(report);
  };
}

bool ProgressBridge::tell(const ProgressReport& report) {
  nb::gil_scoped_acquire locked;
  if (error_) return false;
  try {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (!tell_.is_valid()) return true;
    const nb::object answer =
        tell_(Report{std::string(report.stage), report.fraction, report.step, report.residual});
    return !answer.is(nb::bool_(false));
  } catch (nb::python_error& error) {
    error_.emplace(std::move(error));
    return false;
  }
}

void warn_user(const std::string& text) {
  // The warning refers to the second caller, the line of the user; the first is the wrapper in
  // _calls.py.
  constexpr int frames = 2;
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), frames) != 0) throw nb::python_error();
}

Progress signals() {
  return [](const ProgressReport&) {
    thread_local std::chrono::steady_clock::time_point last;
    const auto now = std::chrono::steady_clock::now();
    if (now - last < interval) return true;
    last = now;
    const nb::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return true;
  };
}

void ProgressBridge::finish(bool done) {
  if (close_.is_valid()) close_(done && !error_);
}

void ProgressBridge::rethrow() {
  if (error_) {
    nb::python_error error = std::move(*error_);
    error_.reset();
    throw error;
  }
}

}  // namespace salebra::python
