#pragma once
// Paths of Python and of the system: any bytes but null, which a str holds as surrogates (PEP 383).
#include <nanobind/nanobind.h>

#include <string>

namespace heml::python {

/// Of a str, bytes or os.PathLike. Throws InputError where it holds a null character, TypeError for another type.
std::string path_text(nanobind::handle path);

/// A str of a path, or of a message that may hold one.
nanobind::object path_object(const std::string& path);

}  // namespace heml::python
