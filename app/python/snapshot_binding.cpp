// heml.Snapshot
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <app/python/bindings.hpp>
#include <app/python/paths.hpp>

namespace heml::python {

namespace nb = nanobind;

namespace {

nb::tuple pickled_snapshot(const Snapshot& snapshot) {
  const Snapshot::Pickled state = snapshot.pickled();
  return nb::make_tuple(state.build, state.kernel_revision, state.recording, path_object(state.file),
                        state.moment.ticks, state.moment.time, state.moment.next_events, state.moment.hash);
}

void unpickle_snapshot(Snapshot& snapshot, const nb::tuple& state) {
  if (nb::len(state) != 8) throw nb::value_error("no state of a heml.Snapshot of this version");
  Snapshot::Pickled pickled;
  pickled.build = nb::cast<std::string>(state[0]);
  pickled.kernel_revision = nb::cast<long>(state[1]);
  pickled.recording = nb::cast<std::string>(state[2]);
  pickled.file = path_text(state[3]);
  pickled.moment = {nb::cast<long>(state[4]), nb::cast<double>(state[5]), nb::cast<long>(state[6]),
                    nb::cast<std::uint64_t>(state[7]), false};
  new (&snapshot) Snapshot(std::move(pickled));
}

}  // namespace

void bind_snapshot(nb::module_& module) {
  nb::class_<Snapshot>(module, "Snapshot",
                       "The whole state of a world at one moment, for World.restore(). In its process it is a copy of "
                       "the state. Pickled it is a recording that leads there: another process plays it when it "
                       "first restores it, to the same bits. Refused by another build.")
      .def_prop_ro(
          "time", [](const Snapshot& snapshot) { return snapshot.moment().time; }, "Simulated time, s.")
      .def_prop_ro(
          "ticks", [](const Snapshot& snapshot) { return snapshot.moment().ticks; }, "Ticks done.")
      .def_prop_ro(
          "build", [](const Snapshot& snapshot) { return snapshot.build(); },
          "Compiler and processor family that it was taken with.")
      .def("__getstate__", &pickled_snapshot)
      .def("__setstate__", &unpickle_snapshot);
}

}  // namespace heml::python
