// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <functional>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/contact_set.hpp>
#include <string>
#include <string_view>
#include <vector>

/// NumPy arrays and fields of the library share memory, in arguments and in results. C-contiguous
/// float64 arrays are not copied.
namespace salebra::python {

namespace nb = nanobind;

using Array1 = nb::ndarray<nb::numpy, double, nb::ndim<1>, nb::device::cpu>;
using Array2 = nb::ndarray<nb::numpy, double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Flags1 = nb::ndarray<nb::numpy, bool, nb::ndim<1>, nb::device::cpu>;
using Flags2 = nb::ndarray<nb::numpy, bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Counts1 = nb::ndarray<nb::numpy, std::int64_t, nb::ndim<1>, nb::device::cpu>;

/// An argument that is a field: anything that numpy.asarray accepts. A C-contiguous float64 array
/// is not copied.
struct FieldArgument {
  nb::object array;  ///< numpy.ndarray, two-dimensional, C-contiguous, float64
  const double* data() const;
  Index rows() const;
  Index columns() const;
  Field copy() const;
};

/// An argument that is a contact set: an array (nx, ny) of truth values.
struct ContactArgument {
  ContactSet set;
};

/// An argument that is a list of numbers: anything one-dimensional that numpy.asarray accepts, or a
/// single number.
struct Values {
  std::vector<double> values;
};

/// An argument that is a number or an array of any shape, for functions whose result has the same
/// shape.
struct Numbers {
  nb::object array;  ///< numpy.ndarray, float64, C-contiguous
  bool scalar = false;
};
/// Calls function(number) for each number, and returns the results in the shape of the argument.
template <class Function>
nb::object for_each_number(const Numbers& numbers, const Function& function);

/// Defines a method from function(object, number). The method also accepts an array, and then
/// returns an array.
template <class Class, class Function>
void number_method(Class& bound, const std::string& name, const std::string& argument,
                   Function function, const char* description);

/// A Field in the memory of a NumPy array. The array must outlive this object, and the size of the
/// field must not change. If the memory is not aligned as Eigen requires, the field is a copy.
class BorrowedField {
 public:
  explicit BorrowedField(const FieldArgument& argument);
  BorrowedField(const BorrowedField&) = delete;
  BorrowedField& operator=(const BorrowedField&) = delete;
  ~BorrowedField();

  const Field& field() const { return field_; }
  bool shares() const { return borrowed_; }

 private:
  Field field_;
  bool borrowed_;
};

/// adopt_memory() lets a Field use the memory at `data`, which it does not own; release_memory()
/// ends this before the Field is destroyed. adopt_memory() returns false, and does nothing, if the
/// memory is not suitable.
bool adopt_memory(Field& field, const double* data, Index rows, Index columns);
void release_memory(Field& field);

/// NumPy arrays that show the memory of `owner` and keep it alive.
Array2 view(const Field& field, nb::handle owner);
Flags2 view(const ContactSet& set, nb::handle owner);
Array1 view(const std::vector<double>& values, nb::handle owner);
Counts1 view(const std::vector<Index>& values, nb::handle owner);

/// One member of every record in a list, as a NumPy array with strides that shows the records'
/// memory.
template <class Record, class Member>
nb::ndarray<nb::numpy, Member, nb::ndim<1>, nb::device::cpu> column_view(
    const std::vector<Record>& records, Member Record::*member, nb::handle owner) {
  static Member nothing{};
  static_assert(sizeof(Record) % sizeof(Member) == 0);
  const std::size_t count = records.size();
  const std::int64_t stride = sizeof(Record) / sizeof(Member);
  auto* first = records.empty() ? &nothing : const_cast<Member*>(&(records.front().*member));
  return {first, {count}, owner, {stride}};
}

/// NumPy arrays that own the given numbers.
Array1 array_of(std::vector<double> values);
Array2 array_of(Field field);

/// Defines a read-only property that is a view of a member of the bound object.
template <class Bound, class Member>
void view_property(nb::class_<Bound>& bound, const char* name, Member member,
                   const char* description) {
  bound.def_prop_ro(
      name,
      [member](nb::handle_t<Bound> self) {
        return view(std::invoke(member, nb::cast<const Bound&>(nb::handle(self))), self);
      },
      description);
}
template <class Bound, class Record, class Member>
void column_property(nb::class_<Bound>& bound, const char* name,
                     std::vector<Record> Bound::*records, Member Record::*member,
                     const char* description) {
  bound.def_prop_ro(
      name,
      [records, member](nb::handle_t<Bound> self) {
        return column_view(nb::cast<const Bound&>(nb::handle(self)).*records, member, self);
      },
      description);
}

nb::object empty_like(const Numbers& numbers, double*& data, std::size_t& size);
const double* data_of(const Numbers& numbers);

template <class Function>
nb::object for_each_number(const Numbers& numbers, const Function& function) {
  const double* in = data_of(numbers);
  if (numbers.scalar) return nb::cast(static_cast<double>(function(*in)));
  double* out = nullptr;
  std::size_t size = 0;
  nb::object result = empty_like(numbers, out, size);
  for (std::size_t i = 0; i < size; ++i) out[i] = function(in[i]);
  return result;
}

template <class Class, class Function>
void number_method(Class& bound, const std::string& name, const std::string& argument,
                   Function function, const char* description) {
  const std::string signature =
      "def " + name + "(self, " + argument + ": numpy.typing.ArrayLike) -> typing.Any";
  bound.def(
      name.c_str(),
      [function](const typename Class::Type& self, const Numbers& numbers) {
        return for_each_number(numbers,
                               [&](double value) { return std::invoke(function, self, value); });
      },
      nb::arg(argument.c_str()), nb::sig(signature.c_str()), description);
}

}  // namespace salebra::python

namespace nanobind::detail {

/// Converts an object with numpy.asarray to an array of the given type. Returns false for an object
/// that cannot be converted.
bool as_array(handle source, const char* type, bool contiguous, object& array) noexcept;

template <>
struct type_caster<salebra::python::FieldArgument> {
  NB_TYPE_CASTER(salebra::python::FieldArgument, const_name("numpy.typing.ArrayLike"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept;
  static handle from_cpp(const salebra::python::FieldArgument& argument, rv_policy,
                         cleanup_list*) noexcept {
    return object(argument.array).release();
  }
};

template <>
struct type_caster<salebra::python::ContactArgument> {
  NB_TYPE_CASTER(salebra::python::ContactArgument, const_name("numpy.typing.ArrayLike"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept;
};

template <>
struct type_caster<salebra::python::Values> {
  NB_TYPE_CASTER(salebra::python::Values, const_name("numpy.typing.ArrayLike"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept;
};

template <>
struct type_caster<salebra::python::Numbers> {
  NB_TYPE_CASTER(salebra::python::Numbers, const_name("numpy.typing.ArrayLike"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept;
};

}  // namespace nanobind::detail
