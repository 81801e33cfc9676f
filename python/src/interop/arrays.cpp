// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion between NumPy arrays and fields, without a copy if the layout of the memory allows it.
#include "interop/arrays.hpp"

#include <cstring>
#include <memory>
#include <salebra/base/error.hpp>
#include <string_view>

namespace salebra::python {
namespace {

// The three words of which Eigen's dynamic arrays consist. Eigen's Array cannot use memory that it
// did not allocate, but the library takes surfaces as Arrays, and a call must not copy 4096²
// heights. So these words are set directly. The layout is checked below. They are reset before
// Eigen could free memory that it does not own.
struct Storage {
  double* data;
  Index rows, columns;
};
static_assert(sizeof(Field) == sizeof(Storage));

void set_storage(Field& field, const Storage& storage) {
  std::memcpy(static_cast<void*>(&field), &storage, sizeof storage);
}

bool layout_is_known() {
  const Field field(2, 3);
  Storage storage{};
  std::memcpy(&storage, static_cast<const void*>(&field), sizeof storage);
  return storage.data == field.data() && storage.rows == 2 && storage.columns == 3;
}

// A two-dimensional contiguous array of doubles as an ndarray, which gives its pointer and shape.
nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu> doubles(
    const nb::object& array) {
  return nb::cast<nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>>(array,
                                                                                         false);
}

}  // namespace

const double* FieldArgument::data() const { return doubles(array).data(); }
Index FieldArgument::rows() const { return static_cast<Index>(doubles(array).shape(0)); }
Index FieldArgument::columns() const { return static_cast<Index>(doubles(array).shape(1)); }
Field FieldArgument::copy() const { return Eigen::Map<const Field>(data(), rows(), columns()); }

bool adopt_memory(Field& field, const double* data, Index rows, Index columns) {
  static const bool known = layout_is_known();
  constexpr std::uintptr_t alignment = EIGEN_MAX_ALIGN_BYTES > 0 ? EIGEN_MAX_ALIGN_BYTES : 1;
  if (!known || reinterpret_cast<std::uintptr_t>(data) % alignment != 0 || rows * columns == 0)
    return false;
  field.resize(0, 0);
  // The cast is safe, since the library takes surfaces as constants.
  set_storage(field, {const_cast<double*>(data), rows, columns});
  return true;
}

void release_memory(Field& field) { set_storage(field, {nullptr, 0, 0}); }

BorrowedField::BorrowedField(const FieldArgument& argument)
    : borrowed_(adopt_memory(field_, argument.data(), argument.rows(), argument.columns())) {
  if (!borrowed_) field_ = argument.copy();
}
BorrowedField::~BorrowedField() {
  if (borrowed_) release_memory(field_);
}

Array2 view(const Field& field, nb::handle owner) {
  return {const_cast<double*>(field.data()),
          {static_cast<std::size_t>(field.rows()), static_cast<std::size_t>(field.cols())},
          owner};
}
Flags2 view(const ContactSet& set, nb::handle owner) {
  return {const_cast<bool*>(set.data()),
          {static_cast<std::size_t>(set.rows()), static_cast<std::size_t>(set.cols())},
          owner};
}
Array1 view(const std::vector<double>& values, nb::handle owner) {
  return {const_cast<double*>(values.data()), {values.size()}, owner};
}
Counts1 view(const std::vector<Index>& values, nb::handle owner) {
  static_assert(sizeof(Index) == sizeof(std::int64_t));
  return {
      reinterpret_cast<std::int64_t*>(const_cast<Index*>(values.data())), {values.size()}, owner};
}

Array1 array_of(std::vector<double> values) {
  auto owned = std::make_unique<std::vector<double>>(std::move(values));
  double* data = owned->data();
  const std::size_t size = owned->size();
  nb::capsule owner(owned.release(), [](void* pointer) noexcept {
    delete static_cast<std::vector<double>*>(pointer);
  });
  return {data, {size}, owner};
}
Array2 array_of(Field field) {
  auto owned = std::make_unique<Field>(std::move(field));
  const Field* held = owned.get();
  nb::capsule owner(owned.release(),
                    [](void* pointer) noexcept { delete static_cast<Field*>(pointer); });
  return view(*held, owner);
}

const double* data_of(const Numbers& numbers) {
  return nb::cast<nb::ndarray<const double, nb::c_contig, nb::device::cpu>>(numbers.array, false)
      .data();
}
nb::object empty_like(const Numbers& numbers, double*& data, std::size_t& size) {
  nb::object result = nb::module_::import_("numpy").attr("empty_like")(numbers.array);
  const auto view = nb::cast<nb::ndarray<double, nb::c_contig, nb::device::cpu>>(result, false);
  data = view.data();
  size = view.size();
  return result;
}

}  // namespace salebra::python

namespace nanobind::detail {

bool as_array(handle source, const char* type, bool contiguous, object& array) noexcept {
  // numpy.asarray would make an array of objects of texts and None, or fail.
  if (source.is_none() || PyUnicode_Check(source.ptr()) || PyBytes_Check(source.ptr()))
    return false;
  // numpy.asarray would drop the unit of a quantity with a unit; salebra._calls converts such
  // quantities.
  if (hasattr(source, "to") && (hasattr(source, "units") || hasattr(source, "unit"))) return false;
  // Returns the type of the exception to raise; nullptr if there is none.
  const auto convert = [&]() -> PyObject* {
    try {
      const module_ numpy = module_::import_("numpy");
      object given = borrow(source);
      const bool masked = isinstance(source, numpy.attr("ma").attr("MaskedArray"));
      if (!masked) given = numpy.attr("asarray")(given);
      // numpy.asarray would drop an imaginary part.
      if (given.attr("dtype").attr("kind").equal(str("c"))) return PyExc_TypeError;
      // numpy.asarray would use the values of masked elements.
      if (masked)
        given = std::string_view(type) == "bool"
                    ? given.attr("filled")(false)
                    : given.attr("astype")(type).attr("filled")(numpy.attr("nan"));
      array =
          contiguous ? numpy.attr("asarray")(given, type, "C") : numpy.attr("asarray")(given, type);
      return nullptr;
    } catch (python_error& error) {
      return error.matches(PyExc_KeyboardInterrupt) ? PyExc_KeyboardInterrupt : PyExc_Exception;
    }
  };
  PyObject* raised = convert();
  if (raised == PyExc_KeyboardInterrupt) {
    // A type caster of nanobind cannot raise an exception. If Ctrl-C came during the conversion, it
    // is set again, so that the call, which checks for signals, raises KeyboardInterrupt.
    raised = convert();
    PyErr_SetInterrupt();
  }
  // False makes nanobind raise a TypeError that lists the types that the function accepts.
  return raised == nullptr;
}

bool type_caster<salebra::python::FieldArgument>::from_python(handle source, uint32_t,
                                                              cleanup_list*) noexcept {
  return as_array(source, "float64", true, value.array) && cast<int>(value.array.attr("ndim")) == 2;
}

bool type_caster<salebra::python::ContactArgument>::from_python(handle source, uint32_t,
                                                                cleanup_list*) noexcept {
  object array;
  if (!as_array(source, "bool", true, array)) return false;
  try {
    const auto flags = cast<ndarray<const bool, ndim<2>, c_contig, device::cpu>>(array, false);
    value.set = Eigen::Map<const salebra::ContactSet>(flags.data(), Eigen::Index(flags.shape(0)),
                                                      Eigen::Index(flags.shape(1)));
    return true;
  } catch (...) {
    return false;
  }
}

bool type_caster<salebra::python::Values>::from_python(handle source, uint32_t,
                                                       cleanup_list*) noexcept {
  object array;
  if (!as_array(source, "float64", true, array)) return false;
  try {
    const auto numbers = cast<ndarray<const double, c_contig, device::cpu>>(array, false);
    if (numbers.ndim() > 1) return false;
    value.values.assign(numbers.data(), numbers.data() + numbers.size());
    return true;
  } catch (...) {
    return false;
  }
}

bool type_caster<salebra::python::Numbers>::from_python(handle source, uint32_t,
                                                        cleanup_list*) noexcept {
  if (!as_array(source, "float64", true, value.array)) return false;
  try {
    value.scalar = cast<int>(value.array.attr("ndim")) == 0;
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace nanobind::detail
