#include <app/python/errors.hpp>
#include <app/python/paths.hpp>
#include <heml/base/error.hpp>

namespace heml::python {

namespace nb = nanobind;

namespace {

// Live as long as the process: translators may run until its end.
PyObject *input_error = nullptr, *not_converged = nullptr, *unstable = nullptr;

PyObject* make_class(nb::module_& module, const char* name, const char* doc, PyObject* base, bool tells_state) {
  nb::dict members;
  if (tells_state) members["positions"] = members["report"] = nb::none();
  const std::string full_name = std::string("heml.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base, members.ptr());
  if (!made) nb::raise_python_error();
  module.attr(name) = nb::borrow(made);
  return made;
}

}  // namespace

void bind_errors(nb::module_& module) {
  input_error = make_class(module, "InputError",
                           "Bad input. The message names the file, the place in it, and what would be right.",
                           PyExc_ValueError, false);
  not_converged = make_class(module, "NotConverged",
                             "A solve or a step found no solution. `positions` (V, 3) in m and `report` hold what "
                             "was reached, where heml.solve() raised it.",
                             PyExc_RuntimeError, true);
  unstable = make_class(module, "Unstable",
                        "The motion became unstable, or left the range of a law. `positions` (V, 3) in m and "
                        "`report` hold what was reached, where heml.solve() raised it.",
                        PyExc_RuntimeError, true);
  nb::register_exception_translator([](const std::exception_ptr& error, void*) {
    try {
      std::rethrow_exception(error);
    } catch (const InputError& wrong) {
      PyErr_SetObject(input_error, path_object(wrong.what()).ptr());
    } catch (const UsageError& wrong) {
      PyErr_SetString(input_error, wrong.what());
    }
  });
}

void raise_halt(const World& halted, nb::object positions, nb::object report) {
  const bool is_unsolved =
      halted.setup().solver.is_static() || halted.halt()->cause == StopReason::Cause::not_converged;
  PyObject* kind = is_unsolved ? not_converged : unstable;
  nb::object error = nb::borrow(kind)(halted.halt()->message.c_str());
  error.attr("positions") = positions;
  error.attr("report") = report;
  PyErr_SetObject(kind, error.ptr());
  throw nb::python_error();
}

void check_signals() {
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

}  // namespace heml::python
