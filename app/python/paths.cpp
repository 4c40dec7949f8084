#include <app/python/paths.hpp>
#include <heml/base/error.hpp>

namespace heml::python {

namespace nb = nanobind;

std::string path_text(nb::handle path) {
  const nb::bytes bytes = nb::steal<nb::bytes>(nb::module_::import_("os").attr("fsencode")(path).release());
  std::string text(bytes.c_str(), bytes.size());
  if (const std::size_t null = text.find('\0'); null != std::string::npos)
    throw InputError(text.substr(0, null), "", "a null character follows in the path", "a path has none");
  return text;
}

nb::object path_object(const std::string& path) {
  return nb::steal(PyUnicode_DecodeUTF8(path.data(), static_cast<Py_ssize_t>(path.size()), "surrogateescape"));
}

}  // namespace heml::python
