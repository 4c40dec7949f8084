#pragma once
// The module's exceptions: heml.InputError (ValueError), heml.NotConverged and heml.Unstable (RuntimeError).
#include <nanobind/nanobind.h>

#include <heml/world/world.hpp>

namespace heml::python {

/// Adds the classes, and translates what the engine throws: InputError and UsageError.
void bind_errors(nanobind::module_& module);

/// Throws why a world has halted: NotConverged where no solution was found, as in all static solves, else Unstable.
/// positions, report: what was reached, as attributes of the exception.
[[noreturn]] void raise_halt(const World& halted, nanobind::object positions = nanobind::none(),
                             nanobind::object report = nanobind::none());

/// Lets handlers of signals run, and throws what they raise: KeyboardInterrupt. The caller holds the GIL.
void check_signals();

}  // namespace heml::python
