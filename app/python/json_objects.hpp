#pragma once
// JSON from and to Python objects.
#include <nanobind/nanobind.h>

#include <heml/scenario/json_text.hpp>
#include <string>

namespace heml::python {

/// Of dicts, lists, tuples, numbers, text, paths, and arrays or numbers of NumPy. Throws InputError naming `file` and
/// the key path of anything else, and of numbers that are not finite.
Json json_from(nanobind::handle object, const std::string& file, const std::string& place = "");

nanobind::object object_from(const Json& json);

}  // namespace heml::python
