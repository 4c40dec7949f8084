#include <fmt/format.h>

#include <app/python/json_objects.hpp>
#include <cmath>
#include <heml/base/error.hpp>

namespace heml::python {

namespace nb = nanobind;

namespace {

constexpr int max_depth = 100;  // of lists and dicts in one another, which may hold themselves

[[noreturn]] void refuse(nb::handle object, const std::string& file, const std::string& place) {
  throw InputError(file, place, fmt::format("is of type {}", nb::str(object.type().attr("__name__")).c_str()),
                   "give dicts, lists, numbers, text, True, False or None");
}

std::string text_from(nb::handle object, const std::string& file, const std::string& place) {
  Py_ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(object.ptr(), &size);
  if (!text) {
    PyErr_Clear();
    throw InputError(file, place, "is not Unicode text");
  }
  return {text, static_cast<std::size_t>(size)};
}

Json number_from(nb::handle object, const std::string& file, const std::string& place) {
  if (PyFloat_Check(object.ptr())) {
    const double value = PyFloat_AsDouble(object.ptr());
    if (!std::isfinite(value)) throw InputError(file, place, fmt::format("is {}", value), "give a finite number");
    return value;
  }
  const long long value = PyLong_AsLongLong(object.ptr());
  if (value == -1 && PyErr_Occurred()) {
    PyErr_Clear();
    throw InputError(file, place, "is too large a whole number");
  }
  return value;
}

Json convert(nb::handle object, const std::string& file, const std::string& place, int depth) {
  if (depth > max_depth) throw InputError(file, place, "is nested too deep");
  if (object.is_none()) return nullptr;
  if (PyBool_Check(object.ptr())) return object.ptr() == Py_True;
  if (PyFloat_Check(object.ptr()) || PyLong_Check(object.ptr())) return number_from(object, file, place);
  if (PyUnicode_Check(object.ptr())) return text_from(object, file, place);
  if (PyDict_Check(object.ptr())) {
    Json json = Json::object();
    for (const auto [key, value] : nb::borrow<nb::dict>(object)) {
      if (!PyUnicode_Check(key.ptr())) refuse(key, file, place.empty() ? "a key" : place + ": a key");
      const std::string name = text_from(key, file, place);
      json[name] = convert(value, file, place.empty() ? name : place + "." + name, depth + 1);
    }
    return json;
  }
  if (PyList_Check(object.ptr()) || PyTuple_Check(object.ptr())) {
    Json json = Json::array();
    for (nb::handle entry : nb::borrow<nb::sequence>(object))
      json.push_back(convert(entry, file, fmt::format("{}[{}]", place, json.size()), depth + 1));
    return json;
  }
  if (nb::hasattr(object, "tolist")) return convert(object.attr("tolist")(), file, place, depth + 1);
  if (nb::hasattr(object, "__fspath__")) return convert(object.attr("__fspath__")(), file, place, depth + 1);
  refuse(object, file, place);
}

}  // namespace

Json json_from(nb::handle object, const std::string& file, const std::string& place) {
  return convert(object, file, place, 0);
}

nb::object object_from(const Json& json) {
  switch (json.type()) {
    case Json::value_t::null:
    case Json::value_t::discarded:
    case Json::value_t::binary:
      return nb::none();
    case Json::value_t::boolean:
      return nb::bool_(json.get<bool>());
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return nb::int_(json.get<long long>());
    case Json::value_t::number_float:
      return nb::float_(json.get<double>());
    case Json::value_t::string: {
      const auto& text = json.get_ref<const std::string&>();
      return nb::str(text.c_str(), text.size());
    }
    case Json::value_t::array: {
      nb::list list;
      for (const Json& entry : json) list.append(object_from(entry));
      return list;
    }
    case Json::value_t::object: {
      nb::dict dict;
      for (const auto& [key, value] : json.items()) dict[nb::str(key.c_str(), key.size())] = object_from(value);
      return dict;
    }
  }
  return nb::none();
}

}  // namespace heml::python
