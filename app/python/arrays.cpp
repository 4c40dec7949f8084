#include <fmt/format.h>
#include <fmt/ranges.h>

#include <app/python/arrays.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <heml/base/error.hpp>

namespace heml::python {

namespace nb = nanobind;

namespace {

const char* name_of(ElementType type) {
  switch (type) {
    case ElementType::float64:
      return "float64";
    case ElementType::int32:
      return "int32";
    case ElementType::uint8:
      return "uint8";
  }
  return "";
}

bool has_type(const Py_buffer& view, ElementType type) {
  const char* format = view.format ? view.format : "B";
  if (*format == '=' || *format == '<' || *format == '@') ++format;
  switch (type) {
    case ElementType::float64:
      return std::strcmp(format, "d") == 0;
    case ElementType::int32:
      return view.itemsize == 4 && std::strchr("il", *format) != nullptr;
    case ElementType::uint8:
      return std::strcmp(format, "B") == 0;
  }
  return false;
}

std::string text_of(const Shape& shape) {
  std::vector<std::string> extents;
  for (const Py_ssize_t extent : shape) extents.push_back(extent < 0 ? "n" : fmt::format("{}", extent));
  return fmt::format("({}{})", fmt::join(extents, ", "), shape.size() == 1 ? "," : "");
}

bool fits(const Py_buffer& view, const Shape& shape) {
  if (view.ndim != static_cast<int>(shape.size())) return false;
  for (std::size_t axis = 0; axis < shape.size(); ++axis)
    if (shape[axis] >= 0 && view.shape[axis] != shape[axis]) return false;
  return true;
}

/// What is wrong with an array; empty: nothing.
std::string problem_of(const Py_buffer& view, const Shape& shape, ArrayMemory::Access access, ElementType type) {
  if (!has_type(view, type)) return fmt::format("has elements of type '{}'", view.format ? view.format : "B");
  if (!fits(view, shape)) return "has the shape " + text_of(Shape(view.shape, view.shape + view.ndim));
  if (!PyBuffer_IsContiguous(&view, 'C')) return "is not contiguous in C order";
  if (access == ArrayMemory::Access::write && view.readonly) return "is read-only";
  return {};
}

}  // namespace

nb::object make_array(const Shape& shape, ElementType type) {
  nb::list extents;
  for (const Py_ssize_t extent : shape) extents.append(extent);
  return nb::module_::import_("numpy").attr("empty")(nb::tuple(extents), name_of(type));
}

ArrayMemory::ArrayMemory(nb::handle array, const std::string& name, const Shape& shape, Access access,
                         ElementType type) {
  const std::string remedy = fmt::format("give a contiguous {}NumPy array, {} {}",
                                         access == Access::write ? "writable " : "", name_of(type), text_of(shape));
  if (!PyObject_CheckBuffer(array.ptr()) || PyObject_GetBuffer(array.ptr(), &view_, PyBUF_STRIDES | PyBUF_FORMAT)) {
    PyErr_Clear();
    throw InputError("", name, "is no array of numbers", remedy);
  }
  if (const std::string problem = problem_of(view_, shape, access, type); !problem.empty()) {
    PyBuffer_Release(&view_);
    throw InputError("", name, problem, remedy);
  }
}

ArrayMemory::~ArrayMemory() { PyBuffer_Release(&view_); }

nb::object filled(nb::object out, const Shape& shape, const std::function<void(double*)>& fill) {
  if (out.is_none()) out = make_array(shape);
  const ArrayMemory memory(out, "out", shape, ArrayMemory::Access::write);
  fill(memory.data<double>());
  return out;
}

nb::object input_array(nb::object given, const std::string& name, const Shape& shape) {
  if (PyList_Check(given.ptr()) || PyTuple_Check(given.ptr())) {
    try {
      given = nb::module_::import_("numpy").attr("array")(given, "float64");
    } catch (nb::python_error&) {
      throw InputError("", name, "is no array of numbers", fmt::format("give numbers, {}", text_of(shape)));
    }
  }
  const ArrayMemory memory(given, name, shape, ArrayMemory::Access::read);
  Py_ssize_t count = 1;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) count *= memory.extent(static_cast<int>(axis));
  const Py_ssize_t per_row = memory.extent(0) > 0 ? count / memory.extent(0) : 1;
  for (Py_ssize_t i = 0; i < count; ++i)
    if (!std::isfinite(memory.data<const double>()[i]))
      throw InputError("", fmt::format("{}[{}]", name, i / per_row), "is not finite", "give finite numbers");
  return given;
}

}  // namespace heml::python
